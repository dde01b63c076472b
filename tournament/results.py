"""One game's result, as standings, statistics and reports need it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Self

from referee.game import EndReason
from referee.play.noise import LEVEL_MAX
from tournament.checks import Checker
from tournament.errors import InvalidResult
from tournament.pairings import game_id

LONGEST_REFERENCE = 2048
MOST = 10**12
"""Bound on counts and seconds: more is a broken writer."""

_check = Checker(InvalidResult)


def _no_fouls() -> tuple[Mapping[str, int], Mapping[str, int]]:
    return {}, {}


@dataclass(frozen=True, slots=True)
class GameResult:
    """How a game ended.

    Attributes:
        pair: id of the pair it belongs to (``Pair.id``; on a standing server any id that two games share).
        leg: 0 or 1, the first or the second game of the pair.
        players: names by seat. Both games of a pair seat the players alike; the break is what changes.
        breaker: the seat that broke.
        winner: the seat that won; None for a draw, and for a game that was aborted.
        reason: why it ended.
        rule: id of the rule behind it.
        noise: level.
        strokes: by seat. seconds: thinking time by seat. simulated: shots simulated by seat.
        fouls: by seat, rule id to how many.
        record: where the game's record is: a path or a link; empty if nowhere.
        attempt: 0, and one more each time the game had to be played again.
        void: taken out by the organiser: kept, shown, never counted.

    Raises:
        InvalidResult: naming the field, its value and what is allowed.
    """

    pair: str
    leg: int
    players: tuple[str, str]
    breaker: int
    winner: int | None
    reason: EndReason
    rule: str = "R48"
    noise: float = 1.0
    strokes: tuple[int, int] = (0, 0)
    seconds: tuple[float, float] = (0.0, 0.0)
    simulated: tuple[int, int] = (0, 0)
    fouls: tuple[Mapping[str, int], Mapping[str, int]] = field(default_factory=_no_fouls, hash=False)
    record: str = ""
    attempt: int = 0
    void: bool = False

    def __post_init__(self) -> None:
        for name, value in _checked(self).items():
            object.__setattr__(self, name, value)
        if self.players[0] == self.players[1]:
            _check.fail("players", self.players, "two different names")
        if self.reason is EndReason.ABORTED and self.winner is not None:
            _check.fail("winner", self.winner, "nobody wins an aborted game")

    @property
    def id(self) -> str:
        """Of the game."""
        return game_id(self.pair, self.leg, self.attempt)

    @property
    def counts(self) -> bool:
        """Whether the game has a result: neither aborted nor void."""
        return not self.void and self.reason is not EndReason.ABORTED

    @property
    def points(self) -> tuple[float, float]:
        """By seat: 1 to the winner, half each for a draw, nothing when the game does not count."""
        if not self.counts:
            return 0.0, 0.0
        if self.winner is None:
            return 0.5, 0.5
        return (1.0, 0.0) if self.winner == 0 else (0.0, 1.0)

    def seat(self, name: str) -> int:
        """The seat of a player; ``InvalidResult`` if that player is not in this game."""
        if name not in self.players:
            _check.fail("player", name, f"one of {self.players}")
        return self.players.index(name)

    def points_of(self, name: str) -> float:
        """The points of a player."""
        return self.points[self.seat(name)]

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {
            "pair": self.pair,
            "leg": self.leg,
            "players": list(self.players),
            "breaker": self.breaker,
            "winner": self.winner,
            "reason": self.reason.value,
            "rule": self.rule,
            "noise": self.noise,
            "strokes": list(self.strokes),
            "seconds": list(self.seconds),
            "simulated": list(self.simulated),
            "fouls": [dict(each) for each in self.fouls],
            "record": self.record,
            "attempt": self.attempt,
            "void": self.void,
        }

    @classmethod
    def from_dict(cls, data: Any) -> Self:
        """Read what ``to_dict`` wrote; what has a default may be missing.

        Raises:
            InvalidResult: naming the field, its value and what is allowed.
        """
        names = [one.name for one in fields(cls)]
        return cls(**_check.object("result", data, names, names[:6]))


def _checked(result: GameResult) -> dict[str, Any]:
    """Every field, checked by itself and in its own type."""
    return {
        "pair": _check.name("pair", result.pair),
        "leg": _check.integer("leg", result.leg, 0, 1),
        "players": tuple(_check.name("players", one) for one in _check.items("players", result.players, 2, 2)),
        "breaker": _check.integer("breaker", result.breaker, 0, 1),
        "winner": None if result.winner is None else _check.integer("winner", result.winner, 0, 1),
        "reason": _check.member(EndReason, "reason", result.reason),
        "rule": _check.name("rule", result.rule),
        "noise": _check.number("noise", result.noise, 0.0, LEVEL_MAX),
        "strokes": _counts("strokes", result.strokes),
        "seconds": tuple(
            _check.number("seconds", one, 0.0, float(MOST)) for one in _check.items("seconds", result.seconds, 2, 2)
        ),
        "simulated": _counts("simulated", result.simulated),
        "fouls": tuple(_tally(one) for one in _check.items("fouls", result.fouls, 2, 2)),
        "record": _check.text("record", result.record, LONGEST_REFERENCE),
        "attempt": _check.integer("attempt", result.attempt, 0, MOST),
        "void": _check.flag("void", result.void),
    }


def _counts(name: str, value: Any) -> tuple[int, ...]:
    return tuple(_check.integer(name, one, 0, MOST) for one in _check.items(name, value, 2, 2))


def _tally(value: Any) -> dict[str, int]:
    if not isinstance(value, Mapping):
        _check.fail("fouls", value, "rule ids and how often, for each seat")
    return {_check.name("fouls", rule): _check.integer("fouls", count, 0, MOST) for rule, count in value.items()}
