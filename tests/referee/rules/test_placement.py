"""R6, R7, R37, R40 and the refusals of R39: what is said before a stroke, with nothing changed by it."""

from math import cos, inf, nan, nextafter, radians, sin
from typing import Any

import pytest
from support.situations import RULES, SOLIDS, TABLE, R, situation, stroke

from physics.shot import Shot
from referee.errors import InvalidAction
from referee.game import Action, CueBallArea, Decision, Game, Phase

BALLS = {0: (0.6, 1.118), 3: (0.9, 1.0), 8: (0.3, 0.5), 11: (0.5, 0.4), 12: (0.3, 1.9)}
HEAD = TABLE.head_string
STEEP = Shot(2.0, 0.0, 60.0)


def in_hand(area: CueBallArea, **fields: Any) -> Game:
    return situation(BALLS, cue_ball_in_hand=area, groups=SOLIDS, **fields)


def refused(game: Game, place: tuple[float, float] | None, shot: Shot = STEEP) -> list[tuple[str, str]]:
    refusals = RULES.check(game, Action(shot=shot, call="safety", cue_ball=place))
    assert all(one.allowed and one.field in one.words for one in refusals)
    return [(one.rule, one.field) for one in refusals]


def test_anywhere_means_anywhere_clear():
    """R40."""
    game = in_hand(CueBallArea.ANYWHERE)
    for place in ((0.3, 0.9), (0.3, 2.0), (R, 0.9)):  # the last frozen to a cushion
        assert refused(game, place, Shot(2.0, 180.0, 60.0)) == []


@pytest.mark.parametrize(
    "place",
    [
        (R - 1e-6, 0.9),
        (0.5, TABLE.length - R + 1e-6),
        (-0.5, 0.9),
        (0.5, 1e200),
        (TABLE.width - R, 1.118),
        (R, 1.06),
        tuple(TABLE.mouths[0].tolist()),
        (0.04, 0.04),
    ],
)
def test_outside_or_on_a_mouth_line(place):
    """R40."""
    assert refused(in_hand(CueBallArea.ANYWHERE), place) == [("R40", "cue_ball")]


@pytest.mark.parametrize("place", [(nan, 0.9), (0.5, inf), (-inf, nan)])
def test_not_finite(place):
    """R37, known error: the historical referee played from NaN."""
    assert refused(in_hand(CueBallArea.ANYWHERE), place) == [("R37", "cue_ball")]


@pytest.mark.parametrize("degrees", [0, 30, 45, 90, 137, 250])
@pytest.mark.parametrize(("gap", "expected"), [(-1e-3, True), (-1e-12, True), (0.0, True), (1e-7, False)])
def test_touching_counts_as_overlap(degrees, gap, expected):
    """R40, in every direction round the 11."""
    reach = 2 * R + gap
    place = (0.5 + reach * cos(radians(degrees)), 0.4 + reach * sin(radians(degrees)))
    found = refused(in_hand(CueBallArea.ANYWHERE), place)
    assert (("R40", "cue_ball") in found) is expected


def test_kitchen_is_strict():
    """R6, R37: on the string is not behind it."""
    game = in_hand(CueBallArea.KITCHEN)
    assert refused(game, (0.5, HEAD)) == [("R37", "cue_ball")]
    assert refused(game, (0.5, HEAD - 0.1)) == [("R37", "cue_ball")]
    assert refused(game, (0.5, nextafter(HEAD, inf))) == []
    assert refused(in_hand(CueBallArea.ANYWHERE), (0.5, HEAD)) == []


def test_break_from_the_kitchen():
    """R7."""
    game = RULES.new_game(3)
    for place, expected in (((0.4, 1.8), []), ((0.4, HEAD), [("R37", "cue_ball")])):
        refusals = RULES.check(game, Action(shot=Shot(9.0, 270.0, 60.0), cue_ball=place))
        assert [(one.rule, one.field) for one in refusals] == expected


def test_every_fault_is_named():
    """R37: outside the kitchen and on two balls at once."""
    game = situation({3: (0.5, 0.5), 8: (0.5 + 2.2 * R, 0.5)}, cue_ball_in_hand=CueBallArea.KITCHEN)
    assert refused(game, (0.5 + 1.1 * R, 0.5)) == [
        ("R37", "cue_ball"),
        ("R40", "cue_ball"),
        ("R40", "cue_ball"),
    ]
    bad = Action(shot=STEEP, call={"ball": 8, "pocket": 7}, cue_ball=(nan, 0.5))  # type: ignore[arg-type]
    assert [one.field for one in RULES.check(game, bad)] == ["call.ball", "call.pocket", "cue_ball"]


def test_cue_ball_that_is_not_in_hand_stays():
    """R37."""
    assert refused(situation(BALLS, groups=SOLIDS), (0.3, 0.9)) == [("R37", "cue_ball")]


def test_cue_ball_off_the_table_has_to_be_placed():
    """R37."""
    balls = {ball: place for ball, place in BALLS.items() if ball != 0}
    game = situation(balls, cue_ball_in_hand=CueBallArea.ANYWHERE)
    assert RULES.legal(game).must_place
    assert refused(game, None) == [("R37", "cue_ball")]
    assert refused(game, (0.6, 1.118)) == []


def test_cue_ball_in_hand_may_stay_where_it_lies():
    """R37: where it may be, that is; in front of the string it may not when bound to the kitchen."""
    assert refused(in_hand(CueBallArea.ANYWHERE), None) == []
    assert refused(in_hand(CueBallArea.KITCHEN), None) == [("R37", "cue_ball")]


@pytest.mark.parametrize("shot", [Shot(2.0, 0.0, 0.0), Shot(2.0, 0.0, 10.0, a=28.0, b=28.0)])
def test_intended_stroke_that_cannot_be_played_is_refused(shot):
    """R39: cue through the cushion, tip off the ball; no stroke, so no noise."""
    game = situation(BALLS, groups=SOLIDS)
    assert refused(game, None, shot) == [("R39", "shot")]
    assert refused(in_hand(CueBallArea.ANYWHERE), (0.3, 0.9), shot) == [("R39", "shot")]


def test_lowest_elevation_is_accepted():
    """R39, the other side."""
    assert refused(situation(BALLS, groups=SOLIDS), None, stroke(BALLS, 0.0, 2.0)) == []


def test_not_an_action():
    with pytest.raises(InvalidAction, match="action = None"):
        RULES.check(situation(BALLS), None)


def test_wrong_kind_of_action():
    """A decision where a stroke is due, a stroke where a decision is, anything before a re-rack."""
    game = situation(BALLS, groups=SOLIDS)
    decision = Action(decision=Decision.ACCEPT_TABLE)
    assert [one.field for one in RULES.check(game, decision)] == ["decision"]
    choices = (Decision.ACCEPT_TABLE, Decision.BALL_IN_HAND)
    asked = situation(BALLS, Phase.DECISION, decisions=choices, choice="R17")
    shot = Action(shot=STEEP, call="safety")
    assert [(one.rule, one.field) for one in RULES.check(asked, shot)] == [("R17", "action")]
    rerack = Action(decision=Decision.RERACK_AND_BREAK)
    assert [(one.rule, one.field) for one in RULES.check(asked, rerack)] == [("R17", "decision")]
    waiting = situation(BALLS, Phase.RERACK)
    assert [one.field for one in RULES.check(waiting, shot)] == ["action"]
