"""A small HTTP/1.1 client: on the machine that also serves, a library's would be a good part of what is measured."""

import asyncio
import json
import math
import time
from dataclasses import dataclass
from typing import Any

IDLE = 2.0
"""Seconds after which a connection is not used again."""


@dataclass(frozen=True, slots=True)
class Reply:
    """An answer."""

    status: int
    body: bytes


class Connection:
    """One connection, kept alive; one request at a time."""

    def __init__(self, port: int) -> None:
        self._port = port
        self._used = -math.inf
        self._writer: asyncio.StreamWriter | None = None

    async def _connect(self) -> None:
        """Connect to this machine; anew after a pause, for servers end connections that are idle for seconds."""
        if time.monotonic() - self._used > IDLE:
            self.close()
            self._reader, self._writer = await asyncio.open_connection("127.0.0.1", self._port, limit=1 << 22)
        self._used = time.monotonic()

    @staticmethod
    def request(method: str, path: str, length: int = 0, headers: str = "") -> bytes:
        """A request's head."""
        body = f"Content-Type: application/json\r\nContent-Length: {length}\r\n" if method == "POST" else ""
        return f"{method} {path} HTTP/1.1\r\nHost: load\r\n{headers}{body}\r\n".encode()

    async def send(self, head: bytes, body: bytes = b"") -> Reply:
        """Send a request and read the answer."""
        await self._connect()
        assert self._writer is not None
        self._writer.write(head + body)
        lines = (await self._reader.readuntil(b"\r\n\r\n")).decode("latin-1").lower().split("\r\n")
        status = int(lines[0].split()[1])
        length = next((int(line[15:]) for line in lines if line.startswith("content-length:")), 0)
        content = await self._reader.readexactly(length)
        self._used = time.monotonic()
        return Reply(status, content)

    async def get(self, path: str) -> Reply:
        """Read something public."""
        return await self.send(self.request("GET", path))

    async def post(self, path: str, content: Any, token: str | None = None, key: str = "") -> Any:
        """Do something that has to succeed; the answer's content."""
        body = json.dumps(content).encode()
        headers = f"Authorization: Bearer {token}\r\nIdempotency-Key: {key}\r\n" if token else ""
        reply = await self.send(self.request("POST", path, len(body), headers), body)
        assert reply.status in (200, 201), reply.body
        return json.loads(reply.body)

    def close(self) -> None:
        """Hang up; what is sent next gets a connection of its own."""
        self._used = -math.inf
        if self._writer is not None:
            self._writer.close()
