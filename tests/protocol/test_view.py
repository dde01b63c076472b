"""The view: everything the contract lists, nothing that yields noise, back to the referee's own values."""

import copy
import json
import pickle
from dataclasses import replace
from typing import Any

import pytest
from pydantic import TypeAdapter

from physics.table import Table
from protocol import ClockView, GameTerms, NoiseView, View
from referee.game import CueBallArea, Decision, EndReason, Group, Outcome, Phase
from referee.play import MatchSeed, NoiseModel, start_game
from referee.rules import EightBall

TABLE = Table.olympiad()
RULES = EightBall(TABLE)
SEEDS = MatchSeed.of(1).game(0)
COMMITMENT = "c0" * 32
CLOCKS = (ClockView(seconds_left=300.0, running=True), ClockView(seconds_left=12.5, running=False))


def terms(told=True):
    return GameTerms(
        game="g1",
        match="m1",
        number=0,
        games=3,
        players=("ann", "bob"),
        rules="eight_ball",
        table={"name": "olympiad"},
        noise=NoiseView.of(NoiseModel(1.5, told), told),
        dry_visits_limit=24,
        replays_limit=2,
        strokes_limit=400,
        commitment=COMMITMENT,
    )


def view_of(game, **changes):
    arguments: dict[str, Any] = {"seat": 0, "version": 4, "clocks": CLOCKS, "score": (1.0, 0.5)} | changes
    return View.of(terms(), game, **arguments)


BREAK = start_game(RULES, SEEDS)
GAMES = [
    BREAK,
    replace(BREAK, phase=Phase.PLAY, cue_ball_in_hand=None, groups=(Group.STRIPES, Group.SOLIDS), turn=1),
    replace(
        BREAK,
        phase=Phase.PLAY,
        state=BREAK.state.removed(0),
        cue_ball_in_hand=CueBallArea.ANYWHERE,
        stroke=7,
        dry_visits=3,
        replays=1,
        rack=2,
        visit_strokes=2,
    ),
    replace(
        BREAK,
        phase=Phase.DECISION,
        cue_ball_in_hand=None,
        decisions=(Decision.ACCEPT_TABLE, Decision.RERACK_AND_BREAK),
        choice="R12",
    ),
    replace(BREAK, phase=Phase.OVER, cue_ball_in_hand=None, outcome=Outcome(1, EndReason.EIGHT_MADE, "R46")),
]


@pytest.mark.parametrize("game", GAMES, ids=lambda game: game.phase)
def test_a_view_survives_json_and_gives_the_referees_state_back(game):
    view = view_of(game)
    read = View.model_validate_json(view.model_dump_json())
    assert read == view
    assert read.to_game() == game
    assert read.state == game.state
    assert read.table_model() == TABLE


def test_a_view_names_everything_the_contract_lists():
    view = json.loads(view_of(GAMES[2]).model_dump_json())
    assert (view["game"], view["version"], view["turn"]) == ("g1", 4, 0)
    assert view["why"] == "ann is to act"
    assert view["allowed"]["actions"] == ["shot", "concede"]
    assert view["callable_balls"] == [1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 15]
    assert view["cue_ball_area"]["name"] == "anywhere"
    assert set(view["balls"]) == {str(ball) for ball in range(1, 16)}
    assert view["groups"] is None
    assert view["noise"] == {"told": True, "level": 1.5}
    assert [clock["seconds_left"] for clock in view["clocks"]] == [300.0, 12.5]
    assert (view["dry_visits"], view["dry_visits_limit"]) == (3, 24)
    assert view["score"] == [1.0, 0.5]
    assert view["strokes_since"] == []


def test_noise_that_is_not_told_is_not_in_the_view():
    view = View.of(terms(told=False), BREAK, seat=0, version=0, clocks=CLOCKS, score=(0.0, 0.0))
    assert json.loads(view.model_dump_json())["noise"] == {"told": False, "level": None}


def test_no_seed_is_in_the_view():
    text = view_of(BREAK).model_dump_json()
    for secret in (MatchSeed.of(1).secret, SEEDS.noise, SEEDS.noise_seed, SEEDS.racks, SEEDS.rack(0)):
        assert secret.hex() not in text
    assert COMMITMENT in text


def test_the_kitchen_is_behind_the_head_string():
    """R6, R7: strictly, so the string itself is the border that is not allowed."""
    area = view_of(BREAK).cue_ball_area
    assert area.y[0] == TABLE.head_string
    assert area.y[1] == TABLE.length - TABLE.ball_radius
    assert area.x == (TABLE.ball_radius, TABLE.width - TABLE.ball_radius)


def test_whose_turn_it_is():
    assert view_of(BREAK).my_turn
    assert view_of(BREAK).why == "ann breaks"
    assert not view_of(BREAK, seat=1).my_turn
    assert not view_of(BREAK, seat=None).my_turn
    over = view_of(GAMES[4])
    assert over.turn is None
    assert not over.my_turn
    assert over.outcome.winner == 1


@pytest.mark.parametrize("game", GAMES, ids=lambda game: game.phase.value)
def test_a_view_nobody_has_read_is_the_one_that_everybody_reads(game):
    """Fields are made when read: whatever copies, compares, pickles or serialises a view finds all of them."""
    whole = View.model_validate_json(view_of(game).model_dump_json())
    assert view_of(game) == whole
    assert whole == view_of(game)
    assert repr(view_of(game)) == repr(whole)
    assert list(dict(view_of(game))) == list(View.model_fields)
    assert pickle.loads(pickle.dumps(view_of(game))) == whole
    assert copy.deepcopy(view_of(game)) == whole
    assert TypeAdapter(list[View]).dump_python([view_of(game)]) == [whole.model_dump()]
    assert view_of(game).model_copy(update={"why": "Because."}) == whole.model_copy(update={"why": "Because."})


def test_a_copy_with_other_balls_has_another_state():
    view = view_of(GAMES[1])
    assert view.state is view.state
    moved = view.model_copy(update={"balls": {0: (0.5, 0.5)}})
    assert moved.state.balls == (0,)
    assert len(view.state.balls) == 16


def test_what_nobody_reads_is_not_made():
    """A driver may give what makes the strokes; asking for the balls does not ask for them."""
    asked: list[int] = []
    view = view_of(BREAK, strokes_since=lambda: [*map(asked.append, (1,))] and ())
    assert view.balls
    assert view.allowed.actions
    assert view.state == BREAK.state
    assert not asked
    assert view.strokes_since == view.strokes_since == ()
    assert asked == [1]


def test_a_field_that_is_none_is_missing():
    with pytest.raises(AttributeError, match="no_such_field"):
        _ = view_of(BREAK).no_such_field
