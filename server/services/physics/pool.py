"""Threads of their own for simulations that clients ask for, so that players' shots never wait behind them."""

import asyncio
import contextlib
import os
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from server.errors import Draining, TooManyRequests

T = TypeVar("T")

WAITING = 32
"""Requests that may wait for a thread: each holds a body of up to two megabytes."""
NICENESS = 10
"""How far these threads step back, on systems where a thread can: the shots of games go first."""


class PhysicsPool:
    """A few threads that simulate; the interpreter is not held while they do."""

    def __init__(self, threads: int) -> None:
        self._threads = threads
        self._pool = ThreadPoolExecutor(threads, "physics", initializer=_step_back)
        self._busy = 0
        self._closed = False

    @property
    def busy(self) -> int:
        """Requests being worked on or waiting."""
        return self._busy

    async def run(self, work: Callable[[], T]) -> T:
        """What `work` returns, done by one of the threads; raises `TooManyRequests` when too many wait already."""
        if self._busy >= self._threads + WAITING:
            raise TooManyRequests("physics of this server", 1, f"{WAITING} requests waiting")
        self._busy += 1
        try:
            return await asyncio.get_running_loop().run_in_executor(self._pool, work)
        finally:
            self._busy -= 1

    def require_open(self) -> None:
        """Raise `Draining` once nobody waits for the work any more; long work asks now and then."""
        if self._closed:
            raise Draining("the server is shutting down; ask the next one")

    def close(self) -> None:
        """Let the threads end when they next ask, or are done; what waits is dropped."""
        self._closed = True
        self._pool.shutdown(wait=False, cancel_futures=True)


def _step_back() -> None:
    if sys.platform == "linux":
        with contextlib.suppress(OSError):
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICENESS)
