"""How the error grows with the number of collisions: shots against the arbitrary-precision engine of the tests.

A shot is followed up to the first event that changes when v and phi move by one ulp. For each collision on the way: the
error of its time, and what one ulp of v and phi does to that time. Their ratio says how many such ulps the arithmetic
of the engine is worth; the growth itself belongs to the game (each collision multiplies an error of aim).
"""

import sys
from collections import defaultdict
from collections.abc import Iterator

import numpy as np

import physics
from benchmarks.command import main
from benchmarks.recording import ROOT, Row, Tables

sys.path.insert(0, str(ROOT / "tests"))

from support.compare import partners
from support.stability import Told, told
from support.truth.strike import Stroke
from support.worlds import from_kernel, mid_game, open_table, run, stroke_at, world_of

SEED = 1665
BALLS = (4, 8, 16)
TABLE = open_table()

Sample = tuple[int, float, float]
"""Collisions so far, error of the time (s), change of the time by one ulp of the input (s)."""


def measure(full: bool) -> Tables:
    """Errors by the number of collisions, mid-game and breaks; shots that left the truth."""
    rng = np.random.default_rng(SEED)
    shots = 200 if full else 10
    samples: dict[str, list[Sample]] = {"mid-game": [], "break": []}
    failures: list[Row] = []
    for positions, stroke in mid_game_shots(rng, shots):
        follow(positions, stroke, samples["mid-game"], failures)
    for positions, stroke in breaks(rng, max(2, shots // 5)):
        follow(positions, stroke, samples["break"], failures)
    return {"error_growth": [row for kind, found in samples.items() for row in rows(kind, found)], "failures": failures}


def mid_game_shots(rng: np.random.Generator, n: int) -> Iterator[tuple[dict[int, tuple[float, float]], Stroke]]:
    """``n`` shots for each number of balls."""
    for balls in BALLS:
        for _ in range(n):
            positions = mid_game(rng, balls)
            yield positions, stroke_at(rng, positions)


def breaks(rng: np.random.Generator, n: int) -> Iterator[tuple[dict[int, tuple[float, float]], Stroke]]:
    """``n`` breaks of the default rack."""
    for seed in range(n):
        state = physics.rack(TABLE, "eight_ball", seed=seed)
        stroke = Stroke(float(rng.uniform(4, 10)), float(rng.uniform(268, 272)), 5.0, 1.0, 1.0)
        yield {ball: place for ball in state.balls if (place := state.position(ball))}, stroke


def follow(
    positions: dict[int, tuple[float, float]], stroke: Stroke, samples: list[Sample], failures: list[Row]
) -> None:
    """Add a sample for every collision of a shot; a failure if the engine leaves the stable story."""
    truth = told(positions, stroke, world_of(TABLE))
    mine = partners(truth.events, from_kernel(run(TABLE, positions, stroke)))
    if len(mine) < len(truth.events):
        failures.append({"positions": positions, "stroke": repr(stroke), "event": len(mine)})
    collisions = 0
    for true, event, moved in zip(truth.events, mine, worst_so_far(truth), strict=False):
        if true.kind == "ball_collision":
            collisions += 1
            samples.append((collisions, abs(float(true.time - event.time)), moved))


def worst_so_far(truth: Told) -> list[float]:
    """For each event the largest change by one ulp of it or any before it (s)."""
    return list(np.maximum.accumulate(truth.sensitivity)) if truth.sensitivity else []


def rows(kind: str, samples: list[Sample]) -> list[Row]:
    """Median and largest error for each number of collisions that at least five shots reached."""
    by_number: dict[int, list[Sample]] = defaultdict(list)
    for sample in samples:
        by_number[sample[0]].append(sample)
    return [row(kind, number, found) for number, found in sorted(by_number.items()) if len(found) >= 5]


def row(kind: str, number: int, samples: list[Sample]) -> Row:
    """One number of collisions."""
    errors, moved = (np.array([sample[k] for sample in samples]) for k in (1, 2))
    return {
        "shots": kind,
        "collisions": number,
        "samples": len(samples),
        "median error s": float(np.median(errors)),
        "largest error s": float(errors.max()),
        "median change by one ulp s": float(np.median(moved)),
        "median error in ulps of the input": float(np.median(errors / np.maximum(moved, 1e-17))),
    }


if __name__ == "__main__":
    main("error_growth", measure)
