"""`client.learn` on every table: observations as shares of its size, actions as shares of its greatest values."""

import hashlib
from importlib.util import find_spec

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.require import require

import physics
from client.learn import ACTION_SIZE, OBSERVATION_SIZE, act, observe
from physics.table import NAMED
from referee import EightBall, Game, Group, MatchSeed, Phase, start_game

for name in ("gymnasium", "pettingzoo"):
    require(find_spec(name) is not None, f"{name}, of the learn extra")

from client.learn import EightBallAEC, EightBallEnv, EightBallVectorEnv  # noqa: E402

NINE = physics.Table.nine_foot()
OPENING = start_game(EightBall(NINE), MatchSeed.of(3).game(0))
BALLS = {0: (0.5, 1.7), 3: (0.4, 0.6), 8: (0.9, 0.4), 12: (0.3, 1.2)}

vectors = st.lists(st.floats(-1.0, 1.0, width=32), min_size=ACTION_SIZE, max_size=ACTION_SIZE).map(np.array)


def playing(table, balls):
    """Seat 0 has the solids."""
    state = physics.TableState.from_positions(balls)
    assert all(table.contains(*place) for place in balls.values())
    return Game(state, Phase.PLAY, 0, 0, groups=(Group.SOLIDS, Group.STRIPES))


SCENES = [OPENING, playing(NINE, BALLS), playing(NINE, BALLS | {3: (0.05, 0.05), 12: (0.02, 1.27)})]


@given(st.sampled_from(SCENES), vectors)
def test_every_vector_is_a_legal_action_between_jaws_too(game, vector):
    assert EightBall(NINE).check(game, act(NINE, game, vector)) == ()


@pytest.mark.parametrize("name", sorted(NAMED))
def test_places_are_shares_of_the_tables_size(name):
    table = physics.Table.named(name)
    game = playing(table, {0: (0.5 * table.width, 0.5 * table.length), 8: (0.25 * table.width, 0.75 * table.length)})
    balls = observe(table, game, 0)[:48].reshape(16, 3)
    assert balls[0].tolist() == [0.5, 0.5, 1.0]
    assert balls[8].tolist() == [0.25, 0.75, 1.0]


@pytest.mark.parametrize("name", sorted(NAMED))
def test_the_greatest_action_is_the_tables_greatest(name):
    table = physics.Table.named(name)
    game = playing(table, {0: (0.5 * table.width, 0.5 * table.length), 8: (0.3, 0.4)})
    hardest = act(table, game, np.array([1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0])).shot
    assert (hardest.v, hardest.theta) == (table.v_max, table.theta_max)
    slow = table.replace(v_max=3.0, theta_max=20.0) if table.has_jaws else table
    softer = act(slow, game, np.array([1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0])).shot
    assert (softer.v, softer.theta) == (slow.v_max, slow.theta_max)


def test_a_ball_in_the_jaws_is_seen_at_the_edge():
    game = playing(NINE, {0: (0.5, 1.7), 3: (0.05, 0.05), 12: (-0.002, 1.27), 8: (0.9, 0.4)})
    seen = observe(NINE, game, 0)
    assert ((seen >= 0.0) & (seen <= 1.0)).all()


@pytest.mark.parametrize("make", [EightBallEnv, lambda **options: EightBallVectorEnv(2, **options)])
def test_games_on_a_table_with_jaws_go_on(make):
    env = make(table=NINE)
    seen, _ = env.reset(seed=4)
    env.action_space.seed(4)
    over = np.zeros(1)
    for _ in range(25):
        if not isinstance(env, EightBallVectorEnv) and over.all():
            break
        seen, _, over, _, info = env.step(env.action_space.sample())
        over = np.asarray(over)
        assert env.observation_space.contains(seen)
    assert np.max(info["strokes"]) > 1


def test_both_players_meet_on_a_table_with_jaws():
    env = EightBallAEC(table=NINE)
    env.reset(seed=4)
    chance = np.random.default_rng(1)
    for _ in range(20):
        seen, _, over, _, _ = env.last()
        env.step(None if over else chance.uniform(-1, 1, ACTION_SIZE).astype(np.float32))
    assert seen.shape == (OBSERVATION_SIZE,)


def old_table(learn):
    """What `learn.observe` and `learn.act` make of games on the Olympiad's table, to the bit."""
    table = physics.Table.olympiad()
    chance = np.random.default_rng(7)
    told = hashlib.sha256()
    for seed in range(4):
        opening = start_game(EightBall(table), MatchSeed.of(seed).game(0))
        for game in (opening, playing(table, BALLS)):
            told.update(learn.observe(table, game, seed % 2).tobytes())
            for _ in range(10):
                action = learn.act(table, game, chance.uniform(-1, 1, ACTION_SIZE))
                told.update(repr(sorted(action.to_dict().items())).encode())
    return told.hexdigest()


def test_observations_and_actions_of_the_old_table_keep_their_bits():
    """The hash is that of 8336b41."""
    import client.learn

    assert old_table(client.learn) == "45069f3162d666e879912900d8b834d2499534ca2aabdbad2af1ef7a3c9e885f"
