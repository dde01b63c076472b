"""Strokes of very many events, which cost a thousand times an ordinary one, hold nobody up.

An ordinary stroke has some hundred events and costs milliseconds; one of 20,000, on a table and from a start made for
it, costs seconds of the interpreter and 20 MB of the database. Such strokes are played one at a time in each process,
with a rest after each, so that together they take a share of the server and no more, however many ask for them. They
wait on the event loop, where they keep no thread from anybody.

Once a stroke was found to be long its game waits for it: nobody learns from the wait what noise did to a stroke, and
then plays another.
"""

import asyncio
import time
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from typing import Final, TypeVar

from starlette.concurrency import run_in_threadpool

MOST_EVENTS: Final = 2_000
"""Events of a stroke that is not long. Breaks have a hundred, and the stress run's ordinary classes at most some
hundred (docs/benchmarks.md)."""
SHARE: Final = 0.25
"""Of the time in which long strokes are played at most, when many wait."""

T = TypeVar("T")


class IsLong(Exception):
    """A stroke that was played as an ordinary one has more than `MOST_EVENTS`; nothing is stored."""


class LongStrokes:
    """Whose turn it is to have a long stroke played, in one process.

    Args:
        now: seconds that only grow.
    """

    def __init__(self, now: Callable[[], float] = time.monotonic) -> None:
        self._now = now
        self._free_at = now()
        self._one = asyncio.Lock()
        self._waiting: dict[str, asyncio.Event] = {}

    async def play(self, game_id: str, ordinary: Callable[[], Awaitable[T]], long: Callable[[], T]) -> T:
        """What comes of a stroke.

        Args:
            game_id: the game that the stroke belongs to.
            ordinary: plays the stroke; raises `IsLong` for one that is.
            long: plays a long one, in a thread.
        """
        while (before := self._waiting.get(game_id)) is not None:
            await before.wait()
        try:
            return await ordinary()
        except IsLong:
            async with self._turn(game_id):
                return await run_in_threadpool(long)

    @asynccontextmanager
    async def _turn(self, game_id: str) -> AsyncIterator[None]:
        """Wait for the strokes before this one, and for the rest after them; the game's other requests wait for it."""
        over = asyncio.Event()
        self._waiting.setdefault(game_id, over)
        try:
            async with self._one:
                await asyncio.sleep(max(0.0, self._free_at - self._now()))
                began = self._now()
                try:
                    yield
                finally:
                    ended = self._now()
                    self._free_at = ended + (ended - began) * (1.0 / SHARE - 1.0)
        finally:
            if self._waiting.get(game_id) is over:
                del self._waiting[game_id]
            over.set()
