"""`client.learn`: the libraries' own API tests, and that every environment plays the referee's game."""

import subprocess
import sys
import warnings
from collections import Counter
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.require import require
from support.situations import situation

import physics
from client.learn import ACTION_SIZE, OBSERVATION_SIZE, act, observe
from client.learn.codec import strokes
from physics.generator import SeededStream
from referee import CueBallArea, EightBall, Group, Limits, MatchSeed, NoiseModel, Phase, play_stroke, start_game
from referee.play.batch import play_strokes
from referee.rules.breaks import OFFERED

for name in ("gymnasium", "pettingzoo"):
    require(find_spec(name) is not None, f"{name}, of the learn extra")

import gymnasium  # noqa: E402
from gymnasium.utils.env_checker import check_env  # noqa: E402

with warnings.catch_warnings():  # where pygame is, it tries one of its own games, made in a way it deprecates
    warnings.simplefilter("ignore", DeprecationWarning)
    from pettingzoo.test import api_test, seed_test

from client.learn import EightBallAEC, EightBallEnv, EightBallVectorEnv  # noqa: E402

RULES = EightBall(physics.Table.olympiad())
BALLS = {0: (0.5, 1.7), 3: (0.4, 0.6), 8: (0.9, 0.4), 12: (0.3, 1.2)}
NO_CUE_BALL = {ball: place for ball, place in BALLS.items() if ball}
SCENES = [
    start_game(RULES, MatchSeed.of(3).game(0)),
    situation(BALLS),
    situation(BALLS, groups=(Group.STRIPES, Group.SOLIDS)),
    situation({0: (0.5, 1.7), 8: (0.9, 0.4)}, groups=(Group.SOLIDS, Group.STRIPES)),
    situation({0: (0.5, 1.7), 8: (0.9, 0.4)}),
    situation(NO_CUE_BALL, cue_ball_in_hand=CueBallArea.ANYWHERE),
    situation(NO_CUE_BALL, cue_ball_in_hand=CueBallArea.KITCHEN),
    RULES.begin_from(situation(BALLS, Phase.DECISION, choice="R12")),
]

vectors = st.lists(st.floats(-1.0, 1.0, width=32), min_size=ACTION_SIZE, max_size=ACTION_SIZE).map(np.array)


def test_pettingzoo_finds_no_fault():
    api_test(EightBallAEC(render_mode="ansi"), num_cycles=120)


def test_pettingzoo_finds_the_seed_obeyed():
    seed_test(EightBallAEC, num_cycles=60)


def test_gymnasium_finds_no_fault():
    spec = gymnasium.envs.registration.EnvSpec("EightBall-v0", entry_point="client.learn:EightBallEnv")
    check_env(gymnasium.make(spec, render_mode="ansi").unwrapped)


@given(st.sampled_from(SCENES), vectors)
def test_every_vector_is_a_legal_action(game, vector):
    assert RULES.check(game, act(RULES.table, game, vector)) == ()


@given(st.sampled_from(SCENES), st.integers(0, 1))
def test_every_observation_is_in_its_space(game, seat):
    seen = observe(RULES.table, game, seat)
    assert seen.shape == (OBSERVATION_SIZE,)
    assert seen.dtype == np.float32
    assert ((seen >= 0.0) & (seen <= 1.0)).all()


def test_the_own_group_comes_first_for_both_players():
    """Places 1 to 7 are the own group: ball 12 for the player of stripes, ball 3 for the other."""
    game = situation(BALLS, groups=(Group.STRIPES, Group.SOLIDS))
    width, length = RULES.table.width, RULES.table.length
    for seat, ball in ((0, 12), (1, 3)):
        own = observe(RULES.table, game, seat)[:48].reshape(16, 3)[1:8]
        (place,) = own[own[:, 2] == 1.0][:, :2]
        assert place == pytest.approx((BALLS[ball][0] / width, BALLS[ball][1] / length), abs=1e-6)


def test_every_call_and_every_decision_can_be_chosen():
    game = situation(BALLS)
    chosen = {act(RULES.table, game, np.array([0.0] * 7 + [last])).call for last in np.linspace(-1, 1, 200)}
    assert len(chosen) == 2 * 6 + 1
    asked = SCENES[-1]
    picked = {act(RULES.table, asked, np.array([0.0] * 7 + [last])).decision for last in np.linspace(-1, 1, 50)}
    assert picked == set(OFFERED["R12"])


@pytest.mark.parametrize("vector", [np.zeros(7), np.zeros((1, 8)), np.array([np.nan] * 8)])
def test_what_is_no_action_is_named(vector):
    with pytest.raises(ValueError, match="an action"):
        act(RULES.table, SCENES[1], vector)


def draws_of(seeds, stroke):
    """The normal numbers that `NoiseModel.perturb` draws, in the order of a stroke's columns."""
    stream = SeededStream(seeds.noise_seed, f"pooliad/1 stroke {stroke}")
    a, b, theta, phi, v = (stream.gaussian() for _ in range(5))
    return v, phi, theta, a, b


def test_games_played_as_batches_are_those_of_the_referee_bit_for_bit():
    """Every stroke of some games, until the last has ended by the rules or a limit of R49, against `play_stroke`."""
    chance, noise = np.random.default_rng(5), NoiseModel(1.0)
    rules = EightBall(RULES.table, Limits(dry_visits=5, replays=1, strokes=40))
    seeds = [MatchSeed.of(number).game(0) for number in range(4 * len(SCENES))]
    games, played = SCENES * 4, 0
    ends: Counter[Any] = Counter()
    while games:
        vectors = [chance.uniform(-1, 1, ACTION_SIZE) for _ in games]
        alone = [
            play_stroke(rules, game, act(rules.table, game, vector), seed, noise)
            for game, vector, seed in zip(games, vectors, seeds, strict=True)
        ]
        rows = [row for row, game in enumerate(games) if not game.decisions]
        striking = [games[row] for row in rows]
        asked = np.array([vectors[row] for row in rows]).reshape(-1, ACTION_SIZE)
        draws = np.array([draws_of(seeds[row], games[row].stroke) for row in rows]).reshape(-1, 5)
        together = play_strokes(rules, strokes(rules.table, striking, asked), noise, draws) if rows else []
        assert together == [alone[row].ruling.game for row in rows]
        played += len(rows)
        ends.update(stroke.game.outcome.rule for stroke in alone if stroke.game.is_over)
        left = [(stroke.game, seed) for stroke, seed in zip(alone, seeds, strict=True) if not stroke.game.is_over]
        games, seeds = [game for game, _ in left], [seed for _, seed in left]
    assert played > 200
    assert {"R42", "R43", "R49"} <= set(ends)


@given(st.sampled_from(SCENES[:-1]), vectors)
def test_a_stroke_among_many_is_the_same_stroke(game, vector):
    many = strokes(RULES.table, [SCENES[1], game, SCENES[5]], np.array([vector * 0.5, vector, -vector]))
    assert many.action(1) == act(RULES.table, game, vector)


def test_many_games_are_the_same_games_again_with_the_same_seed():
    def run():
        env = EightBallVectorEnv(5)
        env.reset(seed=11)
        chance = np.random.default_rng(1)
        return [env.step(chance.uniform(-1, 1, (5, ACTION_SIZE)).astype(np.float32)) for _ in range(40)]

    for one, other in zip(run(), run(), strict=True):
        for mine, yours in zip(one[:4], other[:4], strict=True):
            np.testing.assert_array_equal(mine, yours)


def test_games_of_a_batch_end_are_rewarded_and_begin_anew():
    env = EightBallVectorEnv(4, start=situation({0: (0.5, 1.7), 8: (0.9, 0.4)}, groups=(Group.SOLIDS, Group.STRIPES)))
    seen, info = env.reset(seed=2)
    assert env.observation_space.contains(seen)
    ended, was_over = 0, np.zeros(4, bool)
    for _ in range(120):
        seen, rewards, over, cut, info = env.step(env.action_space.sample())
        assert env.observation_space.contains(seen)
        assert not cut.any()
        assert not (was_over & over).any(), "a game that is over begins anew before it can end again"
        assert (rewards[was_over] == 0.0).all()
        assert (info["strokes"][was_over] <= 50).all()
        assert set(rewards[over]) <= {-1.0, 0.0, 1.0}
        ended += int(over.sum())
        was_over = over
    assert ended > 4


def test_a_policy_of_ones_own_is_the_opponent():
    calls = []

    def policy(observation):
        calls.append(observation.shape)
        return np.zeros((*observation.shape[:-1], ACTION_SIZE), np.float32)

    env = EightBallEnv(policy)
    env.reset(seed=1)
    while not env.step(env.action_space.sample())[2]:
        pass
    assert set(calls) == {(OBSERVATION_SIZE,)}
    many = EightBallVectorEnv(3, policy)
    many.reset(seed=1)
    many.step(many.action_space.sample())
    assert {shape[1:] for shape in calls[-1:]} == {(OBSERVATION_SIZE,)}


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: EightBallEnv(noise=9.0), "level"),
        (lambda: EightBallEnv(render_mode="video"), "render_mode"),
        (lambda: EightBallAEC(render_mode="human"), "render_mode"),
        (lambda: EightBallVectorEnv(0), "num_envs"),
        (lambda: EightBallEnv(start=situation({0: (0.5, 0.5)})), "8"),
    ],
)
def test_settings_that_are_none_are_named(make, words):
    with pytest.raises(ValueError, match=words):
        make()


@pytest.mark.parametrize("actions", [np.zeros((3, 8)), np.zeros((2, 7)), np.zeros(8), np.full((2, 8), np.nan)])
def test_actions_of_another_shape_are_named(actions):
    env = EightBallVectorEnv(2)
    env.reset(seed=1)
    with pytest.raises(ValueError, match="action"):
        env.step(actions)


def test_the_package_loads_neither_compiler_nor_the_other_library_before_it_is_needed():
    """Gymnasium is loaded, to register there, if it is installed."""
    program = "import sys, client.learn; print([n for n in ('pettingzoo', 'numba') if n in sys.modules])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_the_environments_are_what_the_libraries_call_them():
    assert issubclass(EightBallEnv, gymnasium.Env)
    assert issubclass(EightBallVectorEnv, gymnasium.vector.VectorEnv)
