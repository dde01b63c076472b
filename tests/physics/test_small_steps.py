"""Flying shots beside an integrator in small time steps, which knows no events: it converges to them at first order."""

import math

import numpy as np
import pytest
from support.moving import Launch, let_go
from support.stepper import Body, Stepper

import physics

FLYING = physics.Table.nine_foot().replace(flight=True, cue_test=False)
R = FLYING.ball_radius
CORNER = FLYING.corner_shape
HORN = CORNER.horn_centre  # of the jaw that ends the long cushion at the south-west: (x, y) = (d, s)

SCENARIOS = {
    "a jump over a ball, to a slide and a roll": (
        {0: Launch((0.3, 0.6), (1.5, 0.2), (0.0, 20.0, 0.0), 0.0, 1.4), 1: Launch((0.5, 0.6))},
        0.9,
    ),
    "a landing on a ball": (
        {0: Launch((0.3, 0.6), (1.0, 0.1), (0.0, 30.0, 5.0), 0.0, 1.2), 1: Launch((0.53, 0.62))},
        0.5,
    ),
    "a nose in the air": ({0: Launch((1.0, 0.7), (2.0, 0.6), (5.0, -20.0, 10.0), 0.0, 0.75)}, 0.35),
    "a horn in the air": (
        {0: Launch((HORN[1] + 0.09, HORN[0] + 0.075), (-0.9, -0.8), (0.0, 10.0, 0.0), 0.02, 0.35)},
        0.2,
    ),
    "two flying balls": (
        {
            0: Launch((0.4, 0.6), (1.0, 0.0), (0.0, 10.0, 0.0), 0.0, 1.5),
            1: Launch((0.7, 0.61), (-1.0, 0.05), (3.0, 0.0, 0.0), 0.01, 1.3),
        },
        0.4,
    ),
    "a rattle between the jaws": ({0: Launch((0.25, 0.22), (-2.1805, -1.4161), (0.0, 0.0, 0.0), 0.0, 0.45)}, 0.2),
}


def error(launches: dict[int, Launch], until: float, step: float) -> float:
    """How far the stepped balls end from where the events put them, m."""
    balls = sorted(launches)
    bodies = [
        Body(
            (*launches[ball].position, launches[ball].height),
            (*launches[ball].velocity, launches[ball].velocity_z),
            launches[ball].spin,
        )
        for ball in balls
    ]
    Stepper(FLYING, bodies).run(until, step)
    there = let_go(FLYING, launches).at(until)
    return max(
        math.dist(body.place, (*there.positions[ball].tolist(), float(there.heights[ball])))
        for ball, body in zip(balls, bodies, strict=True)
    )


@pytest.mark.parametrize("name", SCENARIOS)
def test_small_steps_converge_to_the_events(name):
    """Ten times smaller steps end about ten times nearer, at last within half a millimetre.

    Where within a step an impact falls is chance, so each figure is a mean over steps of nearly the same size.
    """
    launches, until = SCENARIOS[name]
    kinds = {event.kind.value for event in let_go(FLYING, launches).events if event.time < until}
    assert kinds & {"landing", "ball_collision", "rail_collision", "jaw_collision"}
    coarse, fine = (
        float(np.mean([error(launches, until, step * (1.0 + 0.037 * k)) for k in range(5)])) for step in (3e-4, 3e-5)
    )
    assert fine < 0.25 * coarse
    assert fine < 5e-4
