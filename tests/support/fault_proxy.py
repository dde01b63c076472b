"""A proxy that loses requests, loses replies, sends requests twice and is late, as drawn from a seed."""

import random
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import httpx2

FAULTS = ("lose the request", "lose the reply", "send it twice", "be late", "be late with the second")
LATE = 0.05
"""Seconds at most."""
PASSED_ON = {"content-type", "etag", "location", "retry-after"}


@dataclass(frozen=True, slots=True)
class Exchange:
    """A request that came through, the server's answer to it, and whether the caller got that."""

    method: str
    path: str
    key: str | None
    status: int
    body: bytes
    acknowledged: bool


class FaultProxy:
    """What the proxy does, and what it saw.

    Args:
        target: the server's address. seed: of the faults. share: of the requests that meet one.
    """

    def __init__(self, target: str, seed: int, share: float) -> None:
        self._chance = random.Random(seed)
        self._share = share
        self._server = httpx2.Client(base_url=target, timeout=60)
        self._lock = threading.Lock()
        self.exchanges: list[Exchange] = []
        self.faults: dict[str, int] = dict.fromkeys(FAULTS, 0)

    def answer(self, method: str, path: str, headers: dict[str, str], body: bytes) -> httpx2.Response | None:
        """What the caller gets; None for a connection that ends without an answer."""
        fault, late = self._draw()
        if fault == "lose the request":
            return None
        if fault == "be late":
            time.sleep(late)
        response = self._forward(method, path, headers, body, fault not in ("lose the reply", "send it twice"))
        if fault in ("send it twice", "be late with the second"):
            if fault == "be late with the second":
                time.sleep(late)
            response = self._forward(method, path, headers, body, True)
        return None if fault == "lose the reply" else response

    def _draw(self) -> tuple[str | None, float]:
        with self._lock:
            fault = self._chance.choice(FAULTS) if self._chance.random() < self._share else None
            if fault:
                self.faults[fault] += 1
            return fault, self._chance.uniform(0, LATE)

    def _forward(self, method: str, path: str, headers: dict[str, str], body: bytes, told: bool) -> httpx2.Response:
        response = self._server.request(method, path, headers=headers, content=body)
        key = headers.get("idempotency-key")
        seen = Exchange(method, path, key, response.status_code, response.content, told)
        with self._lock:
            self.exchanges.append(seen)
        return response

    def close(self) -> None:
        """Hang up."""
        self._server.close()


@contextmanager
def serving(proxy: FaultProxy) -> Iterator[str]:
    """The proxy's address, for as long as the block lasts."""

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def _handle(self) -> None:
            body = self.rfile.read(int(self.headers.get("content-length", 0)))
            skipped = ("host", "content-length", "connection")
            headers = {name.lower(): value for name, value in self.headers.items() if name.lower() not in skipped}
            response = proxy.answer(self.command, self.path, headers, body)
            if response is None:
                self.close_connection = True
                return
            self.send_response(response.status_code)
            for name, value in response.headers.items():
                if name.lower() in PASSED_ON:
                    self.send_header(name, value)
            if response.status_code != 204:
                self.send_header("content-length", str(len(response.content)))
            self.end_headers()
            self.wfile.write(response.content)

        do_GET = do_POST = do_DELETE = _handle  # noqa: N815

        def log_message(self, *_arguments: Any) -> None:
            """Nothing."""

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        server.daemon_threads = True
        worker = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.05})
        worker.start()
        try:
            yield f"http://127.0.0.1:{server.server_port}"
        finally:
            server.shutdown()
            worker.join()
            proxy.close()
