"""The terms of a sequential test: two Elo differences and two error rates."""

import math
from dataclasses import dataclass
from typing import Any, Self

from tournament.checks import Checker
from tournament.errors import InvalidSpec

MOST_ELO = 1000.0

_check = Checker(InvalidSpec)


@dataclass(frozen=True, slots=True)
class SprtTerms:
    """A sequential probability ratio test of the first entrant against the second.

    Attributes:
        elo0, elo1: the Elo differences of the null hypothesis and of its alternative, elo0 < elo1, logistic Elo.
        alpha: probability of accepting elo1 when elo0 is true; beta: of accepting elo0 when elo1 is true.

    Raises:
        InvalidSpec: naming the field, its value and what is allowed.
    """

    elo0: float = 0.0
    elo1: float = 20.0
    alpha: float = 0.05
    beta: float = 0.05

    def __post_init__(self) -> None:
        for name in ("elo0", "elo1"):
            object.__setattr__(self, name, _check.number(f"sprt.{name}", getattr(self, name), -MOST_ELO, MOST_ELO))
        for name in ("alpha", "beta"):
            object.__setattr__(self, name, _check.number(f"sprt.{name}", getattr(self, name), 1e-6, 0.4))
        if self.elo0 >= self.elo1:
            _check.fail("sprt.elo1", self.elo1, f"more than elo0 = {self.elo0:g}")

    @property
    def bounds(self) -> tuple[float, float]:
        """Wald's bounds on the log-likelihood ratio: accept elo0 at or below the first, elo1 at or above the other."""
        return math.log(self.beta / (1.0 - self.alpha)), math.log((1.0 - self.beta) / self.alpha)

    def to_dict(self) -> dict[str, float]:
        """``{"elo0": 0.0, "elo1": 20.0, "alpha": 0.05, "beta": 0.05}``."""
        return {"elo0": self.elo0, "elo1": self.elo1, "alpha": self.alpha, "beta": self.beta}

    @classmethod
    def from_dict(cls, data: Any) -> Self:
        """Read what ``to_dict`` wrote."""
        return cls(**_check.object("sprt", data, ("elo0", "elo1", "alpha", "beta")))
