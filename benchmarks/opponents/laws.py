"""Motion and collision laws of ``Table.olympiad()`` (docs/physics.md) for opponents, compiled.

A ball is a row x y vx vy wx wy wz of an array (n, 7), in the table's frame; ``motion`` (n,) holds its state.
"""

import math

import numba

import physics

compiled = numba.njit(cache=False)

TABLE = physics.Table.olympiad()
RADIUS = TABLE.ball_radius
SLIDE = TABLE.mu_slide * TABLE.gravity
ROLL = TABLE.mu_roll * TABLE.gravity
SPIN = 5.0 * TABLE.mu_spin * TABLE.gravity / (2.0 * RADIUS)
MU_BALL, E_BALL = TABLE.mu_ball, TABLE.e_ball
ALONG, ACROSS, KEEP = TABLE.cushion_parallel, TABLE.cushion_perpendicular, TABLE.cushion_spin
WIDTH, LENGTH = TABLE.width, TABLE.length
CORNER = TABLE.corner_reach + RADIUS
HALF_SIDE = 0.5 * TABLE.side_mouth
NO_SLIP = 1e-12

RESTING, SPINNING, SLIDING, ROLLING, POCKETED = 0, 1, 2, 3, 4


@compiled
def classify(ball):
    """Motion state of a ball from its velocity and spin."""
    ux, uy = ball[2] - RADIUS * ball[5], ball[3] + RADIUS * ball[4]
    if math.sqrt(ux * ux + uy * uy) > NO_SLIP:
        return SLIDING
    if math.sqrt(ball[2] * ball[2] + ball[3] * ball[3]) > NO_SLIP:
        return ROLLING
    return SPINNING if ball[6] != 0.0 else RESTING


@compiled
def acceleration(ball, motion):
    """(ax, ay) m/s^2 and how long the motion state lasts, s."""
    if motion == SLIDING:
        ux, uy = ball[2] - RADIUS * ball[5], ball[3] + RADIUS * ball[4]
        slip = math.sqrt(ux * ux + uy * uy)
        return -SLIDE * ux / slip, -SLIDE * uy / slip, 2.0 * slip / (7.0 * SLIDE)
    if motion == ROLLING:
        speed = math.sqrt(ball[2] * ball[2] + ball[3] * ball[3])
        return -ROLL * ball[2] / speed, -ROLL * ball[3] / speed, speed / ROLL
    return 0.0, 0.0, math.inf


@compiled
def move(ball, motion, ax, ay, dt):
    """Advance a ball within its motion state."""
    ball[0] += dt * (ball[2] + 0.5 * dt * ax)
    ball[1] += dt * (ball[3] + 0.5 * dt * ay)
    ball[2] += dt * ax
    ball[3] += dt * ay
    if motion == SLIDING:
        ball[4] += 2.5 / RADIUS * dt * ay
        ball[5] -= 2.5 / RADIUS * dt * ax
    elif motion == ROLLING:
        ball[4], ball[5] = -ball[3] / RADIUS, ball[2] / RADIUS
    slower = max(0.0, abs(ball[6]) - SPIN * dt)
    ball[6] = math.copysign(slower, ball[6])


@compiled
def end_motion(ball, motion):
    """What a ball whose motion state has ended does next."""
    if motion == SLIDING and math.sqrt(ball[2] * ball[2] + ball[3] * ball[3]) > NO_SLIP:
        ball[4], ball[5] = -ball[3] / RADIUS, ball[2] / RADIUS
        return ROLLING
    ball[2:6] = 0.0
    return SPINNING if ball[6] != 0.0 else RESTING


@compiled
def collide(one, two):
    """Two balls that approach: normal impulse, then friction against the slip; both spins turn in the same sense."""
    nx, ny = two[0] - one[0], two[1] - one[1]
    distance = math.sqrt(nx * nx + ny * ny)
    nx, ny = nx / distance, ny / distance
    closing = (one[2] - two[2]) * nx + (one[3] - two[3]) * ny
    change = 0.5 * (1.0 + E_BALL) * closing
    slip_t = (one[3] - two[3]) * nx - (one[2] - two[2]) * ny + RADIUS * (one[6] + two[6])
    slip_z = RADIUS * (ny * (one[4] + two[4]) - nx * (one[5] + two[5]))
    slip = math.sqrt(slip_t * slip_t + slip_z * slip_z)
    push_t, push_z = 0.0, 0.0
    if slip > 0.0:
        size = min(MU_BALL * change, slip / 7.0)
        push_t, push_z = size * slip_t / slip, size * slip_z / slip
    one[2] -= change * nx - push_t * ny
    one[3] -= change * ny + push_t * nx
    two[2] += change * nx - push_t * ny
    two[3] += change * ny + push_t * nx
    turn = -2.5 / RADIUS
    for ball in (one, two):
        ball[4] += turn * push_z * ny
        ball[5] -= turn * push_z * nx
        ball[6] += turn * push_t


@compiled
def boundary(ball):
    """(gap, nx, ny, is a mouth) of the nearest side of the octagon; the normal points outwards; gap < 0 is beyond."""
    gap, nx, ny, mouth = ball[0] - RADIUS, -1.0, 0.0, abs(ball[1] - 0.5 * LENGTH) < HALF_SIDE
    if WIDTH - RADIUS - ball[0] < gap:
        gap, nx = WIDTH - RADIUS - ball[0], 1.0
    if ball[1] - RADIUS < gap:
        gap, nx, ny, mouth = ball[1] - RADIUS, 0.0, -1.0, False
    if LENGTH - RADIUS - ball[1] < gap:
        gap, nx, ny, mouth = LENGTH - RADIUS - ball[1], 0.0, 1.0, False
    side = 1.0 if ball[0] > 0.5 * WIDTH else -1.0
    end = 1.0 if ball[1] > 0.5 * LENGTH else -1.0
    from_corner = (min(ball[0], WIDTH - ball[0]) + min(ball[1], LENGTH - ball[1]) - CORNER) * math.sqrt(0.5)
    if from_corner < gap:
        return from_corner, side * math.sqrt(0.5), end * math.sqrt(0.5), True
    return gap, nx, ny, mouth


@compiled
def rebound(ball, nx):
    """A rail collision; the cushion is a long one if ``nx`` is not 0."""
    if nx != 0.0:
        ball[2], ball[3] = -ACROSS * ball[2], ALONG * ball[3]
    else:
        ball[2], ball[3] = ALONG * ball[2], -ACROSS * ball[3]
    ball[4:7] *= KEEP
