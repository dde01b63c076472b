"""What a connection may do before there is a request: one that does not finish its headers in time is closed (408,
whatever trickles in), and so is one too many from the same address (429). And what it may do after one: whose answer
is not being read is closed too.

The server's framework has a timeout for connections that are idle between requests, none for headers that never end
nor for answers that nobody reads, and no bound on one caller's share of the connections.
"""

import asyncio
from collections import Counter
from functools import partial
from http import HTTPStatus
from typing import Any, ClassVar

from uvicorn.protocols.http.httptools_impl import RequestResponseCycle

from server.http.messages import OneAtATime
from server.settings import Settings

NO_SNIFFING = b"x-content-type-options: nosniff\r\n"
TIMED_OUT = b"HTTP/1.1 408 Request Timeout\r\nconnection: close\r\n" + NO_SNIFFING + b"content-length: 0\r\n\r\n"
TOO_MANY = (
    b"HTTP/1.1 429 Too Many Requests\r\nconnection: close\r\nretry-after: 1\r\ncontent-type: text/plain\r\n"
    + NO_SNIFFING
    + b"content-length: 36\r\n\r\ntoo many connections of this address"
)

WRITE = "pooliad.write"
"""The extension of a request's scope that writes part of its answer at once, if the reader has read all before it."""

GONE = "pooliad.gone"
"""The extension that says whether the reader has hung up: to ask the framework takes a task that is cancelled."""

LEAST_READ = 64 * 1024
"""Bytes."""


class Unread:
    """Bytes of answers that wait to be read, of all connections of this process together.

    Args:
        most: of them.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._waiting: dict[object, int] = {}

    def is_too_much(self, connection: object, waiting: int) -> bool:
        """Whether with so many bytes of this connection there are more than allowed; else they are noted."""
        if waiting + sum(self._waiting.values()) - self._waiting.get(connection, 0) > self._most:
            return True
        self._waiting[connection] = waiting
        return False

    def forget(self, connection: object) -> None:
        """Nothing of this connection waits any more."""
        self._waiting.pop(connection, None)


def http_protocol(settings: Settings) -> type[OneAtATime]:
    """uvicorn's protocol, bounded: the class, with what the connections of one server share."""
    unread = Unread(settings.held_answers)
    members = {"settings": settings, "open_by_address": Counter(), "unread": unread, "frames": _Frames()}
    return type("Bounded", (_Bounded,), members)


class _Frames:
    """Parts of answers of unknown length as RFC 9112, 7.1 has them; the last is kept, for it often goes to many."""

    _part = _framed = b""

    def of(self, part: bytes) -> bytes:
        """The part, framed."""
        if part is not self._part:
            self._part, self._framed = part, b"%x\r\n%b\r\n" % (len(part), part)
        return self._framed


class _Bounded(OneAtATime):
    """A connection whose headers have a deadline and whose answers must be read, one of its address's few."""

    settings: ClassVar[Settings]
    open_by_address: ClassVar[Counter[str]]
    unread: ClassVar[Unread]
    frames: ClassVar[_Frames]
    _deadline: asyncio.TimerHandle | None = None
    _reading: asyncio.TimerHandle | None = None
    _address: str | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """The first request's headers are awaited from now on, unless the address has too many connections."""
        super().connection_made(transport)
        self._address = str((transport.get_extra_info("peername") or ("unknown",))[0])
        self.open_by_address[self._address] += 1
        if 0 < self.settings.address_connections < self.open_by_address[self._address]:
            transport.write(TOO_MANY)
            transport.close()
        else:
            self._await_headers()

    def data_received(self, data: bytes) -> None:
        """Bytes came: part of the headers, the rest of them, or something after them."""
        super().data_received(data)
        if self.is_idle and self._deadline is None:
            self._await_headers()

    def _go_on(self) -> None:
        """Parse what came; a head that came in part, or a body whose request is answered already, has its time."""
        super()._go_on()
        if self._is_refused:
            return
        if not self.is_idle:
            self._stop_waiting()
        elif self._deadline is None and self._came:
            self._await_headers()

    def connection_lost(self, exc: Exception | None) -> None:
        """Nothing is awaited any more, and the address has a place again."""
        self._stop_waiting()
        self._stop_watching()
        if self._address is not None:
            self.open_by_address[self._address] -= 1
            if not self.open_by_address[self._address]:
                del self.open_by_address[self._address]
        super().connection_lost(exc)

    def _refuse(self, status: HTTPStatus) -> None:
        """Refuse what came; the sender has time to read that and to hang up."""
        super()._refuse(status)
        self._stop_waiting()
        self._await_headers()

    def on_headers_complete(self) -> None:
        """Requests that came are begun on the loop's next round: until then their scope may be added to."""
        super().on_headers_complete()
        extensions: Any = self.scope.setdefault("extensions", {})
        extensions[WRITE] = partial(self._write_part, self.cycle)
        extensions[GONE] = partial(getattr, self.cycle, "disconnected")

    def _write_part(self, cycle: RequestResponseCycle, part: bytes) -> bool:
        """Write part of an answer of unknown length; False when it has to wait.

        Between its parts such an answer leaves no trace in the framework but that there are more to come.
        """
        is_open = self.cycle is cycle and not cycle.disconnected and not cycle.response_complete
        if not is_open or not cycle.chunked_encoding or self.transport.get_write_buffer_size():
            return False
        self.transport.write(self.frames.of(part))
        return True

    def pause_writing(self) -> None:
        """More is written than is being read."""
        super().pause_writing()
        waiting = self.transport.get_write_buffer_size()
        if self.unread.is_too_much(self, waiting):
            self.transport.abort()
        else:
            self._await_reader(waiting)

    def resume_writing(self) -> None:
        """It was read."""
        super().resume_writing()
        self._stop_watching()

    def _await_reader(self, waiting: int) -> None:
        self._reading = self.loop.call_later(self.settings.unread_seconds, self._require_read, waiting)

    def _require_read(self, waiting: int) -> None:
        left = self.transport.get_write_buffer_size()
        if left > waiting - LEAST_READ or self.unread.is_too_much(self, left):
            self.transport.abort()
        else:
            self._await_reader(left)

    def _stop_watching(self) -> None:
        self.unread.forget(self)
        if self._reading is not None:
            self._reading.cancel()
            self._reading = None

    def _await_headers(self) -> None:
        self._deadline = self.loop.call_later(self.settings.header_seconds, self._give_up)

    def _stop_waiting(self) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
            self._deadline = None

    def _give_up(self) -> None:
        if not self.transport.is_closing() and not self._is_refused:
            self.transport.write(TIMED_OUT)
        self.transport.close()
