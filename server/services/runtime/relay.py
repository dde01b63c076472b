"""Wake-ups between the server processes on one PostgreSQL, by LISTEN and NOTIFY.

They are hints: nothing waits for them to arrive, and while the connection is down everybody looks for news by
themselves every few seconds (`Settings.poll_recheck`).
"""

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Awaitable, Callable

import psycopg

from server.services.runtime.context import Context
from server.services.runtime.periodic import Periodic, at_work
from server.store.postgresql import driver_url

log = logging.getLogger("pooliad.server.relay")

CHANNEL = "pooliad"
LARGEST = 100
"""Names in one message: PostgreSQL takes 8,000 bytes."""
PAUSE = 1.0
"""Seconds before a lost connection is made again."""


class Relay:
    """Sends this process's wake-ups to the others, and wakes callers here for theirs. Idle on SQLite."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._own = 0
        """The process of the sending connection: its messages come back to us too."""

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """The relay at work for as long as the block lasts."""
        if not self._context.database.is_shared:
            yield
            return
        ends = (_until_lost(self._listen), _until_lost(self._send))
        self._outgoing = self._context.wakeups.outgoing = asyncio.Queue()
        async with at_work(*(Periodic("a wake-up connection", work, PAUSE, first=0).run() for work in ends)):
            yield

    async def _listen(self) -> None:
        async with await self._connected() as connection:
            await connection.execute(f"LISTEN {CHANNEL}")
            async for notice in connection.notifies():
                if notice.pid != self._own:
                    self._context.wakeups.wake(notice.payload.split(","))

    async def _send(self) -> None:
        async with await self._connected() as connection:
            self._own = connection.info.backend_pid
            await connection.execute("SET synchronous_commit = off")  # a hint need not outlive a crash
            while True:
                names = [await self._outgoing.get()]
                while len(names) < LARGEST and not self._outgoing.empty():
                    names.append(self._outgoing.get_nowait())
                await connection.execute("SELECT pg_notify(%s, %s)", (CHANNEL, ",".join(names)))

    async def _connected(self) -> psycopg.AsyncConnection:
        return await psycopg.AsyncConnection.connect(driver_url(self._context.database.url), autocommit=True)


def _until_lost(work: Callable[[], Awaitable[None]]) -> Callable[[], Awaitable[None]]:
    """The work, ended in silence but for a warning when its connection is lost."""

    async def attempt() -> None:
        try:
            await work()
        except (psycopg.Error, OSError) as error:
            log.warning("wake-ups between processes are interrupted: %s", error)

    return attempt
