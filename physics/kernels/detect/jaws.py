"""When a path on the cloth meets the pieces of a pocket mouth: horn, facing and drop edge.

Jaw coordinates (s, d): s along the nose away from the middle of the mouth, d from the nose line into the table. A jaw
is the straight nose from ``nose_end`` on, a horn of radius r about (nose_end, -r), and a facing from the horn into
the pocket. Where a ball's centre may not be is the jaw dilated by the contact distance rho: the strips in front of nose
and facing, and the *whole* disc of r + rho about the horn's centre. The disc needs no bounds, for what is hidden of it
lies inside the strips; so rounding where a strip ends finds the disc an ulp later, never nothing.

A piece is found by its first falling root: the gap goes from >= 0 to below. ``jaw`` is (nose_end, r, s and d of the
facing's start, s and d of its normal, its length), ``rho`` the contact distance in plan, all in m.
"""

import math

from physics.kernels.compiling import kernel, small_kernel
from physics.kernels.detect.contact import contact, first_root
from physics.kernels.detect.line import crossing
from physics.kernels.tolerances import DEEPER, SLOW_APPROACH, TOUCH


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
    """``falling`` for a line that the ball touches now: within TOUCH of it.

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
def meets_facing(jaw, rho, s, d, vs, vd, hs, hd, lasts):
    """First t in [0, ``lasts``] at which a path meets a facing between its ends; infinity if never."""
    _, _, start_s, start_d, normal_s, normal_d, length = jaw
    gap = (s - start_s) * normal_s + (d - start_d) * normal_d - rho
    speed = -(vs * normal_s + vd * normal_d)
    half = -(hs * normal_s + hd * normal_d)
    t = falling_from_touch(gap, speed, half, lasts) if abs(gap) <= TOUCH else falling(gap, speed, half)
    if not t <= lasts:
        return math.inf
    foot_s = s + t * (vs + t * hs) - start_s
    foot_d = d + t * (vd + t * hd) - start_d
    foot = foot_d * normal_s - foot_s * normal_d  # along (-normal_d, normal_s), into the pocket
    return t if 0.0 <= foot <= length else math.inf


@small_kernel
def meets_horn(jaw, rho, s, d, vs, vd, hs, hd, lasts, limit):
    """First t in [0, ``lasts``] at which a path meets a horn; NaN if none, or none up to ``limit``."""
    nose_end, radius = jaw[0], jaw[1]
    return contact(s - nose_end, d + radius, vs, vd, hs, hd, lasts, limit, radius + rho)


@small_kernel
def drops(x, y, vx, vy, hx, hy, radius, lasts, limit):
    """First t in [0, ``lasts``] at which the centre, (x, y) from the hole's, comes over the drop edge; NaN if none."""
    squared = radius * radius
    if x * x + y * y < squared:
        return 0.0
    return first_root(x, y, vx, vy, hx, hy, lasts, limit, squared)


@kernel
def gap_to_facing(jaw, s, d):
    """(gap, foot) of a centre from a facing: distance from its line and place along it, m."""
    _, _, start_s, start_d, normal_s, normal_d, _ = jaw
    at_s, at_d = s - start_s, d - start_d
    return at_s * normal_s + at_d * normal_d, at_d * normal_s - at_s * normal_d
