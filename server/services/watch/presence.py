"""Which agents are there: a poll of theirs is open, or one was a moment ago."""

from collections import Counter

from referee.play.clock import SECOND_NS

LATELY = 10 * SECOND_NS
"""Nanoseconds after its last poll for which an agent counts as being there: between two polls it works."""


class Presence:
    """Who polls this process. Entered and left on the event loop, read from any thread."""

    def __init__(self) -> None:
        self._polls: Counter[str] = Counter()
        self._last: dict[str, int] = {}
        """The end of each agent's last poll, the latest at the end."""

    def enter(self, agent: str) -> None:
        """A poll of this agent begins to wait."""
        self._polls[agent] += 1

    def seen(self, agent: str, now: int) -> None:
        """This agent has asked for its next message."""
        self._last.pop(agent, None)
        self._last[agent] = now
        while now - self._last[longest_ago := next(iter(self._last))] >= LATELY:
            del self._last[longest_ago]

    def leave(self, agent: str, now: int) -> None:
        """A poll of this agent ends."""
        self.seen(agent, now)
        self._polls[agent] -= 1
        if self._polls[agent] <= 0:
            del self._polls[agent]

    def here(self, now: int) -> frozenset[str]:
        """The agents that poll, or did so lately."""
        lately = (agent for agent, last in tuple(self._last.items()) if now - last < LATELY)
        return frozenset(tuple(self._polls)).union(lately)
