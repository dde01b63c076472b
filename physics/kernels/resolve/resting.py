"""Step 3 of the contact rule: contacts that would come back at once (docs/physics.md, eq. 29-31)."""

import math

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, small_kernel, store
from physics.kernels.resolve.ball_ball import approach
from physics.kernels.resolve.flight import any_flies
from physics.kernels.resolve.impulses import linked_to, push_group
from physics.kernels.resolve.touching import listed, pair
from physics.kernels.resolve.vertical import plus_square, scale_vertical, vertical_speed
from physics.kernels.tolerances import PARTING_SHARE, PARTING_SLACK, PRESSING, SLOW_APPROACH, STILL, STOP_BELOW
from physics.kernels.workspace import by_table


@small_kernel
def pressing_on_cloth(s, touch):
    """See ``pressing``."""
    i, j, nx, ny, _ = touch
    ax = 2.0 * (load(s.w, at.HX + j) - load(s.w, at.HX + i))
    ay = 2.0 * (load(s.w, at.HY + j) - load(s.w, at.HY + i))
    vt = (load(s.w, at.VY + j) - load(s.w, at.VY + i)) * nx - (load(s.w, at.VX + j) - load(s.w, at.VX + i)) * ny
    return -(nx * ax + ny * ay) - vt * vt / (2.0 * load(s.p, at.P_RADIUS))


@kernel
def pressing_in_air(s, touch):
    """See ``pressing``: gravity presses too."""
    i, j, nx, ny, nz = touch
    ax = 2.0 * (load(s.w, at.HX + j) - load(s.w, at.HX + i))
    ay = 2.0 * (load(s.w, at.HY + j) - load(s.w, at.HY + i))
    az = 2.0 * (load(s.w, at.HZ + j) - load(s.w, at.HZ + i))
    vx = load(s.w, at.VX + j) - load(s.w, at.VX + i)
    vy = load(s.w, at.VY + j) - load(s.w, at.VY + i)
    vz = load(s.w, at.VZ + j) - load(s.w, at.VZ + i)
    tx, ty, tz = ny * vz - nz * vy, nz * vx - nx * vz, nx * vy - ny * vx  # n x v: as long as v_t
    across = (tx * tx + ty * ty) + tz * tz
    return -((nx * ax + ny * ay) + nz * az) - across / (2.0 * load(s.p, at.P_RADIUS))


@kernel
def pressing_anywhere(s, touch):
    """See ``pressing``."""
    if any_flies(s, 1 << touch.i | 1 << touch.j):
        return pressing_in_air(s, touch)
    return pressing_on_cloth(s, touch)


pressing = by_table(pressing_on_cloth, pressing_anywhere)
"""``pressing(s, touch)``: acceleration at which the gap between touching balls closes, m/s^2:
A = -n.(a2 - a1) - |v_t|^2 / 2R (eq. 29)."""


@small_kernel
def missing_speed(s, touch):
    """By how much a touching pair should open faster, m/s: so as not to meet again within the rest time, nor now."""
    # gap(t) = u t - A t^2 / 2, u the opening speed: closed again at t = 2 u / A, within tau if u < A tau / 2 (eq. 30)
    half = 0.5 * pressing(s, touch) * load(s.p, at.P_REST_TIME)
    opening = -approach(s, touch)
    wanted = max(PARTING_SHARE * half, 2.0 * SLOW_APPROACH)
    if half > 0.5 * PRESSING * load(s.p, at.P_REST_TIME) and opening < half and opening < wanted - PARTING_SLACK:
        return wanted - opening
    return -opening if -opening > PARTING_SLACK else 0.0


@kernel
def part_pressed_pairs(s):
    """Part every touching pair that would meet again within the rest time, all at once; bit set of those changed.

    What one pair's parting presses on acts with them in the next round, plastically: the closing speed of such a pair
    is missing as well.
    """
    for n in range(load_integer(s.k, at.N_PAIRS)):
        store(s.w, at.CLOSING + n, missing_speed(s, listed(s, n)))
    changed = 0
    for n in range(load_integer(s.k, at.N_PAIRS)):
        i, j = pair(s, n)
        if load(s.w, at.CLOSING + n) > 0.0 and changed >> i & 1 == 0:
            group = linked_to(s, i, j)
            push_group(s, group, 1.0)
            changed |= group
    return changed


@kernel
def energy(s, members):
    """Kinetic energy of ``members`` per ball mass, m^2/s^2."""
    inertia = 0.4 * load(s.p, at.P_RADIUS) * load(s.p, at.P_RADIUS)  # I / m = 2/5 R^2
    twice = 0.0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        vx, vy = load(s.w, at.VX + i), load(s.w, at.VY + i)
        wx, wy, wz = load(s.w, at.WX + i), load(s.w, at.WY + i), load(s.w, at.WZ + i)
        moving = plus_square(s, vx * vx + vy * vy, vertical_speed(s, i))
        twice += moving + inertia * (wx * wx + wy * wy + wz * wz)
    return 0.5 * twice


@kernel
def scale_down(s, members, allowed, in_air):
    """Scale velocities and spins so that the cluster's energy is at most ``allowed``; whether it had to (eq. 31).

    One that would lose more than half stops instead, unless a ball of it is ``in_air``.
    """
    now = energy(s, members)
    if now <= allowed:
        return False
    scale = math.sqrt(allowed / now) if in_air or allowed >= STOP_BELOW * now else 0.0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        for quantity in at.SPEEDS:
            store(s.w, quantity + i, scale * load(s.w, quantity + i))
        scale_vertical(s, i, scale)
    return True


@kernel
def lay_still(s, members):
    """Stop the members that hardly move; bit set of them."""
    stopped = 0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        size = energy(s, 1 << i)
        if 0.0 < size <= 0.5 * STILL * STILL:
            for quantity in at.SPEEDS:
                store(s.w, quantity + i, 0.0)
            scale_vertical(s, i, 0.0)
            stopped |= 1 << i
    return stopped
