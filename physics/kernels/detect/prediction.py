"""The next event of one ball.

Every ball keeps one next event, its earliest (Lubachevsky 1991). A ball's prediction is redone only when its motion
changed; a partner that thereby loses its event looks again when that event would have been. Pairs are filtered by
16 branch-free lanes before any of them is solved.
"""

import math

from physics.kernels.advance import along
from physics.kernels.compiling import (
    kernel,
    load,
    load_integer,
    lowest_bit,
    small_kernel,
    store,
    store_integer,
)
from physics.kernels.detect.contact import contact
from physics.kernels.detect.line import crossing
from physics.kernels.layout import (
    CUSHION_LOOKS,
    END,
    HX,
    HY,
    KIND,
    LANES,
    LOOK_AGAIN,
    LOOKS,
    MEET_BALL,
    MEET_CUSHION,
    MEET_POCKET,
    MOTION,
    NEXT,
    NOTHING,
    P_CORNER,
    P_LINE_X,
    P_LINE_Y,
    P_RADIUS,
    P_SIDE,
    PAIRS_LEFT,
    PARTNER,
    SINCE,
    SOLVES,
    TRANSITION,
    VX,
    VY,
    X,
    Y,
)
from physics.kernels.motion import moves
from physics.kernels.resolve.cushion import EAST, NORTH, SOUTH, WEST
from physics.kernels.tolerances import TOUCH

FOREVER = 1e6
"""s. The filter's horizon for a ball without an event of its own: finite, so that 0 m/s times it is 0 m."""

POCKET_SW, POCKET_W, POCKET_NW, POCKET_NE, POCKET_E, POCKET_SE = 0, 1, 2, 3, 4, 5


@small_kernel
def reaches(gap, speed, half, lasts):
    """Whether a path may close ``gap`` within ``lasts``: a bound without a square root, exact unless it slows down."""
    return lasts * (speed + lasts * max(half, 0.0)) >= gap


@small_kernel
def in_side_mouth(p, y, vy, hy, t):
    """Whether a ball that reaches a long cushion's line at ``t`` is then in the side mouth."""
    return abs(along(y, vy, hy, t)) < load(p, P_SIDE)


@small_kernel
def lines_in_reach(p, x, y, vx, vy, hx, hy, lasts):
    """Bit set of the cushion lines the path may reach within ``lasts``."""
    line_x, line_y = load(p, P_LINE_X), load(p, P_LINE_Y)
    return (
        int(reaches(line_x + x, -vx, -hx, lasts)) << WEST
        | int(reaches(line_x - x, vx, hx, lasts)) << EAST
        | int(reaches(line_y + y, -vy, -hy, lasts)) << SOUTH
        | int(reaches(line_y - y, vy, hy, lasts)) << NORTH
    )


@small_kernel
def corners_in_reach(p, x, y, vx, vy, hx, hy, lasts):
    """Bit set of the corner mouths whose line the path may reach within ``lasts``."""
    line = load(p, P_CORNER)
    return (
        int(reaches(line - (-x - y), -vx - vy, -hx - hy, lasts)) << POCKET_SW
        | int(reaches(line - (y - x), vy - vx, hy - hx, lasts)) << POCKET_NW
        | int(reaches(line - (x + y), vx + vy, hx + hy, lasts)) << POCKET_NE
        | int(reaches(line - (x - y), vx - vy, hx - hy, lasts)) << POCKET_SE
    )


@small_kernel
def meet_boundary(p, k, x, y, vx, vy, hx, hy, lasts):
    """First cushion or mouth a moving ball reaches within ``lasts``: (time, kind, number); time infinite if none."""
    best, kind, number = lasts, NOTHING, 0
    store_integer(k, CUSHION_LOOKS, load_integer(k, CUSHION_LOOKS) + 1)
    line_x = load(p, P_LINE_X)
    rest = lines_in_reach(p, x, y, vx, vy, hx, hy, lasts)
    while rest != 0:
        line = lowest_bit(rest)
        rest &= rest - 1
        sign = 1.0 if line & 1 else -1.0
        if line <= EAST:
            t = crossing(max(line_x - sign * x, 0.0), sign * vx, sign * hx)
            if t < best:
                mouth = in_side_mouth(p, y, vy, hy, t)
                best, kind = t, MEET_POCKET if mouth else MEET_CUSHION
                number = (POCKET_E if line == EAST else POCKET_W) if mouth else line
        else:
            t = crossing(max(load(p, P_LINE_Y) - sign * y, 0.0), sign * vy, sign * hy)
            if t < best:
                best, kind, number = t, MEET_CUSHION, line
    if abs(x) >= line_x - TOUCH and abs(y) >= load(p, P_SIDE):
        # Running along a long cushion: the mouth opens at its horn.
        side = 1.0 if y > 0.0 else -1.0
        t = crossing(abs(y) - load(p, P_SIDE), -side * vy, -side * hy)
        if t < best and abs(along(x, vx, hx, t)) >= line_x - TOUCH:
            best, kind, number = t, MEET_POCKET, POCKET_E if x > 0.0 else POCKET_W
    rest = corners_in_reach(p, x, y, vx, vy, hx, hy, best)
    while rest != 0:
        corner = lowest_bit(rest)
        rest &= rest - 1
        sx = 1.0 if corner >= POCKET_NE else -1.0
        sy = 1.0 if POCKET_NW <= corner <= POCKET_NE else -1.0
        t = crossing(max(load(p, P_CORNER) - (sx * x + sy * y), 0.0), sx * vx + sy * vy, sx * hx + sy * hy)
        if t < best:
            best, kind, number = t, MEET_POCKET, corner
    return best, kind, number


@small_kernel
def partners(w, x, y, vx, vy, hx, hy, now, limit, diameter):
    """Bit set of the balls whose path may meet this one before either's next event.

    Branch-free over 16 lanes. Up to the horizon H the relative path c + b t + a t^2 lies in the triangle of its
    control points c, c + b H/2, c + b H + a H^2. A pair cannot meet if the triangle comes no nearer along c, if it
    stays more than the diameter away along c, or beside b. Bits 16 to 31: the balls it touches now.
    """
    limit = min(limit, FOREVER)
    squared = diameter * diameter
    touching = (diameter + TOUCH) * (diameter + TOUCH)
    found = 0
    for j in range(LANES):
        dt = now - load(w, SINCE + j)
        bx = load(w, VX + j)
        by = load(w, VY + j)
        ax = load(w, HX + j)
        ay = load(w, HY + j)
        half_x, half_y = dt * ax, dt * ay
        cx = load(w, X + j) + dt * (bx + half_x) - x
        cy = load(w, Y + j) + dt * (by + half_y) - y
        bx = bx + (half_x + half_x) - vx
        by = by + (half_y + half_y) - vy
        ax = ax - hx
        ay = ay - hy
        horizon = min(limit, load(w, NEXT + j)) - now
        cc = cx * cx + cy * cy
        end_x, end_y = horizon * ax, horizon * ay
        to_middle = horizon * (cx * bx + cy * by)
        nearer = min(0.5 * to_middle, to_middle + horizon * (cx * end_x + cy * end_y))
        least = cc + nearer
        along_c = (nearer >= 0.0) | ((least > 0.0) & (least * least > squared * cc))
        beside = cx * by - cy * bx
        at_end = beside + horizon * (end_x * by - end_y * bx)
        aside = (beside * at_end > 0.0) & (min(beside * beside, at_end * at_end) > squared * (bx * bx + by * by))
        found |= int(not (along_c | aside)) << j
        found |= int(cc <= touching) << (j + LANES)
    return found


@small_kernel
def release(k, i):
    """Tell the ball that was to meet ball ``i`` to look again at that time."""
    if load_integer(k, KIND + i) == MEET_BALL:
        partner = load_integer(k, PARTNER + i)
        if load_integer(k, KIND + partner) == MEET_BALL and load_integer(k, PARTNER + partner) == i:
            store_integer(k, KIND + partner, LOOK_AGAIN)


@kernel
def predict(p, w, k, alive, i, now):
    """Find the next event of ball ``i`` at time ``now`` and, if it is a collision, make it its partner's too.

    ``alive`` is the bit set of balls on the table. Returns the bit set of balls it touches now.
    """
    store_integer(k, LOOKS, load_integer(k, LOOKS) + 1)
    moving = moves(load_integer(k, MOTION + i))
    best = load(w, END + i)
    kind = TRANSITION if best < math.inf else NOTHING
    partner = 0
    dt = now - load(w, SINCE + i)
    vx, vy, hx, hy = load(w, VX + i), load(w, VY + i), load(w, HX + i), load(w, HY + i)
    x = along(load(w, X + i), vx, hx, dt)
    y = along(load(w, Y + i), vy, hy, dt)
    vx = vx + 2.0 * dt * hx
    vy = vy + 2.0 * dt * hy
    if moving:
        t, what, number = meet_boundary(p, k, x, y, vx, vy, hx, hy, best - now)
        if what != NOTHING:
            best, kind, partner = now + t, what, number
    diameter = 2.0 * load(p, P_RADIUS)
    lanes = partners(w, x, y, vx, vy, hx, hy, now, best, diameter)
    others = alive & ~(1 << i)
    found = lanes & others
    if found != 0:
        lasts = load(w, END + i) - now if moving else math.inf
        rest = found
        while rest != 0:
            j = lowest_bit(rest)
            rest &= rest - 1
            store_integer(k, PAIRS_LEFT, load_integer(k, PAIRS_LEFT) + 1)
            other_moves = moves(load_integer(k, MOTION + j))
            if moving or other_moves:
                t = meeting(w, k, j, x, y, vx, vy, hx, hy, now, lasts, other_moves, best, diameter)
                if t < best:
                    best, kind, partner = t, MEET_BALL, j
    release(k, i)
    if kind == MEET_BALL:
        release(k, partner)
        store(w, NEXT + partner, best)
        store_integer(k, KIND + partner, MEET_BALL)
        store_integer(k, PARTNER + partner, i)
    store(w, NEXT + i, best)
    store_integer(k, KIND + i, kind)
    store_integer(k, PARTNER + i, partner)
    return lanes >> LANES & others


@small_kernel
def meeting(w, k, j, x, y, vx, vy, hx, hy, now, lasts, other_moves, best, diameter):
    """Time at which ball ``j`` meets the ball at (x, y) if that is before ``best`` and j's next event, else infinity.

    ``lasts``: how long the ball keeps its motion state.
    """
    store_integer(k, SOLVES, load_integer(k, SOLVES) + 1)
    dt = now - load(w, SINCE + j)
    bx, by, ax, ay = load(w, VX + j), load(w, VY + j), load(w, HX + j), load(w, HY + j)
    cx = along(load(w, X + j), bx, ax, dt) - x
    cy = along(load(w, Y + j), by, ay, dt) - y
    bx = bx + 2.0 * dt * ax - vx
    by = by + 2.0 * dt * ay - vy
    if other_moves:
        lasts = min(lasts, load(w, END + j) - now)
    limit = min(best, load(w, NEXT + j)) - now
    t = contact(cx, cy, bx, by, ax - hx, ay - hy, lasts, limit, diameter)
    return now + t if now + t < load(w, NEXT + j) else math.inf
