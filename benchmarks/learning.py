"""Steps a second of processor time of the learning environments, the opponent included: one game, and many at once."""

import time
from collections.abc import Callable

import numpy as np

from benchmarks.command import main
from benchmarks.recording import Row, Tables
from client.learn import ACTION_SIZE, EightBallAEC, EightBallEnv, EightBallVectorEnv

SEED = 7
SIZES = (1, 8, 32, 128, 1024)
"""Games of a vector environment; each divides the number of steps."""


def measure(full: bool) -> Tables:
    """A row for each environment: random actions for each second of processor time, noise 1."""
    steps = 20_480 if full else 2_048
    rows = [_row("aec", 1, steps, _aec), _row("single", 1, steps, _single)]
    rows += [_row("vector", size, steps, lambda count, size=size: _vector(count, size)) for size in SIZES]
    return {"learning": rows}


def _row(name: str, games: int, steps: int, run: Callable[[int], float]) -> Row:
    run(max(games, 16))  # compiled, and warm
    seconds = run(steps)
    return {"environment": name, "games": games, "steps": steps, "steps_per_second": steps / seconds}


def _actions(count: int) -> np.ndarray:
    chance = np.random.default_rng(SEED)
    return chance.uniform(-1.0, 1.0, (count, ACTION_SIZE)).astype(np.float32)


def _aec(steps: int) -> float:
    env = EightBallAEC()
    env.reset(seed=SEED)
    started = time.process_time()
    for action in _actions(steps):
        env.step(action)
        if all(env.terminations.values()):
            env.reset()
    return time.process_time() - started


def _single(steps: int) -> float:
    env = EightBallEnv()
    env.reset(seed=SEED)
    started = time.process_time()
    for action in _actions(steps):
        if env.step(action)[2]:
            env.reset()
    return time.process_time() - started


def _vector(steps: int, games: int) -> float:
    env = EightBallVectorEnv(games)
    env.reset(seed=SEED)
    started = time.process_time()
    for actions in _actions(steps).reshape(-1, games, ACTION_SIZE):
        env.step(actions)
    return time.process_time() - started


if __name__ == "__main__":
    main("learning", measure)
