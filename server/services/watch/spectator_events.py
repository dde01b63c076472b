"""What spectators are told about a game, read from the database: its strokes, clocks, players and result."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final, NamedTuple

from fastapi.sse import format_sse_event
from sqlalchemy import ColumnElement, Connection, Row, Select, bindparam, select

from protocol import GameAnswer, StreamClocks, StreamConnections, StreamResult, of_many
from server.services.matches.match_views import summary
from server.services.play import stored_strokes
from server.services.play.live_game import LiveGame, find, score_of
from server.services.runtime.context import Context
from server.store.prepared import Prepared, PreparedForIds
from server.store.rows import GameRow
from server.store.tables import games, heartbeats, matches, moves

RESULT: Final = "result"


@dataclass(frozen=True)
class SpectatorEvent:
    """One event about one game, encoded once for all who watch.

    Attributes:
        kind: ``game``, ``stroke``, ``decision``, ``clocks``, ``connections`` or ``result``.
        data: JSON.
        sequence: of a stroke or decision: the event's id.
    """

    game: str
    kind: str
    data: str
    sequence: int | None = None

    @cached_property
    def alone(self) -> bytes:
        """The event in the game's own stream."""
        sequence = None if self.sequence is None else str(self.sequence)
        return format_sse_event(event=self.kind, data_str=self.data, id=sequence)

    @cached_property
    def among_others(self) -> bytes:
        """The event in a stream of several games."""
        return format_sse_event(event=self.kind, data_str=of_many(self.game, self.data))


class Marks(NamedTuple):
    """What differs when there is news: the game's version, its running clock, who is there (by seat)."""

    version: int
    delivered: bool
    clock_from: int
    connected: tuple[bool, bool]


@dataclass(frozen=True, slots=True)
class SpectatorState:
    """What the spectators of a game know already: its marks, the sequence of its last stroke, the number of strokes."""

    marks: Marks
    sequence: int
    strokes: int

    def followed_by(self, strokes: Sequence[SpectatorEvent], marks: Marks) -> "SpectatorState":
        """What they know when they have been told of more strokes."""
        last = strokes[-1].sequence if strokes else None
        return SpectatorState(marks, self.sequence if last is None else last, self.strokes + len(strokes))


def opening(context: Context, game_id: str, after: int | None) -> tuple[list[SpectatorEvent], SpectatorState]:
    """How the game stands for somebody who begins to watch; raises `NotFound`.

    Args:
        context: the server's parts.
        game_id: the game.
        after: tell every stroke after this sequence; None: no stroke of the past.
    """
    with context.database.reading() as connection:
        live = find(connection, game_id)
        rows = [] if after is None else _AFTER.all(connection, game=game_id, sequence=after)
        standing = _standing(context, connection, live)
        first = GameAnswer(
            **summary(live.row, live.fixture.withheld), view=live.view(connection, None, context.time.now())
        )
        news = [
            SpectatorEvent(game_id, "game", first.model_dump_json()),
            *_strokes(rows, game_id),
            *_rest(context, connection, live, standing),
        ]
    return news, standing


def since(
    context: Context, known: Mapping[str, SpectatorState]
) -> tuple[list[SpectatorEvent], dict[str, SpectatorState]]:
    """The news about several games since they stood as known, and how those stand now that have any.

    One query for many games when nothing has happened; two more for each game with news.
    """
    news: list[SpectatorEvent] = []
    standings: dict[str, SpectatorState] = {}
    with context.database.reading() as connection:
        here = agents_here(context, connection)
        for game_id in _moved(connection, known, here):
            live, before = context.seen.find(connection, game_id), known[game_id]
            strokes = list(_strokes(_FROM.all(connection, game=game_id, first=before.strokes), game_id))
            after = standings[game_id] = before.followed_by(strokes, _marks(here, live.row, live.agents))
            news += [*strokes, *_rest(context, connection, live, after, before)]
    return news, standings


def _moved(connection: Connection, known: Mapping[str, SpectatorState], here: frozenset[str]) -> list[str]:
    """The games that stand otherwise than known."""
    rows = _STANDINGS.all(connection, known)
    return [row.id for row in rows if _marks(here, row, (row.seat_0, row.seat_1)) != known[row.id].marks]


_STANDINGS: Final = PreparedForIds(
    select(
        *(games.c.id, games.c.version, games.c.mover, games.c.delivered, games.c.clock_from),
        *(matches.c.seat_0, matches.c.seat_1),
    ).join(matches, games.c.match_id == matches.c.id),
    games.c.id,
)


def _rest(
    context: Context,
    connection: Connection,
    live: LiveGame,
    after: SpectatorState,
    before: SpectatorState | None = None,
) -> Iterator[SpectatorEvent]:
    """Clocks and players, where they differ from before; the result."""
    if before is None or before.marks[:-1] != after.marks[:-1]:
        turn = live.game.turn if live.is_running else None
        clocks = StreamClocks(version=live.row.version, turn=turn, clocks=live.clock_views(context.time.now()))
        yield SpectatorEvent(live.id, "clocks", clocks.model_dump_json())
    if live.is_running and (before is None or before.marks.connected != after.marks.connected):
        connections = StreamConnections(connected=after.marks.connected)
        yield SpectatorEvent(live.id, "connections", connections.model_dump_json())
    if not live.is_running:
        yield SpectatorEvent(live.id, RESULT, _result(connection, live).model_dump_json())


def _result(connection: Connection, live: LiveGame) -> StreamResult:
    """The score is that of the match with this game: a view has the score it is played at."""
    summed = summary(live.row, live.fixture.withheld)
    kept = {name: summed[name] for name in ("status", "outcome", "noise_seed")}
    return StreamResult(**kept, score=score_of(connection, live.match.id), record=f"/v1/games/{live.id}/record")


def _strokes(rows: Iterable[Row[Any]], game_id: str) -> Iterator[SpectatorEvent]:
    for row in rows:
        line = stored_strokes.line(row)
        kind = "decision" if stored_strokes.is_decision(line) else "stroke"
        yield SpectatorEvent(game_id, kind, line, row.sequence)


def _lines(which: ColumnElement[bool]) -> Prepared:
    columns: Select[Any] = select(moves.c.sequence, *stored_strokes.LINE)
    return Prepared(columns.where(moves.c.game_id == bindparam("game"), which).order_by(moves.c.number))


_AFTER: Final = _lines(moves.c.sequence > bindparam("sequence"))
_FROM: Final = _lines(moves.c.number >= bindparam("first"))


def _standing(context: Context, connection: Connection, live: LiveGame) -> SpectatorState:
    numbers = select(moves.c.sequence, moves.c.number).where(moves.c.game_id == live.id)
    last = connection.execute(numbers.order_by(moves.c.number.desc()).limit(1)).first()
    sequence, strokes = (0, 0) if last is None else (last.sequence, last.number + 1)
    return SpectatorState(_marks(agents_here(context, connection), live.row, live.agents), sequence, strokes)


def agents_here(context: Context, connection: Connection) -> frozenset[str]:
    """The agents that poll this process, or another one on the same database."""
    now = context.time.now()
    here = context.presence.here(now)
    if not context.database.is_shared:
        return here
    fresh = heartbeats.c.beat_at > now - context.pulse.longest_gap
    return here.union(*connection.scalars(select(heartbeats.c.present).where(fresh, ~heartbeats.c.stopped)))


def _marks(here: frozenset[str], row: GameRow | Row[Any], seats: tuple[str, str]) -> Marks:
    """Whoever thinks about a turn it has fetched is there, and whoever polls; nobody is when the game is over."""
    thinks = row.mover if row.delivered else None
    connected = [row.mover is not None and (seat == thinks or seat in here) for seat in seats]
    return Marks(row.version, row.delivered, row.clock_from, (connected[0], connected[1]))
