"""Looking at games: how one stands, its strokes in pages, its record."""

from collections.abc import Mapping
from typing import Any, Final

from sqlalchemy import Connection, Select, select

from protocol import GameAnswer, ShotsPage
from server.errors import GameUnfinished, MatchUnfinished, ServerError, TournamentUnfinished
from server.http.commands import Answer
from server.security.callers import Caller
from server.services.matches.match_views import summary
from server.services.matches.secrecy import Holder
from server.services.play import stored_strokes
from server.services.play.live_game import LiveGame, find
from server.services.runtime.context import Context
from server.store.rows import GameRow
from server.store.tables import moves


def game(context: Context, game_id: str, reader: Caller | None) -> Answer:
    """The game as the reader sees it: a player from the own seat, anybody else as a spectator."""
    with context.database.reading() as connection:
        live = find(connection, game_id)
        seat = live.agents.index(reader.id) if reader is not None and reader.id in live.agents else None
        return answer(connection, live, seat, context.time.now())


def answer(connection: Connection, live: LiveGame, seat: int | None, now: int) -> Answer:
    """The game as a seat sees it, None for a spectator; `ETag` is the version."""
    message = GameAnswer(**summary(live.row, live.fixture.withheld), view=live.view(connection, seat, now))
    return Answer.of(200, message, etag=f'"{live.row.version}"')


def shots(context: Context, game_id: str, cursor: int, limit: int) -> ShotsPage:
    """Strokes and decisions from number `cursor` on."""
    ours = (moves.c.game_id == game_id) & (moves.c.number >= cursor)
    with context.database.reading() as connection:
        find(connection, game_id)
        rows = connection.execute(select(moves).where(ours).order_by(moves.c.number).limit(limit + 1)).all()
    page = tuple(stored_strokes.detail(row) for row in rows[:limit])
    return ShotsPage(shots=page, next_cursor=cursor + limit if len(rows) > limit else None)


def record(context: Context, game_id: str) -> str:
    """The record of a game that is over, as JSON lines.

    Raises `GameUnfinished`; while its noise is withheld `MatchUnfinished` or `TournamentUnfinished`: until when.
    """
    with context.database.reading() as connection:
        live = find(connection, game_id)
        if live.is_running:
            raise GameUnfinished("the record, with the seed, is published when the game is over")
        if live.fixture.withheld is not None:
            raise _UNTIL[live.fixture.withheld](
                f"the record shows a level of noise that the players are not told: it is published when the "
                f"{live.fixture.withheld} is over"
            )
        lines = record_lines(connection, live.row)
    return "".join(f"{line}\n" for line in lines)


_UNTIL: Final[Mapping[Holder, type[ServerError]]] = {"match": MatchUnfinished, "tournament": TournamentUnfinished}


def record_lines(connection: Connection, row: GameRow) -> list[str]:
    """The record of a game that is over, from its row."""
    ours: Select[Any] = select(*stored_strokes.LINE).where(moves.c.game_id == row.id).order_by(moves.c.number)
    lines = [stored_strokes.line(each) for each in connection.execute(ours)]
    return [line for line in (row.header, *lines, row.ending, row.seal) if line is not None]
