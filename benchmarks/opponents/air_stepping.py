"""One ball that hops along the cloth by time steps: move it, look whether it is below the cloth, let it bounce there.

Between steps the ball follows its closed forms, in the air and on the cloth (``jaw_stepping.advance``); ``dt`` is only
what finds landings. The laws are the table's: the impact of a fixed body, and no hop slower than LIFT.
"""

import numpy as np

import physics
from benchmarks.opponents.jaw_stepping import RESTING, advance, classify, compiled
from benchmarks.scenes import Floats
from physics.kernels.resolve.fixed import impact
from physics.kernels.tolerances import LIFT


@compiled
def land(v, w, radius, e_cloth, mu):
    """Velocity and spin after an impact on the cloth."""
    bounces = -e_cloth * v[2] >= LIFT
    v, w = impact(radius, v, w, (0.0, 0.0, 1.0), e_cloth if bounces else 0.0, mu)
    return (v[0], v[1], v[2] if bounces else 0.0), w


@compiled
def fly(ball, height, rise, horizon, dt, back_up, table):
    """Carry a ball x y vx vy wx wy wz, at a height and rising so fast, to ``horizon`` (s), overwriting it."""
    radius, gravity, e_cloth, mu, slide, roll, spin = table
    motion = RESTING
    for _ in range(round(horizon / dt)):
        if height == 0.0 and rise == 0.0:
            motion = advance(
                ball, classify(ball, radius) if motion == RESTING else motion, dt, radius, slide, roll, spin
            )
            continue
        ball[0] += dt * ball[2]
        ball[1] += dt * ball[3]
        height += dt * (rise - 0.5 * gravity * dt)
        rise -= gravity * dt
        if height >= 0.0 or rise >= 0.0:
            continue
        ago = min(dt, height / rise) if back_up else 0.0  # at the present speed
        ball[0] -= ago * ball[2]
        ball[1] -= ago * ball[3]
        v, w = land((ball[2], ball[3], rise + gravity * ago), (ball[4], ball[5], ball[6]), radius, e_cloth, mu)
        ball[2], ball[3], rise = v
        ball[4], ball[5], ball[6] = w
        height = 0.0
        if rise > 0.0:
            ball[0] += ago * ball[2]
            ball[1] += ago * ball[3]
            height, rise = ago * (rise - 0.5 * gravity * ago), rise - gravity * ago
        else:
            motion = advance(ball, classify(ball, radius), ago, radius, slide, roll, spin)


def simulate(table: physics.RealTable, ball: Floats, horizon: float, dt: float, back_up: bool) -> None:
    """Carry ``ball`` (9,) x y vx vy wx wy wz z vz to ``horizon``, overwriting its first seven."""
    radius, gravity = table.ball_radius, table.gravity
    friction = table.mu_slide * gravity, table.mu_roll * gravity, 2.5 * table.mu_spin * gravity / radius
    laws = radius, gravity, table.e_cloth, table.mu_slide, *friction
    fly(ball, float(ball[7]), float(ball[8]), horizon, dt, back_up, tuple(map(np.float64, laws)))
