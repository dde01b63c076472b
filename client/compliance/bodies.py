"""The body of a request, however its length is told (RFC 9112, sections 6 and 7.1)."""

import re
from collections.abc import Iterator, Mapping
from io import BufferedIOBase

LARGEST = 64 * 2**20
"""Bytes of a body. A server refuses far smaller ones, and is to say so itself."""
LONGEST_LINE = 8192
"""Bytes of a line between chunks: a size, perhaps with extensions, or a trailer field."""
FRAMING = ("content-length", "transfer-encoding")
"""Headers that say how the body is sent on this connection, and nothing about it."""

_DECIMAL, _HEXADECIMAL = re.compile(r"[0-9]{1,18}"), re.compile(r"[0-9A-Fa-f]{1,15}")


def read_body(headers: Mapping[str, str], stream: BufferedIOBase) -> bytes:
    """The body that follows on `stream`; the names of `headers` are in lower case.

    Raises:
        ValueError: no length can be made out, or the stream ends before the body does.
    """
    coding = headers.get("transfer-encoding")
    if coding is None:
        return _exactly(stream, _number(_DECIMAL, headers.get("content-length", "0"), 10))
    if "content-length" in headers:  # 6.1: perhaps one request smuggled within another; a server refuses it too
        raise ValueError("Content-Length and Transfer-Encoding: must be one of them, not both")
    if coding.strip().lower() != "chunked":
        raise ValueError(f"Transfer-Encoding = {coding!r}: must be chunked")
    return b"".join(_chunks(stream))


def _chunks(stream: BufferedIOBase) -> Iterator[bytes]:
    """The chunks up to the last, which is empty; trailer fields are passed over."""
    total = 0
    while size := _number(_HEXADECIMAL, _line(stream).partition(";")[0], 16):
        total += size
        if total > LARGEST:
            raise ValueError(f"a body of more than {LARGEST} bytes")
        yield _exactly(stream, size)
        if after := _line(stream):
            raise ValueError(f"a chunk of {size} bytes is followed by {after[:40]!r}: must be an empty line")
    while _line(stream):
        pass


def _line(stream: BufferedIOBase) -> str:
    line = stream.readline(LONGEST_LINE)
    if not line.endswith(b"\n"):
        raise ValueError(f"{line[:40]!r} is no whole line of at most {LONGEST_LINE} bytes")
    return line.decode("latin-1").strip()


def _number(allowed: re.Pattern[str], text: str, base: int) -> int:
    """A length; `int` alone would take signs and underscores too."""
    if allowed.fullmatch(text.strip()) is None or (number := int(text, base)) > LARGEST:
        raise ValueError(f"length = {text[:40]!r}: must be from 0 to {LARGEST} bytes, in base {base}")
    return number


def _exactly(stream: BufferedIOBase, size: int) -> bytes:
    body = stream.read(size)
    if len(body) < size:
        raise ValueError(f"the body ended after {len(body)} of {size} bytes")
    return body
