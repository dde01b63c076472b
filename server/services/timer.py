"""The clock's flag: a game whose mover has run out of time ends by itself, whoever asks or does not ask."""

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator
from dataclasses import replace
from typing import Any

from sqlalchemy import select, update
from starlette.concurrency import run_in_threadpool

from referee.game import EndReason
from server.services import games as course
from server.services.context import Context, Writing
from server.services.live import RUNNING, LiveGame, find
from server.store.tables import games

log = logging.getLogger("pooliad.server.timer")


class Timer:
    """Looks at all deadlines several times a second."""

    def __init__(self, context: Context) -> None:
        self._context = context

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """The timer at work for as long as the block lasts."""
        await run_in_threadpool(resume_clocks, self._context)
        task = asyncio.create_task(self._run())
        try:
            yield
        finally:
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task
            await run_in_threadpool(stop_clocks, self._context)

    async def _run(self) -> None:
        while True:
            await asyncio.sleep(self._context.settings.timer_period)
            try:
                await run_in_threadpool(flag, self._context)
            except Exception:
                log.exception("the timer failed; it goes on")


def flag(context: Context) -> None:
    """End every game whose mover is out of time; exactly zero left is out."""
    now = context.time.now()
    due = select(games.c.id).where(games.c.deadline <= now)
    with context.database.reading() as connection:
        late = connection.scalars(due).all()
    for game_id in late:
        try:
            _flag(context, game_id, now)
        except Exception:
            log.exception("game %s could not be ended; the timer goes on with the others", game_id)


def _flag(context: Context, game_id: str, now: int) -> None:
    with context.writing() as writing:
        live = find(writing.connection, game_id)
        deadline = live.row.deadline
        if deadline is None or deadline > now or context.is_in_hand(game_id, deadline):
            return
        at_deadline = replace(writing, now=deadline)
        course.end_from_outside(at_deadline, live, EndReason.TIME_OUT, live.game.turn)
    context.wakeups.notify(live.agents)


def stop_clocks(context: Context) -> None:
    """Charge every running turn for the time until now: the server goes down, and no clock runs meanwhile."""
    with context.writing() as writing:
        for live in _running(writing):
            elapsed = live.elapsed(writing.now)
            used = live.clocks.charged(live.game.turn, elapsed).used_ns
            carried = live.row.carried + elapsed
            values = {"used_0": used[0], "used_1": used[1], "carried": carried}
            _update(writing, live.id, values | {"clock_from": live.row.clock_from + elapsed})


def resume_clocks(context: Context) -> None:
    """After a start every turn is to be fetched anew; nobody pays for the time the server was away.

    A turn that ran when the server was killed is charged nothing for it.
    """
    with context.writing() as writing:
        clock_from = writing.now + context.fetch_grace
        for live in _running(writing):
            left = live.clocks.remaining_ns(live.game.turn)
            turn = {"delivered": False, "available_at": writing.now, "clock_from": clock_from}
            _update(writing, live.id, turn | {"deadline": clock_from + left})


def _running(writing: Writing) -> list[LiveGame]:
    ids = writing.connection.scalars(select(games.c.id).where(games.c.status == RUNNING)).all()
    return [find(writing.connection, game_id) for game_id in ids]


def _update(writing: Writing, game_id: str, values: dict[str, Any]) -> None:
    writing.connection.execute(update(games).where(games.c.id == game_id).values(values))
