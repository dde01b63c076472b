"""The noise of an event: one level, several in turn, or a range that each pair's level is drawn from."""

from dataclasses import dataclass
from typing import Any, Self

from referee.play.noise import LEVEL_MAX
from tournament.checks import Checker
from tournament.errors import InvalidSpec

MOST_LEVELS = 1000

_check = Checker(InvalidSpec)


@dataclass(frozen=True, slots=True)
class NoisePlan:
    """Which level each pair of games is played at; both games of a pair have the same.

    Attributes:
        levels: used in turn: the first pair of a meeting has the first level, and so on round. Factors on the
            Olympiad's standard deviations, in [0, 5].
        range: lowest and highest; each pair's level is drawn uniformly from it. Then ``levels`` is empty.
        told: whether the players are told the level of their game.

    Raises:
        InvalidSpec: no levels, both levels and a range, or a level outside [0, 5].
    """

    levels: tuple[float, ...] = (1.0,)
    range: tuple[float, float] | None = None
    told: bool = True

    def __post_init__(self) -> None:
        levels = _check.items("noise.levels", self.levels, 0, MOST_LEVELS)
        object.__setattr__(self, "levels", tuple(_level("noise.levels", one) for one in levels))
        _check.flag("noise.told", self.told)
        if self.range is not None:
            low, high = (_level("noise.range", one) for one in _check.items("noise.range", self.range, 2, 2))
            if low > high:
                _check.fail("noise.range", self.range, "the lowest level, then the highest")
            object.__setattr__(self, "range", (low, high))
        if bool(self.levels) == (self.range is not None):
            _check.fail("noise", self.to_dict(), "either levels or a range")

    @classmethod
    def variable(cls, low: float = 0.0, high: float = LEVEL_MAX, *, told: bool = True) -> Self:
        """A level drawn for each pair."""
        return cls(levels=(), range=(low, high), told=told)

    def to_dict(self) -> dict[str, Any]:
        """``{"levels": [1.0], "told": true}`` or ``{"range": [0.0, 5.0], "told": true}``."""
        which: dict[str, Any] = {"levels": list(self.levels)} if self.range is None else {"range": list(self.range)}
        return which | {"told": self.told}

    def published(self) -> dict[str, Any]:
        """The same without levels that the players are not told."""
        return self.to_dict() if self.told else {"told": False}

    @classmethod
    def from_dict(cls, data: Any) -> Self:
        """Read what ``to_dict`` wrote; a number alone is one level, told."""
        if isinstance(data, int | float) and not isinstance(data, bool):
            return cls((data,))
        values = _check.object("noise", data, ("levels", "range", "told"))
        if "range" in values:
            values.setdefault("levels", ())
        return cls(**values)


def _level(field: str, value: Any) -> float:
    return _check.number(field, value, 0.0, LEVEL_MAX)
