"""A real PostgreSQL for tests: a cluster of its own in a fresh folder, reached by a socket there, never as root."""

import os
import pwd
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import psycopg
from support.require import require

OWNERS = ("postgres", "nobody")
"""Whom the database runs as when root runs the tests: it refuses to run as root."""
STARTS_WITHIN = 60.0


def program(name: str) -> str:
    """A program of PostgreSQL, on the path or where Debian puts it; skips the test without it."""
    versions = sorted(Path("/usr/lib/postgresql").glob(f"*/bin/{name}"), key=lambda path: int(path.parts[-3]))
    found = shutil.which(name) or (str(versions[-1]) if versions else None)
    require(found is not None, f"PostgreSQL ({name}; Debian's package postgresql)")
    assert found is not None
    return found


def identity() -> dict[str, Any]:
    """Options of `subprocess` to run as somebody who is not root."""
    if os.geteuid() != 0:
        return {}
    for name in OWNERS:
        try:
            user = pwd.getpwnam(name)
        except KeyError:
            continue
        return {"user": user.pw_uid, "group": user.pw_gid, "extra_groups": []}
    require(False, f"a user to run PostgreSQL as: one of {OWNERS}")
    raise AssertionError


class Cluster:
    """A running PostgreSQL."""

    def __init__(self, folder: Path, command: list[str], where: dict[str, Any]) -> None:
        self.folder = folder
        self._made = 0
        self._command, self._where = command, where
        self.start()

    def start(self) -> None:
        """Start, and wait until it answers."""
        with (self.folder / "log").open("ab") as log:
            self._process = subprocess.Popen(self._command, stderr=log, **self._where)
        end = time.monotonic() + STARTS_WITHIN
        while True:
            try:
                psycopg.connect(self.url("postgres")).close()
            except psycopg.OperationalError:
                if time.monotonic() > end:
                    raise
                time.sleep(0.05)
            else:
                return

    def stop(self) -> None:
        """SIGINT is PostgreSQL's fast shutdown; it does not wait for connections that are open."""
        self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(20)
        except subprocess.TimeoutExpired:
            self._process.send_signal(signal.SIGQUIT)
            self._process.wait(20)

    def url(self, name: str) -> str:
        """The address of a database here."""
        return f"postgresql://pooliad@/{name}?host={self.folder}"

    def new(self) -> str:
        """The address of a fresh database."""
        self._made += 1
        name = f"pooliad_{self._made}"
        with psycopg.connect(self.url("postgres"), autocommit=True) as connection:
            connection.execute(f"CREATE DATABASE {name}")
        return self.url(name)


@contextmanager
def cluster(durable: bool = False) -> Iterator[Cluster]:
    """A cluster for the length of the block; it forgets what a power cut would take unless it is `durable`."""
    initdb, postgres, runs_as = program("initdb"), program("postgres"), identity()
    # not pytest's folder, which only its owner may enter; a short name, for the socket's
    folder = Path(tempfile.mkdtemp(prefix="pooliad-"))
    if "user" in runs_as:
        os.chown(folder, runs_as["user"], runs_as["group"])
    where: dict[str, Any] = {"cwd": folder, **runs_as}
    command = [initdb, "-D", f"{folder}/data", "-U", "pooliad", "-A", "trust", "-E", "UTF8", "--locale=C", "--no-sync"]
    try:
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, **where)
        safe = [] if durable else ["-c", "fsync=off"]
        serve = [postgres, "-D", f"{folder}/data", "-k", str(folder), "-c", "listen_addresses=", *safe]
        made = Cluster(folder, serve, where)
        try:
            yield made
        finally:
            made.stop()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
