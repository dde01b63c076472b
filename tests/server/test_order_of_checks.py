"""CONTRACT, "Order of checks": of several things wrong with a request the first in the order is answered."""

import itertools

import pytest

ORDER = ("token", "ownership", "repetition", "version missing", "finished", "stale", "turn", "content")
STATUS = {
    "token": 401,
    "ownership": 403,
    "repetition": 422,
    "version missing": 428,
    "finished": 409,
    "stale": 412,
    "turn": 409,
    "content": 422,
}
CODE = {
    "token": "unauthorized",
    "ownership": "forbidden",
    "repetition": "key_reused",
    "version missing": "version_required",
    "finished": "game_finished",
    "stale": "stale_version",
    "turn": "not_your_turn",
    "content": "invalid",
}


def games_of(new_table, break_shot):
    """Two games, one running, one finished, in each of which both players have shot with the key "used"."""
    tables = new_table(noise={"level": 0.0}), new_table(noise={"level": 0.0})
    for table in tables:
        shooters: set[str] = set()
        while len(shooters) < 2:
            mover, view = table.mover()
            action = soft(view, break_shot)
            fresh = "shot" in action and mover.id not in shooters
            response = mover.act(view, action, key="used" if fresh else None)
            assert response.status_code == 200, response.text
            shooters |= {mover.id} if fresh else set()
    mover, view = tables[1].mover()
    assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
    return tables


def soft(view, break_shot):
    """A stroke that moves little and pockets nothing, or the first decision."""
    if view["phase"] == "decision":
        return {"decision": "accept_table"}
    called = {"call": "safety"} if view["allowed"]["call_required"] else {}
    placed = {"cue_ball": [0.3, 1.9] if view["cue_ball_area"] else None}
    return break_shot | {"shot": break_shot["shot"] | {"v": 0.2}} | called | placed


@pytest.fixture
def prepared(new_table, break_shot, new_player):
    running, finished = games_of(new_table, break_shot)
    return running, finished, new_player()


def send(prepared, wrong):
    """A shot with exactly these things wrong."""
    running, finished, stranger = prepared
    table = finished if "finished" in wrong else running
    game = table.organiser.get(f"/v1/games/{table.game}").json()
    view = game["view"]
    seat = view["turn"] if view["turn"] is not None else 0
    caller = table.players[1 - seat if "turn" in wrong else seat]
    if "ownership" in wrong:
        caller = stranger
    token = "pool_agt_none" if "token" in wrong else caller.token
    headers = {
        "Content-Type": "application/json",
        "Idempotency-Key": "used" if "repetition" in wrong else "new",
    }
    if "version missing" not in wrong:
        headers["If-Match"] = '"99"' if "stale" in wrong else f'"{view["version"]}"'
    return table.players[0].server.request(
        "POST", f"/v1/games/{view['game']}/shots", token, content=b"{}", headers=headers
    )


def test_the_order(prepared):
    """Every pair of faults that can meet; a body without a shot is always the last of them."""
    for first, second in itertools.combinations(ORDER, 2):
        if {first, second} == {"ownership", "repetition"}:
            continue  # a stranger has no key of this game to repeat
        response = send(prepared, {first, second, "content"})
        problem = response.json()
        assert (response.status_code, problem["code"]) == (STATUS[first], CODE[first]), (first, second)


def test_each_alone(prepared):
    for wrong in ORDER:
        response = send(prepared, {wrong})
        assert (response.status_code, response.json()["code"]) == (STATUS[wrong], CODE[wrong]), wrong


def test_a_missing_key_comes_where_the_repetition_is_looked_up(new_table, break_shot, new_player):
    table = new_table()
    mover, view = table.mover()
    path = f"/v1/games/{view['game']}/shots"
    stranger = new_player().request("POST", path, json=break_shot)
    assert stranger.status_code == 403
    own = mover.request("POST", path, json=break_shot)
    assert (own.status_code, own.json()["field"]) == (400, "Idempotency-Key")


def test_a_game_that_does_not_exist_comes_after_the_token(server, new_player, break_shot):
    path = "/v1/games/none/shots"
    assert server.request("POST", path, json=break_shot).status_code == 401
    assert new_player().request("POST", path, json=break_shot).status_code == 404
