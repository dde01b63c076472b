"""A small HTTP/1.1 client: on the machine that also serves, a library's would be a good part of what is measured."""

import asyncio
import json
from dataclasses import dataclass
from typing import Any, Self


@dataclass(frozen=True, slots=True)
class Reply:
    """An answer."""

    status: int
    body: bytes


class Connection:
    """One connection, kept alive; one request at a time."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        self._reader, self._writer = reader, writer

    @classmethod
    async def open(cls, port: int) -> Self:
        """Connect to this machine."""
        return cls(*await asyncio.open_connection("127.0.0.1", port, limit=1 << 22))

    @staticmethod
    def request(method: str, path: str, length: int = 0, headers: str = "") -> bytes:
        """A request's head."""
        body = f"Content-Type: application/json\r\nContent-Length: {length}\r\n" if method == "POST" else ""
        return f"{method} {path} HTTP/1.1\r\nHost: load\r\n{headers}{body}\r\n".encode()

    async def send(self, head: bytes, body: bytes = b"") -> Reply:
        """Send a request and read the answer."""
        self._writer.write(head + body)
        lines = (await self._reader.readuntil(b"\r\n\r\n")).decode("latin-1").lower().split("\r\n")
        status = int(lines[0].split()[1])
        length = next((int(line[15:]) for line in lines if line.startswith("content-length:")), 0)
        return Reply(status, await self._reader.readexactly(length))

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
        """Hang up."""
        self._writer.close()
