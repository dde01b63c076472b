"""Pots as discrete actions, and actions written as vectors."""

from itertools import pairwise

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from support.situations import situation

import client
import client.learn
import physics
from client import geometry
from client.learn import ACTION_NAMES, ACTION_SIZE, EightBallEnv, PotActions, act, encode
from client.learn.pots import SAFETY, SPEEDS
from physics import Table
from referee import Action, CueBallArea, Group

STRAIGHT = {0: (0.558, 1.4), 1: (0.558, 1.8), 3: (0.9, 0.3), 8: (0.2, 0.3), 12: (0.2, 2.0)}


def begun(env):
    """Reset to where the learner plays the first stroke: then nothing has happened."""
    return next(found for seed in range(20) if (found := env.reset(seed=seed))[1]["strokes"] == 0)


def test_an_action_has_a_name_for_each_of_its_numbers():
    assert len(ACTION_NAMES) == ACTION_SIZE == 8
    for name in ACTION_NAMES:
        assert f"\n{name} " in client.learn.__doc__


@pytest.mark.parametrize("table", [Table.olympiad(), Table.nine_foot()])
def test_what_greedy_plays_is_written_as_a_vector(table):
    """To the precision of float32; the call and the decision exactly."""
    strokes = client.play("greedy", "random", games=1, seed=3, table=table).games[0].strokes
    seen = 0
    for before, stroke in pairwise(strokes):
        game, action = before.game, stroke.action
        again = act(table, game, encode(table, game, action))
        assert again.decision == action.decision
        if action.shot is None:
            continue
        seen += 1
        assert again.call == action.call
        for field, width in (("v", 1e-6), ("phi", 1e-4), ("theta", 1e-3), ("a", 1e-5), ("b", 1e-5)):
            assert getattr(again.shot, field) == pytest.approx(getattr(action.shot, field), abs=width)
        if action.cue_ball is not None:
            assert again.cue_ball == pytest.approx(action.cue_ball, abs=1e-6)
    assert seen > 3


def test_no_vector_stands_for_a_tip_far_out():
    game = situation(STRAIGHT)
    with pytest.raises(ValueError, match=r"a = 20.0: must be from -14 to 14 mm"):
        encode(Table.olympiad(), game, Action(physics.Shot(1.0, 90.0, 5.0, a=20.0), "safety"))


@pytest.mark.filterwarnings("ignore:.*different from the unwrapped version")
def test_gymnasium_finds_no_fault():
    check_env(PotActions(EightBallEnv()), skip_render_check=True)


def test_the_mask_has_the_open_pots():
    table, start = Table.olympiad(), situation(STRAIGHT, groups=(Group.SOLIDS, Group.STRIPES))
    game = EightBallEnv(noise=0.0, start=start)
    env = PotActions(game)
    _, info = begun(env)
    state = start.state
    expected = {(pot.ball, pot.pocket) for pot in geometry.pots(table, state, (1, 3))}
    playable = np.flatnonzero(info["action_mask"][:SAFETY]).tolist()
    assert {(number // 18 + 1, number // 3 % 6) for number in playable} == expected != set()
    assert len(playable) == len(SPEEDS) * len(expected)
    assert info["action_mask"][SAFETY] == 1
    easiest = geometry.pots(table, state, (1, 3))[0]
    env.step(((easiest.ball - 1) * 6 + easiest.pocket) * 3 + 1)
    assert game.game.state.position(easiest.ball) is None, "the ball that was called is in the pocket"


@pytest.mark.parametrize("table", [None, Table.seven_foot()])
def test_masked_choices_win_against_chance(table):
    """The first open pot, as gently as can be, against strokes at random, from a break to an end."""
    env = PotActions(gymnasium.make("pooliad/EightBall-v0", table=table))
    won = 0
    for seed in range(4):
        _, info = env.reset(seed=seed)
        over = False
        while not over:
            _, reward, over, _, info = env.step(int(np.flatnonzero(info["action_mask"])[0]))
        won += reward > 0
    assert won >= 3


def test_a_cue_ball_in_hand_goes_where_a_pot_is():
    balls = {ball: place for ball, place in STRAIGHT.items() if ball}
    start = situation(balls, groups=(Group.SOLIDS, Group.STRIPES), cue_ball_in_hand=CueBallArea.ANYWHERE)
    _, info = begun(PotActions(EightBallEnv(noise=0.0, start=start)))
    assert info["action_mask"][:SAFETY].any()


@pytest.mark.parametrize("action", [-1, SAFETY + 1, 0.5, "pot"])
def test_what_is_no_action_is_refused(action):
    env = PotActions(EightBallEnv())
    env.reset(seed=1)
    with pytest.raises(ValueError, match=f"action = .*: must be an integer from 0 to {SAFETY}"):
        env.step(action)


def test_it_wraps_an_environment_of_eight_ball():
    with pytest.raises(TypeError, match="must be an EightBallEnv"):
        PotActions(gymnasium.make("CartPole-v1"))
