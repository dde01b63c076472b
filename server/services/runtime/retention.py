"""Stored answers are deleted once nobody can ask for them again.

An answer is kept for at least `answer_seconds`, for as long as the match is on that it belongs to, and for the first
hour in which a server runs: a player who could not reach any asks then.
"""

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator
from functools import partial
from typing import Final

from sqlalchemy import delete, exists, select, tuple_

from referee.play import nanoseconds
from server.errors import Unavailable
from server.services.play.live_game import RUNNING
from server.services.runtime.context import Context
from server.store.tables import answers, games, matches

log = logging.getLogger("pooliad.server.retention")

AFTER_START: Final = 3600.0
"""Seconds: longer than the SDK asks again for one answer."""
PERIOD: Final = 600.0
"""Seconds between two looks."""
BATCH: Final = 500
"""Answers deleted in one transaction: strokes do not wait long behind it."""

_IN_A_MATCH: Final = exists().where(
    matches.c.status == RUNNING,
    games.c.match_id == matches.c.id,
    answers.c.route.like("/v1/games/" + games.c.id + "/%"),
)


class Retention:
    """Looks for old answers now and then."""

    def __init__(self, context: Context) -> None:
        self._context = context

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """At work for as long as the block lasts."""
        task = asyncio.create_task(self._run())
        try:
            yield
        finally:
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task

    async def _run(self) -> None:
        seconds = self._context.settings.answer_seconds
        await asyncio.sleep(min(seconds, AFTER_START))
        while True:
            with contextlib.suppress(Unavailable):  # the heartbeat says so
                await self._prune()
            await asyncio.sleep(min(seconds, PERIOD))

    async def _prune(self) -> None:
        try:
            while await self._context.run_aside(partial(prune, self._context)) == BATCH:
                continue
        except Unavailable:
            raise
        except Exception:
            log.exception("old answers could not be deleted; the next look is due in %g s", PERIOD)


def prune(context: Context) -> int:
    """Delete the oldest answers that nobody can ask for again, at most a batch; how many they were."""
    keep = nanoseconds(context.settings.answer_seconds)
    with context.writing() as writing:
        old = (
            select(*answers.primary_key)
            .where(answers.c.created_at < writing.now - keep, ~_IN_A_MATCH)
            .order_by(answers.c.created_at)
            .limit(BATCH)
        )
        return writing.connection.execute(delete(answers).where(tuple_(*answers.primary_key).in_(old))).rowcount
