"""Time per agent per game, measured by the server alone; R48: a time-out is its own end reason."""

import json
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from referee.record import verify_record


def seconds_left(table, seat):
    game = table.organiser.get(f"/v1/games/{table.game}").json()
    return game["view"]["clocks"][seat]["seconds_left"]


def test_the_clock_runs_from_the_first_delivery_and_goes_on_at_the_next(new_table):
    table = new_table(clock={"seconds": 100.0})
    seat = table.match["first_breaker"]
    table.mover()
    time.sleep(0.3)
    first = seconds_left(table, seat)
    table.mover()
    assert 90.0 < seconds_left(table, seat) < first <= 99.75  # 0.05 s of a turn are given back for lag
    assert seconds_left(table, 1 - seat) == 100.0


def test_a_turn_nobody_fetches_starts_its_clock_by_itself(own_server, table_at):
    server = own_server(POOLIAD_FETCH_GRACE="0.3")
    table = table_at(server, clock={"seconds": 100.0})
    time.sleep(1.0)
    assert 90.0 < seconds_left(table, table.match["first_breaker"]) <= 99.35


def test_who_reads_the_table_without_a_token_and_fetches_late_pays_for_it(new_table, break_shot):
    """28 s were thought on a clock of 10: five turns were read from outside, and fetched 4.7 s later."""
    table = new_table(clock={"seconds": 100.0})
    seen = table.players[0].server.request("GET", f"/v1/games/{table.game}").json()["view"]
    assert seen["seat"] is None
    assert len(seen["balls"]) == 16
    time.sleep(2.5)
    mover, view = table.mover()
    assert view["balls"] == seen["balls"]
    assert mover.act(view, break_shot).status_code == 200
    book = mover.get(f"/v1/games/{view['game']}/clock").json()
    (charge,) = book["charges"]
    assert charge["measured_ns"] >= 2.5e9
    assert (charge["lag_ns"], charge["grace_ns"]) == (50_000_000, 1_000_000_000)
    assert charge["charged_ns"] == charge["measured_ns"] - 1_050_000_000
    assert book["clocks"][view["seat"]]["seconds_left"] <= 100.0 - (2.5 - 1.05)
    assert (book["grace_seconds"], book["grace_game_seconds"]) == (1.0, 5.0)


def test_who_reads_the_table_and_never_fetches_is_out_of_time_a_second_later(new_table):
    table = new_table(clock={"seconds": 0.5})
    other = table.players[1 - table.match["first_breaker"]]
    assert other.turn(wait=30)["outcome"]["reason"] == "time_out"
    (charge,) = other.get(f"/v1/games/{table.game}/clock").json()["charges"]
    assert charge["measured_ns"] == charge["charged_ns"] + charge["lag_ns"] + charge["grace_ns"] == 1_550_000_000


def test_the_time_of_a_stroke_is_charged_and_the_other_clock_stands(new_table, break_shot):
    table = new_table(clock={"seconds": 100.0})
    mover, view = table.mover()
    time.sleep(0.3)
    answer = mover.act(view, break_shot).json()
    seat = view["seat"]
    assert 90.0 < answer["clocks"][seat]["seconds_left"] <= 99.75
    assert answer["clocks"][1 - seat] == {"seconds_left": 100.0, "running": False, "simulations_left": None}


def test_a_refused_shot_costs_time_and_nothing_else(new_table, break_shot):
    table = new_table(clock={"seconds": 100.0})
    mover, view = table.mover()
    before = seconds_left(table, view["seat"])
    time.sleep(0.1)
    assert mover.act(view, break_shot | {"call": "safety"}).status_code == 422
    assert seconds_left(table, view["seat"]) < before
    assert mover.act(view, break_shot).status_code == 200


def test_a_timer_ends_the_game_without_being_asked(new_table):
    table = new_table(clock={"seconds": 0.4})
    mover, view = table.mover()
    other = table.players[1 - view["seat"]]
    message = other.turn(wait=5)
    assert message["type"] == "game_over"
    assert message["outcome"] == {"winner": 1 - view["seat"], "reason": "time_out", "rule": "R48"}
    assert message["won"] is True
    assert message["view"]["clocks"][view["seat"]] == {"seconds_left": 0.0, "running": False, "simulations_left": None}
    assert mover.turn()["outcome"]["reason"] == "time_out"
    record = table.organiser.get(f"/v1/games/{view['game']}/record").text.splitlines()
    assert verify_record(record).ok


def test_a_game_never_fetched_ends_by_the_timer(own_server, table_at):
    table = table_at(own_server(POOLIAD_FETCH_GRACE="0.2"), clock={"seconds": 0.3})
    message = table.players[1 - table.match["first_breaker"]].turn(wait=5)
    assert message["outcome"]["reason"] == "time_out"


def test_a_shot_that_comes_too_late_is_refused_before_the_timer_has_looked(own_server, table_at, break_shot):
    table = table_at(own_server(POOLIAD_TIMER_PERIOD="5"), clock={"seconds": 0.4})
    mover, view = table.mover()
    time.sleep(0.5)
    response = mover.act(view, break_shot)
    assert (response.status_code, response.json()["code"]) == (409, "out_of_time")
    assert mover.turn(wait=10)["outcome"]["reason"] == "time_out"


@pytest.mark.parametrize("accepted", [True, False])
def test_the_clock_stops_when_the_body_is_complete(new_table, break_shot, accepted):
    """A body that trickles in is on the mover's clock, whatever becomes of it; what the server does with it is not."""
    made = time.monotonic()
    table = new_table(clock={"seconds": 100.0})
    mover, view = table.mover()
    complete = []

    def trickle():
        body = json.dumps(break_shot if accepted else {}).encode()
        for part in (body[:1], body[1:-1], body[-1:]):
            time.sleep(0.2)
            yield part
        complete.append(time.monotonic())

    headers = {
        "Content-Type": "application/json",
        "If-Match": f'"{view["version"]}"',
        "Idempotency-Key": "slow",
    }
    response = mover.request("POST", f"/v1/games/{view['game']}/shots", content=trickle(), headers=headers)
    assert response.status_code == (200 if accepted else 422), response.text
    if not accepted:
        assert mover.act(view, break_shot).status_code == 200
    (charge,) = mover.get(f"/v1/games/{view['game']}/clock").json()["charges"]
    assert (charge["seat"], charge["move"]) == (view["seat"], 0)
    assert charge["measured_ns"] > 0.6e9
    assert charge["charged_ns"] == charge["measured_ns"] - 50_000_000 - charge["grace_ns"]
    if accepted:
        assert charge["measured_ns"] < 1e9 * (complete[0] - made) + 0.3e9


def test_downtime_costs_nobody_anything(own_server, table_at):
    # longer than any machine takes to read the view and fetch the turn: no clock runs meanwhile
    server = own_server(POOLIAD_FETCH_GRACE="60", POOLIAD_FETCH_GRACE_GAME="60")
    table = table_at(server, clock={"seconds": 100.0})
    table.mover()
    time.sleep(0.5)
    seat = table.match["first_breaker"]
    before = seconds_left(table, seat)
    stopping = time.monotonic()
    server.process.terminate()
    server.process.wait(30)
    stopped = time.monotonic() - stopping
    time.sleep(2.0)
    server.restart()
    after = seconds_left(table, seat)
    assert before - stopped - 0.1 < after <= before <= 99.55
    assert table.players[seat].turn()["view"]["clocks"][seat]["seconds_left"] == after


def test_clocks_of_many_games_are_flagged_at_once(new_table):
    tables = [new_table(clock={"seconds": 0.3}) for _ in range(4)]
    for table in tables:
        table.mover()
    with ThreadPoolExecutor(4) as pool:
        seats = [1 - table.match["first_breaker"] for table in tables]
        messages = list(pool.map(lambda table, seat: table.players[seat].turn(), tables, seats))
    assert {message["outcome"]["reason"] for message in messages} == {"time_out"}


@pytest.mark.parametrize("verb", ["shots", "decisions", "concede"])
def test_nothing_counts_after_the_time_is_out(own_server, table_at, break_shot, verb):
    table = table_at(own_server(POOLIAD_TIMER_PERIOD="600"), clock={"seconds": 0.2})
    mover, view = table.mover()
    time.sleep(0.3)
    response = mover.post(f"/v1/games/{view['game']}/{verb}", break_shot, version=view["version"])
    assert response.json()["code"] == "out_of_time"
