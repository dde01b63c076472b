"""Several server processes on one address and one PostgreSQL: `python -m server --processes N`.

They share the listening socket; one that dies is replaced, and its requests, sent again, are answered by another.
"""

import logging
import multiprocessing
import os
import signal
import socket
import sys
import tempfile
import threading
import time
from multiprocessing.connection import wait
from multiprocessing.context import SpawnProcess
from types import FrameType

from prometheus_client.multiprocess import mark_process_dead

from server.errors import SettingsError, Unavailable
from server.ops.metrics import SHARED_FOLDER
from server.serve import announce, listening, serve_on
from server.settings import Settings
from server.store import postgresql

log = logging.getLogger("pooliad.server.processes")

PAUSE = 1.0
"""Seconds before a process that died is replaced: no busy loop when each of them fails at once."""

_spawn = multiprocessing.get_context("spawn")


def serve_by_many(settings: Settings, host: str, port: int, count: int) -> None:
    """Serve with `count` processes until a signal; raises `SettingsError` unless the database is PostgreSQL."""
    if not postgresql.is_ours(settings.database):
        raise SettingsError(f"processes = {count}: must be 1 with SQLite; more need a postgresql:// database")
    with listening(host, port) as server_socket, tempfile.TemporaryDirectory(prefix="pooliad-metrics-") as folder:
        os.environ.setdefault(SHARED_FOLDER, folder)
        _Supervisor(server_socket, settings).run(count)


class _Stopped(BaseException):
    """A signal came: out of whatever is waited for."""


class _Supervisor:
    """The parent: starts, replaces and stops the processes that serve."""

    def __init__(self, server_socket: socket.socket, settings: Settings) -> None:
        self._socket = server_socket
        self._settings = settings
        self._ready = _spawn.Event()
        self._serving: list[SpawnProcess] = []

    def run(self, count: int) -> None:
        """Until a signal comes."""
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, _stop)
        try:
            self._serving = [self._start() for _ in range(count)]
            self._announce()
            while True:
                self._replace_the_dead()
        except _Stopped:
            pass
        finally:
            self._end()

    def _start(self) -> SpawnProcess:
        process = _spawn.Process(target=_serve, args=(self._socket, self._settings, self._ready))
        process.start()
        return process

    def _announce(self) -> None:
        """Once one of them answers; leaves when none ever does."""
        while not self._ready.wait(0.1):
            if failed := [process for process in self._serving if process.exitcode]:
                sys.exit(failed[0].exitcode)
        announce(self._socket)

    def _replace_the_dead(self) -> None:
        wait([process.sentinel for process in self._serving])
        for place, process in enumerate(self._serving):
            if not process.is_alive():
                log.error("server process %s died with %s; another takes its place", process.pid, process.exitcode)
                mark_process_dead(process.pid)  # type: ignore[no-untyped-call]
                time.sleep(PAUSE)
                self._serving[place] = self._start()

    def _end(self) -> None:
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, signal.SIG_IGN)
        for process in self._serving:
            process.terminate()
        for process in self._serving:
            process.join()


def _stop(_number: int, _frame: FrameType | None) -> None:
    raise _Stopped


def _serve(server_socket: socket.socket, settings: Settings, ready: "threading.Event") -> None:
    """What a process does; it ends with its parent."""
    threading.Thread(target=_follow_parent, name="parent", daemon=True).start()
    try:
        serve_on(server_socket, settings, ready.set)
    except (SettingsError, Unavailable) as error:
        sys.exit(f"pooliad server: {error}")


def _follow_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os.kill(os.getpid(), signal.SIGTERM)
