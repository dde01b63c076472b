"""When two balls meet: the earliest root of the quartic |c + b t + a t^2|^2 = D ([II] eq. 7).

The quartic f is never expanded. With m a lower bound of f'' on an interval, f + f' h + m h^2 / 2 lies below f there,
so its first root never oversteps a contact, and "no root" proves that there is none. f'' is a convex parabola: its
least value on an interval is exact and cheap. (docs/physics.md, eq. 22-25.)
"""

import math

from physics.kernels.compiling import kernel, small_kernel
from physics.kernels.tolerances import DEEPER, ROOT_RESIDUAL, SLOW_APPROACH, SOLVER_STEPS, TOUCH


@small_kernel
def least_curvature(c0, c1, c2, start, end):
    """Least value of c0 + c1 t + c2 t^2 on [start, end], for c2 >= 0."""
    if c1 + 2.0 * c2 * start >= 0.0:
        return c0 + start * (c1 + start * c2)
    if c1 + 2.0 * c2 * end <= 0.0:
        return c0 + end * (c1 + end * c2)
    return c0 - 0.25 * c1 * c1 / c2


@small_kernel
def first_step(f, slope, curvature):
    """First h >= 0 at which f + slope h + curvature h^2 / 2 reaches 0, for f >= 0; infinity if never."""
    if slope >= 0.0 and curvature >= 0.0:
        return math.inf
    inside = slope * slope - 2.0 * curvature * f
    if inside < 0.0:
        return math.inf
    if slope < 0.0:
        return 2.0 * f / (math.sqrt(inside) - slope)
    return (slope + math.sqrt(inside)) / -curvature


@kernel
def first_root(cx, cy, bx, by, ax, ay, t_max, limit, squared):
    """Earliest t in [0, t_max] at which |c + b t + a t^2|^2 falls through ``squared``; NaN if none.

    Starts outside (f >= 0, at the start possibly 0 while opening). Steps depend on ``t_max`` alone, so that the bits
    of a root do not depend on what else is known; the search ends early, with NaN, beyond ``limit``.
    """
    t = 0.0
    c0 = 2.0 * (bx * bx + by * by) + 4.0 * (ax * cx + ay * cy)
    c1 = 12.0 * (ax * bx + ay * by)
    c2 = 12.0 * (ax * ax + ay * ay)
    reach = t_max
    for step in range(SOLVER_STEPS):
        dx = cx + t * (bx + t * ax)
        dy = cy + t * (by + t * ay)
        f = dx * dx + dy * dy - squared
        slope = 2.0 * (dx * (bx + 2.0 * ax * t) + dy * (by + 2.0 * ay * t))
        if f <= ROOT_RESIDUAL and step > 0:
            # Past the root only by rounding: a first step that ends at a graze keeps half the digits.
            return t - f / slope if f < -ROOT_RESIDUAL and slope < 0.0 else t
        f = max(f, 0.0)
        h = first_step(f, slope, least_curvature(c0, c1, c2, t, min(t + reach, t_max)))
        if h > reach:
            # Nothing within reach: proved. Look at the rest.
            if t + reach >= t_max:
                return math.nan
            t = t + reach
            reach = t_max - t
            continue
        if t + h > t_max or t + h > limit:
            return math.nan
        if t + h == t:
            return t
        t = t + h
        if step > 0:
            # The bound is slack on a long interval; a graze converges far faster on a short one.
            reach = 4.0 * h
    return t


@kernel
def settled_root(cx, cy, bx, by, ax, ay, t_max, limit, diameter):
    """``first_root`` for balls that touch at the start without approaching or opening.

    f(0) = f'(0) = 0 up to rounding would be "time 0 again" for ever. So the contact looked for is DEEPER than they are;
    from there it is walked back to where the balls, having parted, meet.
    """
    distance = math.sqrt(cx * cx + cy * cy)
    met = min(distance, diameter)
    deeper = met - DEEPER
    t = first_root(cx, cy, bx, by, ax, ay, t_max, limit, deeper * deeper)
    if t != t:
        return t
    back = t
    for _ in range(8):
        dx = cx + back * (bx + back * ax)
        dy = cy + back * (by + back * ay)
        slope = 2.0 * (dx * (bx + 2.0 * ax * back) + dy * (by + 2.0 * ay * back))
        f = dx * dx + dy * dy - met * met
        if abs(f) <= ROOT_RESIDUAL and slope < 0.0:
            return back
        if slope >= 0.0:
            return t
        back = back - f / slope
        if back <= 0.0:
            return t
    return t


@kernel
def contact(cx, cy, bx, by, ax, ay, t_max, limit, diameter):
    """Earliest t in [0, t_max] at which two balls meet; NaN if none, or none up to ``limit``.

    c (m), b (m/s), a (m/s^2, half the relative acceleration): path of one ball's centre seen from the other. Cases:
    apart; touching and approaching (0), opening, or neither; overlapping balls meet where they overlap as much again.
    """
    squared = cx * cx + cy * cy
    reached = diameter * diameter
    near = diameter + TOUCH
    if squared <= near * near:
        distance = math.sqrt(squared)
        opening = (cx * bx + cy * by) / distance
        if opening < -SLOW_APPROACH and distance <= diameter:
            return 0.0
        if abs(opening) <= SLOW_APPROACH:
            return settled_root(cx, cy, bx, by, ax, ay, t_max, limit, diameter)
        reached = min(squared, reached)
    return first_root(cx, cy, bx, by, ax, ay, t_max, limit, reached)
