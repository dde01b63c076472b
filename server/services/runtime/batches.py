"""Requests that arrive together are carried out together: one look, one transaction, one flush.

A stroke takes a thread's time in three places: it looks at the database, is played, and is stored; a poll in two. To
hand each request to a thread of its own, and each of its looks and commits to the database, takes longer than what is
done there. So those that came while others were carried out are taken by one thread, and each step is made for all of
them in turn. Each answers for itself: what is refused, or fails, is refused or fails alone
(`server.store.group_commit`), and where a whole step fails each is carried out again by itself, as without batches.
"""

import asyncio
import contextlib
import contextvars
import logging
import queue
import threading
from collections.abc import AsyncIterator, Callable, Iterator
from functools import partial
from typing import Any, Final, TypeVar

from sqlalchemy import Connection
from starlette.concurrency import run_in_threadpool

from server.errors import ServerError
from server.services.runtime.context import Context
from server.services.runtime.steps import Done, Steps
from server.store.group_commit import MOST
from server.store.outages import Overtaken

log = logging.getLogger("pooliad.server.batches")

T = TypeVar("T")


class Batches:
    """The requests of this process that are carried out in steps; in batches where the database shares commits."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._came: queue.SimpleQueue[_Request | None] = queue.SimpleQueue()
        self._is_running = False

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """A thread at work for as long as the block lasts.

        One: a second, which could work while the first waits for the disk, fights with it for the interpreter, and a
        stroke then takes half as much time again.
        """
        if not self._context.database.shares_commits:
            yield
            return
        loop = asyncio.get_running_loop()
        thread = threading.Thread(target=self._work, args=(loop,), name="batches")
        thread.start()
        self._is_running = True
        try:
            yield
        finally:
            self._is_running = False
            self._came.put(None)
            await asyncio.to_thread(thread.join)

    async def carry_out(self, begun: Callable[[], Steps[T, Any]]) -> T:
        """What comes of a request; begun again as long as somebody else is faster.

        An application whose lifespan nobody runs has no threads for batches: each request then has one of its own.
        """
        while True:
            with contextlib.suppress(Overtaken):
                steps = begun()
                if not self._is_running:
                    return await run_in_threadpool(steps.carried_out)
                request = _Request(steps)
                self._came.put(request)
                result: T = await request.answered
                return result

    def _work(self, loop: asyncio.AbstractEventLoop) -> None:
        while batch := self._taken():
            try:
                self._carry_out(batch)
            except BaseException as error:
                log.exception("a batch of %d requests", len(batch))
                for request in _under_way(batch):
                    request.error = error
            with contextlib.suppress(RuntimeError):  # the loop is closed: nobody waits any more
                loop.call_soon_threadsafe(_answer, batch)

    def _taken(self) -> "list[_Request]":
        """Those that came; none at the end."""
        first = self._came.get()
        batch = [] if first is None else [first]
        while batch and len(batch) < MOST:
            try:
                request = self._came.get_nowait()
            except queue.Empty:
                break
            if request is None:
                self._came.put(None)
                break
            batch.append(request)
        return batch

    def _carry_out(self, batch: "list[_Request]") -> None:
        try:
            with self._context.database.reading() as connection:
                for request in batch:
                    request.look(connection)
        except Exception:
            log.warning("a look for %d requests failed, and each is carried out by itself", len(batch), exc_info=True)
            for request in _under_way(batch):
                request.go(request.steps.carried_out)
            return
        for request in _under_way(batch):
            request.prepare()
        ready = list(_under_way(batch))
        together = [request for request in ready if not request.steps.goes_alone]
        stored = self._context.carry_out_together([(each.steps.store, each.variables) for each in together])
        for request, result in zip(together, stored, strict=True):
            request.go(partial(request.finished, result))
        for request in ready:
            if request.steps.goes_alone:
                request.go(request.steps.stored)


class _Request:
    """One of a batch: how far it is, in its own context, and who waits for it."""

    def __init__(self, steps: Steps[Any, Any]) -> None:
        self.steps: Final = steps
        self.variables: Final = contextvars.copy_context()  # its log lines name its own request
        self.answered: Final[asyncio.Future[Any]] = asyncio.get_running_loop().create_future()
        self.done: Done[Any] | None = None
        self.error: BaseException | None = None

    def look(self, connection: Connection) -> None:
        """Its look; a fault of the database is the batch's."""
        try:
            self.done = self.variables.run(self.steps.looked, connection)
        except ServerError as refusal:
            self.error = refusal

    def prepare(self) -> None:
        """What takes no database."""
        try:
            self.variables.run(self.steps.prepare)
        except BaseException as error:
            self.error = error

    def go(self, step: Callable[[], Any]) -> None:
        """Its last step."""
        try:
            self.done = Done(self.variables.run(step))
        except BaseException as error:
            self.error = error

    def finished(self, stored: Callable[[], Any]) -> Any:
        """What comes of it; raises what its part of the transaction raised."""
        return self.steps.finished(stored())

    def answer(self) -> None:
        """Tell who waits for it, if still somebody does. Called on the loop."""
        if self.answered.done():
            return
        if self.error is not None:
            self.answered.set_exception(self.error)
        elif self.done is not None:
            self.answered.set_result(self.done.value)


def _under_way(batch: "list[_Request]") -> "Iterator[_Request]":
    return (request for request in batch if request.done is None and request.error is None)


def _answer(batch: "list[_Request]") -> None:
    for request in batch:
        request.answer()
