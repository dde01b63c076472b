"""What a flying ball meets: noses, facings and horns, the top of the rails, pockets, the outer edge.

In plan a flight is a straight line. While it keeps R or more from all four nose lines it meets nothing but balls and
cloth: that is the broad phase. Else every nose of the lines it comes near to and every mouth whose pieces it may come
near to is looked for over the whole path (docs/physics.md, eq. 47-50). Coordinates and signs: as in ``mouths``.
"""

import math

from physics.kernels import layout as at
from physics.kernels.apart import apart
from physics.kernels.compiling import kernel, load, load_integer, small_kernel, store_integer
from physics.kernels.detect.boundary import Coming
from physics.kernels.detect.edges_in_air import meets_edge, meets_ring
from physics.kernels.detect.jaws import from_facing
from physics.kernels.detect.mouths import (
    end_jaw,
    from_nose_lines,
    is_corner,
    jaw_at,
    signs_of,
    swapped,
    upper_jaw,
)
from physics.kernels.detect.rail_top import falls_to, from_hole, hole_radius, is_over_rail
from physics.kernels.path import Path, RingPath, Rise, along
from physics.kernels.tolerances import RAIL_CAP, TOUCH
from physics.kernels.workspace import RealWorkspace

SPARE = 1e-3
"""m. By so much more than they reach, mouths are looked at: more is only slower."""


@small_kernel
def earlier(best, time, kind, number):
    """The event at ``time`` if it is earlier than ``best``, else that."""
    return Coming(time, kind, number) if time < best.time else best


@apart(Coming, RealWorkspace, int, int, Path, Rise, float, Coming)
@kernel
def meet_jaw_in_air(s, mouth, number, path, rise, lasts, best):
    """Jaw ``number``, before ``best``; ``path`` in its coordinates, ``rise`` above the nose."""
    jaw, radius = jaw_at(s, mouth), load(s.p, at.P_RADIUS)
    gap, foot = from_facing(jaw, path.x, path.y)
    gap_speed = path.vx * jaw.normal_s + path.vy * jaw.normal_d
    foot_speed = path.vy * jaw.normal_s - path.vx * jaw.normal_d
    t = meets_edge(radius, (gap, gap_speed), (foot, foot_speed), (0.0, jaw.length), rise, lasts, best.time)
    best = earlier(best, t, at.MEET_JAW, at.FIRST_JAW + number)
    ring = RingPath(path.x - jaw.nose_end, path.y + jaw.horn, rise.z, path.vx, path.vy, rise.vz, rise.hz, jaw.horn)
    t = meets_ring(radius, ring, lasts, best.time)
    return earlier(best, t, at.MEET_JAW, at.FIRST_JAW + number)


@small_kernel
def leaves_circle(path, radius):
    """When a straight path leaves a circle about its origin; infinity if it does not, or never is in it."""
    speed_squared = path.vx * path.vx + path.vy * path.vy
    out = path.x * path.vx + path.y * path.vy
    beyond = path.x * path.x + path.y * path.y - radius * radius
    inside = out * out - speed_squared * beyond
    if (speed_squared == 0.0) | (inside <= 0.0) | ((beyond >= 0.0) & (out >= 0.0)):
        return math.inf
    root = math.sqrt(inside)
    return (root - out) / speed_squared if out <= 0.0 else -beyond / (out + root)


@small_kernel
def is_on_shelf(s, pocket, x, y):
    """Whether a place on a drop edge, from its middle, is on the table's side: before both facings and the middle."""
    mouth = at.P_CORNER_JAW if is_corner(pocket) else at.P_SIDE_JAW
    jaw = jaw_at(s, mouth)
    u, v = x + load(s.p, mouth + at.HOLE_U), y + load(s.p, mouth + at.HOLE_V)
    if is_corner(pocket):
        one, _ = from_facing(jaw, u, v)
        other, _ = from_facing(jaw, v, u)
        return (one > 0.0) & (other > 0.0) & (x + y > 0.0)
    one, _ = from_facing(jaw, v, u)
    other, _ = from_facing(jaw, -v, u)
    return (one > 0.0) & (other > 0.0) & (x > 0.0)


@kernel
def meet_liner(s, pocket, path, height, lasts, best):
    """The liner of a pocket, before ``best``: a ball that leaves the hole towards the rail, no higher than its cap."""
    here = from_hole(s, pocket, path)
    t = leaves_circle(here, hole_radius(s, pocket))
    if not t < min(best.time, lasts):
        return best
    if is_on_shelf(s, pocket, here.x + t * here.vx, here.y + t * here.vy):
        return best
    return Coming(t, at.MEET_POCKET, pocket) if along(height.z, height.vz, height.hz, t) < RAIL_CAP else best


@kernel
def meet_mouth_in_air(s, pocket, path, rise, height, lasts, best):
    """The first of a mouth's jaws and its liner that a flight meets before ``best``."""
    sign_x, sign_y = signs_of(pocket)
    if is_corner(pocket):
        first = end_jaw(pocket)
        here = from_nose_lines(s, path, sign_x, sign_y)
        best = meet_jaw_in_air(s, at.P_CORNER_JAW, first, here, rise, lasts, best)
        best = meet_jaw_in_air(s, at.P_CORNER_JAW, first ^ 1, swapped(here), rise, lasts, best)
        return meet_liner(s, pocket, path, height, lasts, best)
    first = upper_jaw(pocket)
    out, speed = load(s.p, at.P_HALF_X) - sign_x * path.x, -sign_x * path.vx
    upper, lower = Path(path.y, out, path.vy, speed, 0.0, 0.0), Path(-path.y, out, -path.vy, speed, 0.0, 0.0)
    best = meet_jaw_in_air(s, at.P_SIDE_JAW, first, upper, rise, lasts, best)
    best = meet_jaw_in_air(s, at.P_SIDE_JAW, first ^ 1, lower, rise, lasts, best)
    return meet_liner(s, pocket, path, height, lasts, best)


@small_kernel
def nearest_to(half, place, speed, lasts):
    """Least distance from the lines at +half and at -half on a straight path, m: (from the first, from the second)."""
    end = place + lasts * speed
    return half - max(place, end), half + min(place, end)


@kernel
def meet_noses_in_air(s, path, rise, lasts, best):
    """The noses that a flight may come near to, before ``best``."""
    radius, half_x, half_y = load(s.p, at.P_RADIUS), load(s.p, at.P_HALF_X), load(s.p, at.P_HALF_Y)
    corner, side = load(s.p, at.P_CORNER_JAW), load(s.p, at.P_SIDE_JAW)
    near = radius + TOUCH
    east, west = nearest_to(half_x, path.x, path.vx, lasts)
    north, south = nearest_to(half_y, path.y, path.vy, lasts)
    for number in (at.WEST, at.EAST):
        sign = 1.0 if number == at.EAST else -1.0
        if (east if number == at.EAST else west) <= near:
            gap = half_x - sign * path.x, -sign * path.vx
            for end in (-1.0, 1.0):
                foot = end * path.y, end * path.vy
                t = meets_edge(radius, gap, foot, (side, half_y - corner), rise, lasts, best.time)
                best = earlier(best, t, at.MEET_CUSHION, number)
    for number in (at.SOUTH, at.NORTH):
        sign = 1.0 if number == at.NORTH else -1.0
        if (north if number == at.NORTH else south) <= near:
            gap = half_y - sign * path.y, -sign * path.vy
            reach = half_x - corner
            t = meets_edge(radius, gap, (path.x, path.vx), (-reach, reach), rise, lasts, best.time)
            best = earlier(best, t, at.MEET_CUSHION, number)
    return best


@kernel
def may_come_to(s, pocket, path, lasts):
    """Whether a straight path may come near to what belongs to a mouth, the hole included."""
    sign_x, sign_y = signs_of(pocket)
    corner = is_corner(pocket)
    mouth = at.P_CORNER_JAW if corner else at.P_SIDE_JAW
    reach = load(s.p, mouth + at.JAW_NOSE_END) + SPARE
    u = load(s.p, at.P_HALF_X) - max(sign_x * path.x, sign_x * (path.x + lasts * path.vx))
    if corner:
        v = load(s.p, at.P_HALF_Y) - max(sign_y * path.y, sign_y * (path.y + lasts * path.vy))
        return (u <= reach) & (v <= reach)
    end = path.y + lasts * path.vy
    low, high = min(path.y, end), max(path.y, end)
    reach = max(reach, load(s.p, mouth + at.HOLE_RADIUS) + SPARE)
    return (u <= load(s.p, at.P_RADIUS) + load(s.p, mouth + at.JAW_HORN) + SPARE) & (low <= reach) & (high >= -reach)


@kernel
def meet_top(s, path, height, lasts, best):
    """The top of the rails, before ``best``."""
    t = falls_to(height, load(s.p, at.P_NOSE))
    if not t < min(best.time, lasts):
        return best
    over = is_over_rail(s, path.x + t * path.vx, path.y + t * path.vy)
    return Coming(t, at.MEET_TOP, 0) if over else best


@small_kernel
def goes_beyond(place, speed, line):
    """When a straight path goes beyond ``line`` on either side; infinity if never."""
    if speed == 0.0:
        return math.inf
    return max(((line if speed > 0.0 else -line) - place) / speed, 0.0)


@small_kernel
def meet_outer_edge(s, path, best):
    """The outer edge of the rails, beyond which there is nothing, before ``best``."""
    width = load(s.p, at.P_RAIL_WIDTH)
    t = min(
        goes_beyond(path.x, path.vx, load(s.p, at.P_HALF_X) + width),
        goes_beyond(path.y, path.vy, load(s.p, at.P_HALF_Y) + width),
    )
    return earlier(best, t, at.LEAVE, 0)


@apart(Coming, RealWorkspace, Path, Rise, float)
@kernel
def meet_in_air(s, path, height, lasts):
    """The first thing but balls and cloth that a flight meets within ``lasts``, counting from now; NOTHING if none.

    ``path``: in plan, straight. ``height``: Rise of the centre above where it rests on the cloth.
    """
    store_integer(s.k, at.CUSHION_LOOKS, load_integer(s.k, at.CUSHION_LOOKS) + 1)
    best = Coming(lasts, at.NOTHING, 0)
    near = load(s.p, at.P_RADIUS) + TOUCH
    east, west = nearest_to(load(s.p, at.P_HALF_X), path.x, path.vx, lasts)
    north, south = nearest_to(load(s.p, at.P_HALF_Y), path.y, path.vy, lasts)
    if (min(east, west) > near) & (min(north, south) > near):
        return best
    rise = Rise(height.z - load(s.p, at.P_NOSE_RISE), height.vz, height.hz)
    best = meet_noses_in_air(s, path, rise, lasts, best)
    for pocket in range(at.POCKET_SE + 1):
        if may_come_to(s, pocket, path, lasts):
            best = meet_mouth_in_air(s, pocket, path, rise, height, lasts, best)
    best = meet_top(s, path, height, lasts, best)
    return meet_outer_edge(s, path, best)
