"""The luck of a game, from its record: stroke by stroke, and summed up by seat."""

import hashlib
import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from referee.game import Action, Game
from referee.record import Header, read_record
from tournament.luck.stroke import DRAWS, StrokeLuck, stroke_luck
from tournament.luck.value import VALUE, ValueModel


@dataclass(frozen=True, slots=True)
class GameLuck:
    """The luck of a game.

    Attributes:
        players: names, by seat; noise: level.
        strokes: each with its luck.
        points: by seat, as played: 1, a half, 0; both 0 when aborted.
    """

    players: tuple[str, str]
    noise: float
    strokes: tuple[StrokeLuck, ...]
    points: tuple[float, float]

    def of(self, seat: int) -> float:
        """Luck of a seat over the game: its own, less the opponent's, in points."""
        return sum(one.luck if one.seat == seat else -one.luck for one in self.strokes)

    def own(self, seat: int) -> float:
        """Luck of a seat in its own strokes alone."""
        return sum(one.luck for one in self.strokes if one.seat == seat)

    def corrected(self, seat: int) -> float:
        """Points less luck: the same mean as the points, less variance. It can lie outside [0, 1]."""
        return self.points[seat] - self.of(seat)

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {
            "players": list(self.players),
            "noise": self.noise,
            "points": list(self.points),
            "luck": [self.of(seat) for seat in (0, 1)],
            "corrected": [self.corrected(seat) for seat in (0, 1)],
            "strokes": [one.to_dict() for one in self.strokes],
        }


def game_luck(
    record: str | os.PathLike[str] | Iterable[str], *, draws: int = DRAWS, value: ValueModel = VALUE
) -> GameLuck:
    """The luck of a recorded game; the record is believed (``referee.record.verify_record`` checks it).

    Args:
        record: path of a record, or its lines.
        draws: fresh draws a stroke.
        value: the value function.

    Raises:
        referee.RefereeError: not a record.
        OSError: the file cannot be read.
    """
    read = read_record(record)
    header = Header.from_dict(read.header)
    key = hashlib.sha256(f"pooliad/1 luck {header.commitment} {header.number}".encode("ascii")).digest()
    strokes = tuple(
        stroke_luck(header.terms.rules, before, action, after, header.terms.noise, key=key, draws=draws, value=value)
        for before, action, after in steps(header.start, read.entries)
        if action.shot is not None
    )
    winner, reason = read.end["outcome"]["winner"], read.end["outcome"]["reason"]
    half = 0.0 if reason == "aborted" else 0.5
    points = (half, half) if winner is None else (float(winner == 0), float(winner == 1))
    return GameLuck(header.players, header.terms.noise.level, strokes, points)


def steps(start: Game, entries: Iterable[dict[str, Any]]) -> Iterator[tuple[Game, Action, Game]]:
    """The game before each stroke or decision of a record, what was intended, and the game after it."""
    before = start
    for entry in entries:
        after = Game.from_dict(entry["game"])
        yield before, Action.from_dict(entry["action"]), after
        before = after
