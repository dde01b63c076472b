"""Cushion laws that know spin and speed, on the cloth: ``han`` and ``mathavan`` (docs/physics.md, eq. 33-35).

A cushion touches the ball at the height of its nose, above the centre: its normal N = cos n + sin k points down,
sin = -(h - R)/R, with n the normal in plan. The cloth takes up the vertical part: nothing leaves it.
"""

import math

from physics.kernels.compiling import kernel, small_kernel
from physics.kernels.resolve.fixed import NO_CONTACT_SLIP, STICKING_SHARE, impact

STEPS = 200
"""Steps in which the approach of ``mathavan`` would be stopped without friction. Of second order: ten times as many
change a rebound by less than 1e-5."""

STEP_LIMIT = 20 * STEPS
"""Steps after which either phase ends where it is. Friction makes a phase up to twice as long; far longer only where it
jams a slow ball with much spin (mu_cushion and mu_slide near 1), which then keeps no speed across the cushion."""


@small_kernel
def han(radius, v, w, normal, e, mu):
    """Han 2005, sec. 3 (errata repaired): the impact law at the nose, the vertical speed taken up by the cloth.

    ``v`` (2,) m/s, ``w`` (3,) rad/s, ``normal`` (3,). Returns v, w.
    """
    (vx, vy, _), turned = impact(radius, (v[0], v[1], 0.0), w, normal, e, mu)
    return (vx, vy), turned


@small_kernel
def limited(size, slip):
    """Factor on a slip vector that makes it a friction of ``size``, or of what stops the slip if that is less."""
    if slip <= NO_CONTACT_SLIP:
        return 0.0
    return min(size, STICKING_SHARE * slip) / slip


@small_kernel
def pushed(radius, state, at, normal, mu, mu_bed, push):
    """``state`` after a small normal impulse ``push`` (m/s) with the friction that the slips of ``at`` call for.

    At the nose f = -mu s^; the cloth answers what presses down, B = max(0, -(N + f)_z), with its own friction
    -mu_bed B u^; the vertical part is absorbed. States: vx vy wx wy wz.
    """
    vx, vy, wx, wy, wz = at
    nx, ny, nz = normal
    speed = nx * vx + ny * vy
    sx = vx - speed * nx + radius * (ny * wz - nz * wy)
    sy = vy - speed * ny + radius * (nz * wx - nx * wz)
    sz = -speed * nz + radius * (nx * wy - ny * wx)
    rub = limited(mu * push, math.sqrt((sx * sx + sy * sy) + sz * sz))
    fx, fy, fz = -rub * sx, -rub * sy, -rub * sz
    ux, uy = vx - radius * wy, vy + radius * wx
    press = max(0.0, -(push * nz + fz))
    drag = limited(mu_bed * press, math.sqrt(ux * ux + uy * uy))
    gx, gy = -drag * ux, -drag * uy
    turn = 2.5 / radius
    return (
        state[0] + (push * nx + fx + gx),
        state[1] + (push * ny + fy + gy),
        state[2] - turn * ((ny * fz - nz * fy) - gy),
        state[3] - turn * ((nz * fx - nx * fz) + gx),
        state[4] - turn * (nx * fy - ny * fx),
    )


@small_kernel
def step(radius, state, normal, mu, mu_bed, push):
    """One midpoint step of the normal impulse."""
    middle = pushed(radius, state, state, normal, mu, mu_bed, 0.5 * push)
    return pushed(radius, state, middle, normal, mu, mu_bed, push)


@small_kernel
def opening(state, normal):
    """Speed of the contact point along N, m/s: negative while the cushion is compressed."""
    return normal[0] * state[0] + normal[1] * state[1]


@kernel
def compressed(radius, state, normal, mu, mu_bed, push):
    """(state, work): the phase until nothing approaches, and the work the cushion has taken up, m^2/s^2."""
    work = 0.0
    speed = opening(state, normal)
    for _ in range(STEP_LIMIT):
        after = step(radius, state, normal, mu, mu_bed, push)
        speed_after = opening(after, normal)
        if speed_after >= 0.0:
            part = speed / (speed - speed_after) * push
            return step(radius, state, normal, mu, mu_bed, part), work - 0.5 * speed * part
        work -= 0.5 * (speed + speed_after) * push
        state, speed = after, speed_after
    across = speed / (normal[0] * normal[0] + normal[1] * normal[1])
    return (state[0] - across * normal[0], state[1] - across * normal[1], state[2], state[3], state[4]), 0.0


@kernel
def restored(radius, state, normal, mu, mu_bed, push, work):
    """The state after the phase in which the cushion gives ``work`` back."""
    speed = max(opening(state, normal), 0.0)
    for _ in range(STEP_LIMIT):
        if work <= 0.0:
            break
        after = step(radius, state, normal, mu, mu_bed, push)
        speed_after = max(opening(after, normal), 0.0)
        given = 0.5 * (speed + speed_after) * push
        if given >= work:
            return step(radius, state, normal, mu, mu_bed, work / given * push)
        work -= given
        state, speed = after, speed_after
    return state


@small_kernel
def kinetic(radius, state):
    """Twice the energy per mass, m^2/s^2."""
    vx, vy, wx, wy, wz = state
    return (vx * vx + vy * vy) + 0.4 * radius * radius * ((wx * wx + wy * wy) + wz * wz)


@kernel
def mathavan(radius, v, w, normal, e, mu, mu_bed):
    """Mathavan, Jackson & Parkin 2010, eq. 12-18: friction at nose and cloth, integrated over the normal impulse.

    Without angles, so that its bits are the same everywhere: compressed until v.N = 0, then e^2 of the work is given
    back. ``v`` (2,) m/s, ``w`` (3,) rad/s, ``normal`` (3,); ``mu_bed``: friction of the cloth. Returns v, w.
    Homogeneous: twice the speeds and spins give twice the result. Energy that the step adds is taken out again.
    """
    start = (v[0], v[1], w[0], w[1], w[2])
    speed = opening(start, normal)
    if speed >= 0.0:
        return v, w
    push = -speed / (STEPS * (normal[0] * normal[0] + normal[1] * normal[1]))
    state, work = compressed(radius, start, normal, mu, mu_bed, push)
    state = restored(radius, state, normal, mu, mu_bed, push, e * e * work)
    before, after = kinetic(radius, start), kinetic(radius, state)
    keep = math.sqrt(before / after) if after > before else 1.0
    return (keep * state[0], keep * state[1]), (keep * state[2], keep * state[3], keep * state[4])
