"""One ball on a table with jaws by time steps: move it, look whether it is in a piece, let it rebound there.

As in ``time_stepping`` the ball moves along its closed forms and changes its motion state at the right time even within
a step; ``dt`` is only what finds contacts. The cushion law is the table's, ``han``.
"""

import math

import numba

import physics
from benchmarks.pieces import Pieces
from benchmarks.scenes import Floats
from physics.kernels.resolve.cushion_laws import han

compiled = numba.njit(cache=False, error_model="numpy")

RESTING, SPINNING, SLIDING, ROLLING, POCKETED = 0, 1, 2, 3, 4
NO_SLIP = 1e-12
CLEAR, WALL, HOLE = 0, 1, 2


@compiled
def classify(ball, radius):
    """Motion state of a ball x y vx vy wx wy wz."""
    if math.hypot(ball[2] - radius * ball[5], ball[3] + radius * ball[4]) > NO_SLIP:
        return SLIDING
    if math.hypot(ball[2], ball[3]) > NO_SLIP:
        return ROLLING
    return SPINNING if ball[6] != 0.0 else RESTING


@compiled
def advance(ball, motion, dt, radius, slide, roll, spin):
    """Move a ball by ``dt`` through its motion states; the state it is in then."""
    while dt > 0.0 and motion in (SLIDING, ROLLING):
        ux, uy = ball[2], ball[3]
        if motion == SLIDING:
            ux, uy = ux - radius * ball[5], uy + radius * ball[4]
        size, drag = math.hypot(ux, uy), slide if motion == SLIDING else roll
        lasts = 2.0 * size / (7.0 * slide) if motion == SLIDING else size / roll
        step, ax, ay = min(dt, lasts), -drag * ux / size, -drag * uy / size
        ball[0] += step * (ball[2] + 0.5 * step * ax)
        ball[1] += step * (ball[3] + 0.5 * step * ay)
        ball[2] += step * ax
        ball[3] += step * ay
        if motion == SLIDING:
            ball[4] += 2.5 / radius * step * ay
            ball[5] -= 2.5 / radius * step * ax
        else:
            ball[4], ball[5] = -ball[3] / radius, ball[2] / radius
        ball[6] = math.copysign(max(0.0, abs(ball[6]) - spin * step), ball[6])
        if step < lasts:
            return motion
        motion = ROLLING if motion == SLIDING and math.hypot(ball[2], ball[3]) > NO_SLIP else RESTING
        if motion == ROLLING:
            ball[4], ball[5] = -ball[3] / radius, ball[2] / radius
        dt -= step
    return motion


@compiled
def deepest(ball, starts, ways, normals, lengths, horns, holes, radii, horn, rho):
    """(gap, nx, ny, CLEAR or WALL or HOLE) of the piece that a ball is deepest in; the normal points to the ball."""
    gap, nx, ny, kind = 0.0, 0.0, 0.0, CLEAR
    for k in range(len(starts)):
        x, y = ball[0] - starts[k, 0], ball[1] - starts[k, 1]
        here = x * normals[k, 0] + y * normals[k, 1] - rho
        if here < gap and 0.0 <= x * ways[k, 0] + y * ways[k, 1] <= lengths[k]:
            gap, nx, ny, kind = here, normals[k, 0], normals[k, 1], WALL
    for k in range(len(horns)):
        x, y = ball[0] - horns[k, 0], ball[1] - horns[k, 1]
        far = math.hypot(x, y)
        if far - horn - rho < gap:
            gap, nx, ny, kind = far - horn - rho, x / far, y / far, WALL
    for k in range(len(holes)):
        if math.hypot(ball[0] - holes[k, 0], ball[1] - holes[k, 1]) < radii[k]:
            return 0.0, 0.0, 0.0, HOLE
    return gap, nx, ny, kind


@compiled
def carry(ball, motion, horizon, dt, back_up, friction, shape, rail):
    """Carry a ball to ``horizon`` (s) in steps of ``dt``, overwriting it; its motion state then."""
    radius, slide, roll, spin = friction
    starts, ways, normals, lengths, horns, holes, radii, horn, rho = shape
    cosine, sine, e, mu = rail
    for _ in range(round(horizon / dt)):
        motion = advance(ball, motion, dt, radius, slide, roll, spin)
        if motion not in (SLIDING, ROLLING):
            break
        gap, nx, ny, kind = deepest(ball, starts, ways, normals, lengths, horns, holes, radii, horn, rho)
        if kind == HOLE:
            return POCKETED
        speed = -(ball[2] * nx + ball[3] * ny)
        if kind == CLEAR or speed <= 0.0:
            continue
        ago = min(dt, -gap / speed) if back_up else 0.0
        ball[0] -= ago * ball[2]
        ball[1] -= ago * ball[3]
        normal = (cosine * nx, cosine * ny, sine)
        v, w = han(radius, (ball[2], ball[3]), (ball[4], ball[5], ball[6]), normal, e, mu)
        ball[2], ball[3], ball[4], ball[5], ball[6] = v[0], v[1], w[0], w[1], w[2]
        ball[0] += ago * ball[2]
        ball[1] += ago * ball[3]
        motion = classify(ball, radius)
    return motion


def simulate(table: physics.RealTable, pieces: Pieces, ball: Floats, horizon: float, dt: float, back_up: bool) -> int:
    """Carry ``ball`` (7,) x y vx vy wx wy wz to ``horizon``, overwriting it; its motion state then."""
    radius, gravity = table.ball_radius, table.gravity
    friction = radius, table.mu_slide * gravity, table.mu_roll * gravity, 2.5 * table.mu_spin * gravity / radius
    shape = (
        *(pieces.starts, pieces.ways, pieces.normals, pieces.lengths, pieces.horns, pieces.holes, pieces.hole_radii),
        *(pieces.horn_radius, pieces.rho),
    )
    cosine, sine = pieces.rho / radius, -(table.nose_height - radius) / radius
    rail = cosine, sine, table.e_cushion, table.mu_cushion
    return int(carry(ball, classify(ball, radius), horizon, dt, back_up, friction, shape, rail))
