"""The values of a game: one form, no loss in JSON, errors that name the field."""

import json
import pickle

import pytest

from physics.errors import InvalidShot, InvalidState
from physics.shot import Shot
from physics.state import TableState
from referee import InvalidAction, InvalidGame
from referee.game import (
    SAFETY,
    Action,
    Call,
    CueBallArea,
    Decision,
    EndReason,
    Evidence,
    Game,
    Group,
    Outcome,
    Phase,
    Refusal,
)

SHOT = Shot(3.0, 270.0, 5.0)
STATE = TableState.from_positions({0: (0.5, 1.7), 3: (0.4, 0.6)})
GAMES = [
    Game(STATE, Phase.BREAK, 1, 1, cue_ball_in_hand=CueBallArea.KITCHEN),
    Game(STATE, Phase.PLAY, 0, 1, (Group.STRIPES, Group.SOLIDS), CueBallArea.ANYWHERE, stroke=7, dry_visits=3),
    Game(STATE, Phase.DECISION, 0, 1, decisions=(Decision.SPOT_EIGHT,), choice="R13", visit_strokes=1),
    Game(STATE, Phase.RERACK, 0, 1, replays=1, rack=2),
    Game(STATE, Phase.OVER, 0, 1, outcome=Outcome(None, EndReason.STALEMATE, "R49")),
]


@pytest.mark.parametrize("game", GAMES, ids=lambda game: game.phase.value)
def test_game_round_trips_through_json_and_pickle(game):
    assert Game.from_dict(json.loads(json.dumps(game.to_dict()))) == game
    assert pickle.loads(pickle.dumps(game)) == game
    assert hash(game) == hash(Game.from_dict(game.to_dict()))


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("turn", 2),
        ("breaker", None),
        ("turn", True),
        ("stroke", -1),
        ("dry_visits", 0.5),
        ("rack", "0"),
        ("choice", 12),
        ("phase", "lunch"),
        ("groups", ["solids", "solids"]),
        ("groups", ["solids"]),
        ("groups", 3),
        ("cue_ball_in_hand", "floor"),
        ("decisions", ["sleep"]),
        ("decisions", 5),
        ("state", [1]),
        ("outcome", {"winner": 0, "reason": "luck", "rule": "R46"}),
        ("outcome", {"winner": 2, "reason": "eight_made", "rule": "R46"}),
        ("outcome", {"winner": 0}),
        ("outcome", 5),
    ],
)
def test_bad_game_data_names_the_field(field, value):
    with pytest.raises(InvalidGame, match=field):
        Game.from_dict(GAMES[0].to_dict() | {field: value})


def test_bad_positions_are_the_physics_to_name():
    with pytest.raises(InvalidState):
        Game.from_dict(GAMES[0].to_dict() | {"state": {"0": [0.5, 0.5], "1": [0.5, 0.51]}})


def test_missing_and_unknown_keys_are_named():
    data = GAMES[0].to_dict()
    with pytest.raises(InvalidGame, match="mood"):
        Game.from_dict(data | {"mood": "good"})
    with pytest.raises(InvalidGame, match="turn"):
        Game.from_dict({key: value for key, value in data.items() if key != "turn"})


@pytest.mark.parametrize(
    "action",
    [
        Action(shot=SHOT),
        Action(shot=SHOT, call=SAFETY, cue_ball=(0.5, 1.8)),
        Action(shot=SHOT, call=Call(3, 5)),
        Action(decision=Decision.ACCEPT_TABLE),
    ],
)
def test_action_round_trips_through_json(action):
    assert Action.from_dict(json.loads(json.dumps(action.to_dict()))) == action


def test_action_takes_plain_values():
    action = Action(shot=SHOT, call={"ball": 3, "pocket": 5}, cue_ball=[0.5, 1.8])  # type: ignore[arg-type]
    assert action == Action(shot=SHOT, call=Call(3, 5), cue_ball=(0.5, 1.8))
    assert Action(decision="concede").decision is Decision.CONCEDE  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("field", "arguments"),
    [
        ("action", {}),
        ("action", {"shot": SHOT, "decision": "concede"}),
        ("action", {"decision": "concede", "call": "safety"}),
        ("shot", {"shot": "hard"}),
        ("shot", {"shot": (3.0, 270.0)}),
        ("call", {"shot": SHOT, "call": "bank"}),
        ("call", {"shot": SHOT, "call": {"ball": 3}}),
        ("call.ball", {"shot": SHOT, "call": {"ball": 3.0, "pocket": 1}}),
        ("call.pocket", {"shot": SHOT, "call": {"ball": 3, "pocket": True}}),
        ("cue_ball", {"shot": SHOT, "cue_ball": (0.5,)}),
        ("cue_ball", {"shot": SHOT, "cue_ball": "here"}),
        ("cue_ball", {"shot": SHOT, "cue_ball": "12"}),
        ("cue_ball", {"shot": SHOT, "cue_ball": (True, 1.0)}),
        ("cue_ball", {"shot": SHOT, "cue_ball": (10**400, 1.0)}),
        ("cue_ball", {"shot": SHOT, "cue_ball": 4}),
        ("decision", {"decision": "sleep"}),
        ("decision", {"decision": 3}),
    ],
)
def test_malformed_action_is_refused_by_name(field, arguments):
    with pytest.raises(InvalidAction) as caught:
        Action(**arguments)
    assert caught.value.field == field
    assert pickle.loads(pickle.dumps(caught.value)).allowed == caught.value.allowed


def test_action_from_unknown_keys_or_bad_shot():
    with pytest.raises(InvalidAction, match="chalk"):
        Action.from_dict({"shot": SHOT.to_dict(), "chalk": True})
    with pytest.raises(InvalidAction, match="an object"):
        Action.from_dict(["shot"])  # type: ignore[arg-type]
    with pytest.raises(InvalidShot, match="v"):
        Action.from_dict({"shot": {"v": "fast", "phi": 0.0}})


def test_refusal_shows_nan_as_text():
    refusal = Refusal("R37", "cue_ball", (float("nan"), 1.0), "two finite numbers")
    assert json.loads(json.dumps(refusal.to_dict(), allow_nan=False))["value"] == ["nan", 1.0]
    assert "nan" in refusal.words


def test_evidence_says_only_what_it_has():
    assert Evidence("R34", searched=(0, 8)).to_dict() == {"rule": "R34", "searched": [0, 8]}
    assert Evidence("R32", (5,), ball=0, pocket=3).to_dict() == {
        "rule": "R32",
        "events": [5],
        "ball": 0,
        "pocket": 3,
    }


@pytest.mark.parametrize(("number", "name"), list(enumerate(("SW", "W", "NW", "NE", "E", "SE"))))
def test_a_pocket_may_be_named(number, name):
    """The names are those of CONTRACT.md, round from the origin; what is kept is the number."""
    assert Call(3, name) == Call(3, number)
    assert Call(3, name).to_dict() == {"ball": 3, "pocket": number}
    shot = Shot(1.0, 2.0)
    for call in ((3, name), [3, number], {"ball": 3, "pocket": name}):
        assert Action(shot=shot, call=call).call == Call(3, number)  # type: ignore[arg-type]


@pytest.mark.parametrize("pocket", ["sw", "", "0", "SOUTH", None, 1.0, True])
def test_a_pocket_that_is_none_is_answered_with_those_there_are(pocket):
    with pytest.raises(InvalidAction, match=r"call.pocket = .*: must be 0 to 5, or SW, W, NW, NE, E, SE"):
        Call(3, pocket)


@pytest.mark.parametrize("call", [(3,), (3, 0, 1), (), "3 SW"])
def test_a_call_of_another_form_is_explained(call):
    with pytest.raises(InvalidAction, match=r"call = .*: must be a Call, \(ball, pocket\)"):
        Action(shot=Shot(1.0, 2.0), call=call)
