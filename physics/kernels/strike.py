"""The cue strike ([I], section 5) and which strokes are possible.

With c = sqrt(R^2 - a^2 - b^2), C = cos theta, S = sin theta and offsets a, b in metres (docs/physics.md, eq. 1-4)::

    F = 2 m V / (1 + m/M + 5/(2R^2) [a^2 + (b C - c S)^2])
    v = (F C / m) d          w = (b C - c S) F/I l + a S F/I d + a C F/I k
"""

import math

from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, small_kernel
from physics.kernels.layout import (
    ABSENT,
    LANES,
    MOTION,
    P_BRACKET,
    P_CUE_LENGTH,
    P_CUE_TEST,
    P_HALF_X,
    P_HALF_Y,
    P_INERTIA,
    P_MASS_RATIO,
    P_NOSE,
    P_RADIUS,
    P_THETA_MAX,
    P_V_MAX,
    POCKETED,
    X,
    Y,
)
from physics.kernels.trigonometry import sine_cosine

PLAYABLE, CUE_OBSTRUCTED, TIP_OFF_BALL, OUT_OF_RANGE, NO_CUE_BALL = 0, 1, 2, 3, 4
"""Numbers of physics.Status."""

MILLIMETRE = 1e-3
"""m: tip offsets of a shot come in millimetres."""

NOBODY = -1
THROUGH_CUE_BALL = 16
"""Obstacle numbers: 0..15 a ball, 16 the cue ball's own body, 17..20 a cushion (W, E, S, N)."""


@small_kernel
def direction(phi, theta):
    """The cue's direction: (cos phi, sin phi, cos theta, sin theta) from its angles in deg."""
    sin_phi, cos_phi = sine_cosine(phi)
    sin_theta, cos_theta = sine_cosine(theta)
    return cos_phi, sin_phi, cos_theta, sin_theta


@small_kernel
def strike(p, v, aim, a, b):
    """Velocity (vx, vy) in m/s and spin (wx, wy, wz) in rad/s of the cue ball after the strike.

    ``v`` m/s, ``aim`` from ``direction``, ``a`` and ``b`` metres; the tip must be on the ball.
    """
    radius = load(p, P_RADIUS)
    depth = math.sqrt(radius * radius - a * a - b * b)
    dx, dy, cos_theta, sin_theta = aim
    lever = b * cos_theta - depth * sin_theta
    bracket = (a * a + lever * lever) * load(p, P_BRACKET)
    force = 2.0 * v / (1.0 + load(p, P_MASS_RATIO) + 2.5 / (radius * radius) * bracket)  # F / m
    turn = force / (load(p, P_INERTIA) * radius * radius)  # F / I
    along = a * sin_theta * turn
    across = lever * turn
    speed = force * cos_theta
    return (
        speed * dx,
        speed * dy,
        along * dx - across * dy,
        along * dy + across * dx,
        a * cos_theta * turn,
    )


@small_kernel
def blocked_by_ball(px, py, pz, ux, uy, uz, length, radius):
    """Whether the segment of ``length`` from the origin along unit (ux, uy, uz) comes nearer to p than ``radius``."""
    along = px * ux + py * uy + pz * uz
    along = min(max(along, 0.0), length)
    gx = px - along * ux
    gy = py - along * uy
    gz = pz - along * uz
    return gx * gx + gy * gy + gz * gz < radius * radius


@small_kernel
def below_nose(start, step, line, height, rise, length, nose):
    """Whether the cue crosses the vertical plane at ``line`` no higher than the nose of the cushion."""
    end = start + step * length
    if (start < line) == (end < line) or step == 0.0:
        return False
    return height + rise * ((line - start) / step) <= nose


@kernel
def obstacle(p, w, aim, a, b):
    """What blocks the cue: NOBODY, or the number of the first obstacle. ``a`` and ``b`` in metres.

    Balls off the table lie far away and block nothing.

    The cue is the segment from the tip r - c d - a l, at height R + b, along (-C d, S).
    """
    radius = load(p, P_RADIUS)
    depth = math.sqrt(radius * radius - a * a - b * b)
    dx, dy, cos_theta, sin_theta = aim
    if depth * cos_theta + b * sin_theta <= 0.0:
        return THROUGH_CUE_BALL
    length = load(p, P_CUE_LENGTH)
    ux, uy = -cos_theta * dx, -cos_theta * dy
    tip_x = load(w, X) - depth * dx + a * dy
    tip_y = load(w, Y) - depth * dy - a * dx
    blocking = 0
    for ball in range(LANES):
        px, py = load(w, X + ball) - tip_x, load(w, Y + ball) - tip_y
        blocking |= int(blocked_by_ball(px, py, -b, ux, uy, sin_theta, length, radius)) << ball
    blocking &= ~1
    if blocking != 0:
        return lowest_bit(blocking)
    half_x, half_y, nose = load(p, P_HALF_X), load(p, P_HALF_Y), load(p, P_NOSE)
    height = radius + b
    if below_nose(tip_x, ux, -half_x, height, sin_theta, length, nose):
        return THROUGH_CUE_BALL + 1
    if below_nose(tip_x, ux, half_x, height, sin_theta, length, nose):
        return THROUGH_CUE_BALL + 2
    if below_nose(tip_y, uy, -half_y, height, sin_theta, length, nose):
        return THROUGH_CUE_BALL + 3
    if below_nose(tip_y, uy, half_y, height, sin_theta, length, nose):
        return THROUGH_CUE_BALL + 4
    return NOBODY


@kernel
def unplayable(p, w, k, v, theta, aim, a, b):
    """Status number of a shot that cannot be played, or 0. ``theta`` in deg, ``a`` and ``b`` in metres."""
    radius = load(p, P_RADIUS)
    if not (0.0 <= v <= load(p, P_V_MAX) and 0.0 <= theta <= load(p, P_THETA_MAX)):
        return OUT_OF_RANGE
    if load_integer(k, MOTION) == ABSENT or load_integer(k, MOTION) == POCKETED:
        return NO_CUE_BALL
    if a * a + b * b > radius * radius:
        return TIP_OFF_BALL
    if load(p, P_CUE_TEST) != 0.0 and obstacle(p, w, aim, a, b) != NOBODY:
        return CUE_OBSTRUCTED
    return PLAYABLE


@kernel
def lowest_elevation(p, w, phi, a, b):
    """Smallest elevation in degrees at which nothing blocks the cue, NaN if none.

    The free elevations need not be one interval (a low tip passes under a ball's widest part), so they are looked
    for in steps of 1/8 deg and the edge of the first found is bisected to the last bit.
    """
    if obstacle(p, w, direction(phi, 0.0), a, b) == NOBODY:
        return 0.0
    top = load(p, P_THETA_MAX)
    low = 0.0
    while low < top:
        high = min(low + 0.125, top)
        if obstacle(p, w, direction(phi, high), a, b) == NOBODY:
            middle = 0.5 * (low + high)
            while low < middle < high:
                if obstacle(p, w, direction(phi, middle), a, b) == NOBODY:
                    high = middle
                else:
                    low = middle
                middle = 0.5 * (low + high)
            return high
        low = high
    return math.nan
