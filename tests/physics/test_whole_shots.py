"""Whole shots of the kernel against the arbitrary-precision engine, event for event.

A shot is compared up to the first event that changes when v and phi move by one ulp. Its times may differ from the
true ones by what a few hundred such ulps do (``SHARE``), rounding inside the kernel being of that size.
"""

from typing import Any

import numpy as np
import pytest
from support.compare import Happening, lone, partners, position_error, velocity_error
from support.scenes import RADIUS
from support.stability import Told, told
from support.truth.strike import Stroke
from support.worlds import from_kernel, mid_game, open_table, run, stroke_at, world_of

import physics

SHOTS = 5
"""Mid-game shots for each number of balls."""

SHARE = 1000.0
"""How many times the effect of one ulp of v and phi the kernel may be off."""

FLOOR = 1e-12
"""s; allowed even where one ulp has no effect."""

CREEPING_FLOOR = 1e-10
"""s; the same where the contact rule parts balls at 1 mm/s again and again: it lets each parting speed be 1e-12 m/s
short, which is 1e-12 s in the millisecond until they meet."""


def compared(table: physics.Table, positions: Any, stroke: Stroke, **options: Any) -> tuple[Told, list[Happening]]:
    """The stable true events, and the kernel's counterparts; fails at the first one missing."""
    truth = told(positions, stroke, world_of(table), **options)
    mine = from_kernel(run(table, positions, stroke))
    found = partners(truth.events, mine)
    k, n = len(found), len(truth.events)
    if k < n:
        near = [(e.time, *e.key) for e in mine[max(0, k - 1) : k + 3]]
        expected = (float(truth.events[k].time), *truth.events[k].key)
        pytest.fail(f"event {k} of {n}: true {expected}, kernel {near}; {positions} {stroke}", pytrace=False)
    if truth.whole and len(mine) > n:
        pytest.fail(f"true end after {n} events, kernel goes on to {len(mine)}; {positions} {stroke}", pytrace=False)
    return truth, found


def check_agreement(
    table: physics.Table, positions: Any, stroke: Stroke, *, floor: float = FLOOR, **options: Any
) -> int:
    """Same events, times and lone states to SHARE ulps; returns how many events were compared."""
    truth, found = compared(table, positions, stroke, **options)
    for k, (true, mine) in enumerate(zip(truth.events, found, strict=True)):
        within = floor + SHARE * max(truth.sensitivity[: k + 1])
        late = abs(float(true.time - mine.time))
        assert late <= within, f"event {k} {true.key}: {late:.1e} s off, allowed {within:.1e}; {positions} {stroke}"
        if lone(truth.events, k):
            off = max(position_error(true, mine), velocity_error(true, mine))
            assert off <= 20 * within + 1e-12, f"event {k} {true.key}: {off:.1e} off; {positions} {stroke}"
    return len(found)


@pytest.mark.parametrize("n_balls", [2, 4, 8, 16])
def test_mid_game_shots(n_balls):
    rng = np.random.default_rng(n_balls)
    table, events = open_table(), 0
    for _ in range(SHOTS):
        positions = mid_game(rng, n_balls)
        events += check_agreement(table, positions, stroke_at(rng, positions))
    assert events > 5 * SHOTS


@pytest.mark.parametrize("seed", range(2))
def test_breaks_of_a_loose_rack(seed):
    """The racked balls are a few micrometres apart: one ulp changes the story after some 30 events."""
    table = open_table()
    state = physics.rack(table, "eight_ball", seed=seed)
    positions = {ball: state.position(ball) for ball in state.balls}
    stroke = Stroke(6.0 + seed, 268.5 + seed, 5.0, 1.0, 2.0)
    assert check_agreement(table, positions, stroke, max_events=50) > 10


@pytest.mark.parametrize(
    "changes",
    [
        {"e_ball": 0.8},
        {"mu_ball": 0.0},
        {"mu_ball": 1.0, "e_ball": 0.9},
        {"mu_slide": 1.0, "mu_roll": 0.001, "mu_spin": 0.001},
        {"mu_slide": 0.01, "mu_roll": 0.01},
        {"cushion_parallel": 1.0, "cushion_perpendicular": 1.0, "cushion_spin": 1.0},
        {"cushion_parallel": 0.0, "cushion_perpendicular": 0.3, "cushion_spin": 0.0},
    ],
    ids=str,
)
def test_other_tables(changes):
    rng = np.random.default_rng(7)
    table = open_table(**changes)
    for _ in range(2):
        positions = mid_game(rng, 6)
        check_agreement(table, positions, stroke_at(rng, positions), max_events=60)


def test_the_historical_table():
    rng = np.random.default_rng(11)
    for _ in range(4):
        positions = mid_game(rng, 8)
        check_agreement(physics.Table.fastfiz(), positions, stroke_at(rng, positions))


def rack_of(gap: float, rows: int = 5) -> dict[int, tuple[float, float]]:
    """A triangle of balls with its apex towards the cue ball."""
    step = 2 * RADIUS + gap
    balls: dict[int, tuple[float, float]] = {}
    for row in range(rows):
        for place in range(row + 1):
            balls[len(balls) + 1] = (0.558 + (place - row / 2) * step, 0.559 - row * step * 3**0.5 / 2)
    return balls


@pytest.mark.parametrize("rows", [2, 5])
@pytest.mark.parametrize("phi", [270.0, 269.0, 266.5])
def test_breaks_of_a_touching_triangle(rows, phi):
    """The contact rule in rounds, then what one ulp leaves of the story."""
    positions = {0: (0.558, 1.7), **rack_of(0.0, rows)}
    assert check_agreement(open_table(), positions, Stroke(5.0, phi), floor=CREEPING_FLOOR, max_events=60) > 3


FROZEN = {
    "ball frozen to the west cushion, struck along it": ({0: (0.2, 0.9), 1: (RADIUS, 0.6)}, 239.0),
    "ball frozen to the south cushion, struck into it": ({0: (0.5, 0.6), 1: (0.5, RADIUS)}, 270.0),
    "cue ball frozen to the east cushion, played away": ({0: (1.116 - RADIUS, 0.6), 1: (0.5, 0.7)}, 170.0),
    "cue ball frozen to the north cushion, played into it": ({0: (0.4, 2.236 - RADIUS), 1: (0.5, 0.7)}, 60.0),
    "two balls frozen to each other and a cushion": (
        {0: (0.5, 0.8), 1: (0.5, RADIUS), 2: (0.5 + 2 * RADIUS, RADIUS)},
        268.0,
    ),
    "cue ball frozen to an object ball, played away": ({0: (0.5, 1.0), 1: (0.5 + 2 * RADIUS, 1.0)}, 120.0),
    "cue ball frozen to an object ball, played into it": ({0: (0.5, 1.0), 1: (0.5 + 2 * RADIUS, 1.0)}, 20.0),
    "a straight row, struck in line": ({0: (0.5, 1.5), **{i: (0.5, 1.2 - 2 * i * RADIUS) for i in range(1, 5)}}, 270.0),
    "a straight row, cue ball first": ({i: (0.5, 1.2 - 2 * i * RADIUS) for i in range(5)}, 270.0),
}


@pytest.mark.parametrize("name", FROZEN)
@pytest.mark.parametrize("b", [0.0, 10.0, -10.0])
def test_frozen_scenes(name, b):
    positions, phi = FROZEN[name]
    assert (
        check_agreement(open_table(), positions, Stroke(2.0, phi, 0.0, 0.0, b), floor=CREEPING_FLOOR, max_events=60) > 1
    )
