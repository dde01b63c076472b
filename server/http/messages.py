"""One request at a time: what comes behind one is parsed when that one is answered.

uvicorn's protocol on httptools hands a parser whatever comes. That parser goes on from one request to the next, keeps
parts of heads without bound, adds the fields behind a body to those before it, and skips the body of a request that
asks for another protocol: its bytes would be taken for the next request. Here the end of a head, and of a body whose
length is known, is found before the parser sees it, and what the parser makes of it must end in the same place.
"""

import asyncio
import re
from collections.abc import Callable
from http import HTTPStatus
from typing import Final

import httptools
from uvicorn.protocols.http.httptools_impl import STATUS_LINE, HttpToolsProtocol

from server.http.body_gate import LONGEST_HEAD
from server.http.until_closed import UntilClosed

BLANK_LINE: Final = re.compile(rb"\n\r?\n")
UPGRADE: Final = re.compile(rb"\nupgrade:[^\n]*(?=\n)", re.IGNORECASE)
"""A field that asks for another protocol; it may be ignored (RFC 9110, 7.8), and with the field its parser's ways."""
FIRST_LINE: Final = re.compile(rb"[A-Z]+ [!-~]+ HTTP/1\.[01]\r\n")
LETTERS: Final = range(ord("A"), ord("Z") + 1)


class Unreadable(Exception):
    """What came is no request, or one that may be read in two ways."""


class HeadTooLong(Unreadable):
    """A head that is longer than `LONGEST_HEAD`, finished or not."""


class OneAtATime(HttpToolsProtocol):
    """A connection whose requests are parsed one after the other, none before the one before it is answered."""

    _cut: Callable[[], bytes]
    _came: bytearray
    """Not yet given to the parser."""
    _sought = 0
    """Of these, searched for the end of a head."""
    _left = 0
    """Bytes that the body still has, where its length is known."""
    _since_body = 0
    """Bytes between two pieces of a body in chunks, or behind the last."""
    _may_begin = False
    """Whether the parser was given a head of which it has not seen the beginning."""
    _has_head = False
    _is_refused = False

    @property
    def is_idle(self) -> bool:
        """Whether all that was asked is answered."""
        return self.cycle is None or self.cycle.response_complete

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """A head is first."""
        super().connection_made(transport)
        self._came, self._cut = bytearray(), self._cut_head

    def data_received(self, data: bytes) -> None:
        """Bytes came; they are parsed as far as it is their turn."""
        self._unset_keepalive_if_required()
        if not self._is_refused:
            self._came += data
            self._go_on()

    def on_response_complete(self) -> None:
        """A request is answered: what came behind it is next."""
        super().on_response_complete()
        if self._came:
            self._go_on()

    def _go_on(self) -> None:
        try:
            while not self.transport.is_closing() and (piece := self._cut()):
                self.parser.feed_data(piece)
        except (Unreadable, httptools.HttpParserError, httptools.HttpParserUpgrade) as error:
            self._refuse(HTTPStatus(431) if isinstance(error, HeadTooLong) else HTTPStatus.BAD_REQUEST)
        else:
            if self._came and not self.is_idle:
                self.flow.pause_reading()

    # what the parser is given

    def _cut_head(self) -> bytes:
        """A whole head, when it is there and its turn: with the blank line at its end (RFC 9112, 2.1)."""
        if not self._came or not self.is_idle:
            return b""
        if self._came[0] not in LETTERS:
            raise Unreadable
        found = BLANK_LINE.search(self._came, max(0, self._sought - 2))
        if found is None:
            self._sought = len(self._came)
            if self._sought > LONGEST_HEAD:
                raise HeadTooLong
            return b""
        self._sought, self._has_head, self._may_begin = 0, False, True
        head = self._taken(found.end())
        if FIRST_LINE.match(head) is None:
            raise Unreadable
        self._cut = self._cut_nothing
        return UPGRADE.sub(b"", head)

    def _cut_nothing(self) -> bytes:
        """The parser saw no end of the head where one was found."""
        raise Unreadable

    def _cut_counted(self) -> bytes:
        """What has come of a body whose length the head says."""
        piece = self._taken(self._left)
        self._left -= len(piece)
        return piece

    def _cut_chunk(self) -> bytes:
        """A line, or what there is of one: no body in chunks ends but with a line."""
        if self._since_body > LONGEST_HEAD:
            raise Unreadable
        piece = self._taken(self._came.find(b"\n") + 1 or len(self._came))
        self._since_body += len(piece)  # nothing, once the parser finds a part of the body in it
        return piece

    def _taken(self, size: int) -> bytes:
        piece = bytes(self._came[:size])
        del self._came[:size]
        return piece

    # what the parser says

    def on_message_begin(self) -> None:
        """A request begins, the only one in its head."""
        if not self._may_begin:
            raise Unreadable
        self._may_begin = False
        super().on_message_begin()

    def on_header(self, name: bytes, value: bytes) -> None:
        """Take a field of a head without blanks behind its value (RFC 9110, 5.5); drop it behind the body (6.5.1)."""
        if not self._has_head:
            super().on_header(name, value.rstrip(b" \t"))

    def on_headers_complete(self) -> None:
        """Begin to answer a request whose host and length are beyond doubt."""
        if self.parser.should_upgrade():
            raise Unreadable  # CONNECT: any other request's wish was left out
        self._require_one_host()
        self._has_head = True
        self._frame_body()
        self._unset_keepalive_if_required()
        super().on_headers_complete()
        if self.parser.get_http_version() == "1.0":
            self.cycle.send = UntilClosed(self.cycle).send  # type: ignore[method-assign]

    def _require_one_host(self) -> None:
        """Raise `Unreadable` (RFC 9112, 3.2)."""
        hosts = sum(name == b"host" for name, _ in self.headers)
        if hosts > 1 or (hosts == 0 and self.parser.get_http_version() == "1.1"):
            raise Unreadable

    def _frame_body(self) -> None:
        """Find out where the body ends (RFC 9112, 6.3); the parser refuses a request with both fields."""
        self._left, self._cut = 0, self._cut_counted
        for name, value in self.headers:
            if name == b"content-length":
                self._left = int(value)
            elif name == b"transfer-encoding":
                if value.lower() != b"chunked":
                    raise Unreadable
                self._since_body, self._cut = 0, self._cut_chunk

    def on_body(self, body: bytes) -> None:
        """A piece of the body."""
        self._since_body = 0
        super().on_body(body)

    def on_message_complete(self) -> None:
        """Its end: a head is next."""
        self._cut = self._cut_head
        super().on_message_complete()

    # what the connection says

    def _refuse(self, status: HTTPStatus) -> None:
        """Say why nothing more is read, unless an answer is on its way, and nothing after that.

        What still comes is dropped until the sender hangs up: closed at once, the connection would be reset, and the
        refusal lost on its way (RFC 9112, 9.6).
        """
        self._is_refused, self._came = True, bytearray()
        text = b"Invalid HTTP request received."
        if self.is_idle or not self.cycle.response_started:
            fields = [
                *self.server_state.default_headers,
                (b"content-type", b"text/plain; charset=utf-8"),
                (b"content-length", str(len(text)).encode()),
                (b"connection", b"close"),
            ]
            head = b"".join(b"%b: %b\r\n" % each for each in fields)
            self.transport.write(STATUS_LINE[status] + head + b"\r\n" + text)
        if not self.is_idle:
            self.cycle.disconnected = True
            self.cycle.message_event.set()
        self.transport.write_eof()
        self.flow.resume_reading()
