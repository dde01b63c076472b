"""Issue 2, "How it is judged": bad input, each answered by a precise 4xx problem and nothing changed."""

import json
import socket
import sqlite3
import uuid
from contextlib import closing

import pytest

from protocol import View


@pytest.fixture
def at_break(new_table):
    """A game before its break: (table, mover, view). Afterwards it must stand as it stood."""
    table = new_table()
    mover, view = table.mover()
    before = state_of(table, view)
    yield table, mover, view
    assert state_of(table, view) == before


def state_of(table, view):
    """Everything about a game but its running clocks."""
    game = table.organiser.get(f"/v1/games/{view['game']}").json()
    game["view"].pop("clocks")
    shots = table.organiser.get(f"/v1/games/{view['game']}/shots").json()
    return game, shots


def send(player, view, body, **headers):
    """The shot with a raw body, well formed in all other ways."""
    sent = {"Content-Type": "application/json", "If-Match": f'"{view["version"]}"', "Idempotency-Key": "raw"}
    return player.request("POST", f"/v1/games/{view['game']}/shots", content=body, headers=sent | headers)


def problem_of(response, status, code):
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/problem+json"
    problem = response.json()
    assert (problem["status"], problem["code"]) == (status, code)
    assert problem["detail"]
    return problem


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"{",
        b"shot",
        b'{"shot": }',
        b"\xff\xfe",
        b'{"a": "\xc3"}',
        b'{"a": "\\ud800"}',
        b"[" * 60_000,
        b'{"a":' * 5_000,
        b"1" * 10_000,
    ],
    ids=lambda body: repr(body[:8]),
)
def test_not_json(at_break, body):
    _, mover, view = at_break
    problem = problem_of(send(mover, view, body), 400, "not_json")
    assert problem["field"] == "body"


@pytest.mark.parametrize("body", [b"null", b"[]", b"7", b'"shot"', b"NaN", b"[[[[1]]]]"])
def test_json_that_is_no_object(at_break, body):
    _, mover, view = at_break
    problem_of(send(mover, view, body), 422, "invalid")


@pytest.mark.parametrize("kind", ["text/plain", "", "application/x-www-form-urlencoded", "application/jsonx"])
def test_a_body_that_does_not_say_it_is_json(at_break, break_shot, kind):
    _, mover, view = at_break
    problem = problem_of(send(mover, view, b"{}", **{"Content-Type": kind}), 415, "unsupported_media_type")
    assert problem["allowed"] == "application/json"


@pytest.mark.parametrize(
    ("path", "value", "field"),
    [
        (("shot", "v"), None, "shot.v"),
        (("shot", "v"), "3", "shot.v"),
        (("shot", "v"), True, "shot.v"),
        (("shot", "v"), -0.001, "shot.v"),
        (("shot", "v"), 10.001, "shot.v"),
        (("shot", "theta"), 70.1, "shot.theta"),
        (("shot", "theta"), -1, "shot.theta"),
        (("shot", "phi"), [1], "shot.phi"),
        (("shot", "spin"), 1.0, "shot.spin"),
        (("shot",), None, "shot"),
        (("speed",), 1, "speed"),
        (("cue_ball",), [0.5], "cue_ball"),
        (("cue_ball",), [0.5, 1.8, 0.0], "cue_ball"),
        (("cue_ball",), {"x": 0.5}, "cue_ball"),
        (("call",), "bank", "call"),
        (("call",), {"ball": 0, "pocket": 0}, "call"),
        (("call",), {"ball": 16, "pocket": 0}, "call"),
        (("call",), {"ball": 3, "pocket": 6}, "call"),
        (("call",), {"ball": 3}, "call"),
        (("call",), {"ball": 3.0, "pocket": 1}, "call"),
    ],
)
def test_fields_of_the_wrong_type_or_range(at_break, break_shot, path, value, field):
    _, mover, view = at_break
    body = {**break_shot, "shot": dict(break_shot["shot"])}
    target = body
    for name in path[:-1]:
        target = target[name]
    target[path[-1]] = value
    problem = problem_of(mover.act(view, body), 422, "invalid")
    assert problem["field"].startswith(field)
    assert problem["allowed"]
    assert problem["errors"][0]["field"] == problem["field"]


def test_every_missing_field_is_listed(at_break):
    _, mover, view = at_break
    problem = problem_of(mover.act(view, {"shot": {"v": 1.0, "phi": 0.0}}), 422, "invalid")
    assert [fault["field"] for fault in problem["errors"]] == ["shot.theta", "shot.a", "shot.b"]


@pytest.mark.parametrize(
    ("literal", "shown"), [(b"NaN", "nan"), (b"Infinity", "inf"), (b"-Infinity", "-inf"), (b"1e999", "inf")]
)
@pytest.mark.parametrize("name", ["v", "phi", "a"])
def test_not_a_number_and_infinity_are_named_as_text(at_break, literal, shown, name):
    _, mover, view = at_break
    shot = {"v": b"3.0", "phi": b"270.0", "theta": b"10.0", "a": b"0.0", "b": b"0.0"} | {name: literal}
    fields = b",".join(b'"%s":%s' % (key.encode(), value) for key, value in shot.items())
    problem = problem_of(send(mover, view, b'{"shot":{%s},"cue_ball":[0.5,1.8]}' % fields), 422, "invalid")
    assert (problem["field"], problem["value"]) == (f"shot.{name}", shown)


def test_a_position_that_is_not_a_number(at_break):
    _, mover, view = at_break
    body = b'{"shot":{"v":3,"phi":270,"theta":10,"a":0,"b":0},"cue_ball":[NaN,1.8]}'
    problem = problem_of(send(mover, view, body), 422, "invalid")
    assert problem["field"].startswith("cue_ball")
    assert problem["value"] == "nan"


@pytest.mark.parametrize("number", [10**400, -(10**400), 10**30])
def test_huge_integers(at_break, break_shot, number):
    _, mover, view = at_break
    body = f'{{"shot":{{"v":{number},"phi":0,"theta":0,"a":0,"b":0}},"cue_ball":[0.5,1.8]}}'
    problem_of(send(mover, view, body.encode()), 422, "invalid")


@pytest.mark.parametrize(
    ("change", "field", "rule"),
    [
        ({"cue_ball": [0.558, 0.559]}, "cue_ball", "R37"),
        ({"cue_ball": [0.558, 1.0]}, "cue_ball", "R37"),
        ({"cue_ball": [0.558, 1.677]}, "cue_ball", "R37"),
        ({"cue_ball": [0.01, 1.8]}, "cue_ball", "R40"),
        ({"cue_ball": [-3.0, 1.8]}, "cue_ball", "R40"),
        ({"cue_ball": [1e300, 1e300]}, "cue_ball", "R40"),
        ({"call": {"ball": 3, "pocket": 0}}, "call", "R8"),
        ({"call": "safety"}, "call", "R8"),
    ],
    ids=[
        "on a ball",
        "outside the kitchen",
        "on the string",
        "in a cushion",
        "off the table",
        "far",
        "call",
        "safety",
    ],
)
def test_what_the_referee_refuses(at_break, break_shot, change, field, rule):
    """R37, R40: refused before the stroke with the reason; R8: no call on the break."""
    _, mover, view = at_break
    problem = problem_of(mover.act(view, break_shot | change), 422, "refused")
    assert problem["field"].startswith(field)
    assert problem["allowed"]
    assert problem["errors"][0]["rule"] == rule


def test_a_decision_that_nobody_asked_for(at_break):
    _, mover, view = at_break
    problem_of(mover.act(view, {"decision": "accept_table"}), 422, "refused")
    problem_of(mover.act(view, {"decision": "win"}), 422, "invalid")


def test_a_shot_out_of_turn(at_break, break_shot):
    table, _, view = at_break
    other = table.players[1 - view["seat"]]
    problem_of(other.act(view, break_shot), 409, "not_your_turn")


def test_a_stale_version_carries_the_current_view(at_break, break_shot):
    _, mover, view = at_break
    problem = problem_of(mover.act(view | {"version": 7}, break_shot), 412, "stale_version")
    assert (problem["view"]["game"], problem["view"]["version"]) == (view["game"], view["version"])
    assert problem["view"]["seat"] == view["seat"]
    assert View.model_validate(problem["view"]).groups is None


def test_the_token_of_another_agent(at_break, new_player, break_shot):
    _, mover, view = at_break
    stranger = new_player()
    problem_of(stranger.act(view, break_shot), 403, "forbidden")
    stranger.token = "pool_agt_" + "A" * 43
    problem_of(stranger.act(view, break_shot), 401, "unauthorized")
    assert mover.get("/v1/turns").json()["type"] == "turn"


def test_a_finished_game(new_table, break_shot):
    table = new_table()
    mover, view = table.mover()
    assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
    before = state_of(table, view)
    problem_of(mover.act(view, break_shot), 409, "game_finished")
    assert state_of(table, view) == before


def test_a_body_of_ten_megabytes_is_refused_without_being_read(at_break):
    _, mover, view = at_break
    body = b'{"shot":' + b" " * 10_000_000 + b"1}"
    problem = problem_of(send(mover, view, body), 413, "too_large")
    assert "bytes" in problem["allowed"]


def test_an_announced_ten_megabytes_are_refused_before_they_come(server, at_break):
    _, mover, view = at_break
    head = (
        f"POST /v1/games/{view['game']}/shots HTTP/1.1\r\nHost: x\r\nAuthorization: Bearer {mover.token}\r\n"
        "Content-Type: application/json\r\nContent-Length: 10000000\r\n\r\n"
    )
    assert first_line(server, head.encode()).startswith("HTTP/1.1 413 ")


def test_ten_megabytes_in_chunks_are_refused(at_break):
    _, mover, view = at_break
    problem_of(send(mover, view, iter([b" " * 100_000] * 100)), 413, "too_large")


def test_a_slow_body_is_not_waited_for(own_server):
    running = own_server(POOLIAD_BODY_SECONDS="0.3")
    head = b"POST /v1/agents HTTP/1.1\r\nHost: x\r\nContent-Length: 50\r\n\r\n{"
    assert first_line(running, head).startswith("HTTP/1.1 408 ")


def first_line(server, request):
    host, port = server.url.removeprefix("http://").split(":")
    with socket.create_connection((host, int(port)), timeout=10) as connection:
        connection.sendall(request)
        return connection.recv(4096).split(b"\r\n")[0].decode()


@pytest.mark.parametrize(
    ("headers", "code", "status"),
    [
        ({"If-Match": '"1"'}, "bad_header", 400),
        ({"Idempotency-Key": "", "If-Match": '"1"'}, "bad_header", 400),
        ({"Idempotency-Key": "k" * 201, "If-Match": '"1"'}, "bad_header", 400),
        ({"Idempotency-Key": "k", "If-Match": "one"}, "bad_header", 400),
        ({"Idempotency-Key": "k", "If-Match": "*"}, "bad_header", 400),
        ({"Idempotency-Key": "k", "If-Match": '"' + "9" * 40 + '"'}, "bad_header", 400),
        ({"Idempotency-Key": "k"}, "version_required", 428),
    ],
)
def test_headers(at_break, break_shot, headers, code, status):
    _, mover, view = at_break
    response = mover.request("POST", f"/v1/games/{view['game']}/shots", json=break_shot, headers=headers)
    problem = problem_of(response, status, code)
    assert problem["field"] in ("Idempotency-Key", "If-Match")


@pytest.mark.parametrize(
    ("method", "path", "status", "code"),
    [
        ("GET", "/v1/nothing", 404, "not_found"),
        ("GET", "/v1/games/no-such-game", 404, "not_found"),
        ("GET", "/v1/games/%00", 404, "not_found"),
        ("GET", "/v1/games/%ff/shots", 404, "not_found"),
        ("GET", "/v1/games/" + "x" * 2000, 404, "not_found"),
        ("GET", "/v1/games/%F0%9F%8E%B1/record", 404, "not_found"),
        ("GET", "/v1/matches/1", 404, "not_found"),
        ("PUT", "/v1/agents", 405, "method_not_allowed"),
        ("DELETE", "/v1/matches", 405, "method_not_allowed"),
        ("GET", "/v1/agents?cursor=x", 422, "invalid"),
        ("GET", "/v1/agents?cursor=-1", 422, "invalid"),
        ("GET", "/v1/agents?limit=0", 422, "invalid"),
        ("GET", "/v1/agents?limit=1e3", 422, "invalid"),
        ("GET", "/v1/agents?cursor=99999999999999999999", 422, "invalid"),
        ("GET", "/v1/agents?cursor=%C2%B2", 422, "invalid"),
        ("GET", "/v1/turns", 401, "unauthorized"),
    ],
)
def test_addresses(server, method, path, status, code):
    problem_of(server.request(method, path), status, code)


@pytest.mark.parametrize("wait", ["-1", "61", "NaN", "inf", "soon", "1" * 500])
def test_a_wait_that_cannot_be(new_player, wait):
    problem = problem_of(new_player().get("/v1/turns", wait=wait), 422, "invalid")
    assert problem["field"] == "wait"


@pytest.mark.parametrize("name", ["", " x", "x" * 65, "a\nb", "a\0b", "\N{BILLIARDS}", "<script>", 7, None])
def test_names_that_cannot_be(server, name):
    body = json.dumps({"name": name})
    response = server.request("POST", "/v1/agents", content=body, headers={"Content-Type": "application/json"})
    problem = problem_of(response, 422, "invalid")
    assert problem["field"] == "name"


@pytest.mark.parametrize("header", ["Bearer", "Bearer x", "Basic YTpi", "pool_agt_x", "Bearer \xe9\xff"])
def test_tokens_that_are_none(server, header):
    response = server.request("GET", "/v1/turns", headers={b"Authorization": header.encode("latin-1")})
    problem_of(response, 401, "unauthorized")
    assert response.headers["www-authenticate"].startswith("Bearer")


def test_a_faulty_value_is_not_echoed_in_full(at_break):
    _, mover, view = at_break
    response = mover.act(view, {"shot": "x" * 10_000, uuid.uuid4().hex: ["y" * 5_000] * 10})
    problem_of(response, 422, "invalid")
    assert len(response.content) < 10_000


def test_a_table_the_physics_does_not_take_is_a_problem_that_names_the_ball(new_table, server, break_shot):
    """Whatever a game's table has become, a shot at it is answered in words."""
    table = new_table()
    mover, view = table.mover()
    with closing(sqlite3.connect(server.database)) as database, database:
        (state,) = database.execute("SELECT state FROM games WHERE id = ?", (view["game"],)).fetchone()
        damaged = json.loads(state)
        damaged["state"]["3"] = [5.0, 0.5]
        changed = "UPDATE games SET state = ?, version = version + 1 WHERE id = ?"
        database.execute(changed, (json.dumps(damaged), view["game"]))
    problem = problem_of(mover.act(view | {"version": view["version"] + 1}, break_shot), 422, "invalid")
    assert (problem["field"], problem["value"]) == ("balls.3", [5.0, 0.5])
    table.organiser.post(f"/v1/matches/{table.match['id']}/abort")


@pytest.mark.parametrize(
    ("method", "path", "allowed"),
    [
        ("PUT", "/v1/agents", "GET, POST"),
        ("DELETE", "/v1/games/none/shots", "GET, POST"),
        ("GET", "/v1/simulate", "POST"),
        ("POST", "/healthz", "GET, HEAD"),
    ],
)
def test_a_method_not_allowed_comes_with_those_that_are(server, method, path, allowed):
    """RFC 9110, 15.5.6: the server must send Allow."""
    response = server.request(method, path)
    problem_of(response, 405, "method_not_allowed")
    assert response.headers["allow"] == allowed


@pytest.mark.parametrize(
    "path",
    [
        "/v1/agents",
        "/v1/matches",
        "/v1/matches/{match}",
        "/v1/games/{game}",
        "/v1/games/{game}/shots",
        "/v1/games/{game}/record",
    ],
)
def test_a_bad_token_is_refused_where_none_is_needed(new_table, server, path):
    table = new_table()
    address = path.format(match=table.match["id"], game=table.game)
    problem_of(server.request("GET", address, "pool_agt_" + "x" * 43), 401, "unauthorized")
    assert server.request("GET", address).status_code in (200, 409)
