"""Serving an app with uvicorn.

The address is announced, and a signal sends waiting polls home before the rest stops.
"""

import asyncio
import errno
import gc
import json
import logging
import os
import resource
import signal
import socket
import sys
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager

import uvicorn

from server.app import create_app, prepare
from server.errors import SettingsError
from server.http.connections import http_protocol
from server.ops import logs
from server.services.runtime.context import Context
from server.settings import Settings

SIGNALS = (signal.SIGINT, signal.SIGTERM)
SWITCH_SECONDS = 0.0005
"""How long a thread may keep the interpreter while others want it, a tenth of Python's own choice: a stroke takes
dozens of turns with it, and each may come behind a thread that reads or writes a batch."""
DESCRIPTORS = 65_536
"""Open files and sockets that are enough."""
BACKLOG = 2048
"""Connections that may wait to be accepted."""


class _HintingServer(uvicorn.Server):
    """uvicorn, draining at the signal itself: its own hook comes after the connections it waits for."""

    def __init__(self, config: uvicorn.Config, context: Context, listening: Callable[[], Awaitable[None]]) -> None:
        super().__init__(config)
        self._context = context
        self._listening = listening

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Start; once connections are accepted, let everything go on that waited for it."""
        await super().startup(sockets)
        if self.started:
            await self._listening()

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
    """Serve until a signal; port 0 takes a free one. Raises `SettingsError` when the address is not to be had.

    The first line on standard output is `{"event": "listening", "url": "http://127.0.0.1:8080"}`, written
    once connections are accepted; the log goes to standard error.
    """
    with listening(host, port) as server_socket:
        serve_on(server_socket, settings, lambda: announce(server_socket))


def serve_on(server_socket: socket.socket, settings: Settings, ready: Callable[[], None]) -> None:
    """Serve on a listening socket until a signal; `ready` is called once requests are answered.

    Raises `SettingsError` when the database is not to be had.
    """
    logs.configure(settings.log_level)
    _raise_descriptor_limit()
    sys.setswitchinterval(SWITCH_SECONDS)
    app = create_app(settings)
    context: Context = app.state.context
    prepare(context)

    async def started() -> None:
        await app.state.heartbeat.listening()
        app.state.house.listening(_url(server_socket))
        ready()

    config = uvicorn.Config(
        app,
        http=http_protocol(settings),
        loop="uvloop",
        ws="none",
        lifespan="on",
        access_log=False,
        log_config=None,
        server_header=False,
        proxy_headers=bool(settings.proxies),
        forwarded_allow_ips=settings.named_proxies,
        headers=[("X-Content-Type-Options", "nosniff")],
        log_level="warning",
        timeout_graceful_shutdown=max(1, round(settings.drain_seconds)),
    )
    _HintingServer(config, context, started).run([server_socket])
    gc.freeze()  # all is closed: the interpreter's last look for garbage takes seconds on what the compiler left
    if context.kernels.are_loading:
        _leave_the_compiler()


def _leave_the_compiler() -> None:
    """Leave at once, with 0: the interpreter's own end takes LLVM's memory from under a thread that works in it."""
    logging.shutdown()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


def _raise_descriptor_limit() -> None:
    """Allow as many connections as the system does: what a shell gives, often 1,024, is soon used up."""
    most = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    wanted = DESCRIPTORS if most == resource.RLIM_INFINITY else min(DESCRIPTORS, most)
    if resource.getrlimit(resource.RLIMIT_NOFILE)[0] < wanted:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, most))


def listening(host: str, port: int) -> socket.socket:
    """A socket that listens at this address; raises `SettingsError` when it cannot.

    asyncio turns Nagle's algorithm off (an answer of two packets would wait 40 ms for an acknowledgement) only where
    the socket itself says that it is TCP, which one of `socket.create_server` does not.
    """
    try:
        place = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)[0]
    except socket.gaierror as error:
        raise SettingsError(f"host = {host}: must be an address of this machine; {error.strerror}") from error
    made = socket.socket(place[0], socket.SOCK_STREAM, socket.IPPROTO_TCP)
    made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        made.bind(place[4])
        made.listen(BACKLOG)
    except OSError as error:
        made.close()
        raise _cannot_listen(host, port, error) from error
    return made


def _cannot_listen(host: str, port: int, error: OSError) -> SettingsError:
    """The system's refusal, and what to do about it."""
    if error.errno == errno.EADDRINUSE:
        return SettingsError(
            f"port = {port}: must be free at {host}; address already in use by another program. Stop that program, "
            "or choose another port: --port 0 takes a free one"
        )
    if error.errno == errno.EACCES:
        return SettingsError(f"port = {port}: must be 1024 or more for a user without privileges; {error.strerror}")
    return SettingsError(f"host = {host}: must be an address of this machine; {error.strerror}")


def announce(server_socket: socket.socket) -> None:
    """Say where the server is, on standard output."""
    print(json.dumps({"event": "listening", "url": _url(server_socket)}), flush=True)  # noqa: T201


def _url(server_socket: socket.socket) -> str:
    """The address to connect to for somebody on this machine."""
    host, port = server_socket.getsockname()[:2]
    reachable = {"0.0.0.0": "127.0.0.1", "::": "::1"}.get(host, host)
    return f"http://[{reachable}]:{port}" if ":" in reachable else f"http://{reachable}:{port}"
