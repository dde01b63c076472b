"""Answers to HTTP/1.0, which knows no chunks (RFC 9112, 6.1); uvicorn sends chunks to every reader."""

from typing import Any

from uvicorn.protocols.http.httptools_impl import RequestResponseCycle


class UntilClosed:
    """An answer that ends with its connection when its length is not known.

    Args:
        cycle: the request and its answer, as uvicorn keeps them.
    """

    def __init__(self, cycle: RequestResponseCycle) -> None:
        self._cycle = cycle
        self._send = cycle.send
        self._has_length = True

    async def send(self, message: Any) -> None:
        """Send a part of the answer."""
        cycle = self._cycle
        if message["type"] == "http.response.start":
            self._has_length = any(name.lower() == b"content-length" for name, _ in message.get("headers", ()))
            if not self._has_length:
                cycle.chunked_encoding = cycle.keep_alive = False
        elif not self._has_length:
            cycle.expected_content_length = len(message.get("body", b""))  # each part is as long as it is
        await self._send(message)
