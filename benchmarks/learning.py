"""Steps a second of the learning environments, the opponent included: one game at a time, and many at once."""

import time
from collections.abc import Callable

import numpy as np

from benchmarks.command import main
from benchmarks.recording import Row, Tables
from client.learn import ACTION_SIZE, EightBallAEC, EightBallEnv, EightBallVectorEnv

SEED = 7
SIZES = (1, 16, 64, 256)
"""Games of a vector environment."""


def measure(full: bool) -> Tables:
    """A row for each environment: actions a second at random, noise 1."""
    steps = 20_000 if full else 400
    rows = [_row("aec", 1, steps, _aec), _row("single", 1, steps, _single)]
    rows += [_row("vector", size, steps, lambda count, size=size: _vector(count, size)) for size in SIZES]
    return {"learning": rows}


def _row(name: str, games: int, steps: int, run: Callable[[int], int]) -> Row:
    run(max(games, 20))  # compiled, and warm
    started = time.perf_counter()
    done = run(steps)
    seconds = time.perf_counter() - started
    return {"environment": name, "games": games, "steps": done, "steps_per_second": done / seconds}


def _actions(count: int) -> np.ndarray:
    chance = np.random.default_rng(SEED)
    return chance.uniform(-1.0, 1.0, (count, ACTION_SIZE)).astype(np.float32)


def _aec(steps: int) -> int:
    env = EightBallAEC()
    env.reset(seed=SEED)
    for action in _actions(steps):
        env.step(action)
        if all(env.terminations.values()):
            env.reset()
    return steps


def _single(steps: int) -> int:
    env = EightBallEnv()
    env.reset(seed=SEED)
    for action in _actions(steps):
        if env.step(action)[2]:
            env.reset()
    return steps


def _vector(steps: int, games: int) -> int:
    env = EightBallVectorEnv(games)
    env.reset(seed=SEED)
    rounds = max(1, steps // games)
    for actions in _actions(rounds * games).reshape(rounds, games, ACTION_SIZE):
        env.step(actions)
    return rounds * games


if __name__ == "__main__":
    main("learning", measure)
