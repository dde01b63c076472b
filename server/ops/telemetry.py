"""Every request gets an id, is counted and measured, and leaves a line in the log."""

import logging
import re
import secrets
import time
from typing import Final

from prometheus_client import Counter, Histogram
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from server.ops.logs import REQUEST
from server.ops.metrics import Metrics

log = logging.getLogger("pooliad.server.requests")

HEADER: Final = b"x-request-id"
USABLE = re.compile(rb"[A-Za-z0-9._:-]{1,64}")
"""An id that a client or a proxy may choose."""
READS = frozenset({"GET", "HEAD"})
PROBES = frozenset({"/healthz", "/readyz", "/metrics"})
"""Asked by machines, again and again."""


class Telemetry:
    """ASGI middleware around everything else."""

    def __init__(self, app: ASGIApp, *, metrics: Metrics) -> None:
        self._app = app
        self._metrics = metrics
        self._labelled: dict[tuple[str, str, int], tuple[Counter, Histogram]] = {}
        """To find a counter by its labels takes longer than to count."""

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let the request through, and account for it."""
        if scope["type"] != "http":
            return await self._app(scope, receive, send)
        request = _id_of(scope)
        REQUEST.set(request)
        started, status = time.perf_counter(), 500

        async def named(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
                message.setdefault("headers", []).append((HEADER, request.encode()))
            await send(message)

        self._metrics.in_progress.inc()
        try:
            await self._app(scope, receive, named)
        finally:
            self._metrics.in_progress.dec()
            self._account(scope, status, time.perf_counter() - started)
        return None

    def _account(self, scope: Scope, status: int, seconds: float) -> None:
        method, route = _known(scope["method"]), getattr(scope.get("route"), "path", "none")
        count, duration = self._of(method, route, status)
        count.inc()
        duration.observe(seconds)
        quiet = route in PROBES or (method in READS and status < 400)
        level = logging.DEBUG if quiet else logging.INFO
        if log.isEnabledFor(level):
            fields = {"method": method, "path": scope["path"], "status": status, "seconds": round(seconds, 6)}
            game = scope.get("path_params", {}).get("game_id")
            log.log(level, "request", extra={"fields": fields | ({} if game is None else {"game": game})})

    def _of(self, method: str, route: str, status: int) -> tuple[Counter, Histogram]:
        """Requests answered, and how long they took. There are as many as routes, methods and statuses."""
        known = self._labelled.get((method, route, status))
        if known is None:
            requests, seconds = self._metrics.requests, self._metrics.request_seconds
            known = requests.labels(method, route, status), seconds.labels(method, route)
            self._labelled[method, route, status] = known
        return known


def _id_of(scope: Scope) -> str:
    """The id that came with the request if it is a usable one, else a new one."""
    sent = next((value for name, value in scope["headers"] if name == HEADER), b"")
    return sent.decode() if USABLE.fullmatch(sent) else secrets.token_hex(8)


def _known(method: str) -> str:
    """The method; whatever clients invent is one."""
    return method if method in ("GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS") else "other"
