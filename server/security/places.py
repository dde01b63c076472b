"""How much of something one caller may hold at a time: a number of places for each."""

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager

from server.errors import TooManyOpen


class Places:
    """What is open, by caller; taken and given back on the event loop. This process's own.

    Args:
        what: `streams` or `polls`.
        most: places of one caller.
    """

    def __init__(self, what: str, most: int) -> None:
        self._what = what
        self._most = most
        self._taken: Counter[str] = Counter()

    @contextmanager
    def one(self, key: str) -> Iterator[None]:
        """A place of this caller's for the length of the block; raises `TooManyOpen`."""
        if (taken := self._taken[key]) >= self._most:
            raise TooManyOpen(key, self._what, taken, self._most)
        self._taken[key] += 1
        try:
            yield
        finally:
            self._taken[key] -= 1
            if not self._taken[key]:
                del self._taken[key]
