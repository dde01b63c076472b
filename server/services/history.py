"""Looking at games: how one stands, its strokes in pages, its record."""

import json

from sqlalchemy import select

from referee.wire import GameAnswer, ShotsPage, StrokeDetail
from server.errors import GameUnfinished
from server.security.callers import Caller
from server.services.commands import Answer
from server.services.context import Context
from server.services.live import find
from server.services.match_views import summary
from server.store.tables import moves


def game(context: Context, game_id: str, reader: Caller | None) -> Answer:
    """The game as the reader sees it: a player from the own seat, anybody else as a spectator."""
    with context.database.reading() as connection:
        live = find(connection, game_id)
        seat = live.agents.index(reader.id) if reader is not None and reader.id in live.agents else None
        view = live.view(connection, seat, context.time.now())
    return Answer.of(200, GameAnswer(**summary(live.row), view=view), etag=f'"{live.row.version}"')


def shots(context: Context, game_id: str, cursor: int, limit: int) -> ShotsPage:
    """Strokes and decisions from number `cursor` on."""
    ours = (moves.c.game_id == game_id) & (moves.c.number >= cursor)
    with context.database.reading() as connection:
        find(connection, game_id)
        rows = connection.execute(select(moves).where(ours).order_by(moves.c.number).limit(limit + 1)).all()
    page = tuple(
        StrokeDetail.model_validate(row.stroke | {"events": json.loads(row.line).get("events", ())})
        for row in rows[:limit]
    )
    return ShotsPage(shots=page, next_cursor=cursor + limit if len(rows) > limit else None)


def record(context: Context, game_id: str) -> str:
    """The record of a game that is over, as JSON lines; raises `GameUnfinished`."""
    ours = select(moves.c.line).where(moves.c.game_id == game_id).order_by(moves.c.number)
    with context.database.reading() as connection:
        live = find(connection, game_id)
        if live.is_running:
            raise GameUnfinished("the record, with the seed, is published when the game is over")
        lines = connection.scalars(ours).all()
    return "".join(f"{line}\n" for line in (live.row.header, *lines, live.row.ending))
