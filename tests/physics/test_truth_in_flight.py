"""Shots on a table that flies against the arbitrary-precision engine, and that engine by itself.

It knows no filter and no broad phase: every ball with every other, every nose, horn, facing, hole and rail, from
polynomials of degree 4 and, at horns, 8.
"""

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf
from support.compare import from_truth, partners, position_error
from support.truth.engine import play, start
from support.truth.flight import is_airborne
from support.truth.model import energy
from support.truth.motion import advance
from support.truth.strike import Stroke
from support.worlds import from_kernel, shot_of, world_of

import physics

FLYING = physics.Table.nine_foot().replace(flight=True, cue_test=False)
R = FLYING.ball_radius
Position = tuple[float, float]


def near_a_mouth(rng: np.random.Generator, n: int) -> dict[int, Position]:
    """Balls in and before the south-west or the west mouth, some touching."""
    places: list[Position] = []
    while len(places) < n:
        x, y = rng.uniform(0.0, 0.35), rng.uniform(0.0, 0.35)
        if rng.random() < 0.5:
            x, y = rng.uniform(-0.005, 0.35), FLYING.length / 2 + rng.uniform(-0.25, 0.25)
        if places and rng.random() < 0.4:
            angle, reach = rng.uniform(0, 2 * math.pi), 2 * R * (1 + float(rng.choice([0.0, 1e-6, 0.3])))
            x, y = places[-1][0] + reach * math.cos(angle), places[-1][1] + reach * math.sin(angle)
        apart = all(math.dist((x, y), place) >= 2 * R - 5e-16 for place in places)
        if FLYING.contains(float(x), float(y)) and apart:
            places.append((float(x), float(y)))
    return dict(enumerate(places))


def drawn(rng: np.random.Generator) -> tuple[dict[int, Position], Stroke]:
    positions = near_a_mouth(rng, int(rng.integers(1, 4)))
    x, y = positions[0]
    to_x, to_y = (-0.03, -0.03) if y < 0.6 else (-0.06, FLYING.length / 2)
    if len(positions) > 1 and rng.random() < 0.5:
        to_x, to_y = positions[1]
    aim = math.degrees(math.atan2(to_y - y, to_x - x)) + float(rng.normal(0, 12))
    theta, side, high = float(rng.choice([5.0, 20.0, 35.0, 50.0, 70.0])), *rng.uniform((-4.0, 0.0), (4.0, 20.0))
    return positions, Stroke(float(rng.uniform(0.5, 6)), aim, theta, float(side), float(high))


@pytest.mark.parametrize("law", ["han", "mathavan"])
def test_flying_shots_tell_the_true_story(law):
    """Up to 20 events at 30 digits: the same events, times to 1e-9 s, places to 1e-8 m."""
    rng, table = np.random.default_rng(23), FLYING.replace(cushion=law)
    kinds: dict[str, int] = {}
    for _ in range(24):
        positions, stroke = drawn(rng)
        records = play(positions, stroke, world_of(table), digits=30, max_events=20).records
        truth = from_truth(records)
        state = physics.TableState.from_positions(positions)
        found = partners(truth, from_kernel(physics.simulate(table, state, shot_of(stroke))))
        assert len(found) == len(truth), (positions, stroke)
        for one, other in zip(truth, found, strict=True):
            assert abs(float(one.time - other.time)) < 1e-9, (positions, stroke)
            assert position_error(one, other) < 1e-8, (positions, stroke)
            kinds[one.kind] = kinds.get(one.kind, 0) + 1
    assert kinds["landing"] > 20, kinds
    assert {"rail_collision", "jaw_collision", "ball_collision", "off_table"} <= kinds.keys()


JUMP_INTO_RACK = {0: (0.6, 0.9), 1: (0.6, 0.6), 2: (0.6 - R, 0.6 - 3**0.5 * R), 3: (0.6 + R, 0.6 - 3**0.5 * R)}
CLUSTERS = {
    "onto a touching pair": (
        {0: (0.6, 0.9), 1: (0.6, 0.62), 2: (0.6 + 2 * R, 0.62)},
        Stroke(1.9, 270.0, 45.0, 0.0, 18.0),
    ),
    "into a touching triangle": (JUMP_INTO_RACK, Stroke(2.6, 270.5, 45.0, 0.0, 18.0)),
    "70 degrees into a frozen pair": (
        {0: (0.6, 0.8), 1: (0.6, 0.8 - 2 * R), 2: (0.6, 0.8 - 4 * R)},
        Stroke(4.0, 270.0, 70.0, 0.0, 12.0),
    ),
    "over a ball into another at the rail": (
        {0: (0.3, 1.0), 1: (0.2, 1.0), 2: (0.0276, 1.0)},
        Stroke(1.9, 180.0, 60.0, 0.0, 19.0),
    ),
}


@pytest.mark.parametrize("name", CLUSTERS)
def test_clusters_with_a_flying_ball_tell_the_true_story(name):
    """Three balls and more at an instant, one of them in the air: the contact rule with the cloth as a third body."""
    positions, stroke = CLUSTERS[name]
    truth = from_truth(play(positions, stroke, world_of(FLYING), digits=40, max_events=24).records)
    state = physics.TableState.from_positions(positions)
    found = partners(truth, from_kernel(physics.simulate(FLYING, state, shot_of(stroke))))
    assert sum(event.kind == "ball_collision" for event in truth) >= 2
    assert len(found) >= min(len(truth), 12), name
    for one, other in zip(truth[: len(found)], found, strict=True):
        assert abs(float(one.time - other.time)) < 1e-8


def total(shot: Any) -> mpf:
    """Kinetic energy and that of height, per mass."""
    balls = [ball.copy() for ball in shot.on_table()]
    for ball in balls:
        advance(shot.world, ball, shot.time)
    return sum(energy(shot.world, ball) + shot.world.gravity * ball.height for ball in balls)


@pytest.mark.parametrize("name", CLUSTERS)
def test_energy_falls_at_every_event(name):
    positions, stroke = CLUSTERS[name]
    with mp.workdps(30):
        shot = start(world_of(FLYING), positions, stroke)
        energies, flew = [total(shot)], False
        while len(shot.records) < 40 and shot.step():
            energies.append(total(shot))
            flew = flew or any(is_airborne(ball) for ball in shot.on_table())
    assert flew
    assert all(after <= before * (1 + mpf("1e-25")) for before, after in pairwise(energies))
