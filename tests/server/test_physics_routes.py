"""CONTRACT, HTTP: the physics alone, for any language, with the library's own numbers."""

import math
from typing import Any

import numpy as np
import pytest

import physics
from protocol import BatchRequest
from server.errors import Invalid
from server.services.physics import simulations as service

OVERLAP = {"0": [0.5, 0.5], "1": [0.51, 0.5]}
OFF_TABLE = {"0": [5.0, 0.5]}
BALLS = {"0": [0.5, 1.7], "3": [0.4, 0.6], "8": [0.7, 0.5]}
SHOT = {"v": 2.0, "phi": 260.0, "theta": 8.0, "a": 0.0, "b": 3.0}


@pytest.fixture
def state():
    return physics.TableState.from_dict(BALLS)


def ask(player, path, **body):
    response = player.request("POST", path, json={"balls": BALLS} | body)
    assert response.status_code == 200, response.text
    return response.json()


def test_simulate_gives_the_librarys_bits(new_player, state):
    answer = ask(new_player(), "/v1/simulate", shot=SHOT)
    result = physics.simulate(physics.Table.olympiad(), state, physics.Shot(**SHOT))
    assert answer["balls"] == result.final.to_dict()
    assert answer["duration"] == result.duration
    assert answer["n_events"] == result.n_events == len(answer["events"])
    assert answer["status"] == "at_rest"
    assert [event["kind"] for event in answer["events"]] == [str(event.kind) for event in result.events]
    assert answer["events"][0]["states"][0]["velocity"] == list(result.events[0].states[0].velocity)


def test_simulate_without_a_trace(new_player):
    answer = ask(new_player(), "/v1/simulate", shot=SHOT, trace=False)
    assert answer["events"] is None
    assert answer["n_events"] > 1


def test_a_shot_that_cannot_be_played_is_an_answer(new_player):
    answer = ask(new_player(), "/v1/simulate", shot=SHOT | {"a": 40.0})
    assert (answer["status"], answer["balls"], answer["n_events"]) == ("tip_off_ball", BALLS, 0)


@pytest.mark.parametrize("table", ["fastfiz", {"name": "olympiad", "mu_slide": 0.25}])
def test_another_table(new_player, state, table):
    answer = ask(new_player(), "/v1/simulate", shot=SHOT, table=table)
    changed = {"name": table} if isinstance(table, str) else table
    result = physics.simulate(physics.Table.from_dict(changed), state, physics.Shot(**SHOT))
    assert answer["balls"] == result.final.to_dict()


def test_a_batch_gives_the_librarys_bits(new_player, state):
    shots = [SHOT | {"phi": 255.0 + i} for i in range(20)]
    answer = ask(new_player(), "/v1/simulate/batch", shots=shots)
    rows = np.array([[shot[name] for name in ("v", "phi", "theta", "a", "b")] for shot in shots])
    batch = physics.simulate_batch(physics.Table.olympiad(), state, rows)
    for i, row in enumerate(answer["results"]):
        assert row["n_events"] == batch.n_events[i]
        assert row["duration"] == batch.duration[i]
        for ball in range(16):
            expected = batch.positions[i, ball].tolist()
            assert row["balls"].get(str(ball)) == (None if math.isnan(expected[0]) else expected)
            pocket = int(batch.pocket[i, ball])
            assert row["pocketed"].get(str(ball)) == (pocket if pocket >= 0 else None)


def test_a_batch_with_a_table_for_each_shot(new_player):
    player = new_player()
    other = BALLS | {"0": [0.6, 1.5]}
    answer = player.request("POST", "/v1/simulate/batch", json={"tables": [BALLS, other], "shots": [SHOT, SHOT]}).json()
    for balls, row in zip((BALLS, other), answer["results"], strict=True):
        assert row["balls"] == ask(player, "/v1/simulate", balls=balls, shot=SHOT)["balls"]


def test_min_elevation(new_player, state):
    answer = ask(new_player(), "/v1/min-elevation", phi=260.0, b=3.0)
    assert answer["theta"] == physics.min_elevation(physics.Table.olympiad(), state, 260.0, 0.0, 3.0)


def test_min_elevation_where_there_is_none(new_player):
    balls = {"0": [0.5, 0.5], "1": [0.5, 0.5 + 2 * 0.028575 + 1e-6]}
    answer = ask(new_player(), "/v1/min-elevation", balls=balls, phi=270.0)
    table, state = physics.Table.olympiad(), physics.TableState.from_dict(balls)
    expected = physics.min_elevation(table, state, 270.0)
    assert answer["theta"] == (None if math.isnan(expected) else expected)


@pytest.mark.parametrize(
    ("path", "change", "field"),
    [
        ("/v1/simulate", {"balls": {"0": [0.5, 0.5], "1": [0.51, 0.5]}}, "balls.1"),
        ("/v1/simulate", {"balls": {"0": [5.0, 0.5]}}, "balls.0"),
        ("/v1/simulate", {"balls": {"16": [0.5, 0.5]}}, "balls.16"),
        ("/v1/simulate", {"balls": {"zero": [0.5, 0.5]}}, "balls.zero"),
        ("/v1/simulate", {"balls": {"0": [0.5]}}, "balls"),
        ("/v1/simulate", {"balls": []}, "balls"),
        ("/v1/simulate", {"shot": SHOT | {"v": 11}}, "shot.v"),
        ("/v1/simulate", {"shot": None}, "shot"),
        ("/v1/simulate", {"table": {"name": "olympiad", "mu_slide": 7}}, "table.mu_slide"),
        ("/v1/simulate", {"table": {"name": "olympiad", "nap": 7}}, "table.nap"),
        ("/v1/simulate/batch", {"shots": []}, "shots"),
        ("/v1/simulate/batch", {"shots": [SHOT], "tables": [BALLS]}, "balls"),
        ("/v1/simulate/batch", {"shots": [SHOT], "balls": None, "tables": [BALLS, BALLS]}, "tables"),
        ("/v1/simulate/batch", {"shots": [SHOT, SHOT | {"theta": 71}]}, "shots.1.theta"),
        ("/v1/simulate/batch", {"shots": [SHOT] * 2, "balls": None, "tables": [BALLS, OVERLAP]}, "tables.1.1"),
        ("/v1/simulate/batch", {"shots": [SHOT] * 2, "balls": None, "tables": [BALLS, OFF_TABLE]}, "tables.1.0"),
        ("/v1/simulate/batch", {"shots": [SHOT], "balls": OFF_TABLE}, "balls.0"),
        ("/v1/min-elevation", {"phi": "north"}, "phi"),
        ("/v1/min-elevation", {"balls": {}}, None),
        ("/v1/min-elevation", {"balls": {"1": [0.5, 0.5]}}, None),
    ],
)
def test_bad_scenes(new_player, path, change, field):
    body: dict[str, Any] = {"balls": BALLS} | ({"phi": 0.0} if path == "/v1/min-elevation" else {"shot": SHOT})
    body = {"balls": BALLS} if "shots" in change else body
    response = new_player().request("POST", path, json=body | change)
    if field is None:
        assert response.status_code in (200, 422), response.text
        return
    assert response.status_code == 422, response.text
    problem = response.json()
    assert problem["code"] == "invalid"
    assert problem["field"].startswith(field)


@pytest.mark.parametrize("path", ["/v1/simulate", "/v1/simulate/batch", "/v1/min-elevation"])
@pytest.mark.parametrize(
    ("table", "field", "value"),
    [
        ({"name": "olympiad", "mu_slide": 7}, "table.mu_slide", 7),
        ({"name": "olympiad", "mu_roll": 0.02, "mu_slide": "x"}, "table.mu_slide", "x"),
        ({"name": "olympiad", "mouths": [1]}, "table.mouths", [1]),
        ({"name": "olympiad", "zzz": None}, "table.zzz", None),
        ({"name": []}, "table.name", []),
        ({"name": {}}, "table.name", {}),
        ({}, "table.name", None),
        ([1], "table", [1]),
        (None, "table", None),
    ],
)
def test_a_bad_table_is_named_with_its_value(new_player, path, table, field, value):
    shots: dict[str, Any] = {"/v1/simulate": {"shot": SHOT}, "/v1/simulate/batch": {"shots": [SHOT]}}
    response = new_player().request("POST", path, json=shots.get(path, {"phi": 0.0}) | {"balls": BALLS, "table": table})
    assert response.status_code == 422, response.text
    fault = response.json()["errors"][0]
    assert (fault["field"], fault["value"]) == (field, value)
    assert fault["allowed"]
    assert fault["detail"].startswith(field)


def test_many_shots_need_a_token(server):
    assert server.request("POST", "/v1/simulate/batch", json={}).status_code == 401


def test_a_trace_of_tens_of_thousands_of_events_is_refused_by_name(new_player):
    """A row of balls that creep (tests/regressions): 46,908 events, 20 MB of JSON; without a trace it is answered."""
    places = {11: 0.661810045775182, 0: 0.7189600457851819, 7: 0.776110045785183, 14: 0.833260045785183}
    places |= {3: 0.890410046785183, 5: 0.947560046785183, 15: 1.004710046785283, 10: 0.604660045775181}
    slow = {"mu_slide": 0.01, "mu_roll": 0.01, "mu_spin": 0.001, "mu_ball": 0.0, "e_ball": 0.8}
    dead = dict.fromkeys(("cushion_parallel", "cushion_perpendicular", "cushion_spin"), 0.0)
    body = {
        "table": {"name": "olympiad", "cue_test": False} | slow | dead,
        "balls": {str(ball): [0.19023233049865176, y] for ball, y in places.items()},
        "shot": {"v": 10.0, "phi": -90.0, "theta": 70.0, "a": 0.0, "b": 0.0},
    }
    player = new_player()
    response = player.request("POST", "/v1/simulate", json=body)
    assert response.status_code == 422
    fault = response.json()["errors"][0]
    assert fault["field"] == "trace"
    assert "46908 events" in fault["allowed"]
    answer = player.request("POST", "/v1/simulate", json=body | {"trace": False}).json()
    assert (answer["n_events"], answer["status"], answer["events"]) == (46908, "at_rest", None)


def batch(shots):
    return BatchRequest.model_validate({"balls": BALLS, "shots": [SHOT] * shots})


def test_a_batch_that_takes_too_long_is_ended(monkeypatch):
    times = iter([0.0, 1.0, 2.0, 30.0])
    monkeypatch.setattr("server.services.physics.simulations.time.monotonic", lambda: next(times))
    with pytest.raises(Invalid) as refused:
        service.simulate_batch(batch(1000))
    assert refused.value.extensions["field"] == "shots"
    assert next(times, None) is None, "it was ended at its third look, and not before"


def test_a_batch_that_nobody_waits_for_any_more_is_ended():
    asked: list[None] = []

    def go_on():
        asked.append(None)
        if len(asked) == 3:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        service.simulate_batch(batch(1000), go_on)
    assert len(asked) == 3


ONE = {"table": "olympiad", "balls": {"0": [0.5, 1.7]}, "shot": {"v": 2, "phi": 270, "theta": 5, "a": 0, "b": 0}}
RAISED = {"table": "olympiad", "balls": {"0": [0.5, 1.7]}, "phi": 270, "a": 0, "b": 0}


def test_single_shots_need_no_token_but_batches_and_budgets_do(server, new_table):
    """Issue 17: the laboratory works without signing in. What counts for a player is for players."""
    http, game = server.http, new_table().game
    assert http.post("/v1/simulate", json=ONE).json()["status"] == "at_rest"
    assert http.post("/v1/min-elevation", json=RAISED).json()["theta"] > 0
    counted = http.post("/v1/simulate", json=ONE | {"game": game}, headers={"Idempotency-Key": "a stranger's"})
    assert (counted.status_code, counted.json()["code"]) == (401, "unauthorized")
    batch = {"table": "olympiad", "balls": ONE["balls"], "shots": [ONE["shot"]]}
    assert http.post("/v1/simulate/batch", json=batch).status_code == 401


def test_strangers_simulations_are_rated_by_address_and_may_be_switched_off(own_server):
    rated = own_server(POOLIAD_ADDRESS_RATE="0.01", POOLIAD_ADDRESS_BURST="2")
    assert [rated.http.post("/v1/simulate", json=ONE).status_code for _ in range(3)] == [200, 200, 429]
    closed = own_server(POOLIAD_PUBLIC_PHYSICS="false")
    for path, body in (("/v1/simulate", ONE), ("/v1/min-elevation", RAISED)):
        assert closed.http.post(path, json=body).status_code == 401
