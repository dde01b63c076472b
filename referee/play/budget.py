"""The simulation budget: a number of simulated shots for each player and game, the same on every machine."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from threading import Lock
from typing import Any, Final, Self

from referee.errors import InvalidGame, RefereeError


class BudgetSpent(RefereeError):
    """More shots were to be simulated than the budget has left; none of them was, and none is counted."""


COUNTED: Final = ("by_driver", "by_honour")
"""Who counts: the driver of a local game, whose simulator the agents use, or the players, who are believed."""


@dataclass(frozen=True, slots=True)
class GrantedBudget:
    """What the terms of a match grant.

    Attributes:
        simulations: shots that each player may simulate in a game.
        counted: one of `COUNTED`.
    """

    simulations: int
    counted: str

    def __post_init__(self) -> None:
        if isinstance(self.simulations, bool) or not isinstance(self.simulations, int) or self.simulations < 0:
            raise InvalidGame("budget.simulations", self.simulations, "must be an integer >= 0")
        if self.counted not in COUNTED:
            raise InvalidGame("budget.counted", self.counted, f"must be one of {', '.join(COUNTED)}")

    def to_dict(self) -> dict[str, Any]:
        """The budget as a JSON object."""
        return asdict(self)

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """Read what ``to_dict`` wrote."""
        return cls(**values)


@dataclass(slots=True)
class SimulationBudget:
    """One player's simulated shots in one game. May be used from several threads.

    Attributes:
        allowed: how many shots may be simulated; None for any number.
        used: how many were.
    """

    allowed: int | None = None
    used: int = 0
    _lock: Lock = field(default_factory=Lock, repr=False, compare=False)

    def __post_init__(self) -> None:
        for name, value in (("allowed", self.allowed), ("used", self.used)):
            if value is not None and (isinstance(value, bool) or not isinstance(value, int) or value < 0):
                raise ValueError(f"{name} = {value!r}: must be an integer >= 0")

    @property
    def remaining(self) -> int | None:
        """How many shots may still be simulated; None for any number."""
        return None if self.allowed is None else self.allowed - self.used

    def spend(self, shots: int) -> None:
        """Count shots about to be simulated.

        Raises:
            BudgetSpent: the budget has fewer left; nothing is counted.
        """
        with self._lock:
            if self.allowed is not None and shots > self.allowed - self.used:
                raise BudgetSpent("simulations", shots, f"at most {self.allowed - self.used} are left in this game")
            self.used += shots


Budgets = tuple[SimulationBudget, SimulationBudget]
"""Both players' budgets, by seat."""


def budgets(allowed: int | None) -> Budgets:
    """Fresh budgets of so many simulated shots each."""
    return SimulationBudget(allowed), SimulationBudget(allowed)
