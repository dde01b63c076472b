"""Spectators of live games: one look at the database serves all of them.

A single task looks for news of all watched games whenever a hint says that something
happened, and from time to time without one, for another process may have written it. What it finds out about a game
is encoded once and written to everybody who has read all that came before; the others have a queue. Who cannot keep up
is sent home, and resumes from the last event it has.
"""

import asyncio
import contextlib
import logging
from collections import deque
from collections.abc import AsyncIterator, Callable, Iterable, Sequence
from functools import cached_property
from itertools import groupby

from starlette.concurrency import run_in_threadpool

from server.errors import Unavailable
from server.services.runtime.context import Context
from server.services.runtime.periodic import at_work
from server.services.runtime.wakeups import EVERYBODY
from server.services.watch.spectator_events import RESULT, SpectatorEvent, SpectatorState, opening, since

log = logging.getLogger("pooliad.server.spectators")

BREATH = 0.05
"""Seconds between two looks at least: with many games at once a look serves many strokes."""
BACKLOG = 256
"""Looks whose events may wait for a slow spectator; about 10 MB of strokes."""
RETRY = b"retry: 1000\n\n"
"""Milliseconds after which a browser comes back: a restart of the server takes a few seconds."""
KEEP_ALIVE = b": keep-alive\n\n"


Write = Callable[[bytes], bool]
"""Writes part of an answer at once, past everything that waits to be sent; False, and nothing written, when the reader
has not read all that was sent."""


def never(_: bytes) -> bool:
    """For a connection that nothing can be written to at once."""
    return False


class News:
    """What one look found out about a game, encoded once for all who watch it."""

    def __init__(self, events: Sequence[SpectatorEvent]) -> None:
        self._events = tuple(events)
        self.game = self._events[0].game
        self.is_result = any(each.kind == RESULT for each in self._events)
        sequences = [each.sequence for each in self._events if each.sequence is not None]
        self._first, self._last = min(sequences, default=None), max(sequences, default=0)

    @cached_property
    def _alone(self) -> bytes:
        return b"".join(each.alone for each in self._events)

    @cached_property
    def _among_others(self) -> bytes:
        return b"".join(each.among_others for each in self._events)

    def encoded(self, after: int, *, several: bool) -> tuple[bytes, int]:
        """The events without strokes up to a sequence, and the sequence of the last stroke told then."""
        last = max(after, self._last)
        if self._first is not None and self._first <= after:
            new = [each for each in self._events if each.sequence is None or each.sequence > after]
            return b"".join([each.among_others if several else each.alone for each in new]), last
        return self._among_others if several else self._alone, last


class Spectator:
    """Somebody who watches one game, or several at once.

    Args:
        after: for each game watched the sequence of the last stroke told.
        several: whether events are to say which game they are about.
        write: to this spectator at once.
    """

    def __init__(self, after: dict[str, int], *, several: bool, write: Write = never) -> None:
        self._after = after
        self._several = several
        self._write = write
        self._backlog: deque[bytes | None] = deque()
        self._waiting: asyncio.Future[None] | None = None

    def encoded(self, news: News) -> bytes:
        """The events as this spectator reads them, without strokes that were told before."""
        text, self._after[news.game] = news.encoded(self._after[news.game], several=self._several)
        return text

    def tell(self, news: News) -> None:
        """Write the events, or queue them behind others; the result of an only game is the last."""
        text = self.encoded(news)
        if text and not (self._is_idle() and self._write(text)):
            self._put(text)
        if self.is_last(news):
            self._put(None)

    def is_last(self, news: News) -> bool:
        """Whether the stream ends with these events."""
        return news.is_result and not self._several

    def send_home(self) -> None:
        """End the stream."""
        self._put(None)

    def _is_idle(self) -> bool:
        """Whether all that was queued is on its way: what is written now comes after it."""
        return self._waiting is not None and not self._waiting.done()

    def _put(self, event: bytes | None) -> None:
        if len(self._backlog) >= BACKLOG:
            self._backlog.clear()
            event = None
        self._backlog.append(event)
        self._wake()

    def _wake(self) -> None:
        if self._waiting is not None and not self._waiting.done():
            self._waiting.set_result(None)

    async def next(self, seconds: float) -> bytes | None:
        """The next events, or a keep-alive if `seconds` pass without one; None at the end of the stream."""
        if not self._backlog:
            loop = asyncio.get_running_loop()
            self._waiting = loop.create_future()
            end = loop.call_later(seconds, self._wake)
            try:
                await self._waiting
            finally:
                end.cancel()
                self._waiting = None
        return self._backlog.popleft() if self._backlog else KEEP_ALIVE


class Spectators:
    """All who watch, and what they know together."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._known: dict[str, SpectatorState] = {}
        self._watching: dict[str, set[Spectator]] = {}
        self._hint = asyncio.Event()

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """The looking task at work for as long as the block lasts."""
        self._hint = self._context.wakeups.listen(EVERYBODY)
        try:
            async with at_work(self._run()):
                yield
        finally:
            self._context.wakeups.leave(EVERYBODY, self._hint)

    async def watch_one(self, game_id: str, after: int, write: Write = never) -> AsyncIterator[bytes]:
        """The stream of one game: how it stands, its strokes after a sequence, then all that happens.

        Raises `NotFound` before the stream begins.
        """
        told, standing = await run_in_threadpool(opening, self._context, game_id, after)
        return self._stream(Spectator({game_id: after}, several=False, write=write), told, {game_id: standing})

    async def watch_many(self, game_ids: Sequence[str], write: Write = never) -> AsyncIterator[bytes]:
        """The stream of several games: how they stand, then all that happens; raises `NotFound`."""
        openings = {one: await run_in_threadpool(opening, self._context, one, None) for one in game_ids}
        standings = {one: standing for one, (_, standing) in openings.items()}
        after = {one: standing.sequence for one, standing in standings.items()}
        spectator = Spectator(after, several=True, write=write)
        return self._stream(spectator, [event for told, _ in openings.values() for event in told], standings)

    async def _stream(
        self, spectator: Spectator, told: Sequence[SpectatorEvent], standings: dict[str, SpectatorState]
    ) -> AsyncIterator[bytes]:
        self._join(spectator, standings)
        try:
            yield RETRY
            for event in told:  # one by one: those of a whole game are many
                news = News((event,))
                if text := spectator.encoded(news):
                    yield text
                if spectator.is_last(news):
                    return
            while (waited := await spectator.next(self._context.settings.stream_keepalive)) is not None:
                yield waited
        finally:
            self._leave(spectator, standings)

    def _join(self, spectator: Spectator, standings: dict[str, SpectatorState]) -> None:
        """Look again from where the new spectator stands: something may have happened since it was told."""
        if self._context.wakeups.draining.is_set():
            spectator.send_home()
        for game_id, standing in standings.items():
            self._watching.setdefault(game_id, set()).add(spectator)
            known = self._known.setdefault(game_id, standing)
            if standing.marks.version < known.marks.version:
                self._known[game_id] = standing
        self._hint.set()

    def _leave(self, spectator: Spectator, game_ids: Iterable[str]) -> None:
        for game_id in game_ids:
            self._watching[game_id].discard(spectator)
            if not self._watching[game_id]:
                del self._watching[game_id], self._known[game_id]

    async def _run(self) -> None:
        while not self._context.wakeups.draining.is_set():
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(self._context.settings.stream_recheck):
                    await self._hint.wait()
            self._hint.clear()
            try:
                await self._look()
            except Unavailable:
                log.warning("the spectators wait: the database does not answer")
            except Exception:
                log.exception("looking for news failed; the spectators wait for the next look")
            await asyncio.sleep(BREATH)
        for spectator in {one for watching in self._watching.values() for one in watching}:
            spectator.send_home()

    async def _look(self) -> None:
        """Tell everybody what happened. Who joined or left meanwhile is met by the next look."""
        if not self._known:
            return
        asked = dict(self._known)
        news, standings = await run_in_threadpool(since, self._context, asked)
        for game_id, standing in standings.items():
            if self._known.get(game_id) is asked[game_id]:
                self._known[game_id] = standing
        for game_id, events in groupby(news, lambda event: event.game):
            found = News(tuple(events))
            for spectator in self._watching.get(game_id, ()):
                spectator.tell(found)
