"""Issue 15, "Everything that shows": tables with jaws over HTTP, described, played on, recorded, refused."""

import json
import math
import signal
from typing import Any

import pytest

import physics
from physics.table import NAMED
from protocol import TableDescription
from referee.record import verify_record

NINE_FOOT = physics.Table.nine_foot()
REAL = ("nine_foot", "eight_foot", "seven_foot")
FIELDS_OF_0_1_0 = [
    *("name", "width", "length", "corner_mouth", "side_mouth", "nose_height", "cue_length", "cue_mass"),
    *("mu_slide", "mu_roll", "mu_spin", "mu_ball", "e_ball", "cushion_parallel", "cushion_perpendicular"),
    *("cushion_spin", "v_max", "theta_max", "rack_gap", "collisions", "cue_test"),
]
BREAK: dict[str, Any] = {
    "shot": {"v": 11.0, "phi": 270.0, "theta": 10.0, "a": 0.0, "b": 0.0},
    "call": None,
    "cue_ball": [0.635, 2.1],
}
"""Harder than the Olympiad's table allows."""
BALLS = {"0": [0.5, 1.7], "3": [0.4, 0.6]}
SHOT = {"v": 2.0, "phi": 260.0, "theta": 10.0, "a": 0.0, "b": 3.0}


# --- described ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", NAMED)
def test_a_named_table_is_described_as_the_physics_has_it(server, name):
    """Without a token: a spectator's page draws it."""
    response = server.request("GET", f"/v1/tables/{name}")
    assert response.status_code == 200, response.text
    table, told = physics.Table.named(name), response.json()
    assert told["table"] == table.to_dict()
    assert (told["digest"], told["has_jaws"]) == (table.digest, name in REAL)
    assert told["pockets"] == [pocket.to_dict() for pocket in table.pockets]
    assert told in server.request("GET", "/v1/tables").json()["tables"]


def test_the_list_has_every_named_table_and_no_other(server):
    tables = server.request("GET", "/v1/tables").json()["tables"]
    assert [one["table"]["name"] for one in tables] == list(NAMED)


@pytest.mark.parametrize("name", NAMED)
def test_noses_horns_and_facings_are_one_line_from_pocket_to_pocket(name):
    """Round the table: a nose on its cushion's line, the horn's arc, the facing; nothing is missing."""
    table = physics.Table.named(name)
    told = TableDescription.of(table)
    lines = {0: (0, 0.0), 1: (0, table.width), 2: (1, 0.0), 3: (1, table.length)}
    ends: list[Any] = []
    for nose in told.noses:
        axis, line = lines[nose.cushion]
        assert [end[axis] for end in nose.ends] == pytest.approx([line, line], abs=1e-15)
        ends += nose.ends
    assert sorted(nose.cushion for nose in told.noses) == [0, 0, 1, 1, 2, 3]
    assert len(set(ends)) == 12
    jaws = [jaw for pocket in told.pockets for jaw in pocket.jaws]
    begins = [jaw.nose_end for jaw in jaws] or [end for pocket in told.pockets for end in pocket.mouth]
    assert sorted(begins) == sorted(ends)
    for jaw in jaws:
        for end in (jaw.nose_end, jaw.facing_start):
            assert math.dist(jaw.horn_centre, end) == pytest.approx(jaw.horn_radius, abs=1e-15)
        along = [b - a for a, b in zip(jaw.facing_start, jaw.facing_end, strict=True)]
        assert abs(sum(a * b for a, b in zip(along, jaw.facing_normal, strict=True))) < 1e-15


def test_a_table_with_parameters_of_its_own_is_described(server):
    mine = NINE_FOOT.replace(corner_mouth=0.12, horn_radius=0.01, corner_shelf=0.03)
    for table in (
        mine.to_dict(),
        {"name": "nine_foot", "corner_mouth": 0.12, "horn_radius": 0.01, "corner_shelf": 0.03},
    ):
        response = server.request("POST", "/v1/tables", json={"table": table})
        assert response.status_code == 200, response.text
        assert response.json() == json.loads(TableDescription.of(mine).model_dump_json())


def test_there_is_no_other_table(server):
    for name in ("ten_foot", "describe", "NINE_FOOT", "x" * 5000):
        problem = server.request("GET", f"/v1/tables/{name}")
        assert (problem.status_code, problem.json()["code"]) == (404, "not_found")
        assert "nine_foot" in problem.json()["allowed"]
        assert len(problem.json()["value"]) <= 201


@pytest.mark.parametrize(
    ("change", "field", "words"),
    [
        ({"name": "ten_foot"}, "table.name", "must be one of"),
        ({"corner_cut": 170.0, "corner_mouth": 0.1}, "table.corner_mouth", "must leave more than"),
        ({"side_cut": 149.0, "side_mouth": 0.091}, "table.side_mouth", "must leave more than"),
        ({"corner_mouth": 9.0}, "table.corner_mouth", "must be a number from 0.09 to 0.16 m"),
        ({"corner_shelf": 0, "corner_hole_radius": 0.08}, "table.corner_shelf", "must keep the hole behind"),
        ({"horn_radius": -1e300}, "table.horn_radius", "must be a number from 0.001 to 0.03 m"),
        ({"v_max": 21}, "table.v_max", "must be a number from 0.1 to 20 m/s"),
        ({"theta_max": True}, "table.theta_max", "must be a number from 0 to 89 deg"),
        ({"ball_mass": "heavy"}, "table.ball_mass", "must be a number from 0.1 to 0.25 kg"),
        ({"cushion": "spongy"}, "table.cushion", "must be one of"),
        ({"ball": 3}, "table.ball", "must be one of"),
        ({"flight": 1}, "table.flight", "must be True or False"),
        ({"collisions": "consistent"}, "table.collisions", "is not a parameter"),
        ({"width": 2.0}, "table.width", "is not a parameter"),
        ({"nap": 1}, "table.nap", "is not a parameter"),
        ({"e_cushion": None}, "table.e_cushion", "must be a number from 0 to 1"),
        ({"mu_roll": 0.3}, "table.mu_roll", "must be a number from 0.001 to 0.2"),
    ],
)
@pytest.mark.parametrize("path", ["/v1/tables", "/v1/simulate", "/v1/matches"])
def test_a_table_that_cannot_be_is_refused_by_field_value_and_what_is_allowed(
    server, new_player, organiser, path, change, field, words
):
    table = {"name": "nine_foot"} | change
    more: dict[str, Any] = {
        "/v1/tables": {},
        "/v1/simulate": {"balls": BALLS, "shot": SHOT},
        "/v1/matches": {"agents": [new_player().id, new_player().id]},
    }
    response = organiser.post(path, {"table": table} | more[path])
    problem = response.json()
    assert (response.status_code, problem["code"], problem["field"]) == (422, "invalid", field)
    assert words in problem["allowed"]
    assert problem["value"] == table.get(field.removeprefix("table."))


@pytest.mark.parametrize("literal", ["NaN", "Infinity", "1e999", "-1e999", str(10**400)])
@pytest.mark.parametrize("name", ["corner_mouth", "e_tip", "v_max", "rack_gap"])
def test_a_parameter_that_is_no_finite_number(server, name, literal):
    body = f'{{"table": {{"name": "nine_foot", "{name}": {literal}}}}}'
    response = server.request("POST", "/v1/tables", content=body.encode(), headers={"Content-Type": "application/json"})
    assert (response.status_code, response.json()["field"]) == (422, f"table.{name}")


# --- what old tables send ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["olympiad", "fastfiz"])
def test_old_tables_keep_their_fields(server, new_player, organiser, name):
    match = organiser.post("/v1/matches", {"agents": [new_player().id, new_player().id], "table": name}).json()
    view = organiser.get(f"/v1/games/{match['played'][0]['id']}").json()["view"]
    assert list(match["table"]) == list(view["table"]) == FIELDS_OF_0_1_0
    answer = new_player().request("POST", "/v1/simulate", json={"table": name, "balls": BALLS, "shot": SHOT}).json()
    assert "miscue" not in answer["facts"]


def test_old_strokes_keep_their_fields(new_table, break_shot):
    table = new_table(noise={"level": 0.0})
    mover, view = table.mover()
    stroke = mover.act(view, break_shot).json()["stroke"]
    assert list(stroke) == [
        *("index", "stroke", "seat", "action", "shot", "status", "duration", "pocketed", "ruling", "balls"),
        *("before", "final", "events"),
    ]


# --- ranges ---------------------------------------------------------------------------------------------------


def test_a_shot_is_held_to_the_ranges_of_its_own_table(new_player):
    player = new_player()

    def ask(table, **change):
        body = {"table": table, "balls": BALLS, "shot": SHOT | change, "trace": False}
        return player.request("POST", "/v1/simulate", json=body)

    assert ask("nine_foot", v=11.0).json()["status"] == "at_rest"
    assert ask("nine_foot", theta=84.0, b=0.0).json()["status"] == "at_rest"
    assert ask({"name": "nine_foot", "v_max": 20.0}, v=19.9).json()["status"] == "at_rest"
    for table, change, most in (
        ("nine_foot", {"v": 12.001}, "12 m/s"),
        ("nine_foot", {"v": -1e-9}, "12 m/s"),
        ("nine_foot", {"theta": 85.1}, "85 deg"),
        ("nine_foot", {"theta": 1e308}, "85 deg"),
        ("olympiad", {"v": 10.001}, "10 m/s"),
        ("olympiad", {"theta": 70.1}, "70 deg"),
        ({"name": "nine_foot", "v_max": 3.0}, {"v": 3.5}, "3 m/s"),
    ):
        ((name, value),) = change.items()
        response = ask(table, **change)
        problem = response.json()
        assert (response.status_code, problem["code"]) == (422, "invalid"), response.text
        assert (problem["field"], problem["value"]) == (f"shot.{name}", value)
        assert problem["allowed"] == f"must be a number from 0 to {most}"
        batch = {"table": table, "balls": BALLS, "shots": [SHOT, SHOT | change]}
        refused = player.request("POST", "/v1/simulate/batch", json=batch).json()
        assert (refused["code"], refused["field"], refused["value"]) == ("invalid", f"shots.1.{name}", value)


def test_what_is_out_of_range_costs_nothing_of_a_budget(new_table):
    table = new_table(table="nine_foot", clock={"seconds": 300, "simulations": 10})
    mover, view = table.mover()
    scene = {"table": "nine_foot", "balls": BALLS, "game": view["game"]}
    assert mover.post("/v1/simulate", scene | {"shot": SHOT | {"v": 12.5}}).status_code == 422
    assert mover.post("/v1/simulate/batch", scene | {"shots": [SHOT, SHOT | {"theta": 86}]}).status_code == 422
    assert mover.turn()["view"]["clocks"][view["seat"]]["simulations_left"] == 10
    assert mover.post("/v1/simulate", scene | {"shot": SHOT}).status_code == 200
    assert mover.turn()["view"]["clocks"][view["seat"]]["simulations_left"] == 9


def test_a_stroke_is_held_to_the_ranges_of_the_matchs_table(new_table):
    """Refused before anything is drawn or stored: the game, its noise and the key are as they were."""
    table = new_table(table="nine_foot", noise={"level": 1.0})
    mover, view = table.mover()
    for change, field in (({"v": 12.5}, "shot.v"), ({"theta": 85.5}, "shot.theta"), ({"v": -0.1}, "shot.v")):
        response = mover.act(view, BREAK | {"shot": BREAK["shot"] | change}, key="the same")
        problem = response.json()
        assert (response.status_code, problem["code"], problem["field"]) == (422, "invalid", field)
        assert problem["allowed"].startswith("must be a number from 0 to ")
    played = mover.act(view, BREAK, key="the same")
    assert played.status_code == 200, played.text
    assert played.headers["etag"] == f'"{view["version"] + 1}"'
    twin = new_table(table="nine_foot", noise={"level": 1.0})
    breaker, first = twin.mover()
    assert breaker.act(first, BREAK).json()["stroke"]["shot"] == played.json()["stroke"]["shot"]


def test_noise_is_clamped_by_the_matchs_table(new_table):
    speeds = set()
    for digit in "0123":
        table = new_table(table="nine_foot", noise={"level": 5.0}, seed=digit * 64)
        mover, view = table.mover()
        shot = mover.act(view, BREAK | {"shot": BREAK["shot"] | {"v": 12.0}}).json()["stroke"]["shot"]
        speeds.add(shot["v"])
    assert max(speeds) == 12.0
    assert len(speeds) > 1


# --- played on --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", REAL)
def test_a_match_knows_its_table_by_name_and_by_parameters(new_table, name):
    plain, own = new_table(table=name), new_table(table={"name": name, "mu_slide": 0.25, "cushion": "mathavan"})
    assert plain.match["table"] == physics.Table.named(name).to_dict()
    assert own.match["table"] == physics.Table.named(name).replace(mu_slide=0.25, cushion="mathavan").to_dict()
    _, view = plain.mover()
    assert view["table"] == plain.match["table"]
    near = physics.RealTable.of_size(name).contact_distance
    assert view["cue_ball_area"]["x"] == [near, plain.match["table"]["width"] - near]


def test_a_whole_game_with_restarts_is_verified(own_server, table_at):
    """Killed in the middle, and stopped; the record is played again through the referee, bit for bit."""
    server = own_server()
    table = table_at(server, table="nine_foot", noise={"level": 0.5}, seed="9" * 64)
    answers = table.play(4, seed=3)
    server.restart(signal.SIGKILL)
    answers += table.play(4, seed=4)
    server.restart(signal.SIGTERM)
    answers += table.play(200, seed=5)
    if table.is_running:
        mover, view = table.mover()
        answers.append(mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).json())
    (game,) = table.organiser.get(f"/v1/matches/{table.match['id']}").json()["played"]
    lines = table.organiser.get(f"/v1/games/{game['id']}/record").text.splitlines()
    assert json.loads(lines[0])["table"] == NINE_FOOT.to_dict()
    verification = verify_record(lines)
    assert verification.ok, verification
    kinds = {event["kind"] for answer in answers for event in answer["stroke"]["events"]}
    assert {"jaw_collision", "pocket_collision", "rail_collision"} <= kinds


def test_a_challenge_on_a_real_table(new_player):
    one, two = new_player(), new_player()
    agents = {"agents": [one.id, two.id]}
    for table in ("nine_foot", "seven_foot", {"name": "eight_foot", "cushion": "mathavan"}):
        assert one.post("/v1/matches", agents | {"table": table}).status_code == 201
    problem = one.post("/v1/matches", agents | {"table": {"name": "nine_foot", "cue_end_mass": 0.0}}).json()
    assert problem["field"] == "table.cue_end_mass"
    assert "an organiser" in problem["allowed"]


def test_a_tournament_on_a_real_table(server, new_player, organiser):
    players = {name: new_player() for name in ("ann", "bob")}
    terms = {"name": "Cup", "entrants": list(players), "pairs": 1, "seed": 5, "table": {"name": "nine_foot"}}
    agents = {name: player.id for name, player in players.items()}
    event = organiser.post("/v1/tournaments", {"terms": terms, "agents": agents})
    assert event.status_code == 201, event.text
    path = f"/v1/tournaments/{event.json()['id']}"
    assert organiser.post(f"{path}/start").status_code == 200
    for _ in range(2):
        (game,) = [one for one in organiser.get(path).json()["played"] if one["status"] == "running"]
        match = organiser.get(f"/v1/matches/{game['match']}").json()
        assert match["table"] == NINE_FOOT.to_dict()
        view = organiser.get(f"/v1/games/{match['played'][-1]['id']}").json()["view"]
        mover = players[game["players"][view["turn"]]]
        while (message := mover.turn())["type"] != "turn":
            pass
        assert mover.act(message["view"], BREAK).status_code == 200
        last = organiser.get(f"/v1/games/{view['game']}").json()["view"]
        mover = players[game["players"][last["turn"]]]
        while (message := mover.turn())["type"] != "turn":
            pass
        mover.post(f"/v1/games/{view['game']}/concede", version=message["view"]["version"])
        lines = organiser.get(f"/v1/games/{view['game']}/record").text.splitlines()
        assert verify_record(lines).ok
    assert organiser.get(path).json()["status"] == "finished"


def test_a_miscue_is_told_and_no_foul_of_its_own(new_table):
    """The tip slips at 0.9 R: told in the stroke, in the history and in the record; the ruling does not cite R39."""
    table = new_table(table="nine_foot", noise={"level": 0.0})
    mover, view = table.mover()
    wide = BREAK | {"shot": BREAK["shot"] | {"a": 25.0, "theta": 20.0}}
    stroke = mover.act(view, wide).json()["stroke"]
    assert stroke["miscue"] is True
    assert "R39" not in stroke["ruling"]["rules"]
    scene = {"table": "nine_foot", "balls": stroke["before"], "shot": stroke["shot"]}
    assert mover.request("POST", "/v1/simulate", json=scene).json()["facts"]["miscue"] == 1
    held = scene | {"shot": stroke["shot"] | {"a": 0.0}}
    assert mover.request("POST", "/v1/simulate", json=held).json()["facts"]["miscue"] == 0
    (told,) = table.organiser.get(f"/v1/games/{view['game']}/shots").json()["shots"]
    assert told["miscue"] is True
    mover, view = table.mover()
    mover.post(f"/v1/games/{view['game']}/concede", version=view["version"])
    lines = table.organiser.get(f"/v1/games/{view['game']}/record").text.splitlines()
    recorded = [json.loads(line) for line in lines]
    assert [line.get("miscue") for line in recorded if line["type"] == "stroke"] == [True, None]
    assert verify_record(lines).ok


def test_every_name_is_offered_by_the_schema(server):
    schemas = server.request("GET", "/openapi.json").json()["components"]["schemas"]
    names = schemas["MatchRequest"]["properties"]["table"]["anyOf"][0]["enum"]
    assert names == list(NAMED)
