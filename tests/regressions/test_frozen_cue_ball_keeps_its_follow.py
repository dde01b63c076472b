"""Seen: a cue ball frozen to a cushion, played straight into a touching ball and away from the cushion, lost its
follow and rolled off along the cushion.

Expected: after the hit it stands still with the spin of the strike, which carries it on in the direction of the
stroke. Why it did not: rounding left it 1e-15 m/s towards the cushion, and being held there takes the spin.
"""

import math

import pytest
from support.moving import after
from support.play import OPEN
from support.scenes import RADIUS as R

import physics

EAST_LINE = 1.116 - R


@pytest.mark.parametrize("y", [0.31963584777604936, 0.4, 0.5123, 0.61])
@pytest.mark.parametrize("phi", [95.0, 135.0, 150.0, 179.0, 200.0])
@pytest.mark.parametrize("v", [0.5, 1.0])
def test_it_follows_in_the_direction_of_the_stroke(y, phi, v):
    angle = math.radians(phi)
    other = (EAST_LINE + 2 * R * math.cos(angle), y + 2 * R * math.sin(angle))
    state = physics.TableState.from_positions({0: (EAST_LINE, y), 1: other})
    result = physics.simulate(OPEN.replace(mu_ball=0.0), state, physics.Shot(v, phi, 0.0, 0.0, 8.0))
    rolls = next(event for event in result.events if event.kind.value == "sliding_rolling" and event.ball == 0)
    vx, vy = after(rolls, 0).velocity
    assert math.degrees(math.atan2(vy, vx)) % 360.0 == pytest.approx(phi, abs=1e-6)
