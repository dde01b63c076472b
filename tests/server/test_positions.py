"""Matches that begin from a given position: who may make them, what is refused, their records."""

from typing import Any

import pytest

from physics import Table, rack
from referee.play import GameSeeds, seed_from_hex
from referee.record import MatchTerms, read_record, verify_record

START: dict[str, Any] = {"balls": {"0": [0.5, 1.7], "3": [0.4, 0.6], "8": [0.9, 0.4]}, "groups": ["solids", "stripes"]}


def test_every_game_begins_there_and_the_match_is_unrated(new_table):
    table = new_table(games=2, start=START)
    assert (table.match["rated"], table.match["first_breaker"]) == (False, 0)
    assert table.match["start"]["balls"] == START["balls"]
    for seat, groups in ((0, ["solids", "stripes"]), (1, ["stripes", "solids"])):
        mover, view = table.mover()
        assert (view["seat"], view["phase"], view["callable_balls"]) == (seat, "play", [3])
        assert (view["groups"], view["balls"]) == (groups, START["balls"])
        assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
        record = mover.get(f"/v1/games/{view['game']}/record").text
        assert verify_record(record.splitlines()).ok


def test_a_match_with_a_break_is_rated(new_table):
    assert new_table(seed=None).match["rated"] is True


def test_a_choice_after_a_break_can_be_the_beginning(new_table):
    start = {"balls": START["balls"], "phase": "decision", "choice": "R12", "turn": 1}
    _mover, view = new_table(start=start).mover()
    assert (view["seat"], view["phase"], view["choice"]) == (1, "decision", "R12")
    assert view["allowed"]["decisions"] == ["accept_table", "rerack_and_break", "opponent_reracks"]


def test_the_racks_after_it_follow_from_the_seed(new_table):
    """A new rack asked for in the first turn is the game's rack 1, as verification finds."""
    start = {"balls": START["balls"], "phase": "decision", "choice": "R12"}
    table = new_table(start=start)
    mover, view = table.mover()
    assert mover.act(view, {"decision": "rerack_and_break"}).status_code == 200
    mover, view = table.mover()
    assert (view["phase"], view["rack"], len(view["balls"])) == ("break", 1, 16)
    mover.post(f"/v1/games/{view['game']}/concede", version=view["version"])
    assert verify_record(mover.get(f"/v1/games/{view['game']}/record").text.splitlines()).ok


def test_an_agent_may_challenge_from_a_position(server, new_player):
    ann, bob = new_player(), new_player()
    made = ann.post("/v1/matches", {"agents": [ann.id, bob.id], "start": START})
    assert (made.status_code, made.json()["status"]) == (201, "challenged")
    accepted = bob.post(f"/v1/matches/{made.json()['id']}/accept")
    assert accepted.json()["played"][0]["breaker"] == 0


STARTS = {
    "play": START,
    "break": {
        "balls": rack(Table.olympiad(), "eight_ball", seed=7).to_dict(),
        "phase": "break",
        "cue_ball_in_hand": "kitchen",
    },
    "decision": {"balls": START["balls"], "phase": "decision", "choice": "R12", "turn": 1},
}


@pytest.mark.parametrize("phase", STARTS)
def test_the_match_shows_the_commitment_that_its_record_leads_to(new_table, phase):
    """A match that began with a decision had committed to the decision before the referee had listed its choices."""
    table = new_table(start=STARTS[phase])
    mover, view = table.mover()
    assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
    record = read_record(mover.get(f"/v1/games/{view['game']}/record").text.splitlines())
    seeds = GameSeeds(seed_from_hex(record.end["noise_secret"]), seed_from_hex(record.end["rack_secret"]))
    assert record.header["commitment"] == MatchTerms.from_dict(record.header).commitment(seeds, 0)
    assert table.match["commitment"] == record.header["commitment"]


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"balls": {"0": [0.5, 1.7], "3": [0.4, 0.6]}}, "start.balls"),
        ({"balls": START["balls"] | {"3": [9.0, 0.6]}}, "start.balls.3"),
        ({"balls": START["balls"] | {"4": [0.4, 0.61]}}, "start.balls.4"),
        ({"balls": {"0": [0.5, 1.7], "16": [0.4, 0.6]}}, "start.balls.16"),
        ({"phase": "over"}, "start.phase"),
        ({"phase": "decision"}, "start.choice"),
        ({"choice": "R13"}, "start.choice"),
        ({"choice": 13}, "start.choice"),
        ({"phase": "decision", "choice": "R12"}, "start.groups"),
        ({"groups": ["solids", "solids"]}, "start.groups"),
        ({"turn": 2}, "start.turn"),
        ({"cue_ball_in_hand": "behind the bar"}, "start.cue_ball_in_hand"),
        ({"stroke": 399}, "start.stroke"),
    ],
)
def test_what_cannot_be_played_on_from_is_named(organiser, new_player, change, field):
    request = {"agents": [new_player().id, new_player().id], "start": START | change}
    response = organiser.post("/v1/matches", request)
    assert (response.status_code, response.json()["code"]) == (422, "invalid")
    assert response.json()["field"] == field
