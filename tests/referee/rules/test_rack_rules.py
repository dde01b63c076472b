"""R1 to R5 over racks as games get them, R7 and R50."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from physics.state import TableState
from physics.table import Table
from referee.game import CueBallArea, Phase
from referee.rules import EightBall, breaker
from referee.rules import rack as rack_rules
from referee.rules.placement import behind_head_string

TABLE = Table.olympiad()
RULES = EightBall(TABLE)
seeds = st.integers(min_value=0, max_value=2**64)


def placed(seed: int) -> list[list[int | None]]:
    state = rack_rules.new_rack(TABLE, seed)
    return [[rack_rules.ball_at(state, place) for place in row] for row in rack_rules.places(TABLE)]


def swapped(state: TableState, one: int, other: int) -> TableState:
    positions = {ball: state.positions[ball] for ball in state.balls}
    positions[one], positions[other] = positions[other], positions[one]
    return TableState.from_positions(positions)


@given(seeds)
def test_every_rack_keeps_the_rules(seed):
    """R1, R2, R3, R5."""
    state = RULES.new_game(seed).state
    assert rack_rules.apex_on_foot_spot(TABLE, state)
    assert rack_rules.eight_in_third_row(TABLE, state)
    assert rack_rules.back_corners_differ(TABLE, state)
    assert rack_rules.balls_separated(TABLE, state)


def test_historical_rack_would_be_noticed():
    """Known errors: the 8 in the wrong place, both back corners stripes (R2, R3)."""
    state = rack_rules.new_rack(TABLE, 7)
    order = placed(7)
    apex, corners = order[0][0], (order[4][0], order[4][4])
    assert apex is not None

    solid = next(ball for ball in corners if ball is not None and ball < 8)
    stripe = next(ball for row in order[:4] for ball in row if ball is not None and ball > 8)
    assert not rack_rules.eight_in_third_row(TABLE, swapped(state, 8, apex))
    assert not rack_rules.back_corners_differ(TABLE, swapped(state, solid, stripe))


def test_loose_rack_is_noticed():
    """R1, R5: a ball two hundredths of a millimetre out of its place."""
    state = rack_rules.new_rack(TABLE, 7)
    ball = placed(7)[4][2]
    assert ball is not None
    x, y = state.positions[ball].tolist()
    moved = state.moved(ball, (x, y - 2e-5))
    assert not rack_rules.apex_on_foot_spot(TABLE, moved)
    assert not rack_rules.balls_separated(TABLE, moved)


def test_rack_comes_from_the_seed_alone():
    """R4: the same for equal seeds; among 40 seeds every ball is seen at the apex but the 8."""
    assert RULES.new_game(7).state == RULES.new_game(7).state
    assert {placed(seed)[0][0] for seed in range(200)} == set(range(1, 16)) - {8}


def test_break_is_played_from_the_kitchen():
    """R7, R6: ball in hand behind the head string, the cue ball racked there already."""
    game = RULES.new_game(7, breaker=1)
    assert (game.phase, game.turn, game.breaker) == (Phase.BREAK, 1, 1)
    assert game.cue_ball_in_hand is CueBallArea.KITCHEN
    assert behind_head_string(TABLE, game.state.positions[0][1])


@pytest.mark.parametrize("first", [0, 1])
def test_break_alternates(first):
    """R50."""
    assert [breaker(first, game) for game in range(4)] == [first, 1 - first, first, 1 - first]
