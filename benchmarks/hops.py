"""Run time against error a second into hops: this engine, and time stepping that knows the same closed forms.

The truth is the arbitrary-precision engine of the tests at 30 digits, as in ``real_tables``.
"""

from collections.abc import Iterator

import numpy as np

import physics
from benchmarks import timing
from benchmarks.command import main
from benchmarks.flight_costs import FLYING
from benchmarks.opponents import air_stepping
from benchmarks.real_tables import HORIZON, cue_ball_of, errors, played, stepped, truth
from benchmarks.recording import Row, Tables
from benchmarks.scenes import Floats

STEPS = (1e-2, 1e-3, 1e-4, 1e-5)


def measure(full: bool) -> Tables:
    """The table."""
    return {"error_vs_time": list(error_vs_time(24 if full else 6, list(STEPS)))}


def scenes_of(n: int) -> tuple[Floats, Floats]:
    """A lone ball that jumps up the table and lands once or more within a second, far from every cushion."""
    rng, states, shots = np.random.default_rng(22), np.full((n, 16, 2), np.nan), np.zeros((n, 5))
    states[:, 0] = 0.635, 0.3
    shots[:, 0], shots[:, 1] = rng.uniform(1.0, 2.0, n), rng.uniform(85.0, 95.0, n)
    shots[:, 2], shots[:, 4] = rng.uniform(25.0, 50.0, n), rng.uniform(0.0, 8.0, n)
    return states, shots


def error_vs_time(n: int, steps: list[float]) -> Iterator[Row]:
    """Run time against error a second into hops: this engine, and time stepping; truth as in ``real_tables``."""
    states, shots = scenes_of(n)
    truths = [truth(FLYING, state, shot) for state, shot in zip(states, shots, strict=True)]
    results = [played(FLYING, state, shot) for state, shot in zip(states, shots, strict=True)]
    many = 200
    work = FLYING, np.tile(states, (many, 1, 1)), np.tile(shots, (many, 1))
    seconds = timing.cpu_seconds(lambda: physics.simulate_batch(*work))
    ends = [result.at(min(HORIZON, result.duration)).positions[0] for result in results]
    yield errors("this engine", None, seconds / many / n, ends, truths)

    def carry(ball: Floats, horizon: float, step: float, back_up: bool) -> Floats:
        air_stepping.simulate(FLYING, ball, horizon, step, back_up)
        return ball[:2]

    yield from stepped([cue_ball_of(result) for result in results], truths, steps, carry)


if __name__ == "__main__":
    main("hops", measure)
