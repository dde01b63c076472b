"""Spectators of live games: one look at the database serves all of them.

Every spectator has a queue. A single task looks for news of all watched games whenever a hint says that something
happened, and from time to time without one, for another process may have written it. Who cannot keep up is sent
home, and resumes from the last event it has.
"""

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Iterable, Sequence

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
"""Events that may wait for a slow spectator; about 10 MB of strokes."""
RETRY = b"retry: 1000\n\n"
"""Milliseconds after which a browser comes back: a restart of the server takes a few seconds."""
KEEP_ALIVE = b": keep-alive\n\n"


class Spectator:
    """Somebody who watches one game, or several at once."""

    def __init__(self, after: dict[str, int], *, several: bool) -> None:
        """`after`: for each game watched the sequence of the last stroke told."""
        self._after = after
        self._several = several
        self._queue: asyncio.Queue[bytes | None] = asyncio.Queue(BACKLOG)

    def encoded(self, news: SpectatorEvent) -> bytes:
        """The event as this spectator reads it; nothing for a stroke that was told before."""
        if news.sequence is not None:
            if news.sequence <= self._after[news.game]:
                return b""
            self._after[news.game] = news.sequence
        return news.among_others if self._several else news.alone

    def tell(self, news: SpectatorEvent) -> None:
        """Queue an event; the result of an only game is the last."""
        if event := self.encoded(news):
            self._put(event)
        if self.is_last(news):
            self._put(None)

    def is_last(self, news: SpectatorEvent) -> bool:
        """Whether the stream ends with this event."""
        return news.kind == RESULT and not self._several

    def send_home(self) -> None:
        """End the stream."""
        self._put(None)

    def _put(self, event: bytes | None) -> None:
        if self._queue.full():
            while not self._queue.empty():
                self._queue.get_nowait()
            event = None
        self._queue.put_nowait(event)

    async def next(self, seconds: float) -> bytes | None:
        """The next event, or a keep-alive after so many seconds without one; None at the end of the stream."""
        try:
            return await asyncio.wait_for(self._queue.get(), seconds)
        except TimeoutError:
            return KEEP_ALIVE


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

    async def watch_one(self, game_id: str, after: int) -> AsyncIterator[bytes]:
        """The stream of one game: how it stands, its strokes after a sequence, then all that happens.

        Raises `NotFound` before the stream begins.
        """
        told, standing = await run_in_threadpool(opening, self._context, game_id, after)
        return self._stream(Spectator({game_id: after}, several=False), told, {game_id: standing})

    async def watch_many(self, game_ids: Sequence[str]) -> AsyncIterator[bytes]:
        """The stream of several games: how they stand, then all that happens; raises `NotFound`."""
        openings = {one: await run_in_threadpool(opening, self._context, one, None) for one in game_ids}
        standings = {one: standing for one, (_, standing) in openings.items()}
        spectator = Spectator({one: standing.sequence for one, standing in standings.items()}, several=True)
        return self._stream(spectator, [news for told, _ in openings.values() for news in told], standings)

    async def _stream(
        self, spectator: Spectator, told: Sequence[SpectatorEvent], standings: dict[str, SpectatorState]
    ) -> AsyncIterator[bytes]:
        self._join(spectator, standings)
        try:
            yield RETRY
            for news in told:
                if event := spectator.encoded(news):
                    yield event
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
                await asyncio.wait_for(self._hint.wait(), self._context.settings.stream_recheck)
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
        for one in news:
            for spectator in self._watching.get(one.game, ()):
                spectator.tell(one)
