"""CONTRACT: `Idempotency-Key`. A request is carried out once, however often it comes."""

from concurrent.futures import ThreadPoolExecutor

import pytest


def version_of(table):
    return table.organiser.get(f"/v1/games/{table.game}").json()["view"]["version"]


def test_a_shot_sent_again_gets_the_stored_answer_byte_for_byte(new_table, break_shot):
    table = new_table()
    mover, view = table.mover()
    first = mover.act(view, break_shot, key="break")
    table.play(2)
    version = version_of(table)
    again = mover.act(view, break_shot, key="break")
    assert again.status_code == first.status_code == 200
    assert again.content == first.content
    assert again.headers["etag"] == first.headers["etag"]
    assert version_of(table) == version


def test_the_answer_is_kept_after_the_end_and_whatever_the_version_says(new_table, break_shot):
    table = new_table()
    mover, view = table.mover()
    first = mover.act(view, break_shot, key="break")
    table.organiser.post(f"/v1/matches/{table.match['id']}/abort")
    assert mover.act(view | {"version": 55}, break_shot, key="break").content == first.content


def test_the_same_key_with_another_body_is_refused(new_table, break_shot):
    table = new_table()
    mover, view = table.mover()
    mover.act(view, break_shot, key="k")
    response = mover.act(view, break_shot | {"cue_ball": [0.5, 1.8]}, key="k")
    assert (response.status_code, response.json()["code"]) == (422, "key_reused")
    assert response.json()["value"] == "k"


def test_a_refused_request_leaves_its_key_free(new_table, break_shot):
    table = new_table()
    mover, view = table.mover()
    assert mover.act(view, break_shot | {"call": "safety"}, key="k").status_code == 422
    assert mover.act(view | {"version": 9}, break_shot, key="k").status_code == 412
    assert mover.act(view, break_shot, key="k").status_code == 200


def test_a_key_is_the_callers_and_the_routes_own(new_table, break_shot):
    table = new_table()
    for path in (f"/v1/matches/{table.match['id']}/abort", f"/v1/agents/{table.players[0].id}/token"):
        assert table.organiser.post(path, key="same").status_code == 200
    other = new_table()
    mover, view = other.mover()
    assert mover.act(view, break_shot, key="same").status_code == 200


def test_duplicates_at_the_same_time_are_one_shot(new_table, break_shot):
    table = new_table()
    mover, view = table.mover()
    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(lambda _: mover.act(view, break_shot, key="k"), range(8)))
    assert {answer.status_code for answer in answers} == {200}
    assert len({answer.content for answer in answers}) == 1
    assert version_of(table) == view["version"] + 1


def test_of_two_shots_at_the_same_time_one_is_played(new_table, break_shot):
    """Two workers of one agent, each with a shot of its own: the version decides."""
    table = new_table()
    mover, view = table.mover()
    shots = [break_shot | {"cue_ball": [0.5 + 0.01 * i, 1.8]} for i in range(8)]
    with ThreadPoolExecutor(8) as pool:
        answers = list(pool.map(lambda shot: mover.act(view, shot), shots))
    codes = sorted(answer.status_code for answer in answers)
    assert codes == [200] + [412] * 7
    assert version_of(table) == view["version"] + 1
    played = table.organiser.get(f"/v1/games/{view['game']}/shots").json()["shots"]
    assert len(played) == 1


def test_a_match_sent_again_is_one_match(organiser, new_player):
    request = {"agents": [new_player().id, new_player().id]}
    first, again = (organiser.post("/v1/matches", request, key=f"match {request}") for _ in range(2))
    assert first.status_code == again.status_code == 201
    assert first.content == again.content
    assert first.headers["location"] == again.headers["location"]
    assert len(organiser.get("/v1/matches", agent=request["agents"][0]).json()["matches"]) == 1


def test_acceptance_and_abortion_sent_again(new_player):
    ann, bob = new_player(), new_player()
    match = ann.post("/v1/matches", {"agents": [ann.id, bob.id]}).json()
    path = f"/v1/matches/{match['id']}/accept"
    first, again = (bob.post(path, key="yes") for _ in range(2))
    assert first.status_code == again.status_code == 200
    assert first.content == again.content


@pytest.mark.parametrize("path", ["/v1/matches", "/v1/matches/{match}/abort", "/v1/agents/{agent}/token"])
def test_every_other_command_needs_a_key_too(new_table, path):
    table = new_table()
    path = path.format(match=table.match["id"], agent=table.players[0].id)
    response = table.organiser.request("POST", path, json={})
    assert (response.status_code, response.json()["field"]) == (400, "Idempotency-Key")
