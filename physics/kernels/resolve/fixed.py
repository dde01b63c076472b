"""A ball against a fixed body: one impact law for cushions and the cloth (docs/physics.md, eq. 32).

Normal restitution, Coulomb friction, at most sticking. With N the unit normal to the centre, v_n = v.N < 0::

    j = -(1 + e) v_n        s = v - v_n N - R w x N        t = min(mu j, 2 |s| / 7)
    v' = v + j N - t s^     w' = w + 5/(2R) t N x s^

The energy changes by -(1 - e^2) v_n^2 / 2 - t |s| + 7 t^2 / 4: it never rises for e <= 1.
"""

import math

from physics.kernels.compiling import small_kernel

NO_CONTACT_SLIP = 1e-12
"""m/s. A slip at a contact that is no faster is none: rounding of a velocity is 1e-15 m/s."""

STICKING_SHARE = 2.0 / 7.0
"""Impulse, per mass and slip, that stops the slip of a solid sphere."""


@small_kernel
def impact(radius, v, w, normal, e, mu):
    """Velocity (3,) m/s and spin (3,) rad/s after the impact; as they were unless the ball approaches.

    ``radius`` m; ``v``, ``w`` and the unit vector ``normal`` towards the centre have three components.
    """
    vx, vy, vz = v
    wx, wy, wz = w
    nx, ny, nz = normal
    # The two terms in the plane are summed first: exchanging x and y keeps the bits.
    speed = (nx * vx + ny * vy) + nz * vz
    if speed >= 0.0:
        return v, w
    push = -(1.0 + e) * speed
    sx = vx - speed * nx + radius * (ny * wz - nz * wy)
    sy = vy - speed * ny + radius * (nz * wx - nx * wz)
    sz = vz - speed * nz + radius * (nx * wy - ny * wx)
    slip = math.sqrt((sx * sx + sy * sy) + sz * sz)
    vx, vy, vz = vx + push * nx, vy + push * ny, vz + push * nz
    if slip <= NO_CONTACT_SLIP:
        return (vx, vy, vz), w
    rub = min(mu * push, STICKING_SHARE * slip) / slip
    turn = 2.5 * rub / radius
    return (
        (vx - rub * sx, vy - rub * sy, vz - rub * sz),
        (
            wx + turn * (ny * sz - nz * sy),
            wy + turn * (nz * sx - nx * sz),
            wz + turn * (nx * sy - ny * sx),
        ),
    )
