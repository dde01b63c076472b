"""`GET /v1/games/{id}/stream`: what spectators are told, in the format of
https://html.spec.whatwg.org/multipage/server-sent-events.html (9.2.6), and going on after a restart.
"""

import json
import sqlite3
import threading
import time
from typing import Any

import httpx2
import pytest
from support.streams import kinds, told, until, watching

SOFT = {"v": 0.2, "phi": 270.0, "theta": 10.0, "a": 0.0, "b": 0.0}


def softly(break_shot: dict[str, Any]) -> dict[str, Any]:
    return break_shot | {"shot": SOFT}


def test_a_game_from_the_break_to_its_result(server, new_table, break_shot):
    """A late spectator is told everything in order; the lines are the record's."""
    table = new_table(noise={"level": 0.0})
    game = table.game
    with watching(server, f"/v1/games/{game}/stream") as events:
        first = until(events, "connections")
        assert kinds(first) == ["game", "clocks", "connections"]
        assert first[0].data["view"]["seat"] is None
        mover, view = table.mover()
        mover.act(view, softly(break_shot))
        (stroke,) = [one for one in until(events, "stroke") if one.kind == "stroke"]
        mover, view = table.mover()
        mover.act(view, {"decision": "concede"})
        rest = until(events, "result")
        assert list(events) == []
    decision = next(one for one in rest if one.kind == "decision")
    assert int(decision.id) > int(stroke.id)
    record = table.organiser.get(f"/v1/games/{game}/record").text.splitlines()
    assert [json.loads(line) for line in record[1:-2]] == [stroke.data, decision.data]
    assert rest[-1].data["outcome"]["reason"] == "concession"
    assert sorted(rest[-1].data["score"]) == [0.0, 1.0]
    assert rest[-1].data["record"] == f"/v1/games/{game}/record"
    assert rest[-1].data["noise_seed"] == table.organiser.get(f"/v1/games/{game}").json()["noise_seed"]


def test_a_finished_game_is_told_and_the_stream_ends(server, new_table, break_shot):
    table = new_table(noise={"level": 0.0})
    game = table.game
    mover, view = table.mover()
    mover.act(view, softly(break_shot))
    mover, view = table.mover()
    mover.post(f"/v1/games/{game}/concede", version=view["version"])
    with watching(server, f"/v1/games/{game}/stream") as events:
        everything = list(events)
    assert kinds(everything) == ["game", "stroke", "decision", "clocks", "result"]
    ids = [one.id for one in everything if one.id]
    with watching(server, f"/v1/games/{game}/stream", **{"Last-Event-ID": ids[0]}) as events:
        assert kinds(list(events)) == ["game", "decision", "clocks", "result"]
    with watching(server, f"/v1/games/{game}/stream?after={ids[1]}") as events:
        assert kinds(list(events)) == ["game", "clocks", "result"]


def test_ids_are_the_moves_sequence(own_server, table_at, break_shot):
    server = own_server()
    table = table_at(server, noise={"level": 0.0})
    mover, view = table.mover()
    mover.act(view, softly(break_shot))
    with watching(server, f"/v1/games/{view['game']}/stream") as events:
        (stroke,) = [one for one in until(events, "stroke") if one.kind == "stroke"]
    with sqlite3.connect(server.database) as database:
        assert database.execute("SELECT sequence FROM moves").fetchall() == [(int(stroke.id),)]


def test_a_restart_loses_nothing_and_repeats_nothing(own_server, table_at, break_shot):
    server = own_server()
    table = table_at(server, noise={"level": 0.0})
    path = f"/v1/games/{table.game}/stream"
    mover, view = table.mover()
    with watching(server, path) as events:
        mover.act(view, softly(break_shot))
        last = until(events, "stroke")[-1].id
        began = time.monotonic()
        server.process.terminate()
        assert [one.kind for one in events if one.id] == []
        server.process.wait(10)
        assert time.monotonic() - began < 4.0, "an open stream must not hold the server up"
    assert server.process.returncode == 0
    server.http.close()
    server.process.stdout.close()
    server.start()
    mover, view = table.mover()
    mover.act(view, {"decision": "concede"})
    with watching(server, path, **{"Last-Event-ID": last}) as events:
        assert [one.kind for one in events if one.id] == ["decision"]


def test_clocks_and_connections_follow_the_players(own_server, table_at):
    """Nobody has come yet; the mover fetches its turn, which starts its clock; the other one waits, and goes."""
    server = own_server(POOLIAD_FETCH_GRACE="60", POOLIAD_FETCH_GRACE_GAME="60")
    table = table_at(server)
    game = table.game
    with watching(server, f"/v1/games/{game}/stream") as events:
        first = {one.kind: one.data for one in until(events, "connections")}
        assert first["connections"]["connected"] == [False, False]
        assert [clock["running"] for clock in first["clocks"]["clocks"]] == [False, False]
        _, view = table.mover()
        seat = view["seat"]
        news = {one.kind: one.data for one in until(events, "connections")}
        assert news["clocks"]["clocks"][seat]["running"]
        assert news["connections"]["connected"][seat]
        other = table.players[1 - seat]
        poll = threading.Thread(target=other.get, args=("/v1/turns",), kwargs={"wait": 0.2})
        poll.start()
        assert until(events, "connections")[-1].data["connected"] == [True, True]
        poll.join()
        gone = until(events, "connections")[-1].data["connected"]
        assert gone[seat]
        assert not gone[1 - seat]


def test_idle_streams_are_kept_alive(own_server, table_at):
    server = own_server(POOLIAD_STREAM_KEEPALIVE="0.2")
    table = table_at(server)
    with watching(server, f"/v1/games/{table.game}/stream") as events:
        until(events, "connections")
        assert kinds([next(events), next(events)]) == ["", ""]


def test_several_games_in_one_stream(server, new_table, break_shot):
    """Each event says which game it is about; games begin as they stand, without their past."""
    tables = [new_table(noise={"level": 0.0}) for _ in range(3)]
    games = [table.game for table in tables]
    mover, view = tables[0].mover()
    mover.act(view, softly(break_shot))
    address = "/v1/stream?" + "&".join(f"game={game}" for game in games)
    with watching(server, address) as events:
        opening = until(events, "connections", 3)
        assert {one.data["game"] for one in opening if one.kind == "game"} == set(games)
        assert "stroke" not in kinds(opening)
        for table in tables[1:]:
            mover, view = table.mover()
            mover.act(view, softly(break_shot))
        strokes = [one.data for one in until(events, "stroke", 2) if one.kind == "stroke"]
    assert {one["game"] for one in strokes} == set(games[1:])
    assert all(one["data"]["events"] for one in strokes)


def test_many_spectators_share_one_look(server, new_table, break_shot):
    """All are told the same, and none is forgotten."""
    table = new_table(noise={"level": 0.0})
    path, seen = f"/v1/games/{table.game}/stream", []

    def watch() -> None:
        with httpx2.Client(base_url=server.url, timeout=30) as http, http.stream("GET", path) as response:
            seen.append([one for one in told(response.iter_lines()) if one.id or one.kind == "result"])

    threads = [threading.Thread(target=watch) for _ in range(20)]
    for thread in threads:
        thread.start()
    mover, view = table.mover()
    mover.act(view, softly(break_shot))
    mover, view = table.mover()
    mover.act(view, {"decision": "concede"})
    for thread in threads:
        thread.join(30)
    assert len(seen) == 20
    assert all(one == seen[0] for one in seen)
    assert kinds(seen[0]) == ["stroke", "decision", "result"]


@pytest.mark.parametrize("bad", ["", "x", "-1", "1.5", "9" * 16, "٣"])
def test_an_id_that_is_none_is_named(server, new_table, bad):
    game = new_table().game
    problem = server.request("GET", f"/v1/games/{game}/stream", params={"after": bad})
    assert (problem.status_code, problem.json()["field"]) == (422, "after")
    problem = server.request("GET", f"/v1/games/{game}/stream", headers={"Last-Event-ID": bad.encode()})
    assert (problem.status_code, problem.json()["field"]) == (400, "Last-Event-ID")


def test_what_cannot_be_watched(server, new_table):
    assert server.request("GET", "/v1/games/game_none/stream").status_code == 404
    assert server.request("GET", "/v1/stream").json()["field"] == "game"
    assert server.request("GET", "/v1/stream", params={"game": ["game_none"]}).status_code == 404
    too_many = {"game": [f"game_{n}" for n in range(65)]}
    assert server.request("GET", "/v1/stream", params=too_many).status_code == 422


def test_a_level_that_is_not_told_is_not_told_to_spectators(server, new_table):
    table = new_table(noise={"level": 1.0, "told": False})
    with watching(server, f"/v1/games/{table.game}/stream") as events:
        assert next(events).data["view"]["noise"] == {"told": False, "level": None}


def test_the_streams_of_an_address_and_of_a_token_are_counted_apart(own_server, table_at):
    """docs/protocol.md, limits: the problem names whose limit it was, how many are open and how many may be."""
    server = own_server(POOLIAD_STREAMS="2")
    table = table_at(server)
    path, token = f"/v1/games/{table.game}/stream", {"Authorization": f"Bearer {table.players[0].token}"}
    with watching(server, path) as events, watching(server, f"/v1/stream?game={table.game}"):
        until(events, "connections")
        refused = server.request("GET", path)
        problem = refused.json()
        assert (refused.status_code, problem["code"], refused.headers["retry-after"]) == (
            429,
            "too_many_requests",
            "10",
        )
        assert (problem["field"], problem["value"]) == ("streams", 2)
        assert problem["allowed"] == "at most 2 at once of the address 127.0.0.1"
        with watching(server, path, **token), watching(server, path, **token):
            answer = server.request("GET", path, headers=token)
            assert answer.json()["allowed"] == f"at most 2 at once of the token of {table.players[0].id}"
    end = time.monotonic() + 30
    for _ in range(5):  # what was refused or is over holds no place, once the server has seen that the reader is gone
        while (status := server.request("GET", "/v1/games/game_none/stream").status_code) == 429:
            assert time.monotonic() < end
            time.sleep(0.05)
        assert status == 404
