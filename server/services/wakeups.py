"""Hints that something may have happened for a caller.

A hint is never the news itself: who wakes looks it up.
"""

import asyncio
from collections import defaultdict
from collections.abc import Iterable

EVERYBODY = "*"
"""Listening for this is listening for every agent's news at once."""


class Wakeups:
    """Who waits for which agent's news.

    Waiting is done on the event loop; `notify` may come from any thread.
    """

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        self._waiting: defaultdict[str, set[asyncio.Event]] = defaultdict(set)
        self.draining = asyncio.Event()

    def start(self) -> None:
        """Remember the running loop; called once when the server starts."""
        self._loop = asyncio.get_running_loop()

    def notify(self, agents: Iterable[str]) -> None:
        """Wake everybody who waits for one of these agents."""
        if self._loop is not None:
            self._loop.call_soon_threadsafe(self._set, tuple(agents))

    def drain(self) -> None:
        """Send every waiting caller home: the server is stopping. Called on the loop."""
        self.draining.set()
        self._set(tuple(self._waiting))

    def _set(self, agents: tuple[str, ...]) -> None:
        for agent in (*agents, EVERYBODY):
            for event in self._waiting.get(agent, ()):
                event.set()

    def listen(self, agent: str) -> asyncio.Event:
        """Start listening for an agent; give the event back to `leave`."""
        event = asyncio.Event()
        self._waiting[agent].add(event)
        return event

    def leave(self, agent: str, event: asyncio.Event) -> None:
        """Stop listening."""
        self._waiting[agent].discard(event)
        if not self._waiting[agent]:
            del self._waiting[agent]
