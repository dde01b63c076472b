"""What the server does by itself, again and again, for as long as it runs."""

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Awaitable, Callable, Coroutine
from dataclasses import dataclass
from typing import Any

from server.errors import Unavailable

log = logging.getLogger("pooliad.server.periodic")


@contextlib.asynccontextmanager
async def at_work(*work: Coroutine[Any, Any, None]) -> AsyncIterator[None]:
    """Run tasks beside the block; they are cancelled, and have ended, when it is left."""
    tasks = [asyncio.create_task(one) for one in work]
    try:
        yield
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


@dataclass(frozen=True)
class Periodic:
    """A piece of work that is done again and again; one that fails is logged and does not end the others.

    Attributes:
        name: what the log calls it.
        work: done once.
        period: seconds from its end to its next start.
        first: seconds before the first time; None: a period.
        outage: called while the database does not answer; by default silent, because the heartbeat says so.
    """

    name: str
    work: Callable[[], Awaitable[None]]
    period: float
    first: float | None = None
    outage: Callable[[], None] = lambda: None

    async def run(self) -> None:
        """Until it is cancelled."""
        await asyncio.sleep(self.period if self.first is None else self.first)
        while True:
            try:
                await self.work()
            except Unavailable:
                self.outage()
            except Exception:
                log.exception("%s failed; the next is due in %g s", self.name, self.period)
            await asyncio.sleep(self.period)

    def running(self) -> contextlib.AbstractAsyncContextManager[None]:
        """At work for as long as the block lasts."""
        return at_work(self.run())
