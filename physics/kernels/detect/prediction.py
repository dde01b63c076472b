"""The next event of one ball.

Every ball keeps one next event, its earliest (Lubachevsky 1991). A ball's prediction is redone only when its motion
changed; a partner that thereby loses its event looks again when that event would have been. Pairs are filtered by
16 branch-free lanes before any of them is solved.
"""

import math

from physics.kernels.advance import along
from physics.kernels.compiling import kernel, load, load_integer, small_kernel, store, store_integer
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
    ROLLING,
    SINCE,
    SLIDING,
    SOLVES,
    TRANSITION,
    VX,
    VY,
    X,
    Y,
)
from physics.kernels.resolve.cushion import EAST, NORTH, SOUTH, WEST
from physics.kernels.tolerances import TOUCH

POCKET_SW, POCKET_W, POCKET_NW, POCKET_NE, POCKET_E, POCKET_SE = 0, 1, 2, 3, 4, 5


@small_kernel
def moves(motion):
    """Whether a ball in this motion state changes its place."""
    return (motion == SLIDING) | (motion == ROLLING)


@small_kernel
def earlier_corner(p, x, y, vx, vy, hx, hy, sx, sy, best):
    """Time until the corner mouth in direction (sx, sy) if it is before ``best``, else infinity."""
    speed = sx * vx + sy * vy
    half = sx * hx + sy * hy
    gap = load(p, P_CORNER) - (sx * x + sy * y)
    if (speed <= 0.0 and half <= 0.0) or gap > best * (max(speed, 0.0) + best * max(half, 0.0)):
        return math.inf
    t = crossing(max(gap, 0.0), speed, half)
    return t if t < best else math.inf


@small_kernel
def in_side_mouth(p, y, vy, hy, t):
    """Whether a ball that reaches a long cushion's line at ``t`` is then in the side mouth."""
    return abs(along(y, vy, hy, t)) < load(p, P_SIDE)


@kernel
def meet_boundary(p, k, x, y, vx, vy, hx, hy, lasts):
    """First cushion or mouth a moving ball reaches within ``lasts``: (time, kind, number); time infinite if none."""
    best, kind, number = lasts, NOTHING, 0
    line_x, line_y = load(p, P_LINE_X), load(p, P_LINE_Y)
    if vx > 0.0 or hx > 0.0:
        t = crossing(max(line_x - x, 0.0), vx, hx)
        if t < best:
            mouth = in_side_mouth(p, y, vy, hy, t)
            best, kind, number = t, MEET_POCKET if mouth else MEET_CUSHION, POCKET_E if mouth else EAST
    if vx < 0.0 or hx < 0.0:
        t = crossing(max(line_x + x, 0.0), -vx, -hx)
        if t < best:
            mouth = in_side_mouth(p, y, vy, hy, t)
            best, kind, number = t, MEET_POCKET if mouth else MEET_CUSHION, POCKET_W if mouth else WEST
    if vy > 0.0 or hy > 0.0:
        t = crossing(max(line_y - y, 0.0), vy, hy)
        if t < best:
            best, kind, number = t, MEET_CUSHION, NORTH
    if vy < 0.0 or hy < 0.0:
        t = crossing(max(line_y + y, 0.0), -vy, -hy)
        if t < best:
            best, kind, number = t, MEET_CUSHION, SOUTH
    if abs(x) >= line_x - TOUCH and vx == 0.0 and hx == 0.0 and abs(y) >= load(p, P_SIDE):
        # Rolling along a long cushion: the mouth opens at its horn.
        side = 1.0 if y > 0.0 else -1.0
        t = crossing(abs(y) - load(p, P_SIDE), -side * vy, -side * hy)
        if t < best:
            best, kind, number = t, MEET_POCKET, POCKET_E if x > 0.0 else POCKET_W
    store_integer(k, CUSHION_LOOKS, load_integer(k, CUSHION_LOOKS) + 1)
    t = earlier_corner(p, x, y, vx, vy, hx, hy, -1.0, -1.0, best)
    if t < best:
        best, kind, number = t, MEET_POCKET, POCKET_SW
    t = earlier_corner(p, x, y, vx, vy, hx, hy, -1.0, 1.0, best)
    if t < best:
        best, kind, number = t, MEET_POCKET, POCKET_NW
    t = earlier_corner(p, x, y, vx, vy, hx, hy, 1.0, 1.0, best)
    if t < best:
        best, kind, number = t, MEET_POCKET, POCKET_NE
    t = earlier_corner(p, x, y, vx, vy, hx, hy, 1.0, -1.0, best)
    if t < best:
        best, kind, number = t, MEET_POCKET, POCKET_SE
    return best, kind, number


@kernel
def partners(w, x, y, vx, vy, hx, hy, now, limit, diameter):
    """Bit set of the balls whose path may meet this one before either's next event.

    One step of the contact solver for all 16 lanes: f(h) >= f + f' h + m h^2/2 with m <= f'' proves that a pair does
    not meet. Linear in the worst case, so m needs no division: m = f''(0) + min(0, f'''(0) H), f''' rising.
    """
    squared = diameter * diameter
    touching = (diameter + TOUCH) * (diameter + TOUCH) - squared
    found = 0
    for j in range(LANES):
        dt = now - load(w, SINCE + j)
        bx = load(w, VX + j)
        by = load(w, VY + j)
        ax = load(w, HX + j)
        ay = load(w, HY + j)
        cx = load(w, X + j) + dt * (bx + dt * ax) - x
        cy = load(w, Y + j) + dt * (by + dt * ay) - y
        bx = bx + 2.0 * dt * ax - vx
        by = by + 2.0 * dt * ay - vy
        ax = ax - hx
        ay = ay - hy
        horizon = min(limit, load(w, NEXT + j)) - now
        f = cx * cx + cy * cy - squared
        slope = 2.0 * (cx * bx + cy * by)
        m = 2.0 * (bx * bx + by * by) + 4.0 * (ax * cx + ay * cy) + min(0.0, 12.0 * (ax * bx + ay * by) * horizon)
        at_end = f + horizon * (slope + 0.5 * m * horizon)
        dips = (slope < 0.0) & (slope + m * horizon >= 0.0) & (slope * slope >= 2.0 * m * f)
        found |= int((at_end <= 0.0) | dips | (f <= touching)) << j
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

    ``alive`` is the bit set of balls on the table.
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
    found = partners(w, x, y, vx, vy, hx, hy, now, best, diameter) & alive & ~(1 << i)
    if found != 0:
        lasts = load(w, END + i) - now if moving else math.inf
        for j in range(LANES):
            if found >> j & 1:
                other_moves = moves(load_integer(k, MOTION + j))
                if moving or other_moves:
                    store_integer(k, PAIRS_LEFT, load_integer(k, PAIRS_LEFT) + 1)
                    t = meeting(w, j, x, y, vx, vy, hx, hy, now, lasts, other_moves, best, diameter)
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


@kernel
def meeting(w, j, x, y, vx, vy, hx, hy, now, lasts, other_moves, best, diameter):
    """Time at which ball ``j`` meets the ball at (x, y) if that is before ``best`` and j's next event, else infinity.

    ``lasts``: how long the ball keeps its motion state.
    """
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
