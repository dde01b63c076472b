"""The terms of a sequential test: two Elo differences and two error rates."""

import math
from typing import Annotated

from tournament.errors import InvalidSpec
from tournament.validation import Value, number, value

MOST_ELO = 1000.0

Elo = Annotated[float, number(-MOST_ELO, MOST_ELO)]
ErrorRate = Annotated[float, number(1e-6, 0.4)]


@value(InvalidSpec, "sprt")
class SprtTerms(Value):
    """A sequential probability ratio test of the first entrant against the second.

    Attributes:
        elo0, elo1: the Elo differences of the null hypothesis and of its alternative, elo0 < elo1, logistic Elo.
        alpha: probability of accepting elo1 when elo0 is true; beta: of accepting elo0 when elo1 is true.

    Raises:
        InvalidSpec: naming the field, its value and what is allowed.
    """

    elo0: Elo = 0.0
    elo1: Elo = 20.0
    alpha: ErrorRate = 0.05
    beta: ErrorRate = 0.05

    def __post_init__(self) -> None:
        if self.elo0 >= self.elo1:
            raise InvalidSpec("elo1", self.elo1, f"must be more than elo0 = {self.elo0:g}")

    @property
    def bounds(self) -> tuple[float, float]:
        """Wald's bounds on the log-likelihood ratio: accept elo0 at or below the first, elo1 at or above the other."""
        return math.log(self.beta / (1.0 - self.alpha)), math.log((1.0 - self.beta) / self.alpha)
