"""One game's result, as standings, statistics and reports need it."""

from collections.abc import Mapping
from dataclasses import field
from typing import Annotated

from referee.game import EndReason
from referee.play.noise import LEVEL_MAX
from tournament.errors import InvalidResult
from tournament.pairings import game_id
from tournament.validation import Flag, Name, Value, integer, items, number, one_of, text, value

LONGEST_REFERENCE = 2048
MOST = 10**12
"""Bound on counts and seconds: more is a broken writer."""

Seat = Annotated[int, integer(0, 1)]
Count = Annotated[int, integer(0, MOST)]
Counts = Annotated[tuple[Count, Count], items(2, 2)]
Seconds = Annotated[float, number(0.0, float(MOST))]
Tally = Mapping[Name, Count]


def _no_fouls() -> tuple[Mapping[str, int], Mapping[str, int]]:
    return {}, {}


@value(InvalidResult, "result", is_part=False)
class GameResult(Value):
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

    pair: Name
    leg: Seat
    players: Annotated[tuple[Name, Name], items(2, 2)]
    breaker: Seat
    winner: Seat | None
    reason: Annotated[EndReason, one_of(EndReason)]
    rule: Name = "R48"
    noise: Annotated[float, number(0.0, LEVEL_MAX)] = 1.0
    strokes: Counts = (0, 0)
    seconds: Annotated[tuple[Seconds, Seconds], items(2, 2)] = (0.0, 0.0)
    simulated: Counts = (0, 0)
    fouls: Annotated[tuple[Tally, Tally], items(2, 2)] = field(default_factory=_no_fouls, hash=False)
    record: Annotated[str, text(LONGEST_REFERENCE)] = ""
    attempt: Count = 0
    void: Flag = False

    def __post_init__(self) -> None:
        if self.players[0] == self.players[1]:
            raise InvalidResult("players", self.players, "must be two different names")
        if self.reason is EndReason.ABORTED and self.winner is not None:
            raise InvalidResult("winner", self.winner, "must be none: nobody wins an aborted game")

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
            raise InvalidResult("player", name, f"must be one of {self.players}")
        return self.players.index(name)

    def points_of(self, name: str) -> float:
        """The points of a player."""
        return self.points[self.seat(name)]
