"""What a player may ask of another without an organiser (issue 13, items 4 and 5)."""

import pytest

from physics import Table
from server.services.matches.challenges import MOST_WAITING


def terms(*players, **more):
    return {"agents": [player.id for player in players]} | more


@pytest.mark.parametrize(
    ("name", "value", "is_usual"),
    [
        *[("mu_slide", 0.1, True), ("mu_slide", 0.3, True), ("mu_slide", 0.0999, False), ("mu_slide", 0.31, False)],
        *[("mu_roll", 0.001, False), ("cushion_perpendicular", 0.9, True), ("cushion_perpendicular", 0.91, False)],
        *[("e_ball", 0.8, True), ("mu_ball", 0.0, False), ("collisions", "fastfiz", True), ("cue_test", False, True)],
    ],
)
def test_a_table_far_from_every_named_one_needs_an_organiser(server, new_player, organiser, name, value, is_usual):
    """Seen: a challenge on a slow, lively table had strokes of 46,908 events, 10 s and 35 MB each."""
    one, two = new_player(), new_player()
    table = {"name": "olympiad", name: value}
    response = one.post("/v1/matches", terms(one, two, table=table))
    if is_usual:
        assert response.status_code == 201, response.text
    else:
        problem = response.json()
        assert (response.status_code, problem["code"], problem["field"]) == (422, "invalid", f"table.{name}")
        assert "an organiser" in problem["allowed"]
        usual = Table.olympiad().to_dict()[name]
        assert f"from {0.5 * usual:g} to {1.5 * usual:g}" in problem["allowed"]
    assert organiser.post("/v1/matches", terms(one, two, table=table)).status_code == 201


def test_challenges_that_wait_are_bounded_by_pair_and_direction(server, new_player):
    one, two, three = new_player(), new_player(), new_player()
    made = [one.post("/v1/matches", terms(one, two)) for _ in range(MOST_WAITING)]
    assert {response.status_code for response in made} == {201}
    refused = one.post("/v1/matches", terms(two, one))
    assert (refused.status_code, refused.json()["code"]) == (409, "wrong_status")
    assert f"must be at most {MOST_WAITING}" in refused.json()["detail"]
    assert one.post("/v1/matches", terms(one, three)).status_code == 201, "another pair"
    assert two.post("/v1/matches", terms(one, two)).status_code == 201, "the other direction"
    assert two.post(f"/v1/matches/{made[0].json()['id']}/accept").status_code == 200
    assert one.post("/v1/matches", terms(one, two)).status_code == 201, "one of them waits no more"
    assert one.post("/v1/matches", terms(one, two)).status_code == 409
    assert one.post(f"/v1/matches/{made[1].json()['id']}/abort").status_code == 200
    assert one.post("/v1/matches", terms(one, two)).status_code == 201
