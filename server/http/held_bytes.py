"""How much of the bodies of all requests together is in memory."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from server.errors import TooManyRequests


class HeldBytes:
    """Bytes held by requests, taken and given back on the event loop. This process's own.

    Args:
        most: of all requests together.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._held = 0

    @contextmanager
    def share(self) -> Iterator[Callable[[int], None]]:
        """What one request holds, given back at the end of the block.

        To be called with all that it holds by now; raises `TooManyRequests` when that is too much beside the others.
        """
        share = 0

        def hold(size: int) -> None:
            nonlocal share
            if self._held + size - share > self._most:
                raise TooManyRequests("bodies of this server", 1, f"{self._most} bytes at once")
            self._held += size - share
            share = size

        try:
            yield hold
        finally:
            self._held -= share
