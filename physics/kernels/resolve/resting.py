"""Step 3 of the contact rule: contacts that would come back at once (docs/physics.md, eq. 29-31)."""

import math

from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, small_kernel, store
from physics.kernels.layout import (
    CLOSING,
    HX,
    HY,
    N_PAIRS,
    NORMAL_X,
    NORMAL_Y,
    P_RADIUS,
    P_REST_TIME,
    PAIRS,
    VX,
    VY,
    WX,
    WY,
    WZ,
)
from physics.kernels.resolve.ball_ball import approach
from physics.kernels.resolve.impulses import linked_to, push_group
from physics.kernels.resolve.touching import towards_cushion
from physics.kernels.tolerances import PARTING_SHARE, PARTING_SLACK, PRESSING, SLOW_APPROACH, STILL, STOP_BELOW


@small_kernel
def returns_at_once(p, w, i, cushion):
    """Whether ball ``i``'s own acceleration brings it back to a cushion it touches within the rest time."""
    half = towards_cushion(w, cushion, HX, HY, i)
    return half > 0.0 and -towards_cushion(w, cushion, VX, VY, i) < half * load(p, P_REST_TIME)


@small_kernel
def pressing(p, w, i, j, nx, ny):
    """Acceleration at which the gap between touching balls closes, m/s^2: A = -n.(a2 - a1) - |v_t|^2 / 2R."""
    ax = 2.0 * (load(w, HX + j) - load(w, HX + i))
    ay = 2.0 * (load(w, HY + j) - load(w, HY + i))
    vt = (load(w, VY + j) - load(w, VY + i)) * nx - (load(w, VX + j) - load(w, VX + i)) * ny
    return -(nx * ax + ny * ay) - vt * vt / (2.0 * load(p, P_RADIUS))


@small_kernel
def missing_speed(p, w, i, j, nx, ny):
    """By how much a touching pair should open faster, m/s: so as not to meet again within the rest time, nor now."""
    half = 0.5 * pressing(p, w, i, j, nx, ny) * load(p, P_REST_TIME)
    opening = -approach(w, i, j, nx, ny)
    wanted = max(PARTING_SHARE * half, 2.0 * SLOW_APPROACH)
    if half > 0.5 * PRESSING * load(p, P_REST_TIME) and opening < half and opening < wanted - PARTING_SLACK:
        return wanted - opening
    return -opening if -opening > PARTING_SLACK else 0.0


@kernel
def part_pressed_pairs(p, w, k):
    """Part every touching pair that would meet again within the rest time, all at once; bit set of those changed.

    What one pair's parting presses on acts with them in the next round, plastically: the closing speed of such a pair
    is missing as well.
    """
    for n in range(load_integer(k, N_PAIRS)):
        pair = load_integer(k, PAIRS + n)
        nx, ny = load(w, NORMAL_X + n), load(w, NORMAL_Y + n)
        store(w, CLOSING + n, missing_speed(p, w, pair >> 4, pair & 15, nx, ny))
    changed = 0
    for n in range(load_integer(k, N_PAIRS)):
        pair = load_integer(k, PAIRS + n)
        if load(w, CLOSING + n) > 0.0 and changed >> (pair >> 4) & 1 == 0:
            group = linked_to(w, k, pair)
            push_group(w, k, group, 1.0)
            changed |= group
    return changed


@kernel
def energy(p, w, members):
    """Kinetic energy of ``members`` per ball mass, m^2/s^2."""
    inertia = 0.4 * load(p, P_RADIUS) * load(p, P_RADIUS)
    twice = 0.0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        vx, vy = load(w, VX + i), load(w, VY + i)
        wx, wy, wz = load(w, WX + i), load(w, WY + i), load(w, WZ + i)
        twice += vx * vx + vy * vy + inertia * (wx * wx + wy * wy + wz * wz)
    return 0.5 * twice


@kernel
def scale_down(p, w, members, allowed):
    """Scale the cluster's velocities and spins so that its energy is at most ``allowed``; whether it had to."""
    now = energy(p, w, members)
    if now <= allowed:
        return False
    scale = math.sqrt(allowed / now) if allowed >= STOP_BELOW * now else 0.0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        for quantity in (VX, VY, WX, WY, WZ):
            store(w, quantity + i, scale * load(w, quantity + i))
    return True


@kernel
def lay_still(p, w, members):
    """Stop the members that hardly move; bit set of them."""
    stopped = 0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        size = energy(p, w, 1 << i)
        if 0.0 < size <= 0.5 * STILL * STILL:
            for quantity in (VX, VY, WX, WY, WZ):
                store(w, quantity + i, 0.0)
            stopped |= 1 << i
    return stopped
