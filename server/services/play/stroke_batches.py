"""Strokes that arrive together are carried out together: one look, one transaction, one flush.

A stroke takes a thread's time in three places: it looks at the database, is played, and is stored. To hand each stroke
to a thread of its own, and each of its looks and commits to the database, takes longer than what is done there. So
the strokes that came while others were carried out are taken by one thread, and its steps are made for all of them in
turn. Each answers for itself: what is refused, or fails, is refused or fails alone (`server.store.group_commit`), and
where a whole step fails each stroke is carried out again by itself, as without batches.
"""

import asyncio
import contextlib
import contextvars
import logging
import queue
import threading
from collections.abc import AsyncIterator, Callable, Iterator
from functools import partial
from typing import Final

from sqlalchemy import Connection

from server.errors import ServerError
from server.http.commands import Answer
from server.services.play import games, strokes
from server.services.play.live_game import LiveGame
from server.services.play.strokes import Attempt, Move
from server.services.runtime.context import Context
from server.store.group_commit import MOST

log = logging.getLogger("pooliad.server.strokes")

THREADS: Final = 2
"""While one waits for the disk the other plays."""


class StrokeBatches:
    """The strokes of this process, in batches. Only where the database shares commits."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._came: queue.SimpleQueue[_Stroke | None] = queue.SimpleQueue()

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """Threads at work for as long as the block lasts."""
        if not self._context.database.shares_commits:
            yield
            return
        loop = asyncio.get_running_loop()
        threads = [threading.Thread(target=self._work, args=(loop,), name="strokes") for _ in range(THREADS)]
        for thread in threads:
            thread.start()
        try:
            yield
        finally:
            for _ in threads:
                self._came.put(None)
            for thread in threads:
                await asyncio.to_thread(thread.join)

    async def play(self, game_id: str, move: Move) -> Answer:
        """The answer of an ordinary stroke; raises `IsLong` for one of very many events, as `strokes.shoot` does."""
        context = self._context
        context.pulse.require(context.time.now())
        while True:
            stroke = _Stroke(strokes.attempt_of(context, game_id, move))
            self._came.put(stroke)
            with contextlib.suppress(games.MoveConflict):
                return await stroke.answered

    def _work(self, loop: asyncio.AbstractEventLoop) -> None:
        while batch := self._taken():
            try:
                self._carry_out(batch)
            except BaseException as error:
                log.exception("a batch of %d strokes", len(batch))
                for stroke in _under_way(batch):
                    stroke.fail(error)
            with contextlib.suppress(RuntimeError):  # the loop is closed: nobody waits any more
                loop.call_soon_threadsafe(_answer, batch)

    def _taken(self) -> "list[_Stroke]":
        """Those that came; none at the end."""
        first = self._came.get()
        batch = [] if first is None else [first]
        while batch and len(batch) < MOST:
            try:
                stroke = self._came.get_nowait()
            except queue.Empty:
                break
            if stroke is None:
                self._came.put(None)
                break
            batch.append(stroke)
        return batch

    def _carry_out(self, batch: "list[_Stroke]") -> None:
        try:
            with self._context.database.reading() as connection:
                for stroke in batch:
                    stroke.look(connection)
        except Exception:
            log.warning("a look for %d strokes failed, and each is carried out by itself", len(batch), exc_info=True)
            for stroke in _under_way(batch):
                stroke.go(stroke.attempt.carried_out_alone)
            return
        for stroke in _under_way(batch):
            stroke.play()
        playing = list(_under_way(batch))
        together = [stroke for stroke in playing if not stroke.attempt.ends_game]
        stored = self._context.carry_out_together([(stroke.attempt.store, stroke.variables) for stroke in together])
        for stroke, result in zip(together, stored, strict=True):
            stroke.go(partial(stroke.finished, result))
        for stroke in playing:
            if stroke.attempt.ends_game:
                stroke.go(stroke.attempt.stored_alone)


class _Stroke:
    """One of a batch: how far it is, in its own context, and who waits for it."""

    def __init__(self, attempt: Attempt) -> None:
        self.attempt: Final = attempt
        self.variables: Final = contextvars.copy_context()  # its log lines name its own request
        self.answered: Final[asyncio.Future[Answer]] = asyncio.get_running_loop().create_future()
        self._answer: Answer | None = None
        self._error: BaseException | None = None

    @property
    def is_under_way(self) -> bool:
        """Whether there is no answer yet, and no refusal."""
        return self._answer is None and self._error is None

    def look(self, connection: Connection) -> None:
        """Look it up; a fault of the database is the batch's."""
        try:
            self._answer = self.variables.run(self.attempt.looked, connection)
        except ServerError as refusal:
            self._error = refusal

    def play(self) -> None:
        """Play it."""
        try:
            self.variables.run(self.attempt.play)
        except BaseException as error:
            self._error = error

    def go(self, step: Callable[[], Answer]) -> None:
        """Its last step."""
        try:
            self._answer = self.variables.run(step)
        except BaseException as error:
            self._error = error

    def finished(self, stored: Callable[[], tuple[LiveGame, Answer]]) -> Answer:
        """Its answer; raises what its part of the transaction raised."""
        return self.attempt.finished(stored())

    def fail(self, error: BaseException) -> None:
        """It has no answer."""
        self._error = error

    def answer(self) -> None:
        """Tell who waits for it, if still somebody does. Called on the loop."""
        if self.answered.done():
            return
        if self._error is not None:
            self.answered.set_exception(self._error)
        elif self._answer is not None:
            self.answered.set_result(self._answer)


def _under_way(batch: "list[_Stroke]") -> "Iterator[_Stroke]":
    return (stroke for stroke in batch if stroke.is_under_way)


def _answer(batch: "list[_Stroke]") -> None:
    for stroke in batch:
        stroke.answer()
