"""R18 to R29 and R51: calls, groups and who shoots next, each through a simulated stroke."""

import pytest
from support.situations import RULES, SOLIDS, STRIPES, TABLE, play, pot, situation, stroke

from physics.events import EventKind
from referee.game import Action, Call, Group, Phase, callable_balls

E, W = 4, 1
STRAIGHT = {0: (0.6, 1.118), 3: (0.9, 1.118), 5: (0.8, 0.4), 8: (0.3, 0.5), 11: (0.5, 0.4), 12: (0.3, 1.9)}
"""The 3 is straight into E."""
STRAIGHT_STRIPE = {0: (0.6, 1.118), 11: (0.9, 1.118), 5: (0.8, 0.4), 8: (0.3, 0.5), 3: (0.5, 0.4)}
IN_LINE = {0: (0.45, 1.118), 3: (0.7, 1.118), 11: (1.0, 1.118), 8: (0.3, 0.5), 5: (0.8, 0.4)}
"""The 3 drives the 11 into E and rolls in after it."""


def test_called_ball_on_an_open_table_fixes_the_groups():
    """R19, R28."""
    played = play(situation(STRAIGHT), pot(STRAIGHT, 3, E, v=1.5), (3, E))
    assert played.ruling.made
    assert played.ruling.rules == ("R28", "R19")
    assert played.game.groups == SOLIDS
    assert (played.game.turn, played.game.phase, played.game.cue_ball_in_hand) == (0, Phase.PLAY, None)
    event = played.proof("R19")[0]
    assert (event.kind, event.ball, event.other) == (EventKind.POCKET_COLLISION, 3, E)


def test_called_stripe_gives_the_second_player_stripes():
    """R19 from seat 1."""
    played = play(situation(STRAIGHT_STRIPE, turn=1), pot(STRAIGHT_STRIPE, 11, E, v=1.5), (11, E))
    assert played.game.groups == (Group.SOLIDS, Group.STRIPES)


def test_any_ball_but_the_eight_may_be_struck_first_on_an_open_table():
    """R20: a stripe first while a solid is called is no foul."""
    played = play(situation(IN_LINE), pot(IN_LINE, 3, E, v=1.4, b=-8.0), (11, E))
    assert played.facts.struck_first == (3,)
    assert played.ruling.fouls == ()
    assert played.game.groups == STRIPES


def test_other_balls_do_not_decide_groups():
    """R21: the 3 fell as well, but the 11 was called."""
    played = play(situation(IN_LINE), pot(IN_LINE, 3, E, v=1.4, b=-8.0), (11, E))
    assert [ball for ball, _, _ in played.facts.pocketed_in_order] == [11, 3]
    assert played.game.groups == STRIPES
    assert [one.ball for one in played.proof("R21")] == [3]


def test_uncalled_balls_leave_the_table_open():
    """R19, R21: both balls fell, neither as called."""
    played = play(situation(IN_LINE), pot(IN_LINE, 3, E, v=1.4, b=-8.0), (5, E))
    assert len(played.facts.pocketed_in_order) == 2
    assert played.game.groups is None
    assert played.game.turn == 1


def test_foul_leaves_the_table_open():
    """R22: made as called, with a scratch."""
    played = play(situation(STRAIGHT), pot(STRAIGHT, 3, E, v=2.0, b=15.0), (3, E))
    assert played.ruling.fouls == ("R32",)
    assert not played.ruling.made
    assert "R22" in played.ruling.rules
    assert played.game.groups is None


@pytest.mark.parametrize(
    ("groups", "gone", "expected"),
    [
        (None, (), (3, 5, 11, 12)),
        (SOLIDS, (), (3, 5)),
        (STRIPES, (), (11, 12)),
        (SOLIDS, (3, 5), (8,)),
        (STRIPES, (3, 5), (11, 12)),
        (None, (3, 5, 11, 12), ()),
    ],
)
def test_callable_balls(groups, gone, expected):
    """R23, R27: exactly these are accepted, and a safety always is."""
    balls = {ball: place for ball, place in STRAIGHT.items() if ball not in gone}
    game = situation(balls, groups=groups)
    shot = stroke(balls, 90.0, 1.0)
    assert callable_balls(game) == RULES.legal(game).callable == expected
    for ball in range(-1, 17):
        refusals = RULES.check(game, Action(shot=shot, call=Call(ball, E)))
        wanted = [] if ball in expected else [("R27" if ball == 8 else "R23", "call.ball", ball)]
        assert [(one.rule, one.field, one.value) for one in refusals] == wanted
    assert RULES.check(game, Action(shot=shot, call="safety")) == ()


def test_call_is_required_and_names_a_pocket():
    """R23."""
    shot = stroke(STRAIGHT, 90.0, 1.0)
    game = situation(STRAIGHT)
    assert [one.field for one in RULES.check(game, Action(shot=shot))] == ["call"]
    for pocket in (-1, 6):
        refusals = RULES.check(game, Action(shot=shot, call=Call(3, pocket)))
        assert [(one.rule, one.field) for one in refusals] == [("R23", "call.pocket")]
    both = RULES.check(game, Action(shot=shot, call=Call(8, 9)))
    assert [one.field for one in both] == ["call.ball", "call.pocket"]


def test_combination_counts():
    """R24: the 11 by way of the 3."""
    played = play(situation(IN_LINE, groups=STRIPES), pot(IN_LINE, 11, E, v=1.4, b=-8.0), "safety")
    assert played.facts.struck_first == (3,)
    open_table = play(situation(IN_LINE), pot(IN_LINE, 3, E, v=1.4, b=-8.0), (11, E))
    assert open_table.ruling.made


def test_bank_counts():
    """R24: off the foot cushion first and then in, as called."""
    balls = {0: (0.30, 0.95), 3: (0.40, 0.55), 8: (0.2, 2.0), 5: (0.15, 1.7)}
    for target in range(200):
        shot = stroke(balls, 280.0 + target * 0.1, 2.6, b=-4.0)
        probe = play(situation(balls), shot, "safety")
        banked = probe.facts.cushion[3] >= 0 and 0 <= probe.facts.cushion[3] < probe.facts.pocketed[3]
        if banked and not probe.ruling.fouls:
            played = play(situation(balls), shot, (3, probe.facts.pocket[3]))
            assert played.ruling.made
            return
    pytest.fail("no bank was found to test with")


def test_called_ball_in_another_pocket():
    """R25: not made, stays down, the turn passes, no foul."""
    played = play(situation(STRAIGHT, groups=SOLIDS), pot(STRAIGHT, 3, E, v=1.5), (3, W))
    assert played.ruling.fouls == ()
    assert not played.ruling.made
    assert played.ruling.rules == ("R25",)
    assert (played.game.turn, played.game.cue_ball_in_hand) == (1, None)
    assert 3 not in played.game.state.balls
    assert played.ruling.evidence[0].pocket == E


def test_safety_passes_the_turn_whatever_falls():
    """R26."""
    played = play(situation(STRAIGHT, groups=SOLIDS), pot(STRAIGHT, 3, E, v=1.5), "safety")
    assert played.facts.pocketed[3] >= 0
    assert played.ruling.fouls == ()
    assert "R26" in played.ruling.rules
    assert played.game.turn == 1
    assert 3 not in played.game.state.balls


def test_foul_on_a_safety_counts():
    """R26, R32."""
    played = play(situation(STRAIGHT, groups=SOLIDS), pot(STRAIGHT, 3, E, v=2.0, b=15.0), "safety")
    assert played.ruling.fouls == ("R32",)
    assert played.game.cue_ball_in_hand == "anywhere"


def test_safety_on_an_open_table_leaves_it_open():
    """R19, R26."""
    played = play(situation(STRAIGHT), pot(STRAIGHT, 3, E, v=1.5), "safety")
    assert played.game.groups is None


def test_missed_ball_passes_the_turn():
    """R28, with the range of events searched for the ball's fall."""
    shot = stroke(STRAIGHT, 6.0, 1.5)
    played = play(situation(STRAIGHT, groups=SOLIDS), shot, (3, E))
    assert played.facts.struck_first == (3,)
    assert played.game.turn == 1
    (evidence,) = (one for one in played.ruling.evidence if one.rule == "R28")
    assert evidence.searched == (0, len(played.result.events) - 1)


def test_opponents_ball_stays_down():
    """R29: called ball made, the opponent's falls too; the shooter goes on."""
    balls = {0: (0.45, 1.118), 3: (0.7, 1.118), 5: (0.8, 0.4), 11: (1.0, 1.118), 8: (0.3, 0.5)}
    played = play(situation(balls, groups=SOLIDS), pot(balls, 3, E, v=1.4, b=-8.0), (3, E))
    assert played.ruling.made
    assert [one.ball for one in played.proof("R29")] == [11]
    assert played.game.turn == 0
    assert played.game.state == played.result.final


def test_hanging_ball_belongs_to_the_stroke_that_dropped_it():
    """R51: pocketed long after the cue ball came to rest, it is still made."""
    played = play(situation(STRAIGHT, groups=SOLIDS), pot(STRAIGHT, 3, E, v=0.7, b=-10.0), (3, E))
    rest = [one for one in played.result.events if one.ball == 0][-1]
    assert played.proof("R28")[0].time > rest.time
    assert played.ruling.made
    assert played.game.turn == 0


def test_legal_says_so():
    """The description of what is allowed agrees with the rulings."""
    game = situation(STRAIGHT, groups=SOLIDS)
    allowed = RULES.legal(game)
    assert allowed.actions == ("shot", "concede")
    assert allowed.pockets == tuple(range(len(TABLE.mouths)))
    assert allowed.safety
    assert allowed.cue_ball is None
