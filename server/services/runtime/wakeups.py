"""Hints that something may have happened for a caller.

A hint is never the news itself: who wakes looks it up. A hint that is lost costs the time until the next look.
"""

import asyncio
import threading
from collections import defaultdict
from collections.abc import Iterable

EVERYBODY = "*"
"""Listening for this is listening for every agent's news at once."""


class Wakeups:
    """Who waits for which agent's news.

    Waiting is done on the event loop; `notify` may come from any thread. `outgoing`, when there is one, takes what
    other processes should hear too (`server.services.runtime.relay`).
    """

    def __init__(self) -> None:
        self._loop: asyncio.AbstractEventLoop | None = None
        self._waiting: defaultdict[str, set[asyncio.Event]] = defaultdict(set)
        self._told: set[str] = set()
        self._lock = threading.Lock()
        self.draining = asyncio.Event()
        self.outgoing: asyncio.Queue[str] | None = None

    def start(self) -> None:
        """Remember the running loop; called once when the server starts."""
        self._loop = asyncio.get_running_loop()

    def notify(self, agents: Iterable[str]) -> None:
        """Wake everybody who waits for one of these agents; nobody does once the loop has ended.

        One call of the loop does for all that come before it is carried out.
        """
        if self._loop is None:
            return
        with self._lock:
            is_called, self._told = bool(self._told), self._told.union(agents)
        if is_called:
            return
        try:
            self._loop.call_soon_threadsafe(self._tell)
        except RuntimeError:
            if not self._loop.is_closed():
                raise

    def drain(self) -> None:
        """Send every waiting caller home: the server is stopping. Called on the loop."""
        self.draining.set()
        self.wake(tuple(self._waiting))

    def _tell(self) -> None:
        with self._lock:
            agents, self._told = self._told, set()
        self.wake(agents)
        if self.outgoing is not None:
            for agent in agents:
                self.outgoing.put_nowait(agent)

    def wake(self, agents: Iterable[str]) -> None:
        """Wake who waits in this process. Called on the loop."""
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
