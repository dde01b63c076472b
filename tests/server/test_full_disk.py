"""A database that takes no more (docs/operations.md, "When the database is away"): the server is not ready.

Seen: on a full disk every stroke was answered 503 while `/readyz` stayed 200, for the small heartbeats got through.
"""

import contextlib
import os
import resource
import subprocess
import time
from pathlib import Path

import pytest
from support.server_time import Stage

from server.errors import Unavailable
from server.routes.health import readiness
from server.services.runtime import heartbeat

WITHIN = 60.0
"""Seconds: heartbeats come each 0.2 s, on a busy machine later."""
QUICK = {"POOLIAD_HEARTBEAT_PERIOD": "0.2"}
DISK = 6 * 1024 * 1024


def until_ready(server, status):
    end = time.monotonic() + 5 * WITHIN  # kernels may have to be compiled first
    while (answer := server.request("GET", "/readyz")).status_code != status:
        assert time.monotonic() < end, answer.text
        time.sleep(0.05)
    return answer.json()


def register_until_refused(server):
    """Write until the database takes no more."""
    for number in range(100_000):
        answer = server.request("POST", "/v1/agents", json={"name": f"writer {number}"})
        if answer.status_code != 201:
            return answer
    raise AssertionError("the database takes everything")


@contextlib.contextmanager
def small_files(server):
    """The server's files grow no more, as with `ulimit -f`: the log of the database is full."""
    log = server.database.with_name(server.database.name + "-wal")
    before = resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE)
    size = max(log.stat().st_size, server.database.stat().st_size)
    resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.prlimit(server.process.pid, resource.RLIMIT_FSIZE, before)


def test_not_ready_while_writes_fail(own_server):
    server = own_server(POOLIAD_ADDRESS_RATE="100000", POOLIAD_ADDRESS_BURST="100000", **QUICK)
    until_ready(server, 200)
    with small_files(server):
        refused = register_until_refused(server)
        assert (refused.status_code, refused.json()["code"]) == (503, "unavailable")
        for _ in range(20):
            answer = server.request("GET", "/readyz")
            assert (answer.status_code, answer.json()["code"]) == (503, "unavailable")
            assert server.request("GET", "/healthz").status_code == 200
            time.sleep(0.05)
    assert until_ready(server, 200)["status"] == "ready"
    assert server.request("POST", "/v1/agents", json={"name": "again"}).status_code == 201
    assert "Traceback" not in server.log


@pytest.fixture
def small_disk(tmp_path):
    """A file system of its own of a few megabytes; only root can mount one."""
    place = tmp_path / "disk"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={DISK}", "tmpfs", str(place)]
    if os.getuid() != 0 or subprocess.run(mount, capture_output=True, check=False).returncode != 0:
        pytest.skip("no file system may be mounted here; test_not_ready_while_writes_fail does without")
    yield place
    subprocess.run(["umount", "--lazy", str(place)], check=True)


def test_a_full_disk(own_server, small_disk):
    """Full before any write fails: the server says so all the same, and goes on when there is room."""
    server = own_server(f"sqlite:///{small_disk / 'pooliad.db'}", **QUICK)
    until_ready(server, 200)
    ballast = small_disk / "ballast"
    with contextlib.suppress(OSError), ballast.open("wb", buffering=0) as file:
        while file.write(bytes(4096)):
            continue
    assert until_ready(server, 503)["code"] == "unavailable"
    ballast.unlink()
    assert until_ready(server, 200)["status"] == "ready"


def test_a_small_write_that_succeeds_says_nothing(tmp_path):
    """Ready again when as much as a large stroke was taken, and not when a heartbeat was."""
    stage = Stage(tmp_path / "small.db")
    stage.context.kernels.straight.start()
    assert stage.context.kernels.straight.ready.wait(600)
    heartbeat.begin(stage.context, "p", alone=True)
    stage.context.database.writes_fail.set()
    heartbeat.beat(stage.context, "p")
    with pytest.raises(Unavailable, match="does not take what is written"):
        readiness(stage.context)
    stage.context.database.try_writing()
    assert not stage.context.database.writes_fail.is_set()
    with stage.context.database.reading() as connection:
        assert connection.exec_driver_sql("SELECT count(*) FROM answers").scalar() == 0
    stage.close()
    assert not Path(tmp_path / "small.db-wal").exists()
