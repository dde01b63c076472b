"""Turning points of an event, and its games to watch, from their records.

A record is believed here; ``referee.record.verify_record`` checks it. A stroke is drawn as this engine plays it; where
another engine played it otherwise, the picture has only how it began.
"""

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final

import pictures
from physics import Result, Shot, Table, TableState, simulate
from referee.game import Game
from referee.record import Record, read_record
from tournament.luck import VALUE

MOST: Final = 6
"""Turning points of an event."""
_SEAT: Final = re.compile(r"\b[Pp]layer ([01])\b")

Source = str | os.PathLike[str] | Iterable[str]


@dataclass(frozen=True, slots=True)
class Moment:
    """A stroke that changed the chance of its player to win as no other of its game did.

    Attributes:
        record: of the game, as its result names it.
        number: of the stroke, from 1.
        player: whose stroke it was.
        before, after: the player's chance, by the value function of luck (``tournament.luck.VALUE``).
        words: the referee's sentence, with names.
        picture: SVG of the stroke.
    """

    record: str
    number: int
    player: str
    before: float
    after: float
    words: str
    picture: str

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {name: getattr(self, name) for name in self.__slots__}


def turning_points(records: Mapping[str, Source], most: int = MOST) -> tuple[Moment, ...]:
    """The greatest changes first, at most one of a game, and never a game's last stroke.

    Args:
        records: where each record is to be read, by what results call it.
        most: moments.

    Raises:
        InvalidRecord: a record is none.
    """
    found = []
    for name, source in records.items():
        record = read_record(source)
        if (best := _best(record)) is not None:
            found.append((name, record, *best))
    found.sort(key=lambda each: -abs(each[4] - each[3]))
    return tuple(_moment(*each) for each in found[:most])


def _best(record: Record) -> tuple[int, float, float] | None:
    """The place of an entry, and its player's chances before and after it."""
    noise = record.header["noise"]["level"]
    changes = []
    for place, (before, after) in enumerate(pairwise(record.entries), 1):
        game = Game.from_dict(after["game"])
        if after["stroke"] is None or game.outcome is not None:
            continue
        chance = VALUE(Game.from_dict(before["game"]), after["seat"], noise)
        changes.append((place, chance, VALUE(game, after["seat"], noise)))
    return max(changes, key=lambda each: abs(each[2] - each[1]), default=None)


def _moment(name: str, record: Record, place: int, before: float, after: float) -> Moment:
    entry, players = record.entries[place], record.header["players"]
    call = entry["action"].get("call")
    result = _played(record, entry)
    picture = pictures.svg(
        result or TableState.from_dict(entry["before"]),
        table=Table.from_dict(record.header["table"]),
        shot=Shot.from_dict(entry["shot"]),
        call=(call["ball"], call["pocket"]) if isinstance(call, dict) else None,
    )
    return Moment(name, entry["stroke"] + 1, players[entry["seat"]], before, after, words(entry, players), picture)


def replay(source: Source) -> str | None:
    """A game as a page that plays it; None where nothing was played, or this engine plays it otherwise.

    Raises:
        InvalidRecord: the record is none.
    """
    record = read_record(source)
    scenes = list(_scenes(record))
    if not scenes or None in scenes:
        return None
    players = record.header["players"]
    return pictures.html([each for each in scenes if each is not None], title=f"{players[0]} against {players[1]}")


def _scenes(record: Record) -> Iterator[pictures.ReplayShot | None]:
    for entry in record.entries:
        if entry["stroke"] is not None:
            result = _played(record, entry)
            yield None if result is None else pictures.ReplayShot(result, words(entry, record.header["players"]))


def _played(record: Record, entry: Mapping[str, Any]) -> Result | None:
    """A stroke simulated again, with its noise; None where that does not end as it did."""
    table, state = Table.from_dict(record.header["table"]), TableState.from_dict(entry["before"])
    result = simulate(table, state, Shot.from_dict(entry["shot"]))
    return result if result.final.to_dict() == entry["final"] else None


def words(entry: Mapping[str, Any], players: tuple[str, str]) -> str:
    """The referee's sentence about a stroke, with names for seats."""
    return _SEAT.sub(lambda found: players[int(found[1])], entry["ruling"]["words"])
