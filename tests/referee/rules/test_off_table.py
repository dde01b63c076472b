"""R16, R36, R45 and a cue ball off the table, on facts made by hand.

On this table no ball leaves the cloth, so no simulated stroke can show them; the rules hold all the same.
"""

from dataclasses import replace
from typing import Any

from support.situations import RULES, SOLIDS, TABLE, situation

from physics.facts import Facts
from physics.shot import Shot
from referee.game import Action, Call, CueBallArea, Decision, EndReason, Game, Phase, Ruling

BALLS = {0: (0.6, 1.118), 3: (0.9, 1.118), 5: (0.8, 0.4), 8: (0.3, 0.5), 11: (0.5, 0.4)}


def at(*balls: int, event: int = 5) -> tuple[int, ...]:
    """A per-ball fact that happened to these balls at this event."""
    return tuple(event if ball in balls else -1 for ball in range(16))


def ruling(game: Game, gone: tuple[int, ...], **facts: Any) -> Ruling:
    action = Action(shot=Shot(2.0, 0.0, 10.0), call=None if game.phase is Phase.BREAK else Call(3, 4))
    happened = replace(Facts.none(), n_events=20, crossed_before_contact=1, crossed_head_string=1, **facts)
    return RULES.apply(game, action, happened, game.state.removed(*gone))


def to_break() -> Game:
    return situation(BALLS, Phase.BREAK, cue_ball_in_hand=CueBallArea.KITCHEN)


def test_object_ball_off_the_table_on_a_legal_break():
    """R16: a foul; the ball stays out; accept or ball in hand."""
    given = ruling(to_break(), (5, 3), first_contact=at(5, event=2), off_table=at(5), pocketed=at(3, event=7))
    assert given.rules[0] == "R16"
    assert given.fouls == ("R36",)
    assert given.game.decisions == (Decision.ACCEPT_TABLE, Decision.BALL_IN_HAND)
    assert 5 not in given.game.state.balls


def test_eight_off_the_table_on_the_break_is_spotted():
    """R16, R30, R31."""
    given = ruling(to_break(), (8, 3), first_contact=at(5, event=2), off_table=at(8), pocketed=at(3, event=7))
    assert {"R16", "R30", "R31"} <= set(given.rules)
    assert given.game.state.position(8) == TABLE.foot_spot
    assert given.game.phase is Phase.DECISION


def test_object_ball_off_the_table():
    """R36: a foul, the ball stays out, ball in hand anywhere."""
    given = ruling(
        situation(BALLS, groups=SOLIDS),
        (11,),
        first_contact=at(3, event=2),
        off_table=at(11),
        cushion_after_contact=at(3, event=3),
    )
    assert given.fouls == ("R36",)
    assert given.evidence[0].ball == 11
    assert given.game.cue_ball_in_hand is CueBallArea.ANYWHERE
    assert 11 not in given.game.state.balls


def test_eight_off_the_table_loses():
    """R45."""
    given = ruling(
        situation(BALLS, groups=SOLIDS),
        (8,),
        first_contact=at(3, event=2),
        off_table=at(8),
        cushion_after_contact=at(3, event=3),
    )
    outcome = given.game.outcome
    assert outcome is not None
    assert (outcome.winner, outcome.reason, outcome.rule) == (1, EndReason.EIGHT_OFF_TABLE, "R45")


def test_cue_ball_off_the_table():
    """R32: as good as pocketed."""
    given = ruling(
        situation(BALLS, groups=SOLIDS),
        (0,),
        first_contact=at(3, event=2),
        off_table=at(0),
        cushion_after_contact=at(3, event=3),
    )
    assert given.fouls == ("R32",)
    assert "left the table" in given.words
    assert given.allowed.must_place
