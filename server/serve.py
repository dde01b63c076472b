"""Serving an app with uvicorn.

The address is announced, and a signal sends waiting polls home before the rest stops.
"""

import asyncio
import json
import signal
import socket
from collections.abc import Iterator
from contextlib import contextmanager

import uvicorn

from server.app import create_app
from server.services.context import Context
from server.services.house_bots import House
from server.settings import Settings

SIGNALS = (signal.SIGINT, signal.SIGTERM)


class _Server(uvicorn.Server):
    """uvicorn, draining at the signal itself: its own hook comes after the connections it waits for."""

    def __init__(self, config: uvicorn.Config, context: Context, house: House) -> None:
        super().__init__(config)
        self._context = context
        self._house = house

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Start, then announce the address."""
        await super().startup(sockets)
        if self.started:
            url = _url(*self.servers[0].sockets[0].getsockname()[:2])
            print(json.dumps({"event": "listening", "url": url}), flush=True)  # noqa: T201
            self._house.listening(url)

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Stop in good order at SIGTERM and SIGINT, and exit with 0."""
        loop = asyncio.get_running_loop()
        for number in SIGNALS:
            loop.add_signal_handler(number, self._stop)
        try:
            yield
        finally:
            for number in SIGNALS:
                loop.remove_signal_handler(number)

    def _stop(self) -> None:
        self._context.wakeups.drain()
        self.should_exit = True


def serve(settings: Settings, host: str, port: int) -> None:
    """Serve until a signal; port 0 takes a free one. Exits with 3 when the address is taken.

    The first line on standard output is `{"event": "listening", "url": "http://127.0.0.1:8080"}`, written
    once connections are accepted; the log goes to standard error.
    """
    app = create_app(settings)
    config = uvicorn.Config(
        app,
        host=host,
        port=port,
        http="h11",
        ws="none",
        lifespan="on",
        access_log=False,
        server_header=False,
        log_level="warning",
        timeout_graceful_shutdown=max(1, round(settings.drain_seconds)),
    )
    _Server(config, app.state.context, app.state.house).run()


def _url(host: str, port: int) -> str:
    """The address to connect to for somebody on this machine."""
    reachable = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(host, host)
    return f"http://[{reachable}]:{port}" if ":" in reachable else f"http://{reachable}:{port}"
