"""After a restart no clock and no grace runs before the server listens (docs/operations.md).

Seen: a server that was slow to start took up the games first and listened seconds later; its players could not reach
it, and paid for the difference. Expected: time counts from the moment in which a player can fetch the turn.
"""

import json
import signal
import subprocess
import sys

import httpx2
import pytest
from sqlalchemy import select
from support.server_time import SECOND, Stage

from protocol import AgentRequest
from server.security.callers import ORGANISER
from server.services.accounts import agents
from server.services.matches import matches
from server.services.matches.player_seeds import begin_due
from server.services.play.clock import ledger, standstill
from server.services.play.clock.flag import flag
from server.services.runtime import heartbeat
from server.store import tables

SLOW_SECONDS = 8.0
SLOW_START = f"""
import contextlib, time
from server import __main__
from server.services.accounts.house_processes import House

quick = House.running

@contextlib.asynccontextmanager
async def slow(self):
    time.sleep({SLOW_SECONDS})
    async with quick(self):
        yield

House.running = slow
__main__.main()
"""
"""A server whose last step before it listens takes long."""
FAR_LESS = 5.0
"""Seconds: less than the start took, more than a busy machine needs for one request."""


@pytest.fixture
def stage(tmp_path):
    made = Stage(tmp_path / "restart.db", lag_turn=0.0)
    yield made
    made.close()


def stopped_in_a_turn(stage):
    """A game of whose first turn 2 of 10 seconds are gone, and its server for an hour."""
    heartbeat.begin(stage.context, "first", alone=True)
    standstill.release(stage.context)
    seats = stage.game("ann", "bob")
    seats.fetch()
    stage.time.pass_(2.0)
    heartbeat.beat(stage.context, "first")
    stage.time.pass_(3600.0)
    return seats


def clock_of(stage, seats):
    clock = ledger.read(stage.context, seats.id).clocks[seats.breaker]
    return clock.seconds_left, clock.running


def status(stage, table, row_id):
    with stage.context.database.reading() as connection:
        return connection.scalar(select(table.c.status).where(table.c.id == row_id))


def test_however_long_the_start_takes_the_clock_stands(stage):
    seats = stopped_in_a_turn(stage)
    heartbeat.begin(stage.context, "second", alone=True)
    for _ in range(3):
        stage.time.pass_(1000.0)
        heartbeat.beat(stage.context, "second")
        flag(stage.context)
        assert clock_of(stage, seats) == (8.0, False)
    standstill.release(stage.context)
    assert clock_of(stage, seats) == (8.0, False)
    stage.time.pass_(stage.context.settings.fetch_grace + 8.0 - 1e-6)
    flag(stage.context)
    assert status(stage, tables.games, seats.id) == "running"
    stage.time.pass_(1e-6)
    flag(stage.context)
    assert status(stage, tables.games, seats.id) == "finished", "once released, a turn that nobody fetches runs out"


def test_a_turn_whose_time_was_up_before_the_stop_ends_once_released(stage):
    """Its deadline passed, the flag was not seen to before the crash: the hold dated it before any release looked."""
    heartbeat.begin(stage.context, "first", alone=True)
    standstill.release(stage.context)
    seats = stage.game("ann", "bob")
    seats.fetch()
    stage.time.pass_(11.0)
    heartbeat.beat(stage.context, "first")
    stage.time.pass_(3600.0)
    heartbeat.begin(stage.context, "second", alone=True)
    standstill.release(stage.context)
    stage.time.pass_(stage.context.settings.fetch_grace)
    flag(stage.context)
    assert status(stage, tables.games, seats.id) == "finished"


def test_a_turn_fetched_before_the_release_runs_from_the_fetch(stage):
    seats = stopped_in_a_turn(stage)
    heartbeat.begin(stage.context, "second", alone=True)
    stage.time.pass_(1000.0)
    assert seats.fetch()["clocks"][seats.breaker]["seconds_left"] == 8.0
    stage.time.pass_(3.0)
    standstill.release(stage.context)
    stage.time.pass_(1.0)
    assert clock_of(stage, seats) == (4.0, True)


def test_an_action_before_the_release_costs_nothing(stage):
    seats = stopped_in_a_turn(stage)
    heartbeat.begin(stage.context, "second", alone=True)
    stage.time.pass_(1000.0)
    assert seats.concede()["clocks"][seats.breaker]["seconds_left"] == 8.0


def test_a_second_death_before_the_release_loses_nothing(stage):
    seats = stopped_in_a_turn(stage)
    for process in ("second", "third"):
        heartbeat.begin(stage.context, process, alone=True)
        stage.time.pass_(1000.0)
    standstill.release(stage.context)
    assert clock_of(stage, seats) == (8.0, False)


def test_the_time_to_add_seeds_goes_on_where_it_was(stage):
    """10 of 30 seconds are gone when the server is; 20 are left when it listens again."""
    heartbeat.begin(stage.context, "first", alone=True)
    ids = [json.loads(agents.register(stage.context, AgentRequest(name=name)).body)["agent"]["id"] for name in "ab"]
    body = json.dumps({"agents": ids, "client_seed_seconds": 30.0}).encode()
    match = json.loads(matches.create(stage.context, stage.command(ORGANISER, body)).body)["id"]
    stage.time.pass_(10.0)
    heartbeat.beat(stage.context, "first")
    for process in ("second", "third"):
        stage.time.pass_(3600.0)
        heartbeat.begin(stage.context, process, alone=True)
        stage.time.pass_(1000.0)
        begin_due(stage.context)
        assert status(stage, tables.matches, match) == "opening"
    standstill.release(stage.context)
    stage.time.pass_(20.0 - 1 / SECOND)
    begin_due(stage.context)
    assert status(stage, tables.matches, match) == "opening"
    stage.time.pass_(1 / SECOND)
    begin_due(stage.context)
    assert status(stage, tables.matches, match) == "running"


def test_no_clock_and_no_grace_runs_before_the_server_listens(own_server, table_at):
    """A real server, killed in a turn; the next takes seconds from its first look at the games to its first answer."""
    server = own_server(POOLIAD_FETCH_GRACE="0.1")
    table = table_at(server, clock={"seconds": 60.0})
    mover, view = table.mover()
    path, seat = f"/v1/games/{view['game']}/clock", view["seat"]
    before = mover.get(path).json()["clocks"][seat]["seconds_left"]
    server.stop(signal.SIGKILL)
    command = [sys.executable, "-c", SLOW_START, "--port", str(server.port), "--database", server.database_url]
    with subprocess.Popen(command, env=server.environment, stdout=subprocess.PIPE, text=True) as slow:
        assert slow.stdout is not None
        assert json.loads(slow.stdout.readline())["url"] == server.url
        after = httpx2.get(f"{server.url}{path}", timeout=60.0).json()["clocks"][seat]["seconds_left"]
        slow.terminate()
    assert before - after < FAR_LESS < SLOW_SECONDS
