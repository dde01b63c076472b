"""The server's one source of time."""

import time
from datetime import UTC, datetime

from referee.play.clock import SECOND_NS


class TimeSource:
    """Whole nanoseconds since 1970 that never jump: anchored to the wall once, then monotonic.

    Every time in the database and every clock reads it, so that setting the machine's clock costs no player
    anything.
    """

    def __init__(self) -> None:
        self._offset = time.time_ns() - time.monotonic_ns()

    def now(self) -> int:
        """Now, in nanoseconds."""
        return self._offset + time.monotonic_ns()


def date_time(nanoseconds: int) -> datetime:
    """A stored time as messages show it."""
    return datetime.fromtimestamp(nanoseconds / SECOND_NS, UTC)
