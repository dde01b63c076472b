"""Shaping by a potential: Ng, Harada & Russell, "Policy invariance under reward transformations" (1999)."""

import math

import numpy as np
import pytest
from support.situations import situation

from client.learn import EightBallEnv, EightBallVectorEnv
from client.learn.games import Games, referee_of
from client.learn.rows import row_of
from referee import Group, NoiseModel

ROW = np.zeros(1, np.int64)


def lead(balls, groups, seat):
    games = Games(referee_of(None), NoiseModel(0.0), 1)
    game = situation({ball: (0.1 + 0.06 * ball, 1.0) for ball in balls}, groups=groups)
    games.places[0], games.state[0] = game.state.positions, row_of(game)
    return games.leads(np.array([seat]))[0]


@pytest.mark.parametrize(
    ("balls", "groups", "of_seat_0"),
    [
        ((0, 1, 2, 8, 9, 10, 11), None, 0.0),
        ((0, 1, 2, 8, 9, 10, 11), (Group.SOLIDS, Group.STRIPES), 1 / 7),
        ((0, 1, 2, 8, 9, 10, 11), (Group.STRIPES, Group.SOLIDS), -1 / 7),
        ((0, 8, 9, 10, 11, 12, 13, 14, 15), (Group.SOLIDS, Group.STRIPES), 1.0),
    ],
)
def test_the_lead_counts_balls(balls, groups, of_seat_0):
    assert lead(balls, groups, 0) == pytest.approx(of_seat_0)
    assert lead(balls, groups, 1) == pytest.approx(-of_seat_0)


def test_an_episode_pays_the_same_with_shaping():
    """The gains of a game add up to nothing: it begins on an open table and its end has no lead."""
    shaped, plain = EightBallEnv(noise=0.0, shaping=0.5), EightBallEnv(noise=0.0)
    chance, differs = np.random.default_rng(5), 0
    for seed in range(6):
        (seen, _), (same, _) = shaped.reset(seed=seed), plain.reset(seed=seed)
        assert (seen == same).all()
        begins, total, over = shaped._lead, 0.0, False
        while not over:
            action = chance.uniform(-1.0, 1.0, 8).astype(np.float32)
            (_, reward, over, _, _), (_, won, _, _, _) = shaped.step(action), plain.step(action)
            total += reward
            differs += reward != won
        assert total + 0.5 * begins == pytest.approx(won, abs=1e-12)
    assert differs > 6


def test_many_games_are_shaped_as_one_is():
    """The same games by the same draws; a game begun anew is paid nothing for having begun."""
    shaped, plain = EightBallVectorEnv(16, shaping=0.5), EightBallVectorEnv(16)
    shaped.reset(seed=1)
    plain.reset(seed=1)
    chance, leads = np.random.default_rng(2), shaped._leads
    begun = np.zeros(16, np.bool_)
    for _ in range(60):
        actions = chance.uniform(-1.0, 1.0, (16, 8)).astype(np.float32)
        (_, rewards, over, _, _), (_, won, _, _, _) = shaped.step(actions), plain.step(actions)
        gains = np.where(begun, 0.0, 0.5 * (shaped._leads - leads))
        assert rewards == pytest.approx(won + gains)
        assert (shaped._leads[over] == 0.0).all()
        begun, leads = over, shaped._leads


@pytest.mark.parametrize("shaping", [-0.1, math.nan, math.inf, "1", None, True])
def test_a_weight_is_a_number_from_0_on(shaping):
    for make in (EightBallEnv, EightBallVectorEnv):
        with pytest.raises(ValueError, match=r"shaping = .*: must be a number from 0 on"):
            make(shaping=shaping)
