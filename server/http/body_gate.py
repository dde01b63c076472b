"""A request before anything looks at it: an address that can be looked up, the body's size, the time it takes, and when
it was complete.

The body is read as it comes in, whatever else the server is busy with, so that the end of a player's clock is
the arrival of the last byte and not the moment somebody got round to reading it.
"""

import asyncio
from collections.abc import Callable
from typing import Any, Final
from urllib.parse import parse_qsl

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from protocol import shown
from server.errors import (
    HeadTooLarge,
    NotFound,
    ServerError,
    SlowBody,
    TooLarge,
    TwoLengths,
    UnsupportedMediaType,
    invalid_field,
    render,
)
from server.http.held_bytes import HeldBytes
from server.services.runtime.time import TimeSource
from server.settings import Settings

BODILESS = frozenset({"GET", "HEAD", "OPTIONS", "DELETE"})
LARGE: Final = frozenset({"/v1/simulate/batch", "/v1/tournaments"})
"""Where a thousand shots or entrants may come: no other route has use for a large body."""
LONGEST_HEAD: Final = 16 * 1024
"""Bytes of a request line with all header fields: a token, a key and a version have some hundreds."""
UNCOUNTED: Final = 16 * 1024
"""Bytes of each body that are always taken, however much is held already: no stroke is longer."""


class BodyGate:
    """ASGI middleware: collects the body into `scope["state"]["body"]`, its arrival into `…["arrived"]`."""

    def __init__(self, app: ASGIApp, *, settings: Settings, time: TimeSource) -> None:
        self._app = app
        self._limit = settings.body_limit
        self._large_limit = settings.large_body_limit
        self._seconds = settings.body_seconds
        self._held = HeldBytes(settings.held_bodies)
        self._time = time

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let the request through with its body, or answer 400, 404, 408, 413, 415, 422, 429 or 431 in its place."""
        if scope["type"] != "http":
            return await self._app(scope, receive, send)
        with self._held.share() as hold:
            return await self._pass(scope, receive, send, hold)

    async def _pass(self, scope: Scope, receive: Receive, send: Send, hold: Callable[[int], None]) -> None:
        body = None
        try:
            _require_short_head(scope)
            _require_one_length(scope)
            _require_address(scope)
            if scope["method"] not in BODILESS:
                body = await self._collect(scope, receive, hold)
        except _HungUp:
            return None
        except ServerError as error:
            return await render(error, scope["path"])(scope, receive, send)
        if body is None:
            return await self._app(scope, receive, send)
        scope.setdefault("state", {}).update(body=body, arrived=self._time.now())
        return await self._app(scope, _replay(body, receive), send)

    async def _collect(self, scope: Scope, receive: Receive, hold: Callable[[int], None]) -> bytes:
        _require_plain(scope)
        limit = self._large_limit if scope["path"] in LARGE else self._limit
        if _announced_length(scope) > limit:
            raise _too_large(limit)
        try:
            async with asyncio.timeout(self._seconds):
                return await _read(receive, limit, hold)
        except TimeoutError as error:
            allowed = f"{self._seconds:g} seconds"
            raise SlowBody(f"the body was not complete after {allowed}", allowed=allowed) from error


async def _read(receive: Receive, limit: int, hold: Callable[[int], None]) -> bytes:
    body = bytearray()
    while True:
        message = await receive()
        if message["type"] == "http.disconnect":
            raise _HungUp
        body += message.get("body", b"")
        if len(body) > limit:
            raise _too_large(limit)
        hold(max(0, len(body) - UNCOUNTED))
        if not message.get("more_body", False):
            return bytes(body)


def _too_large(limit: int) -> TooLarge:
    return TooLarge(f"the body is larger than {limit} bytes", field="body", allowed=f"at most {limit} bytes")


class _HungUp(Exception):
    """The caller left before the body was complete: nobody to answer, and nothing to carry out."""


def _require_short_head(scope: Scope) -> None:
    """Raise `HeadTooLarge` (RFC 6585, 5). The framework's own limit is on heads that come in pieces alone."""
    line = len(scope["method"]) + len(scope["raw_path"]) + len(scope["query_string"]) + len(" ? HTTP/1.1\r\n")
    size = line + sum(len(name) + len(value) + len(": \r\n") for name, value in scope["headers"])
    if size > LONGEST_HEAD:
        allowed = f"at most {LONGEST_HEAD} bytes"
        detail = f"headers = {size} bytes: must be {allowed} with the request line"
        raise HeadTooLarge(detail, field="headers", value=size, allowed=allowed)


def _require_one_length(scope: Scope) -> None:
    """Raise `TwoLengths` (RFC 9112, 6.3): a proxy may go by the one length, the framework goes by the other."""
    if {b"content-length", b"transfer-encoding"} <= {name for name, _ in scope["headers"]}:
        detail = "the request has a Content-Length and a Transfer-Encoding"
        raise TwoLengths(detail, field="Transfer-Encoding", allowed="one of them")


def _require_address(scope: Scope) -> None:
    """Raise `NotFound` or `Invalid` for an address with a NUL: no id and no name has one, and not every database may be
    asked for one.
    """
    if "\0" in scope["path"]:
        raise NotFound("there is nothing at an address with a NUL")
    if b"%00" in scope["query_string"]:
        for name, value in parse_qsl(scope["query_string"].decode("latin-1"), keep_blank_values=True):
            if "\0" in name + value:
                raise invalid_field(name, value, "a text without NUL")


def _require_plain(scope: Scope) -> None:
    """Raise `UnsupportedMediaType` for a compressed body: nothing is unpacked, so that nothing grows."""
    for name, value in scope["headers"]:
        if name == b"content-encoding" and value.lower() != b"identity":
            coding = value.decode("latin-1")
            detail = f"the body's coding is {coding!r}; nothing is unpacked"
            raise UnsupportedMediaType(detail, field="Content-Encoding", value=shown(coding), allowed="identity")


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
