"""Requests on one connection, in any pieces: what reaches the application is what h11 reads in the same bytes.

h11 is a parser written apart from llhttp, with RFC 9112 beside it. Two servers that read the same bytes in two ways are
what a request is smuggled by.
"""

import asyncio
from itertools import pairwise
from typing import Any

import h11
import uvicorn
from hypothesis import given, settings
from hypothesis import strategies as st
from uvicorn.server import ServerState

from server.http.connections import http_protocol
from server.settings import Settings

BOUNDED = http_protocol(Settings())


class Wire(asyncio.Transport):
    """A connection of which only what is written counts."""

    def __init__(self) -> None:
        super().__init__()
        self.said, self.is_closed = b"", False

    def get_extra_info(self, name: str, default: Any = None) -> Any:
        return ("127.0.0.1", 1) if name in ("peername", "sockname") else default

    def write(self, data: Any) -> None:
        self.said += bytes(data)

    def write_eof(self) -> None:
        self.is_closed = True

    def close(self) -> None:
        self.is_closed = True

    def is_closing(self) -> bool:
        return self.is_closed

    def get_write_buffer_size(self) -> int:
        return 0

    def pause_reading(self) -> None:
        """Pieces that came already come all the same."""

    def resume_reading(self) -> None:
        """Likewise."""


async def taken(pieces: list[bytes]) -> list[tuple[Any, ...]]:
    """The requests that the application gets, with their bodies, and whether what came after them was refused."""
    seen: list[tuple[Any, ...]] = []

    async def app(scope: Any, receive: Any, send: Any) -> None:
        body = b""
        while True:
            message = await receive()
            if message["type"] == "http.disconnect":
                return
            body += message["body"]
            if not message["more_body"]:
                break
        seen.append((scope["method"], scope["raw_path"], sorted(scope["headers"]), body))
        await send({"type": "http.response.start", "status": 200, "headers": [(b"content-length", b"0")]})
        await send({"type": "http.response.body", "body": b""})

    config = uvicorn.Config(app, lifespan="off", http=BOUNDED, log_config=None, access_log=False)
    config.load()
    wire, protocol = Wire(), BOUNDED(config, ServerState(), {})
    protocol.connection_made(wire)
    for piece in pieces:
        if wire.is_closed:
            break
        protocol.data_received(piece)
        await asyncio.sleep(0)
    for _ in range(100):  # rounds of the loop; a request takes two or three
        await asyncio.sleep(0)
    refused = b"HTTP/1.1 400 " in wire.said or b"HTTP/1.1 431 " in wire.said
    protocol.connection_lost(None)
    await asyncio.gather(*protocol.tasks)
    return [*seen, ("refused", refused)]


def read_by_h11(sent: bytes) -> list[tuple[Any, ...]]:
    """The same, as h11 has it."""
    seen: list[tuple[Any, ...]] = []
    connection, request, body = h11.Connection(h11.SERVER), None, b""
    connection.receive_data(sent)
    while True:
        try:
            event = connection.next_event()
        except h11.RemoteProtocolError:
            return [*seen, ("refused", True)]
        if isinstance(event, h11.Request):
            request, body = event, b""
        elif isinstance(event, h11.Data):
            body += bytes(event.data)
        elif isinstance(event, h11.EndOfMessage):
            assert request is not None
            fields = sorted((name, value) for name, value in request.headers if name != b"upgrade")
            seen.append((request.method.decode(), request.target, fields, body))
            connection.send(h11.Response(status_code=200, headers=[(b"content-length", b"0")]))
            connection.send(h11.EndOfMessage())
            if connection.our_state is not h11.DONE:
                return [*seen, ("refused", False)]
            connection.start_next_cycle()
        else:
            return [*seen, ("refused", False)]


LINES = st.sampled_from([b"a", b"\n", b"\r\n", b"\r\n\r\n", b"0\r\n\r\n", b"GET / HTTP/1.1\r\nHost: x\r\n\r\n", b"\0"])
BODIES = st.lists(LINES, max_size=6).map(b"".join)
FIELDS = st.sampled_from(
    [b"X: y\r\n", b"Upgrade: h2c\r\nConnection: upgrade\r\n", b"x:\r\n", b"X:  a\tb  \r\n", b"Cookie: \xc3\xa9\r\n"]
)


@st.composite
def requests(draw: Any) -> bytes:
    method = draw(st.sampled_from([b"GET", b"POST", b"DELETE"]))
    head = method + b" /a HTTP/1.1\r\nHost: x\r\n" + b"".join(draw(st.lists(FIELDS, max_size=2, unique=True)))
    body = draw(BODIES)
    match draw(st.sampled_from(["none", "length", "chunks"])):
        case "length":
            return bytes(head + b"Content-Length: %d\r\n\r\n" % len(body) + body)
        case "chunks":
            size = draw(st.integers(1, 9))
            parts = [body[start : start + size] for start in range(0, len(body), size)]
            chunks = b"".join(b"%x\r\n%b\r\n" % (len(part), part) for part in parts)
            trailer = draw(st.sampled_from([b"", b"Authorization: z\r\n"]))
            return bytes(head + b"Transfer-Encoding: chunked\r\n\r\n" + chunks + b"0\r\n" + trailer + b"\r\n")
    return bytes(head + b"\r\n")


SENT = st.lists(requests(), min_size=1, max_size=4).map(b"".join)


def cut(sent: bytes, places: list[int]) -> list[bytes]:
    edges = [0, *sorted({place % (len(sent) + 1) for place in places}), len(sent)]
    return [sent[start:end] for start, end in pairwise(edges) if start < end]


@settings(max_examples=300, deadline=None)
@given(sent=SENT, places=st.lists(st.integers(0, 2000), max_size=12))
def test_requests_are_read_as_another_parser_reads_them_in_whatever_pieces(sent, places):
    assert asyncio.run(taken(cut(sent, places))) == read_by_h11(sent)


@settings(max_examples=300, deadline=None)
@given(
    sent=SENT,
    place=st.integers(0, 2000),
    junk=st.sampled_from([b"\r", b"\n", b"\0", b" ", b":", b"\r\n", b"\r\n\r\n", b"A", b"Content-Length: 3\r\n"]),
    places=st.lists(st.integers(0, 2000), max_size=4),
)
def test_junk_anywhere_never_makes_a_request_that_another_parser_does_not_see(sent, place, junk, places):
    """This server may refuse more than h11: it is given no request that h11 has not, and none with another body."""
    at = place % (len(sent) + 1)
    spoilt = sent[:at] + junk + sent[at:]
    *ours, _ = asyncio.run(taken(cut(spoilt, places)))
    *theirs, _ = read_by_h11(spoilt)
    assert ours == theirs[: len(ours)]


def test_a_chunk_larger_than_a_head_is_read():
    body = b"x" * 100_000
    sent = b"POST /a HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n186a0\r\n%b\r\n0\r\n\r\n" % body
    for pieces in ([sent], cut(sent, [30_000, 60_000, 90_000])):
        assert asyncio.run(taken(pieces)) == read_by_h11(sent)


def test_in_pieces_of_a_byte_they_are_the_same():
    sent = b"POST /a HTTP/1.1\r\nHost: x\r\nContent-Length: 4\r\n\r\n\r\n\r\n" * 3
    assert asyncio.run(taken([bytes([byte]) for byte in sent])) == read_by_h11(sent)
    assert len(read_by_h11(sent)) == 4
