"""The best strokes of the games that ended last: where a player's chance to win rose the most."""

import threading
from collections.abc import Sequence
from itertools import pairwise
from typing import Any, Final, NamedTuple

from pydantic_core import from_json
from sqlalchemy import Connection, Row, Select, select

from protocol import BestStroke, BestStrokes
from referee.game import EndReason, Game
from server.services.play import stored_strokes
from server.services.play.live_game import FINISHED
from server.services.runtime.context import Context
from server.store.tables import agents, games, matches, moves
from tournament.luck import VALUE

NEWEST: Final = 24
"""Games that are looked at."""
KEPT: Final = 256
"""Games whose best stroke is remembered: a game that is over stays as it is, and to read one takes some 50 ms."""

_ONE, _OTHER = agents.alias(), agents.alias()
_ENDED: Final = (
    select(games.c.id, games.c.match_id, matches.c.noise_level, matches.c.noise_told)
    .add_columns(_ONE.c.name.label("name_0"), _OTHER.c.name.label("name_1"))
    .join(matches, games.c.match_id == matches.c.id)
    .join(_ONE, _ONE.c.id == matches.c.seat_0)
    .join(_OTHER, _OTHER.c.id == matches.c.seat_1)
    .where(games.c.status == FINISHED, games.c.state["outcome"]["reason"].as_string() != EndReason.ABORTED.value)
    .order_by(games.c.ended_at.desc(), games.c.id.desc())
    .limit(NEWEST)
)


class _Best(NamedTuple):
    """A stroke without the names of its game."""

    number: int
    seat: int
    before: float
    after: float
    words: str


def read(context: Context) -> BestStrokes:
    """One stroke of each game that has one, the best first."""
    with context.database.reading() as connection:
        found = [(row, best) for row in connection.execute(_ENDED).all() if (best := _best(connection, row))]
    found.sort(key=lambda each: each[1].before - each[1].after)
    return BestStrokes(strokes=tuple(_shown(row, best) for row, best in found))


def _shown(row: Row[Any], best: _Best) -> BestStroke:
    return BestStroke(game=row.id, match=row.match_id, players=(row.name_0, row.name_1), **best._asdict())


def _best(connection: Connection, row: Row[Any]) -> _Best | None:
    """A level that is not told, which would tell itself by the chances, counts as none."""
    with _LOCK:
        if row.id in _KNOWN:
            return _KNOWN[row.id]
    ours = moves.c.game_id == row.id
    query: Select[Any] = select(*stored_strokes.LINE).where(ours).order_by(moves.c.number)
    lines = connection.execute(query).all()
    entries = [from_json(stored_strokes.line(line)) for line in lines]
    best = best_of(entries, row.noise_level if row.noise_told else 0.0)
    with _LOCK:
        _KNOWN[row.id] = best
        while len(_KNOWN) > KEPT:
            del _KNOWN[next(iter(_KNOWN))]
    return best


_LOCK: Final = threading.Lock()
_KNOWN: Final[dict[str, _Best | None]] = {}
"""By game; ids are never used again, and the first to come are the first to go."""


def best_of(entries: Sequence[dict[str, Any]], noise: float) -> _Best | None:
    """The stroke of a game that made what it called, and after which its player's chance rose the most.

    Args:
        entries: the lines of its record, in order.
        noise: level of the game.
    """
    strokes = []
    for number, (before, after) in enumerate(pairwise(entries), 1):
        game = Game.from_dict(after["game"])
        if not after["ruling"]["made"] or game.outcome is not None:
            continue
        seat = after["seat"]
        chance = VALUE(Game.from_dict(before["game"]), seat, noise)
        strokes.append(_Best(number, seat, chance, VALUE(game, seat, noise), after["ruling"]["words"]))
    best = max(strokes, key=lambda each: each.after - each.before, default=None)
    return best if best is not None and best.after > best.before else None
