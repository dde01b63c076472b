"""R32 to R41: fouls, each through a simulated stroke."""

from dataclasses import replace
from math import cos, radians, sin
from typing import Literal

import pytest
from support.situations import (
    RULES,
    SOLIDS,
    STRIPES,
    TABLE,
    Balls,
    Played,
    R,
    play,
    pot,
    situation,
    stroke,
    towards,
)

import physics
from physics.shot import Shot
from referee.errors import InvalidAction
from referee.game import Action, Call, CueBallArea, Decision, Game, Phase

E = 4
STRAIGHT = {0: (0.6, 1.118), 3: (0.9, 1.118), 5: (0.8, 0.4), 8: (0.3, 0.5), 11: (0.5, 0.4), 12: (0.3, 1.9)}
STRAIGHT_STRIPE = {0: (0.6, 1.118), 11: (0.9, 1.118), 3: (0.8, 0.4), 8: (0.3, 0.5)}
STRAIGHT_EIGHT = {0: (0.6, 1.118), 8: (0.8, 1.0), 3: (0.8, 0.4), 11: (0.3, 0.5)}


def from_kitchen(balls: Balls, phi: float, v: float, place: tuple[float, float], b: float = 0.0) -> Played:
    """An open table, the cue ball in hand behind the head string and put at ``place``."""
    game = situation(balls, cue_ball_in_hand=CueBallArea.KITCHEN)
    return play(game, stroke({**balls, 0: place}, phi, v, b=b), "safety", cue_ball=place)


def miscue(game: Game, played_as: Shot, intended: Shot, call: Call | Literal["safety"] | None = "safety") -> Played:
    """``intended`` may be played; noise made it ``played_as``."""
    action = Action(shot=intended, call=call)
    assert RULES.check(game, action) == ()
    result = physics.simulate(TABLE, game.state, played_as)
    return Played(game, action, result, RULES.apply(game, action, result.facts, result.final))


def assert_ball_in_hand(played: Played) -> None:
    assert (played.game.turn, played.game.phase) == (1, Phase.PLAY)
    assert played.game.cue_ball_in_hand is CueBallArea.ANYWHERE


def test_scratch():
    """R32."""
    played = play(situation(STRAIGHT, groups=SOLIDS), pot(STRAIGHT, 3, E, v=2.0, b=15.0), (3, E))
    assert played.ruling.fouls == ("R32",)
    assert played.proof("R32")[0].ball == 0
    assert_ball_in_hand(played)
    assert RULES.legal(played.game).must_place
    assert 3 not in played.game.state.balls


def test_opponents_ball_first():
    """R33."""
    played = play(situation(STRAIGHT_STRIPE, groups=SOLIDS), stroke(STRAIGHT_STRIPE, 0.0, 1.5), (3, E))
    assert played.ruling.fouls == ("R33",)
    assert played.proof("R33")[0].ball == 0
    assert played.proof("R33")[0].other == 11
    assert_ball_in_hand(played)


def test_own_ball_first_with_the_group_cleared():
    """R33: on the 8, the 8 has to be struck first."""
    balls = {ball: place for ball, place in STRAIGHT_STRIPE.items() if ball != 3}
    played = play(situation(balls, groups=SOLIDS), stroke(balls, 0.0, 1.5), (8, E))
    assert played.ruling.fouls == ("R33",)


def test_eight_first_before_the_group_is_cleared():
    """R33."""
    shot = stroke(STRAIGHT_EIGHT, towards((0.6, 1.118), (0.8, 1.0)), 2.0)
    played = play(situation(STRAIGHT_EIGHT, groups=SOLIDS), shot, (3, E))
    assert played.ruling.fouls == ("R33",)


def test_eight_first_on_an_open_table():
    """R20, known error: the historical referee let it pass."""
    shot = stroke(STRAIGHT_EIGHT, towards((0.6, 1.118), (0.8, 1.0)), 2.0)
    played = play(situation(STRAIGHT_EIGHT), shot, (3, E))
    assert played.ruling.fouls == ("R33",)
    assert played.proof("R20")[0].other == 8
    assert "R22" in played.ruling.rules


@pytest.mark.parametrize("groups", [SOLIDS, STRIPES])
def test_simultaneous_first_contacts_go_to_the_shooter(groups):
    """R33: the 3 and the 11 struck at the same instant suit whoever shoots."""
    x = 0.5 * TABLE.width
    balls = {
        0: (x, 1.5),
        3: (x - 0.04, 1.0),
        11: (x + 0.04, 1.0),
        8: (0.2, 0.3),
        5: (0.9, 0.3),
        12: (0.2, 1.9),
    }
    played = play(situation(balls, groups=groups), stroke(balls, 270.0, 3.0), "safety")
    assert played.facts.struck_first == (3, 11)
    assert "R33" not in played.ruling.fouls


def test_touching_ball_counts_only_if_driven_into():
    """R33: away from a frozen opponent's ball is no contact with it, into it is."""
    balls = {0: (0.5, 1.0), 11: (0.5 + 2 * R, 1.0), 8: (0.2, 0.3), 12: (0.2, 0.5)}
    at = (0.5 + 0.5 * cos(radians(120)), 1.0 + 0.5 * sin(radians(120)))
    balls[3] = at
    away = play(situation(balls, groups=SOLIDS), stroke(balls, 120.0, 2.0), "safety")
    assert away.facts.frozen_to_cue_ball[11]
    assert away.facts.struck_first == (3,)
    assert "R33" not in away.ruling.fouls
    into = play(situation(balls, groups=SOLIDS), stroke(balls, 30.0, 2.0), "safety")
    assert into.facts.struck_first == (11,)
    assert "R33" in into.ruling.fouls


def test_no_ball_struck():
    """R34, with the whole stroke searched."""
    played = play(situation(STRAIGHT, groups=SOLIDS), stroke(STRAIGHT, 90.0, 0.4), (3, E))
    assert played.ruling.fouls == ("R34",)
    assert played.ruling.evidence[0].searched == (0, len(played.result.events) - 1)
    assert_ball_in_hand(played)


def test_no_cushion_after_contact():
    """R35, searched from the contact on."""
    played = play(situation(STRAIGHT, groups=SOLIDS), stroke(STRAIGHT, 8.0, 0.4, b=-5.0), (3, E))
    assert played.ruling.fouls == ("R35",)
    contact = played.facts.first_contact[3]
    assert played.ruling.evidence[0].searched == (contact, len(played.result.events) - 1)
    assert_ball_in_hand(played)


def test_cushion_before_contact_does_not_help():
    """R35: the cue ball came off a cushion, then nothing reached one."""
    balls = {0: (0.45, 0.3), 3: (0.6, 0.22), 8: (0.2, 1.9), 11: (0.9, 1.9)}
    for step in range(60):
        played = play(situation(balls, groups=SOLIDS), stroke(balls, 285.0, 0.55 + 0.01 * step), "safety")
        facts = played.facts
        if facts.struck_first and 0 <= facts.cushion[0] < facts.first_contact[3]:
            break
    else:
        pytest.fail("the kick never arrived")
    assert not any(event >= 0 for event in facts.cushion_after_contact)
    assert played.ruling.fouls == ("R35",)


def test_uncalled_pocketed_ball_satisfies_the_cushion_rule():
    """R35, known error: a ball pocketed, called or not, is enough; no cushion was touched."""
    played = play(situation(STRAIGHT, groups=SOLIDS), pot(STRAIGHT, 3, E, v=0.9, b=-6.0), (5, E))
    assert not any(event >= 0 for event in played.facts.cushion_after_contact)
    assert played.facts.pocketed[3] >= 0
    assert played.ruling.fouls == ()


def test_ball_frozen_to_a_cushion_has_to_leave_and_come_back():
    """R35 with R9's meaning of driven: pressing a frozen ball into its cushion is not enough."""
    balls = {0: (0.35, R + 0.2), 3: (0.35, R), 8: (0.2, 1.9), 11: (0.9, 1.9)}
    played = play(situation(balls, groups=SOLIDS), stroke(balls, 270.0, 0.25), "safety")
    assert played.facts.frozen_to_cushion[3]
    assert played.facts.struck_first == (3,)
    assert played.facts.cushion_after_contact[3] < 0
    assert played.ruling.fouls == ("R35",)


def test_from_the_kitchen_first_ball_behind_the_string():
    """R38: struck before the cue ball crossed. Known error: the historical test was inverted."""
    balls = {3: (0.558, 2.0), 11: (0.3, 0.5), 8: (0.8, 0.5)}
    played = from_kitchen(balls, 90.0, 2.0, (0.558, 1.75))
    assert played.facts.struck_first == (3,)
    assert played.ruling.fouls == ("R38",)
    assert_ball_in_hand(played)


def test_from_the_kitchen_across_the_string_is_fair():
    """R38, the other side of the inverted test: an ordinary stroke out of the kitchen."""
    balls = {3: (0.558, 0.9), 11: (0.3, 0.5), 8: (0.8, 0.5)}
    played = from_kitchen(balls, 270.0, 3.0, (0.558, 1.75))
    assert played.facts.crossed_before_contact >= 0
    assert played.ruling.fouls == ()
    assert played.game.cue_ball_in_hand is None


def test_from_the_kitchen_a_ball_on_the_string_may_be_struck():
    """R38, R6: on the string is not behind it, and the cue ball need not cross."""
    on_string = {3: (0.558, TABLE.head_string), 11: (0.3, 0.5), 8: (0.8, 0.5)}
    played = from_kitchen(on_string, 270.0, 3.0, (0.558, 1.9))
    assert played.facts.struck_first == (3,)
    assert played.facts.crossed_before_contact < 0
    assert played.ruling.fouls == ()
    behind = on_string | {3: (0.558, TABLE.head_string + 1e-6)}
    assert from_kitchen(behind, 270.0, 3.0, (0.558, 1.9)).ruling.fouls == ("R38",)


def test_from_the_kitchen_back_into_it_is_fair():
    """R38: a ball behind the string may be struck after the cue ball crossed."""
    balls = {3: (0.33, 2.1), 11: (0.8, 0.5), 8: (0.9, 0.5)}
    played = from_kitchen(balls, 270.0, 4.5, (0.3, 1.8), b=0.0)
    assert played.facts.struck_first == (3,)
    assert played.facts.crossed_before_contact >= 0
    assert played.ruling.fouls == ()


def test_from_the_kitchen_neither_crossing_nor_reaching():
    """R38 with R34, all reported (R41)."""
    balls = {3: (0.558, 0.9), 11: (0.3, 0.5), 8: (0.8, 0.5)}
    played = from_kitchen(balls, 270.0, 0.1, (0.558, 1.9))
    assert played.ruling.fouls == ("R38", "R34")


def test_kitchen_restriction_ends_with_the_stroke():
    """R38: the next player plays as usual."""
    balls = {3: (0.558, 0.9), 11: (0.3, 0.5), 8: (0.8, 0.5)}
    played = from_kitchen(balls, 270.0, 3.0, (0.558, 1.75))
    assert played.game.cue_ball_in_hand is None
    assert RULES.legal(played.game).cue_ball is None


@pytest.mark.parametrize(
    ("played_as", "status"),
    [
        (Shot(2.0, 0.0, 10.0, a=30.0), "TIP_OFF_BALL"),
        (Shot(2.0, 0.0, 0.0), "CUE_OBSTRUCTED"),
    ],
)
def test_miscue(played_as, status):
    """R39: what noise makes impossible is a foul, the balls stay; there is no second draw."""
    game = situation(STRAIGHT, groups=SOLIDS)
    played = miscue(game, played_as, stroke(STRAIGHT, 0.0, 2.0))
    assert played.ruling.fouls == ("R39",)
    assert played.ruling.evidence[0].status == status
    assert_ball_in_hand(played)
    assert played.game.state == game.state
    assert played.game.stroke == game.stroke + 1


def test_miscue_on_the_break():
    """R39, R12a, R17: an illegal break with a foul."""
    game = RULES.new_game(5)
    balls = {ball: tuple(game.state.positions[ball].tolist()) for ball in game.state.balls}
    played = miscue(game, Shot(2.0, 270.0, 10.0, b=40.0), stroke(balls, 270.0, 9.0), None)
    assert played.ruling.fouls == ("R39",)
    assert Decision.ACCEPT_TABLE in played.game.decisions
    assert Decision.BALL_IN_HAND in played.game.decisions
    assert played.game.turn == 1


def test_only_strokes_that_were_played_are_ruled():
    """R39: out of range or no cue ball cannot come from noise; the driver has to refuse."""
    game = situation(STRAIGHT, groups=SOLIDS)
    action = Action(shot=stroke(STRAIGHT, 0.0, 2.0), call="safety")
    result = physics.simulate(TABLE, game.state, action.shot)
    facts = replace(result.facts, status=int(physics.Status.NO_CUE_BALL))
    with pytest.raises(InvalidAction, match="NO_CUE_BALL"):
        RULES.apply(game, action, facts, result.final)


def test_all_fouls_are_reported_and_one_penalised():
    """R41: the wrong ball first and a scratch; the worst leads."""
    shot = stroke(STRAIGHT_STRIPE, 0.0, 2.0, b=15.0)
    played = play(situation(STRAIGHT_STRIPE, groups=SOLIDS), shot, (3, E))
    assert played.ruling.fouls == ("R32", "R33")
    assert played.ruling.rules[0] == "R32"
    assert "R41" in played.ruling.rules
    assert_ball_in_hand(played)


def test_fouls_do_not_move_the_other_balls():
    """R29, R41: object balls lie where the stroke left them."""
    played = play(situation(STRAIGHT, groups=SOLIDS), stroke(STRAIGHT, 90.0, 0.4), (3, E))
    assert played.game.state == played.result.final
