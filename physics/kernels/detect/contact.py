"""When two balls meet: the earliest root of the quartic |c + b t + a t^2|^2 = D^2 ([II] eq. 7).

The quartic f(t) is never expanded. With m a lower bound of f'' on an interval, f + f' h + m h^2 / 2 lies below f there,
so its first root never oversteps a contact, and "no root" proves that there is none. f'' is a convex parabola: its
least value on an interval is exact and cheap. (docs/physics.md, eq. 22-25.)

A relative path is a ``Path``, c = (x, y), b = (vx, vy), a = (hx, hy); a ``SpacePath``, one component more; or a
``RingPath``. ``detect/distance.py`` knows what differs.
"""

import math
from typing import NamedTuple

from physics.kernels.compiling import kernel, small_kernel
from physics.kernels.detect.distance import curvature_of, least_curvature, reach_at, start_of
from physics.kernels.tolerances import (
    DEEPER,
    ROOT_RESIDUAL,
    SETTLED_STEPS,
    SLOW_APPROACH,
    SOLVER_STEPS,
    TOUCH,
)

(
    AT_ONCE,  # they touch and approach
    MEETS,  # f fell to the rounding of the gap
    STALLED,  # the next step is below the last place of t: the contact is here
    OUT_OF_STEPS,  # SOLVER_STEPS were taken: the contact is here, at a gap far below TOUCH
    NEVER,  # proved: f stays above 0 up to the end
    LATER,  # not up to ``limit``
    DEEPER_ONLY,  # balls that touched come DEEPER, but no time before at which they meet was found
) = range(7)
"""How a search ended; up to OUT_OF_STEPS and at DEEPER_ONLY there is a time."""


class Root(NamedTuple):
    """Outcome of a search: ``time`` (s), NaN if there is no contact, and how it ended."""

    time: float
    ended: int


@small_kernel
def first_step(f, slope, curvature):
    """First h >= 0 at which f + slope h + curvature h^2 / 2 reaches 0, for f >= 0; infinity if never.

    Of the two forms of the root, each branch takes the one that adds numbers of one sign: nothing cancels.
    """
    if slope >= 0.0 and curvature >= 0.0:
        return math.inf
    inside = slope * slope - 2.0 * curvature * f
    if inside < 0.0:
        return math.inf
    if slope < 0.0:
        return 2.0 * f / (math.sqrt(inside) - slope)
    return (slope + math.sqrt(inside)) / -curvature


@kernel
def first_root(path, t_max, limit, squared):
    """Earliest t in [0, t_max] at which |c + b t + a t^2|^2 falls through ``squared``, a Root.

    Starts outside (f >= 0, at the start possibly 0 while opening). Steps depend on ``t_max`` alone, so that the bits
    of a root do not depend on what else is known; the search ends early, LATER, beyond ``limit``.
    """
    t = 0.0
    curvature = curvature_of(path)
    reach = t_max
    for step in range(SOLVER_STEPS):
        squared_distance, slope = reach_at(path, t)
        f = squared_distance - squared
        if f <= ROOT_RESIDUAL and step > 0:
            # Past the root only by rounding: a first step that ends at a graze keeps half the digits.
            return Root(t - f / slope if f < -ROOT_RESIDUAL and slope < 0.0 else t, MEETS)
        f = max(f, 0.0)
        h = first_step(f, slope, least_curvature(path, curvature, t, min(t + reach, t_max)))
        if h > reach:
            # Nothing within reach: proved. Look at the rest.
            if t + reach >= t_max:
                return Root(math.nan, NEVER)
            t = t + reach
            reach = t_max - t
            continue
        if t + h > t_max:
            return Root(math.nan, NEVER)
        if t + h > limit:
            return Root(math.nan, LATER)
        if t + h == t:
            return Root(t, STALLED)
        t = t + h
        if step > 0:
            # The bound is slack on a long interval; a graze converges far faster on a short one.
            reach = 4.0 * h
    return Root(t, OUT_OF_STEPS)


@kernel
def settled_root(path, t_max, limit, diameter):
    """``first_root`` for balls that touch at the start without approaching or opening.

    f(0) = f'(0) = 0 up to rounding would be "time 0 again" for ever. So the contact looked for is DEEPER than they are;
    from there it is walked back, by Newton's steps, to where the balls, having parted, meet.
    """
    squared, _ = start_of(path)
    distance = math.sqrt(squared)
    met = min(distance, diameter)
    deeper = met - DEEPER
    found = first_root(path, t_max, limit, deeper * deeper)
    if found.time != found.time:
        return found
    back = found.time
    for _ in range(SETTLED_STEPS):
        squared, slope = reach_at(path, back)
        f = squared - met * met
        if abs(f) <= ROOT_RESIDUAL and slope < 0.0:
            return Root(back, MEETS)
        if slope >= 0.0:
            break
        back = back - f / slope
        if back <= 0.0:
            break
    return Root(found.time, DEEPER_ONLY)


@kernel
def contact(path, t_max, limit, diameter):
    """Earliest t in [0, t_max] at which two balls meet, a Root; LATER if not up to ``limit``.

    ``path``: of one ball's centre seen from the other. Cases: touching and approaching (0), neither, or opening;
    apart. Overlapping balls meet where they overlap as much again.
    """
    squared, advance = start_of(path)
    reached = diameter * diameter
    near = diameter + TOUCH
    if squared <= near * near:
        distance = math.sqrt(squared)
        opening = advance / distance
        if opening < -SLOW_APPROACH and distance <= diameter:
            return Root(0.0, AT_ONCE)
        if abs(opening) <= SLOW_APPROACH:
            return settled_root(path, t_max, limit, diameter)
        reached = min(squared, reached)
    return first_root(path, t_max, limit, reached)


@kernel
def contact_time(path, t_max, diameter):
    """Time of ``contact``, searched to the end."""
    return contact(path, t_max, t_max, diameter).time
