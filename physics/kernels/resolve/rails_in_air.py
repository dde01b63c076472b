"""A flying ball at the noses, horns and facings of a table with jaws: what it touches, and what they do to it.

A nose gives a flying ball the impact law with its normal in space, and keeps the vertical speed (docs/physics.md,
eq. 33, 47). Gravity cannot be held as friction can: where it presses a ball against a nose, the ball is parted from it
as touching balls are.
"""

import math
from typing import NamedTuple

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load, small_kernel, store
from physics.kernels.detect.jaws import from_facing
from physics.kernels.detect.mouths import (
    beside_long_nose,
    beside_short_nose,
    corner_near,
    end_jaw,
    jaw_at,
    side_near,
    upper_jaw,
)
from physics.kernels.resolve.fixed import impact
from physics.kernels.resolve.flight import set_motion, spin_of, velocity_of
from physics.kernels.tolerances import PARTING_SHARE, PARTING_SLACK, PRESS_TIME, SLOW_APPROACH, TOUCH


class Edge(NamedTuple):
    """An edge where a flying ball touches it.

    Attributes:
        nx, ny, nz: unit normal from it to the centre. gap: m in plan, of the centre from nose line, facing or horn.
        far: m, of the centre from the middle of the horn in plan; infinite at a straight edge.
    """

    nx: float
    ny: float
    nz: float
    gap: float
    far: float


@small_kernel
def is_at_edge(gap, zeta, near):
    """Whether a centre ``gap`` from an edge in plan, ``zeta`` above it, is within ``near`` of it."""
    return (gap >= 0.0) & (gap * gap + zeta * zeta <= near * near)


@small_kernel
def is_at_jaw(jaw, near, zeta, s, d):
    """Whether a flying ball in jaw coordinates touches the facing, beside it, or the horn, round it."""
    gap, foot = from_facing(jaw, s, d)
    if foot >= 0.0:
        return (foot <= jaw.length) & is_at_edge(gap, zeta, near)
    from_s, from_d = s - jaw.nose_end, d + jaw.horn
    return (s < jaw.nose_end) & is_at_edge(math.sqrt(from_s * from_s + from_d * from_d) - jaw.horn, zeta, near)


@kernel
def touched_in_air(s, i):
    """Number of the cushion or jaw that flying ball ``i`` touches, or NO_CUSHION. At most one."""
    x, y = load(s.w, at.X + i), load(s.w, at.Y + i)
    near = load(s.p, at.P_RADIUS) + TOUCH
    zeta = load(s.w, at.Z + i) - load(s.p, at.P_NOSE_RISE)
    u, v = load(s.p, at.P_HALF_X) - abs(x), load(s.p, at.P_HALF_Y) - abs(y)
    if ((u > near) & (v > near)) | (zeta > near):
        return at.NO_CUSHION
    if beside_long_nose(s, y) & is_at_edge(u, zeta, near):
        return at.EAST if x > 0.0 else at.WEST
    if beside_short_nose(s, x) & is_at_edge(v, zeta, near):
        return at.NORTH if y > 0.0 else at.SOUTH
    corner = jaw_at(s, at.P_CORNER_JAW)
    if (u < corner.nose_end) & (v < corner.nose_end):
        first = end_jaw(corner_near(x, y))
        if is_at_jaw(corner, near, zeta, u, v):
            return at.FIRST_JAW + first
        return at.FIRST_JAW + (first ^ 1) if is_at_jaw(corner, near, zeta, v, u) else at.NO_CUSHION
    side = jaw_at(s, at.P_SIDE_JAW)
    if (abs(y) < side.nose_end) & is_at_jaw(side, near, zeta, abs(y), u):
        first = upper_jaw(side_near(x))
        return at.FIRST_JAW + (first if y > 0.0 else first ^ 1)
    return at.NO_CUSHION


@kernel
def edge_of(s, wall, i):
    """The edge of a wall, where flying ball ``i`` touches it: its normal leans by the height above the nose."""
    zeta = load(s.w, at.Z + i) - load(s.p, at.P_NOSE_RISE)
    gap = max(wall.distance, 0.0)
    distance = math.sqrt(gap * gap + zeta * zeta)
    across = gap / distance
    far = gap + 1.0 / wall.bend - load(s.p, at.P_RHO) if wall.bend > 0.0 else math.inf
    return Edge(across * wall.nx, across * wall.ny, zeta / distance, gap, far)


@small_kernel
def opening_in_air(s, edge, i):
    """Speed of ball ``i`` away from an edge, m/s."""
    plan = load(s.w, at.VX + i) * edge.nx + load(s.w, at.VY + i) * edge.ny
    return plan + load(s.w, at.VZ + i) * edge.nz


@kernel
def rebound_in_air(s, edge, i):
    """A collision with an edge: the impact law. A nose over the ball's middle presses it down, for PRESS_TIME."""
    e, mu = load(s.p, at.P_E_CUSHION), load(s.p, at.P_MU_CUSHION)
    normal = (edge.nx, edge.ny, edge.nz)
    v, w = impact(load(s.p, at.P_RADIUS), velocity_of(s, i), spin_of(s, i), normal, e, mu)
    set_motion(s, i, v, w)
    if (edge.nz < 0.0) & (v[2] < 0.0):
        store(s.w, at.PRESSED + i, load(s.w, at.SINCE + i) + PRESS_TIME)


@small_kernel
def open_at(s, edge, i, speed):
    """Let ball ``i`` open from an edge at ``speed``; nothing else changes."""
    more = speed - opening_in_air(s, edge, i)
    store(s.w, at.VX + i, load(s.w, at.VX + i) + more * edge.nx)
    store(s.w, at.VY + i, load(s.w, at.VY + i) + more * edge.ny)
    store(s.w, at.VZ + i, load(s.w, at.VZ + i) + more * edge.nz)


@kernel
def half_towards_edge(s, edge, wall, i):
    """Half the acceleration at which ball ``i`` returns to an edge, m/s^2: gravity's, less the centrifugal of its arc.

    The distance is g = sqrt(gap^2 + zeta^2): g'' = (gap'^2 + zeta'^2 - g'^2 + gap gap'' + zeta zeta'') / g, where gap''
    is |v along|^2 / far round a horn.
    """
    vx, vy, vz = velocity_of(s, i)
    across, along = vx * wall.nx + vy * wall.ny, vy * wall.nx - vx * wall.ny
    opening = opening_in_air(s, edge, i)
    round_edge = across * across + vz * vz - opening * opening
    round_horn = edge.gap * (along * along) / edge.far
    gravity = 2.0 * load(s.w, at.HZ + i) * edge.nz
    return -0.5 * ((round_edge + round_horn) / load(s.p, at.P_RADIUS) + gravity)


@small_kernel
def returns_in_air(s, edge, wall, i):
    """Whether gravity brings ball ``i`` back to an edge it touches within the rest time."""
    half = half_towards_edge(s, edge, wall, i)
    wanted = max(PARTING_SHARE * half * load(s.p, at.P_REST_TIME), 2.0 * SLOW_APPROACH)
    opening = opening_in_air(s, edge, i)
    return half > 0.0 and opening < half * load(s.p, at.P_REST_TIME) and opening < wanted - PARTING_SLACK


@small_kernel
def hold_in_air(s, edge, wall, i):
    """A soft touch, or one that gravity would renew at once: the ball opens so fast that it stays away long enough."""
    half = max(half_towards_edge(s, edge, wall, i), 0.0)
    open_at(s, edge, i, max(PARTING_SHARE * half * load(s.p, at.P_REST_TIME), 2.0 * SLOW_APPROACH))
