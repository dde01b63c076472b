"""A connection that does not finish its request's headers in time is closed: 408, whatever trickles in.

The server's framework has a timeout for connections that are idle between requests and none for headers that never end.
"""

import asyncio

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

TIMED_OUT = b"HTTP/1.1 408 Request Timeout\r\nconnection: close\r\ncontent-length: 0\r\n\r\n"


def http_protocol(seconds: float) -> type[H11Protocol]:
    """uvicorn's protocol with a limit on the time that headers take.

    Args:
        seconds: from the connection, or from the first byte of a later request on it, to the end of the headers.
    """

    class Guarded(_Guarded):
        header_seconds = seconds

    return Guarded


class _Guarded(H11Protocol):
    """A connection whose headers have a deadline."""

    header_seconds: float
    _deadline: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """The first request's headers are awaited from now on."""
        super().connection_made(transport)
        self._await_headers()

    def data_received(self, data: bytes) -> None:
        """Bytes came: part of the headers, the rest of them, or something after them."""
        super().data_received(data)
        if self.conn.their_state is not h11.IDLE:
            self._stop_waiting()
        elif self._deadline is None and self.conn.trailing_data[0]:
            self._await_headers()

    def connection_lost(self, exc: Exception | None) -> None:
        """Nothing is awaited any more."""
        self._stop_waiting()
        super().connection_lost(exc)

    def _await_headers(self) -> None:
        self._deadline = self.loop.call_later(self.header_seconds, self._give_up)

    def _stop_waiting(self) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None

    def _give_up(self) -> None:
        if not self.transport.is_closing():
            self.transport.write(TIMED_OUT)
            self.transport.close()
