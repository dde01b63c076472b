"""Two balls: friction that falls with the slip (``alciatore``), and the impact law in space.

Alciatore, TP A-14, after Marlow's data (docs/physics.md, eq. 36)::

    mu(|s|) = 9.951e-3 + 0.108 exp(-1.088 |s|)        t = min(mu J, |s| / 7)
"""

import math

from physics.kernels.compiling import small_kernel

FRICTION_AT_SPEED, FRICTION_MORE, FRICTION_FALLS = 9.951e-3, 0.108, 1.088
"""Friction of a fast slip; what a slow one has more; how fast that fades, s/m."""

PER_LOG_TWO = 1.4426950408889634
LOG_TWO_HIGH, LOG_TWO_LOW = 0.6931471803691238, 1.9082149292705877e-10
"""ln 2 to 33 bits, so that a multiple of it is exact, and the rest."""

FADED = 43.0
"""From here on exp(-x), below 2^-62, adds nothing to the friction."""


@small_kernel
def fading(x):
    """exp(-x) for x >= 0 by a fixed sequence of + - * /, within 2 ulp; 0 from FADED on.

    x = k ln 2 + r; exp(-r) is the sum of (-r)^i / i! up to i = 13, and 2^-k is exact.
    """
    if not x < FADED:
        return 0.0
    k = math.floor(x * PER_LOG_TWO + 0.5)
    r = (x - k * LOG_TWO_HIGH) - k * LOG_TWO_LOW
    high = 2.505210838544172e-08 - r * (2.08767569878681e-09 - r * 1.6059043836821613e-10)
    middle = 2.48015873015873e-05 - r * (2.7557319223985893e-06 - r * (2.755731922398589e-07 - r * high))
    low = 0.008333333333333333 - r * (0.001388888888888889 - r * (0.0001984126984126984 - r * middle))
    total = 1.0 - r * (1.0 - r * (0.5 - r * (0.16666666666666666 - r * (0.041666666666666664 - r * low))))
    return total / float(1 << int(k))


@small_kernel
def friction(slip):
    """Coefficient of friction between balls that slip at ``slip`` m/s."""
    return FRICTION_AT_SPEED + FRICTION_MORE * fading(FRICTION_FALLS * slip)


@small_kernel
def length(vector):
    """Of a vector of three components; those in the plane are summed first: exchanging them keeps the bits."""
    x, y, z = vector
    return math.sqrt((x * x + y * y) + z * z)


@small_kernel
def slip_in_space(radius, normal, one, two):
    """The slip v1 - v2 - R n x (w1 + w2) without its normal part, three components.

    ``one`` and ``two``: (v, w), three components each; ``normal`` from ball 1 to ball 2.
    """
    (ax, ay, az), (px, py, pz) = one
    (bx, by, bz), (qx, qy, qz) = two
    nx, ny, nz = normal
    dx, dy, dz = ax - bx, ay - by, az - bz
    wx, wy, wz = px + qx, py + qy, pz + qz
    closing = (nx * dx + ny * dy) + nz * dz
    return (
        dx - closing * nx - radius * (ny * wz - nz * wy),
        dy - closing * ny - radius * (nz * wx - nx * wz),
        dz - closing * nz - radius * (nx * wy - ny * wx),
    )


@small_kernel
def rubbed(radius, normal, slip, size, most, share):
    """Friction against a slip of ``size``: (change of ball 1's velocity, of both spins).

    The impulse is at most ``most`` (m/s), and |slip| / (7 ``share``), which ends the slip of ``share`` contacts.
    """
    if size == 0.0:
        return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    nx, ny, nz = normal
    sx, sy, sz = slip
    rub = min(most, size / (7.0 * share)) / size
    turn = -2.5 * rub / radius
    return (
        (-rub * sx, -rub * sy, -rub * sz),
        (turn * (ny * sz - nz * sy), turn * (nz * sx - nx * sz), turn * (nx * sy - ny * sx)),
    )


@small_kernel
def collide_in_space(radius, normal, one, two, e, mu):
    """Two balls of equal mass, anywhere: normal impulse (1 + e)/2 v_n, then friction (docs/physics.md, eq. 37).

    Arguments as for ``slip_in_space``, ``mu`` of friction; balls that do not approach stay as they are.
    Returns (v1, w1), (v2, w2).
    """
    (ax, ay, az), (px, py, pz) = one
    (bx, by, bz), (qx, qy, qz) = two
    nx, ny, nz = normal
    closing = (nx * (ax - bx) + ny * (ay - by)) + nz * (az - bz)
    if closing <= 0.0:
        return one, two
    push = 0.5 * (1.0 + e) * closing
    slip = slip_in_space(radius, normal, one, two)
    (rx, ry, rz), (tx, ty, tz) = rubbed(radius, normal, slip, length(slip), mu * push, 1.0)
    return (
        ((ax - push * nx + rx, ay - push * ny + ry, az - push * nz + rz), (px + tx, py + ty, pz + tz)),
        ((bx + push * nx - rx, by + push * ny - ry, bz + push * nz - rz), (qx + tx, qy + ty, qz + tz)),
    )
