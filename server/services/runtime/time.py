"""The server's one source of time: this process's clock, or the database's where several processes share it."""

import threading
import time
from collections.abc import Callable
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

    def adjust(self) -> None:
        """Follow the clock that is to be followed, if it is another's; called with every heartbeat."""


class DatabaseTime(TimeSource):
    """The database's clock, for several processes that share one: monotonic in between, and never going back.

    The database read its clock at some moment between the question and the answer, which bounds how far off this
    process can be; it moves no farther than into those bounds. So all processes agree to within a round trip.

    Args:
        read: asks the database for its time, ns since 1970.
        monotonic: this process's clock, ns.
    """

    def __init__(self, read: Callable[[], int], monotonic: Callable[[], int] = time.monotonic_ns) -> None:
        super().__init__()
        self._read, self._monotonic = read, monotonic
        self._last = 0
        self._lock = threading.Lock()

    def now(self) -> int:
        """Now, in nanoseconds, never less than before."""
        with self._lock:
            self._last = max(self._last, self._offset + self._monotonic())
            return self._last

    def adjust(self) -> None:
        """Ask the database, and go where its answer says that the time is."""
        asked = self._monotonic()
        told = self._read()
        answered = self._monotonic()
        self._offset = min(max(self._offset, told - answered), told - asked)


def date_time(nanoseconds: int) -> datetime:
    """A stored time as messages show it."""
    return datetime.fromtimestamp(nanoseconds / SECOND_NS, UTC)
