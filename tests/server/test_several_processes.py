"""Several server processes on one PostgreSQL (docs/operations.md, "Several processes")."""

import itertools
import json
import re
import signal
import socket
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import httpx2
import psycopg
import pytest
from support.cup import Cup
from support.streams import until, watching

from referee.record import verify_record
from server.services.runtime import heartbeat
from server.services.runtime.context import Context
from server.settings import Settings
from server.store.database import Database
from server.store.upgrade import upgrade

PROMPT = 12.0
"""Seconds in which a hint arrives on the busiest machine; without one a poll here looks again after 30."""


@pytest.fixture(scope="module")
def pair(postgres, new_running):
    """Two servers on one database, for all tests that leave them running."""
    database = postgres.new()
    return tuple(new_running(database, POOLIAD_POLL_RECHECK="30") for _ in range(2))


@pytest.fixture
def own_pair(own_server):
    """Two of the test's own."""
    first = own_server()
    return first, own_server(first.database_url)


def at(server, table):
    """The same match, its players at another server."""
    for player in (*table.players, table.organiser):
        player.server = server
    return table


def records(table):
    match = table.organiser.get(f"/v1/matches/{table.match['id']}").json()
    return [table.organiser.get(f"/v1/games/{game['id']}/record").text.splitlines() for game in match["played"]]


def workers_of(server):
    """The processes that serve below `--processes`."""
    listing = subprocess.run(
        ["ps", "-ww", "-o", "pid=,args=", "--ppid", str(server.process.pid)], capture_output=True, text=True, check=True
    ).stdout
    return [int(line.split()[0]) for line in listing.splitlines() if "spawn_main" in line]


def test_a_match_is_played_through_both_in_turns(pair, table_at):
    table = table_at(pair[0], noise={"level": 0.5})
    servers = itertools.cycle(pair)
    for stroke in range(8):
        at(next(servers), table).play(1, seed=stroke)
    mover, view = table.mover()
    assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
    assert all(verify_record(lines).ok for lines in records(table))


def test_a_stroke_here_wakes_a_poll_there(pair, table_at, break_shot):
    here, there = pair
    table = table_at(here)
    mover, view = table.mover()
    waiting = table.players[1 - view["seat"]]
    waiting.server = there
    with ThreadPoolExecutor(1) as pool:
        poll = pool.submit(waiting.turn, 20)
        time.sleep(0.5)
        played = time.monotonic()
        answer = mover.post(f"/v1/games/{view['game']}/concede", version=view["version"])
        assert answer.status_code == 200, answer.text
        assert poll.result()["type"] == "game_over"
    assert time.monotonic() - played < PROMPT


def test_a_spectator_here_sees_the_players_there(pair, table_at, break_shot):
    """Strokes by the hint or the next look; who waits within a few heartbeats, by the database."""
    here, there = pair
    table = at(there, table_at(there, noise={"level": 0.0}))
    with watching(here, f"/v1/games/{table.game}/stream") as events:
        mover, view = table.mover()
        with ThreadPoolExecutor(1) as pool:
            poll = pool.submit(table.players[1 - view["seat"]].turn, 20)
            while until(events, "connections")[-1].data["connected"] != [True, True]:
                pass
            assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
            assert [one.kind for one in until(events, "result") if one.id] == ["decision"]
            poll.result()


@pytest.mark.slow
def test_a_spectator_here_sees_that_the_players_server_was_killed(own_pair, table_at):
    """ "Opponent disconnected" across processes: a dead one's word lasts three heartbeats, and no longer."""
    here, there = own_pair
    table = at(there, table_at(there))
    with watching(here, f"/v1/games/{table.game}/stream") as events:
        _, view = table.mover()
        waiting = table.players[1 - view["seat"]]
        with ThreadPoolExecutor(1) as pool:
            poll = pool.submit(waiting.get, "/v1/turns", wait=20)
            while until(events, "connections")[-1].data["connected"] != [True, True]:
                pass
            there.stop(signal.SIGKILL)
            thinks = [seat == view["seat"] for seat in (0, 1)]  # whoever has fetched the turn still thinks about it
            while until(events, "connections")[-1].data["connected"] != thinks:
                pass
            assert isinstance(poll.exception(), httpx2.TransportError)


@pytest.mark.slow
def test_a_lost_connection_of_the_hints_costs_time_and_nothing_else(own_server, table_at):
    """The database ends the sessions that listen and send; polls look by themselves, and the relay comes back."""
    first = own_server(POOLIAD_POLL_RECHECK="0.5")
    second = own_server(first.database_url, POOLIAD_POLL_RECHECK="0.5")
    table = table_at(first)
    end = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE query ~ 'LISTEN|synchronous_commit|pg_notify'"
    with psycopg.connect(first.database_url, autocommit=True) as connection:
        assert connection.execute(f"{end} AND pid <> pg_backend_pid()").rowcount >= 2
    for stroke, server in zip(range(4), itertools.cycle((second, first)), strict=False):
        at(server, table).play(1, seed=stroke)
    assert "wake-ups between processes are interrupted" in first.log


def test_one_of_two_is_killed_in_the_middle_and_the_match_goes_on_through_the_other(own_pair, table_at):
    table = table_at(own_pair[0], noise={"level": 1.0})
    answers = table.play(3, seed=0)
    own_pair[0].stop(signal.SIGKILL)
    at(own_pair[1], table)
    answers += table.play(5, seed=1)
    mover, view = table.mover()
    answers.append(mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).json())
    (lines,) = records(table)
    assert verify_record(lines).ok
    kept = [line for line in map(json.loads, lines) if line["type"] == "stroke"]
    assert [line["entry"] for line in kept] == list(range(len(answers)))


@pytest.mark.slow
def test_who_stays_keeps_the_clocks_of_running_turns(own_pair, table_at):
    """A process that starts or leaves while another serves is no downtime: no turn is to be fetched anew."""
    table = table_at(own_pair[0], clock={"seconds": 60})
    _, view = table.mover()
    own_pair[1].restart()
    time.sleep(0.3)
    clock = table.organiser.get(f"/v1/games/{view['game']}").json()["view"]["clocks"][view["seat"]]
    assert clock["running"]
    assert clock["seconds_left"] < 60


FOUR = ("ann", "bob", "cat", "dan")


@pytest.mark.slow
def test_one_of_two_is_killed_in_the_middle_and_the_event_goes_on_through_the_other(own_pair, organiser_at, player_at):
    """docs/running-tournaments.md, Over HTTP: finished games stand, running ones go on, what is due begins."""
    first, second = own_pair
    event = Cup(organiser_at(first), lambda: player_at(first), FOUR)
    assert event.act("start").status_code == 200
    before, under_way = event.running()
    event.concede(before)
    games = {game["match"] for game in event.running()}
    assert under_way["match"] in games
    first.stop(signal.SIGKILL)
    event.at(second)
    assert {game["match"] for game in event.running()} == games
    assert event.read()["games"] == 1
    event.play_out()
    assert event.read()["status"] == "finished"
    played = event.read()["played"]
    assert len(played) == 12
    assert {(game["attempt"], game["outcome"]["reason"]) for game in played} == {(0, "concession")}


def test_matches_that_end_at_both_at_once_begin_each_due_game_once(pair, organiser_at, player_at):
    """Their two transactions write the same event: whoever comes second sees what the first one gave out."""
    event = Cup(organiser_at(pair[0]), lambda: player_at(pair[0]), FOUR)
    event.act("start")
    with ThreadPoolExecutor(2) as pool:
        while running := event.running():
            for number, game in enumerate(running):
                for name in game["players"]:
                    event.players[name].server = pair[number % 2]
            list(pool.map(event.concede, running))
            busy = [name for game in event.running() for name in game["players"]]
            assert len(busy) == len(set(busy))
    view = event.read()
    assert (view["status"], view["games"]) == ("finished", 12)
    assert len({(game["pair"], game["leg"]) for game in view["played"]}) == len(view["played"]) == 12


def test_a_decision_asked_for_at_both_at_once_is_taken_once(pair, organiser_at, player_at):
    event = Cup(organiser_at(pair[0]), lambda: player_at(pair[0]), ("ann", "bob"))
    organisers = [organiser_at(server) for server in pair]
    with ThreadPoolExecutor(2) as pool:
        answers = list(pool.map(lambda one: one.post(f"/v1/tournaments/{event.id}/start"), organisers))
    assert sorted(answer.status_code for answer in answers) == [200, 409]
    assert [entry["kind"] for entry in event.read()["log"]] == ["opened", "go_on"]
    assert len(event.running()) == 1


def test_of_shots_at_both_at_once_one_is_played(pair, table_at, break_shot):
    """The version is compared and set in the database, whichever process a request came to."""
    table = table_at(pair[0])
    mover, view = table.mover()
    headers = {"If-Match": f'"{view["version"]}"'}

    def shoot(number):
        body = break_shot | {"cue_ball": [0.5 + 0.01 * number, 1.8]}
        options = {"json": body, "headers": headers | {"Idempotency-Key": f"{number}"}}
        return pair[number % 2].request("POST", f"/v1/games/{view['game']}/shots", mover.token, **options)

    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(shoot, range(8)))
    assert sorted(answer.status_code for answer in answers) == [200] + [412] * 7


def test_the_same_request_at_both_at_once_is_carried_out_once(pair, table_at, break_shot):
    table = table_at(pair[0])
    mover, view = table.mover()
    headers = {"If-Match": f'"{view["version"]}"', "Idempotency-Key": "twice"}
    shots = f"/v1/games/{view['game']}/shots"
    with ThreadPoolExecutor(8) as pool:
        answers = list(
            pool.map(
                lambda n: pair[n % 2].request("POST", shots, mover.token, json=break_shot, headers=headers), range(8)
            )
        )
    assert {answer.status_code for answer in answers} == {200}
    assert len({answer.content for answer in answers}) == 1


def test_the_same_match_asked_for_at_both_at_once_is_made_once(pair, table_at):
    table = table_at(pair[0])
    body: dict[str, Any] = {"agents": [player.id for player in table.players], "games": 3}
    headers = {"Idempotency-Key": "match"}
    with ThreadPoolExecutor(8) as pool:
        answers = list(
            pool.map(
                lambda n: pair[n % 2].request("POST", "/v1/matches", table.organiser.token, json=body, headers=headers),
                range(8),
            )
        )
    assert {answer.status_code for answer in answers} == {201}
    assert len({answer.content for answer in answers}) == 1
    assert len(table.organiser.get("/v1/matches", agent=body["agents"][0]).json()["matches"]) == 2


@pytest.mark.slow
def test_two_timers_let_a_flag_fall_once(own_server, table_at):
    first = own_server(POOLIAD_FETCH_GRACE="0.2")
    own_server(first.database_url, POOLIAD_FETCH_GRACE="0.2")
    tables = [table_at(first, clock={"seconds": 1}) for _ in range(4)]
    for table in tables:
        for player in table.players:
            news = [player.turn(20)["type"] for _ in range(2)]
            while news[0] == "turn":  # the mover was asked before the time was out
                news = [*news[1:], player.turn(20)["type"]]
            assert news == ["game_over", "match_over"]
            assert player.get("/v1/turns").status_code == 204


@pytest.mark.slow
def test_a_process_that_is_killed_is_replaced(own_server, table_at):
    server = own_server(options=("--processes", "2"))
    table = table_at(server)
    table.play(2)
    victims = workers_of(server)
    assert len(victims) == 2
    subprocess.run(["kill", "-9", str(victims[0])], check=True)
    server.http.close()
    server.http = type(server.http)(base_url=server.url, timeout=30)
    table.play(2, seed=3)
    until_replaced(server, victims[0])
    assert server.stop() == 0
    assert "another takes its place" in server.log


@pytest.mark.slow
def test_what_a_process_was_answering_when_it_was_killed_is_not_in_progress_any_more(own_server, player_at):
    server = own_server(options=("--processes", "2"))
    request = f"GET /v1/turns?wait=60 HTTP/1.1\r\nHost: x\r\nAuthorization: Bearer {player_at(server).token}\r\n\r\n"
    polls = [socket.create_connection(("127.0.0.1", server.port)) for _ in range(8)]
    for poll in polls:
        poll.sendall(request.encode())
    end = time.monotonic() + 30
    while in_progress(server) < 9:
        assert time.monotonic() < end
        time.sleep(0.1)
    for victim in workers_of(server):
        subprocess.run(["kill", "-9", str(victim)], check=True)
        until_replaced(server, victim)
    server.http.close()
    server.http = type(server.http)(base_url=server.url, timeout=30)
    assert in_progress(server) == 1, "this request itself"
    for poll in polls:
        poll.close()


def in_progress(server):
    """Requests being answered, by all processes together."""
    found = re.search(r"^pooliad_requests_in_progress (\S+)$", server.request("GET", "/metrics").text, re.MULTILINE)
    return float(found[1])


def until_replaced(server, victim):
    end = time.monotonic() + 30
    while len(present := workers_of(server)) < 2 or victim in present:
        assert time.monotonic() < end
        time.sleep(0.2)


def test_processes_end_with_their_parent(own_server):
    server = own_server(options=("--processes", "2"))
    orphans = workers_of(server)
    server.stop(signal.SIGKILL)
    end = time.monotonic() + 30
    while subprocess.run(["ps", "-p", ",".join(map(str, orphans))], stdout=subprocess.DEVNULL).returncode == 0:
        assert time.monotonic() < end
        time.sleep(0.2)


@pytest.mark.parametrize("options", [(), ("--processes", "2")])
def test_sqlite_is_for_one_process(tmp_path, options):
    """A second server on the same file, or several processes, are refused in a sentence."""
    command = [sys.executable, "-m", "server", "--port", "0", "--database", f"sqlite:///{tmp_path / 'one.db'}"]
    first = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        assert first.stdout is not None
        assert "listening" in first.stdout.readline()
        second = subprocess.run([*command, *options], capture_output=True, text=True, timeout=60)
        assert second.returncode == 1
        assert "postgresql://" in second.stderr
        assert "Traceback" not in second.stderr
        if not options:
            assert f"({first.pid})" in second.stderr
    finally:
        first.kill()
        first.wait()
        assert first.stdout is not None
        first.stdout.close()
    third = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    with third.stdout:
        assert "listening" in third.stdout.readline()  # the lock ended with the process
        third.kill()
        third.wait()


def test_a_flag_waits_for_a_request_in_hand_at_another_process(postgres):
    """It was complete in time, and is worked on elsewhere: that process's heartbeat says so; a dead one does not."""
    database = Database(postgres.new())
    upgrade(database)
    here, there = Context(Settings(), database), Context(Settings(), database)
    deadline = here.time.now()
    heartbeat.begin(here, "here", alone=True)
    with there.in_hand.working_on("some game", deadline - 1):
        heartbeat.begin(there, "there", alone=False)
        with database.reading() as connection:
            assert not heartbeat.is_clear(connection, here, deadline)
            assert heartbeat.is_clear(connection, here, deadline - 1)
    heartbeat.beat(there, "there")
    with database.reading() as connection:
        assert heartbeat.is_clear(connection, here, deadline)
    with there.in_hand.working_on("some game", deadline - 1):
        heartbeat.beat(there, "there")
    patient = Context(Settings(heartbeat_period=1e-6), database)
    with database.reading() as connection:
        assert heartbeat.is_clear(connection, patient, deadline)
    database.dispose()
