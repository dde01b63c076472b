"""When a path reaches a straight line: cushions and pocket mouths are quadratics ([II], section 4)."""

import math

from physics.kernels import layout as at
from physics.kernels.compiling import load, small_kernel


@small_kernel
def crossing(gap, speed, half):
    """First t >= 0 at which gap - speed t - half t^2 falls to 0; infinity if never.

    ``gap`` >= 0 m to the line, ``speed`` m/s and ``half`` m/s^2 (half the acceleration) towards it. At the line and
    leaving, the start does not count; nor does it for a ball that rests there.
    """
    # t = (-speed +- sqrt(speed^2 + 4 half gap)) / 2 half; each branch takes the form that subtracts nothing.
    inside = speed * speed + 4.0 * half * gap
    if inside < 0.0:
        return math.inf
    if speed > 0.0:
        return 2.0 * gap / (speed + math.sqrt(inside))
    if half > 0.0:
        return (math.sqrt(inside) - speed) / (2.0 * half)
    return math.inf


@small_kernel
def reaches(gap, speed, half, lasts):
    """Whether a path may close ``gap`` within ``lasts``: a bound without a square root, exact unless it slows down."""
    return lasts * (speed + lasts * max(half, 0.0)) >= gap


@small_kernel
def may_lie_inside(s, x, y, slack):
    """Whether a centre may rest at (x, y), from the table's centre: on a cushion line, but not on a mouth line.

    ``slack`` (m) off a cushion line counts as on it.
    """
    side, end = abs(x), abs(y)
    line_x, line_y = load(s.p, at.P_LINE_X), load(s.p, at.P_LINE_Y)
    inside = (side <= line_x + slack) & (end <= line_y + slack)
    mouth = ((side >= line_x) & (end < load(s.p, at.P_SIDE))) | (side + end >= load(s.p, at.P_CORNER))
    return inside & (not mouth)
