"""A request's body before anything looks at it: its size, the time it takes, and when it was complete.

The body is read as it comes in, whatever else the server is busy with, so that the end of a player's clock is
the arrival of the last byte and not the moment somebody got round to reading it.
"""

import asyncio
from typing import Any

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from server.errors import ServerError, SlowBody, TooLarge, render
from server.services.time import TimeSource

BODILESS = frozenset({"GET", "HEAD", "OPTIONS", "DELETE"})


class BodyGate:
    """ASGI middleware: collects the body into `scope["state"]["body"]`, its arrival into `…["arrived"]`."""

    def __init__(self, app: ASGIApp, *, limit: int, seconds: float, time: TimeSource) -> None:
        self._app = app
        self._limit = limit
        self._seconds = seconds
        self._time = time

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let the request through with its body, or answer 408 or 413 in its place."""
        if scope["type"] != "http" or scope["method"] in BODILESS:
            return await self._app(scope, receive, send)
        try:
            body = await self._collect(scope, receive)
        except _HungUp:
            return None
        except ServerError as error:
            return await render(error, scope["path"])(scope, receive, send)
        scope.setdefault("state", {}).update(body=body, arrived=self._time.now())
        return await self._app(scope, _replay(body, receive), send)

    async def _collect(self, scope: Scope, receive: Receive) -> bytes:
        if _announced_length(scope) > self._limit:
            raise self._too_large()
        try:
            return await asyncio.wait_for(self._read(receive), self._seconds)
        except TimeoutError as error:
            allowed = f"{self._seconds:g} seconds"
            raise SlowBody(f"the body was not complete after {allowed}", allowed=allowed) from error

    async def _read(self, receive: Receive) -> bytes:
        body = bytearray()
        while True:
            message = await receive()
            if message["type"] == "http.disconnect":
                raise _HungUp
            body += message.get("body", b"")
            if len(body) > self._limit:
                raise self._too_large()
            if not message.get("more_body", False):
                return bytes(body)

    def _too_large(self) -> TooLarge:
        return TooLarge(
            f"the body is larger than {self._limit} bytes",
            field="body",
            allowed=f"at most {self._limit} bytes",
        )


class _HungUp(Exception):
    """The caller left before the body was complete: nobody to answer, and nothing to carry out."""


def _announced_length(scope: Scope) -> int:
    for name, value in scope["headers"]:
        if name == b"content-length":
            return int(value)
    return 0


def _replay(body: bytes, receive: Receive) -> Receive:
    """A `receive` that gives the collected body once, then what the connection says (it was closed)."""
    messages: list[dict[str, Any]] = [{"type": "http.request", "body": body, "more_body": False}]

    async def replayed() -> Message:
        return messages.pop() if messages else await receive()

    return replayed
