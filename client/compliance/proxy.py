"""A proxy between an agent and a server: it keeps what was said, and does what the situation's twist says."""

import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import httpx2

from client.compliance.answers import problem_of, rendered, with_new_fields
from client.compliance.bodies import FRAMING, read_body
from client.compliance.exchange import ACTIONS, Exchange, code_of
from client.compliance.situations import Twist
from protocol import Problem, ProblemCode

PATIENCE = 90.0
"""Seconds the server may take; a long poll waits up to sixty."""


class Proxy:
    """Listens on a free port of this machine and passes everything on to `upstream`; a context manager."""

    def __init__(self, upstream: str) -> None:
        self._client = httpx2.Client(base_url=upstream, timeout=PATIENCE)
        self._lock = threading.Lock()
        self._seen: list[Exchange] = []
        self._twist = Twist.NONE
        self._used = 0
        self._server = ThreadingHTTPServer(("127.0.0.1", 0), self._handler())
        self._server.daemon_threads = True
        self._thread = threading.Thread(target=self._server.serve_forever, name="proxy", daemon=True)

    @property
    def url(self) -> str:
        """Where the agent finds it."""
        return f"http://127.0.0.1:{self._server.server_port}"

    def __enter__(self) -> "Proxy":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._server.shutdown()
        self._server.server_close()
        self._client.close()

    def begin(self, twist: Twist) -> None:
        """A new situation: nothing seen, the twist not used yet."""
        with self._lock:
            self._seen, self._twist, self._used = [], twist, 0

    def seen(self) -> list[Exchange]:
        """Every exchange since the situation began, in order of their ends."""
        with self._lock:
            return list(self._seen)

    def answer(self, method: str, path: str, headers: dict[str, str], body: bytes) -> httpx2.Response | None:
        """What the agent is answered; None cuts the connection."""
        at, twist = time.monotonic(), self._due(method, path)
        if twist in (Twist.DRAINING, Twist.REFUSED):
            response: httpx2.Response | None = problem_of(twist, path)
        else:
            response = self._forward(method, path, headers, body)
            if twist is Twist.NEW_FIELDS and response is not None:
                response = with_new_fields(response)
        cut = twist in (Twist.LOST_REPLY, Twist.RESET)
        self._keep(at, method, path, headers, body, None if cut else response, twist is not Twist.NONE)
        return None if cut else response

    def refuse(self, method: str, path: str, headers: dict[str, str], reason: str) -> httpx2.Response:
        """What the agent is answered when its request cannot be read."""
        problem = Problem.of(ProblemCode.BAD_HEADER, reason, instance=path)
        response = rendered(problem, {})
        self._keep(time.monotonic(), method, path, headers, b"", response, twisted=False)
        return response

    def _due(self, method: str, path: str) -> Twist:
        """The twist, if it is this request's turn to be twisted."""
        tail = path.partition("?")[0].rpartition("/")[2]
        with self._lock:
            action, poll = method == "POST" and tail in ACTIONS, method == "GET" and tail == "turns"
            once = action and self._used == 0
            every_second = poll and self._used % 2 == 0
            self._used += action if self._twist is not Twist.RESET else poll
            if self._twist is Twist.NEW_FIELDS:
                return self._twist
            due = every_second if self._twist is Twist.RESET else once
            return self._twist if due else Twist.NONE

    def _forward(self, method: str, path: str, headers: dict[str, str], body: bytes) -> httpx2.Response | None:
        kept = {name: value for name, value in headers.items() if name not in ("host", "connection", *FRAMING)}
        try:
            return self._client.request(method, path, headers=kept, content=body or None)
        except httpx2.TransportError:
            return None

    def _keep(
        self,
        at: float,
        method: str,
        path: str,
        headers: dict[str, str],
        body: bytes,
        response: httpx2.Response | None,
        twisted: bool,
    ) -> None:
        status = 0 if response is None else response.status_code
        answer = b"" if response is None else response.content
        bare, _, query = path.partition("?")
        exchange = Exchange(
            at=at,
            done=time.monotonic(),
            method=method,
            path=bare,
            query=query,
            headers=headers,
            body=body,
            status=status,
            code=code_of(status, answer),
            answer=answer,
            twisted=twisted,
        )
        with self._lock:
            self._seen.append(exchange)

    def _handler(self) -> type[BaseHTTPRequestHandler]:
        """What the standard library's server makes one of for each connection."""
        proxy = self

        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def _pass_on(self) -> None:
                headers = {name.lower(): value for name, value in self.headers.items()}
                try:
                    body = read_body(headers, self.rfile)
                except ValueError as error:  # where the next request begins cannot be known
                    self.close_connection = True
                    self._reply(proxy.refuse(self.command, self.path, headers, str(error)))
                    return
                response = proxy.answer(self.command, self.path, headers, body)
                if response is None:
                    self.close_connection = True
                    self.connection.close()
                    return
                self._reply(response)

            def _reply(self, response: httpx2.Response) -> None:
                self.send_response(response.status_code)
                for name, value in response.headers.items():
                    if name not in (
                        "content-length",
                        "connection",
                        "transfer-encoding",
                        "date",
                        "server",
                        "content-encoding",
                    ):
                        self.send_header(name, value)
                self.send_header("Content-Length", str(len(response.content)))
                if self.close_connection:
                    self.send_header("Connection", "close")
                self.end_headers()
                self.wfile.write(response.content)

            do_GET = do_POST = do_DELETE = do_HEAD = _pass_on  # noqa: N815 - names of the standard library

            def handle(self) -> None:
                try:
                    super().handle()
                except OSError:  # the agent has left, or its connection was cut on purpose
                    self.close_connection = True

            def finish(self) -> None:
                try:
                    super().finish()
                except (OSError, ValueError):
                    self.close_connection = True

            def log_message(self, *_: Any) -> None:
                """The proxy keeps its own account."""

        return Handler
