"""When a path on the cloth meets the pieces of a pocket mouth: horn, facing and drop edge.

Jaw coordinates (s, d): s along the nose away from the middle of the mouth, d from the nose line into the table. A jaw
is the straight nose from ``nose_end`` on, a horn of radius r about (nose_end, -r), and a facing from the horn into
the pocket. Where a ball's centre may not be is the jaw dilated by the contact distance rho: the strips in front of nose
and facing, and the *whole* disc of r + rho about the horn's centre. The disc needs no bounds, for what is hidden of it
lies inside the strips; so rounding where a strip ends finds the disc an ulp later, never nothing. A ball that runs
along a strip touches the disc where the strip ends: rounding may take that for a meeting, over and over, so such a one
must come ``DEEPER``.

A piece is found by its first falling root: the gap goes from >= 0 to below. ``rho`` is
the contact distance in plan; paths are in jaw coordinates, x for s and y for d.
"""

import math
from typing import NamedTuple

from physics.kernels.compiling import kernel, small_kernel
from physics.kernels.detect.contact import DEEPER_ONLY, contact, first_root, settled_root
from physics.kernels.detect.line import crossing
from physics.kernels.path import Path, along
from physics.kernels.tolerances import DEEPER, SLOW_APPROACH, TOUCH


class JawOutline(NamedTuple):
    """A jaw in its coordinates, m: see ``physics.mouths``."""

    nose_end: float
    horn: float
    start_s: float
    start_d: float
    normal_s: float
    normal_d: float
    length: float


@small_kernel
def from_facing(jaw, s, d):
    """(distance from a facing's line, place along it into the pocket) of a centre, m."""
    at_s, at_d = s - jaw.start_s, d - jaw.start_d
    return at_s * jaw.normal_s + at_d * jaw.normal_d, at_d * jaw.normal_s - at_s * jaw.normal_d


@small_kernel
def falling(gap, speed, half):
    """First t >= 0 at which gap - speed t - half t^2 falls through 0; infinity if never.

    A path may start behind a line, in a mouth: then it falls through at the later root, once it has come out.
    """
    if gap >= 0.0:
        return crossing(gap, speed, half)
    inside = speed * speed + 4.0 * half * gap
    if half <= 0.0 or speed >= 0.0 or inside < 0.0:
        return math.inf
    return (math.sqrt(inside) - speed) / (2.0 * half)


@small_kernel
def falling_from_touch(gap, speed, half, lasts):
    """``falling`` for a line that the ball touches now: within TOUCH of it, or in it by a rounded place.

    Approaching it meets where it is, and opening it meets where it has come back to. Doing neither it is looked for
    DEEPER, and meets where it has come back to, if it parts at all.
    """
    if abs(speed) > SLOW_APPROACH:
        return crossing(max(gap, 0.0), speed, half)
    deeper = crossing(max(gap, 0.0) + DEEPER, speed, half)
    if deeper <= lasts and speed < 0.0:
        return crossing(max(gap, 0.0), speed, half)
    return deeper


@small_kernel
def meets_facing(jaw, rho, path, lasts):
    """First t in [0, ``lasts``] at which a path meets a facing between its ends; infinity if never."""
    distance, foot = from_facing(jaw, path.x, path.y)
    gap = distance - rho
    speed = -(path.vx * jaw.normal_s + path.vy * jaw.normal_d)
    half = -(path.hx * jaw.normal_s + path.hy * jaw.normal_d)
    beside = (foot >= 0.0) & (foot <= jaw.length)
    touching = (abs(gap) <= TOUCH) | (beside & (gap < 0.0))
    t = falling_from_touch(gap, speed, half, lasts) if touching else falling(gap, speed, half)
    if not t <= lasts:
        return math.inf
    _, foot = from_facing(jaw, along(path.x, path.vx, path.hx, t), along(path.y, path.vy, path.hy, t))
    return t if 0.0 <= foot <= jaw.length else math.inf


@kernel
def touches_strip(jaw, rho, path, t):
    """Whether a path at a horn touches the nose or the facing at ``t``: then it is not the horn that it meets.

    A path that comes along the nose line is found at the horn up to a micrometre before the nose begins, for there the
    two are a rounded place apart. One that comes nearer to the line meets the horn there: the nose would miss it.
    """
    s, d = along(path.x, path.vx, path.hx, t), along(path.y, path.vy, path.hy, t)
    gap, foot = from_facing(jaw, s, d)
    comes_nearer = (path.vy + 2.0 * path.hy * t < 0.0) | (path.hy < 0.0)
    at_nose = (abs(d - rho) <= TOUCH) & ((s >= jaw.nose_end) | (not comes_nearer))
    return at_nose | ((foot >= 0.0) & (abs(gap - rho) <= TOUCH))


@kernel
def deeper_in_horn(from_centre, t, lasts, limit, reach):
    """``meets_horn`` for a path that at ``t`` is at the disc where nose or facing ends: from there on, DEEPER."""
    x, y, vx, vy, hx, hy = from_centre
    here = Path(along(x, vx, hx, t), along(y, vy, hy, t), vx + 2.0 * hx * t, vy + 2.0 * hy * t, hx, hy)
    found = settled_root(here, lasts - t, limit - t, reach)
    # Nearer and nearer from here on: it is met here, unless it was here already.
    return t if (found.ended == DEEPER_ONLY) & (t > 0.0) else t + found.time


@small_kernel
def meets_horn(jaw, rho, path, lasts, limit):
    """First t in [0, ``lasts``] at which a path meets a horn; NaN if none, or none up to ``limit``."""
    from_centre = Path(path.x - jaw.nose_end, path.y + jaw.horn, path.vx, path.vy, path.hx, path.hy)
    t = contact(from_centre, lasts, limit, jaw.horn + rho).time
    if t == t and touches_strip(jaw, rho, path, t):
        return deeper_in_horn(from_centre, t, lasts, limit, jaw.horn + rho)
    return t


@small_kernel
def drops(path, radius, lasts, limit):
    """First t in [0, ``lasts``] at which a centre comes over the drop edge, ``path`` from the hole's; NaN if none."""
    squared = radius * radius
    if path.x * path.x + path.y * path.y < squared:
        return 0.0
    return first_root(path, lasts, limit, squared).time
