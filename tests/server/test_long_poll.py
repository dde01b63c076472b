"""`GET /v1/turns?wait=`: what is told, when, how often; and stopping while polls are open."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import httpx2
import pytest


def test_nothing_to_tell(new_player):
    player = new_player()
    start = time.monotonic()
    assert player.get("/v1/turns", wait=0).status_code == 204
    assert player.get("/v1/turns").status_code == 204
    assert time.monotonic() - start < 1.0
    response = player.get("/v1/turns", wait=0.5)
    assert response.status_code == 204
    assert response.content == b""
    assert time.monotonic() - start >= 0.5


def test_a_poll_wakes_up_when_the_turn_comes(new_table, break_shot):
    table = new_table(noise={"level": 0.0})
    mover, view = table.mover()
    other = table.players[1 - view["seat"]]
    with ThreadPoolExecutor(1) as pool:
        poll = pool.submit(other.turn, 20)
        time.sleep(0.3)
        assert not poll.done()
        soft = break_shot | {"shot": break_shot["shot"] | {"v": 0.2}}
        assert mover.act(view, soft).status_code == 200
        acted = time.monotonic()
        message = poll.result(timeout=10)
    assert time.monotonic() - acted < 1.0
    assert (message["type"], message["view"]["turn"]) == ("turn", other_seat(view))


def other_seat(view):
    return 1 - view["seat"]


def test_a_poll_wakes_up_when_a_match_begins(organiser, new_player):
    players = new_player(), new_player()
    with ThreadPoolExecutor(2) as pool:
        polls = [pool.submit(player.get, "/v1/turns", wait=3) for player in players]
        time.sleep(0.3)
        match = organiser.post("/v1/matches", {"agents": [player.id for player in players]}).json()
        made = time.monotonic()
        assert polls[match["first_breaker"]].result(timeout=10).json()["type"] == "turn"
        assert time.monotonic() - made < 1.0
        assert polls[1 - match["first_breaker"]].result(timeout=10).status_code == 204


def test_a_turn_is_told_again_until_it_is_played(new_table):
    table = new_table()
    mover, view = table.mover()
    again = mover.turn()
    assert (again["view"]["version"], again["view"]["game"]) == (view["version"], view["game"])


def test_all_who_wait_for_one_agent_are_told(new_table):
    """Two workers of one agent both see the turn; the version decides who plays it."""
    table = new_table()
    mover, _ = table.mover()
    with ThreadPoolExecutor(2) as pool:
        messages = list(pool.map(lambda _: mover.turn(), range(2)))
    assert messages[0]["view"]["version"] == messages[1]["view"]["version"]


def test_news_is_told_once(new_table):
    table = new_table()
    mover, view = table.mover()
    mover.post(f"/v1/games/{view['game']}/concede", version=view["version"])
    assert [mover.turn()["type"] for _ in range(2)] == ["game_over", "match_over"]
    assert mover.get("/v1/turns").status_code == 204


def test_two_matches_of_one_agent_take_turns(organiser, new_player):
    """Of two turns that wait the one not told yet comes first."""
    ann, bob, eve = new_player(), new_player(), new_player()
    for other in (bob, eve):
        organiser.post("/v1/matches", {"agents": [ann.id, other.id], "seed": "5" * 64})
    first = ann.get("/v1/turns")
    if first.status_code == 200:
        assert first.json()["game"] != ann.turn()["game"]
    else:
        assert bob.turn()["game"] != eve.turn()["game"]


def test_a_caller_who_hung_up_is_told_nothing(new_table, break_shot, server):
    """A turn delivered to a closed connection would start a clock that nobody sees."""
    table = new_table(noise={"level": 0.0}, clock={"seconds": 100.0})
    mover, view = table.mover()
    other = table.players[other_seat(view)]
    with pytest.raises(httpx2.ReadTimeout):
        other.request("GET", "/v1/turns", params={"wait": 20}, timeout=0.3)
    soft = break_shot | {"shot": break_shot["shot"] | {"v": 0.2}}
    mover.act(view, soft)
    time.sleep(0.5)
    clock = table.organiser.get(f"/v1/games/{table.game}").json()["view"]["clocks"][other_seat(view)]
    assert clock == {"seconds_left": 100.0, "running": False, "simulations_left": None}


def test_the_organiser_has_no_turns(organiser):
    response = organiser.get("/v1/turns")
    assert (response.status_code, response.json()["code"]) == (403, "forbidden")


def test_a_signal_sends_open_polls_home_and_stops_the_server_within_seconds(own_server, table_at):
    server = own_server()
    table = table_at(server)
    _, view = table.mover()
    other = table.players[other_seat(view)]
    statuses = []
    polls = [
        threading.Thread(target=lambda: statuses.append(other.get("/v1/turns", wait=25).status_code)) for _ in range(8)
    ]
    for poll in polls:
        poll.start()
    time.sleep(0.5)
    start = time.monotonic()
    server.process.terminate()
    assert server.process.wait(10) == 0
    assert time.monotonic() - start < 4.0
    for poll in polls:
        poll.join()
    assert statuses == [204] * 8
    assert "Traceback" not in server.log


def test_a_server_told_to_stop_leaves_its_compiler_behind(own_server, tmp_path):
    """Seen in one of thirty: the interpreter's end took LLVM's memory from under the thread that loads the kernels."""
    server = own_server(POOLIAD_CACHE_DIR=str(tmp_path / "empty"))
    server.process.terminate()
    assert server.process.wait(60) == 0
    assert "Traceback" not in server.log


def test_the_polls_of_a_token_are_bounded(own_server, player_at):
    """Each looks into the database every two seconds: two thousand of one agent kept it busy for all others."""
    server = own_server(POOLIAD_POLLS="2")
    player, other = player_at(server), player_at(server)
    with ThreadPoolExecutor(2) as pool:
        polls = [pool.submit(player.get, "/v1/turns", wait=4) for _ in range(2)]
        time.sleep(1.0)
        refused = player.get("/v1/turns")
        problem = refused.json()
        assert (refused.status_code, problem["code"]) == (429, "too_many_requests")
        assert refused.headers["retry-after"] == "10"
        assert (problem["field"], problem["value"]) == ("polls", 2)
        assert problem["allowed"] == f"at most 2 at once of the token of {player.id}"
        assert other.get("/v1/turns").status_code == 204
        assert {poll.result().status_code for poll in polls} == {204}
    assert player.get("/v1/turns").status_code == 204
