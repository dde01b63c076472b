"""What a format decides: pairs of games, and who has a bye."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

LEGS = (0, 1)
"""The two games of a pair."""


@dataclass(frozen=True, slots=True)
class Pair:
    """Two games between the same players, on the same racks and at the same level, the break swapped.

    Attributes:
        id: unique in the event, ``"r0-m2-p1"``: round, meeting, pair, each from 0.
        number: its place in the order of the event, from 0.
        round, meeting, index: where it stands: round of the event, meeting of the round, pair of the meeting.
        players: names, by seat, in both games. Seat 0 breaks the first one.
        noise: level.
    """

    id: str
    number: int
    round: int
    meeting: int
    index: int
    players: tuple[str, str]
    noise: float

    def breaker(self, leg: int) -> int:
        """The seat that breaks the first (0) or second (1) game."""
        return leg

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {
            "id": self.id,
            "number": self.number,
            "round": self.round,
            "meeting": self.meeting,
            "index": self.index,
            "players": list(self.players),
            "noise": self.noise,
        }


def game_id(pair: str, leg: int, attempt: int) -> str:
    """``"r0-m2-p1-g0"``, and ``"-a1"`` after it when it is played again."""
    return f"{pair}-g{leg}" + (f"-a{attempt}" if attempt else "")


@dataclass(frozen=True, slots=True)
class Due:
    """A game to be played.

    Attributes:
        pair: it belongs to; leg: 0 or 1; attempt: how often it was void or aborted before.
    """

    pair: Pair
    leg: int
    attempt: int = 0

    @property
    def breaker(self) -> int:
        """The seat that breaks."""
        return self.pair.breaker(self.leg)

    @property
    def id(self) -> str:
        """Of the game."""
        return game_id(self.pair.id, self.leg, self.attempt)


@dataclass(frozen=True, slots=True)
class Bye:
    """A round without an opponent: as good as a meeting won where meetings count (Swiss, knockout)."""

    round: int
    player: str


@dataclass(frozen=True, slots=True)
class Plan:
    """What is certain so far.

    Attributes:
        pairs: played or to be played, in order.
        byes: in order.
        complete: no further pairs will follow from the results of these.
        advanced: in a knockout, name to how many rounds that entrant has survived, byes included.
    """

    pairs: tuple[Pair, ...]
    byes: tuple[Bye, ...] = ()
    complete: bool = True
    advanced: Mapping[str, int] = field(default_factory=dict, hash=False)
