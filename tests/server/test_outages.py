"""A database that goes away and comes back (docs/operations.md, "When the database is away"): nobody is answered with a
fault, nothing acknowledged is lost, nobody pays for the time, and nobody has to start a server anew.
"""

import sqlite3
import subprocess
import sys
import time
from contextlib import closing

import httpx2
import pytest
from support.postgres import cluster
from support.server_time import Stage
from support.streams import until, watching

from referee.record import verify_record
from server.errors import Unavailable
from server.routes.health import readiness
from server.services.play.clock.flag import flag
from server.services.runtime import heartbeat
from server.store.database import Database

QUICK = {"POOLIAD_HEARTBEAT_PERIOD": "0.2", "POOLIAD_DATABASE_SECONDS": "0.3", "POOLIAD_STREAM_RECHECK": "0.1"}


@pytest.fixture
def mortal():
    """A PostgreSQL that the test stops and starts as it likes."""
    with cluster() as made:
        yield made


def require_unavailable(response):
    problem = response.json()
    assert (response.status_code, problem["code"]) == (503, "unavailable"), problem
    assert response.headers["content-type"] == "application/problem+json"
    assert response.headers["retry-after"] == "1"
    assert "/tmp" not in response.text, "where the database is concerns nobody"


def insist(send):
    """Send until the server is itself again."""
    end = time.monotonic() + 30.0
    while (response := send()).status_code == 503:
        assert time.monotonic() < end, response.text
        time.sleep(0.05)
    return response


def require_no_fault(server):
    assert "fault while answering" not in server.log
    assert "Traceback" not in server.log, server.log[-3000:]


def test_a_postgresql_that_stops_and_starts(mortal, own_server, table_at, break_shot):
    server = own_server(mortal.new(), **QUICK)
    table = table_at(server, noise={"level": 0.0})
    mover, view = table.mover()
    shoot = lambda: mover.act(view, break_shot, key="through the outage")  # noqa: E731
    insist(lambda: server.request("GET", "/readyz"))
    with watching(server, f"/v1/games/{view['game']}/stream") as events:
        until(events, "connections")
        mortal.stop()
        with httpx2.Client(base_url=server.url) as others:
            for path in ("/v1/agents", f"/v1/games/{view['game']}", "/v1/turns", "/readyz"):
                require_unavailable(others.get(path, headers={"Authorization": f"Bearer {mover.token}"}))
            require_unavailable(others.post("/v1/agents", json={"name": "late"}))
            assert others.get("/healthz").status_code == 200
            metrics = others.get("/metrics")
            assert metrics.status_code == 200
            assert "pooliad_games_running" not in metrics.text
        require_unavailable(shoot())
        mortal.start()
        insist(lambda: server.request("GET", "/readyz"))
        played = insist(shoot)
        assert played.status_code == 200
        assert until(events, "stroke"), "who watched is told of it"
    assert shoot().content == played.content
    mover, view = table.mover()
    mover.post(f"/v1/games/{view['game']}/concede", version=view["version"])
    record = table.organiser.get(f"/v1/games/{view['game']}/record").text.splitlines()
    assert verify_record(record).ok
    require_no_fault(server)
    assert eventually(lambda: is_served(server.database_url)), "the server has taken its place again"
    mortal.stop()
    assert server.stop() == 0, "without a database it stops in good order, too"
    require_no_fault(server)


def is_served(url):
    """Whether a process has its place among those that serve the database."""
    database = Database(url)
    database.membership.enter()
    try:
        return not database.membership.is_alone
    finally:
        database.membership.leave()
        database.dispose()


def eventually(holds, seconds=20.0):
    """Whether it does within so long; with the next heartbeat, as a rule."""
    deadline = time.monotonic() + seconds
    while not (held := holds()) and time.monotonic() < deadline:
        time.sleep(0.1)
    return held


def test_a_server_without_a_database_says_so_and_does_not_start(tmp_path):
    command = [sys.executable, "-m", "server", "--database", f"postgresql://pooliad@/none?host={tmp_path}"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    assert "pooliad server: the database does not answer" in done.stderr
    assert "Traceback" not in done.stderr


def test_an_sqlite_file_locked_for_long(own_server, table_at, break_shot):
    """Another process is in the middle of a transaction: reads go on, writes are answered, later all goes on."""
    server = own_server(**QUICK)
    table = table_at(server, noise={"level": 0.0})
    mover, view = table.mover()
    insist(lambda: server.request("GET", "/readyz"))
    with closing(sqlite3.connect(server.database, isolation_level=None)) as other:
        other.execute("BEGIN IMMEDIATE")
        require_unavailable(mover.act(view, break_shot, key="k"))
        assert mover.get(f"/v1/games/{view['game']}").status_code == 200
        end = time.monotonic() + 30.0
        while (ready := server.request("GET", "/readyz")).status_code == 200:
            assert time.monotonic() < end
            time.sleep(0.05)
        require_unavailable(ready)
    assert insist(lambda: mover.act(view, break_shot, key="k")).status_code == 200
    require_no_fault(server)


def test_nobody_pays_for_an_outage(tmp_path):
    """The turn's clock has 10 s and ran 2 of them when the heartbeats ended; they come again after a minute."""
    stage = Stage(tmp_path / "outage.db")
    seats = stage.game("ann", "bob")
    heartbeat.begin(stage.context, "p", alone=True)
    seats.fetch()
    for _ in range(2):
        stage.time.pass_(1.0)
        heartbeat.beat(stage.context, "p")
    stage.time.pass_(60.0)
    stage.context.pulse.missed()
    flag(stage.context)
    with pytest.raises(Unavailable):
        seats.concede()
    stage.context.kernels.straight.start()
    assert stage.context.kernels.straight.ready.wait(600)
    with pytest.raises(Unavailable, match="heartbeats"):
        readiness(stage.context)
    heartbeat.beat(stage.context, "p")
    view = seats.fetch()
    (clock,) = [clock for seat, clock in enumerate(view["clocks"]) if seat == seats.breaker]
    assert clock["seconds_left"] == 8.0 + 0.05  # of which the first 50 ms are given back for the way
    assert seats.concede()["view"]["outcome"]["reason"] == "concession"
    stage.close()


def test_a_beat_that_is_late_is_no_outage(tmp_path):
    """Three may be missed, and a busy machine is nobody's database: what it took is the player's."""
    stage = Stage(tmp_path / "late.db")
    seats = stage.game("ann", "bob")
    heartbeat.begin(stage.context, "p", alone=True)
    seats.fetch()
    stage.time.pass_(3.0)
    stage.context.pulse.missed()
    heartbeat.beat(stage.context, "p")
    assert seats.fetch()["clocks"][seats.breaker]["seconds_left"] == 7.0 + 0.05
    stage.time.pass_(4.0)
    heartbeat.beat(stage.context, "p")
    assert seats.fetch()["clocks"][seats.breaker]["seconds_left"] == 3.0 + 0.05
    stage.close()


def test_of_several_processes_one_makes_up_for_an_outage(tmp_path):
    stage = Stage(tmp_path / "several.db")
    seats = stage.game("ann", "bob")
    heartbeat.begin(stage.context, "one", alone=True)
    heartbeat.begin(stage.context, "other", alone=False)
    seats.fetch()
    stage.time.pass_(60.0)
    stage.context.pulse.missed()
    heartbeat.beat(stage.context, "one")
    seats.fetch()
    stage.time.pass_(2.0)
    stage.context.pulse.missed()
    heartbeat.beat(stage.context, "other")
    assert seats.fetch()["clocks"][seats.breaker]["seconds_left"] == 8.0 + 0.05
    stage.close()


def test_what_a_statement_gets_wrong_is_a_fault_and_no_outage(tmp_path):
    database = Database(f"sqlite:///{tmp_path / 'empty.db'}")
    with pytest.raises(Exception, match="no such table") as fault, database.reading() as connection:
        connection.exec_driver_sql("SELECT * FROM agents")
    assert not isinstance(fault.value, Unavailable)
    database.dispose()
