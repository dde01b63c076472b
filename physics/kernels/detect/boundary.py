"""When a ball reaches the boundary of the table: four cushion lines, two side mouths in them, four corner mouths.

The lines that a ball's centre may not cross are an octagon; a long side's middle is a mouth. Each piece is met in
coordinates in which it lies ahead (signs flipped), so that mirror images have the same bits. Every function takes the
best event so far and returns a better one or the same; of simultaneous ones the first found stays.
"""

from typing import NamedTuple

from physics.kernels import layout as at
from physics.kernels.compiling import load, load_integer, lowest_bit, small_kernel, store_integer
from physics.kernels.detect.line import crossing, reaches
from physics.kernels.path import along
from physics.kernels.tolerances import TOUCH


class Coming(NamedTuple):
    """A coming event of one ball.

    Attributes:
        time: s. kind: NOTHING, MEET_BALL, MEET_CUSHION, MEET_POCKET or TRANSITION.
        number: of the ball, cushion or pocket.
    """

    time: float
    kind: int
    number: int


@small_kernel
def in_side_mouth(s, path, t):
    """Whether a ball that reaches a long cushion's line at ``t`` is then in the side mouth."""
    return abs(along(path.y, path.vy, path.hy, t)) < load(s.p, at.P_SIDE)


@small_kernel
def lines_in_reach(s, path, lasts):
    """Bit set of the cushion lines the path may reach within ``lasts``."""
    line_x, line_y = load(s.p, at.P_LINE_X), load(s.p, at.P_LINE_Y)
    return (
        int(reaches(line_x + path.x, -path.vx, -path.hx, lasts)) << at.WEST
        | int(reaches(line_x - path.x, path.vx, path.hx, lasts)) << at.EAST
        | int(reaches(line_y + path.y, -path.vy, -path.hy, lasts)) << at.SOUTH
        | int(reaches(line_y - path.y, path.vy, path.hy, lasts)) << at.NORTH
    )


@small_kernel
def meet_lines(s, path, best):
    """The cushion, or the side mouth, whose line the path reaches before ``best``."""
    rest = lines_in_reach(s, path, best.time)
    while rest != 0:
        line = lowest_bit(rest)
        rest &= rest - 1
        sign = 1.0 if line & 1 else -1.0
        if line <= at.EAST:
            gap = max(load(s.p, at.P_LINE_X) - sign * path.x, 0.0)
            t = crossing(gap, sign * path.vx, sign * path.hx)
            if t < best.time:
                mouth = in_side_mouth(s, path, t)
                pocket = at.POCKET_E if line == at.EAST else at.POCKET_W
                best = Coming(t, at.MEET_POCKET if mouth else at.MEET_CUSHION, pocket if mouth else line)
        else:
            gap = max(load(s.p, at.P_LINE_Y) - sign * path.y, 0.0)
            t = crossing(gap, sign * path.vy, sign * path.hy)
            if t < best.time:
                best = Coming(t, at.MEET_CUSHION, line)
    return best


@small_kernel
def meet_mouth_along_cushion(s, path, best):
    """The side mouth, before ``best``, of a ball that runs along a long cushion: it opens at its horn."""
    near, side_mouth = load(s.p, at.P_LINE_X) - TOUCH, load(s.p, at.P_SIDE)
    if abs(path.x) >= near and abs(path.y) >= side_mouth:
        side = 1.0 if path.y > 0.0 else -1.0
        t = crossing(abs(path.y) - side_mouth, -side * path.vy, -side * path.hy)
        if t < best.time and abs(along(path.x, path.vx, path.hx, t)) >= near:
            return Coming(t, at.MEET_POCKET, at.POCKET_E if path.x > 0.0 else at.POCKET_W)
    return best


@small_kernel
def corners_in_reach(s, path, lasts):
    """Bit set of the corner mouths whose line the path may reach within ``lasts``."""
    x, y, vx, vy, hx, hy = path
    line = load(s.p, at.P_CORNER)
    return (
        int(reaches(line - (-x - y), -vx - vy, -hx - hy, lasts)) << at.POCKET_SW
        | int(reaches(line - (y - x), vy - vx, hy - hx, lasts)) << at.POCKET_NW
        | int(reaches(line - (x + y), vx + vy, hx + hy, lasts)) << at.POCKET_NE
        | int(reaches(line - (x - y), vx - vy, hx - hy, lasts)) << at.POCKET_SE
    )


@small_kernel
def meet_corners(s, path, best):
    """The corner mouth whose line |x| + |y| = P_CORNER the path reaches before ``best``."""
    rest = corners_in_reach(s, path, best.time)
    while rest != 0:
        corner = lowest_bit(rest)
        rest &= rest - 1
        sx = 1.0 if corner >= at.POCKET_NE else -1.0
        sy = 1.0 if at.POCKET_NW <= corner <= at.POCKET_NE else -1.0
        gap = max(load(s.p, at.P_CORNER) - (sx * path.x + sy * path.y), 0.0)
        t = crossing(gap, sx * path.vx + sy * path.vy, sx * path.hx + sy * path.hy)
        if t < best.time:
            best = Coming(t, at.MEET_POCKET, corner)
    return best


@small_kernel
def meet_octagon(s, path, lasts):
    """First cushion or mouth a moving ball reaches within ``lasts``, counting from now; NOTHING if none."""
    store_integer(s.k, at.CUSHION_LOOKS, load_integer(s.k, at.CUSHION_LOOKS) + 1)
    best = meet_lines(s, path, Coming(lasts, at.NOTHING, 0))
    best = meet_mouth_along_cushion(s, path, best)
    return meet_corners(s, path, best)
