"""The clock's flag: a game whose mover has run out of time ends by itself, whoever asks or does not ask."""

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator

from anyio.to_thread import run_sync
from sqlalchemy import select, update

from referee.game import EndReason
from server.services import games as course
from server.services.context import Context
from server.services.live import RUNNING, find
from server.store.tables import games

log = logging.getLogger("pooliad.server.timer")


class Timer:
    """Looks at all deadlines several times a second."""

    def __init__(self, context: Context) -> None:
        self._context = context

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """The timer at work for as long as the block lasts."""
        await run_sync(resume_clocks, self._context)
        task = asyncio.create_task(self._run())
        try:
            yield
        finally:
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task
            await run_sync(stop_clocks, self._context)

    async def _run(self) -> None:
        while True:
            await asyncio.sleep(self._context.settings.timer_period)
            try:
                await run_sync(flag, self._context)
            except Exception:
                log.exception("the timer failed; it goes on")


def flag(context: Context) -> None:
    """End every game whose mover is out of time; exactly zero left is out."""
    now = context.time.now()
    due = select(games.c.id).where(games.c.deadline <= now)
    with context.database.reading() as connection:
        late = connection.scalars(due).all()
    for game_id in late:
        _flag(context, game_id, now)


def _flag(context: Context, game_id: str, now: int) -> None:
    with context.database.writing() as connection:
        live = find(connection, game_id)
        deadline = live.row.deadline
        if deadline is None or deadline > now or context.is_in_hand(game_id, deadline):
            return
        course.end_from_outside(connection, context, live, EndReason.TIME_OUT, live.game.turn, deadline)
    context.wakeups.notify(live.agents)


def stop_clocks(context: Context) -> None:
    """Charge every running turn for the time until now.

    The server goes down, and no clock runs while it is.
    """
    now = context.time.now()
    with context.database.writing() as connection:
        for row in connection.execute(
            select(games).where(games.c.status == RUNNING, games.c.clock_from < now)
        ).all():
            used = f"used_{row.state['turn']}"
            charged = {used: getattr(row, used) + now - row.clock_from, "clock_from": now}
            connection.execute(update(games).where(games.c.id == row.id).values(charged))


def resume_clocks(context: Context) -> None:
    """After a start every turn is to be fetched anew; nobody pays for the time the server was away.

    A turn that ran when the server was killed is charged nothing for it.
    """
    now = context.time.now()
    with context.database.writing() as connection:
        for row in connection.execute(select(games).where(games.c.status == RUNNING)).all():
            left = max(0, row.deadline - row.clock_from)
            clock_from = now + context.fetch_grace
            fresh = {
                "delivered": False,
                "available_at": now,
                "clock_from": clock_from,
                "deadline": clock_from + left,
            }
            connection.execute(update(games).where(games.c.id == row.id).values(fresh))
