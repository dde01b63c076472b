"""Whether this process's signs of life reach the database: without them no clock may cost anybody a game."""

from typing import Final

from server.store.outages import unavailable

MISSED_BEATS: Final = 3
"""Heartbeats that may be missed. Then a process is dead for the others; what it had in hand is lost, and its players
send it again. For itself its database is gone."""


class HeartbeatHealth:
    """The last heartbeat that was stored.

    Args:
        period: nanoseconds between two heartbeats.

    Attributes:
        has_failed: whether one failed since.
    """

    def __init__(self, period: int) -> None:
        self.longest_gap: Final = MISSED_BEATS * period
        self.has_failed = False
        self._last = 0

    def felt(self, now: int) -> None:
        """A heartbeat was stored."""
        self._last, self.has_failed = now, False

    def missed(self) -> None:
        """The database did not take one. One that is merely late, on a busy machine, is none of these."""
        self.has_failed = True

    def is_lost(self, now: int) -> bool:
        """Whether the database has not taken any for too long."""
        return self.has_failed and now - self._last > self.longest_gap

    def require(self, now: int) -> None:
        """Raise `Unavailable` when the pulse is lost.

        The database may be back already, but nobody has been given back the time that it was away.
        """
        if self.is_lost(now):
            raise unavailable()
