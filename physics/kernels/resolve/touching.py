"""What touches what at an instant: the geometry the contact rule works on."""

from physics.kernels.advance import advance, along
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, small_kernel, store, store_integer
from physics.kernels.layout import (
    HX,
    HY,
    LANES,
    MOTION,
    N_PAIRS,
    NORMAL_X,
    NORMAL_Y,
    P_LINE_X,
    P_LINE_Y,
    P_RADIUS,
    P_SIDE,
    PAIRS,
    POCKETED,
    SINCE,
    VX,
    VY,
    X,
    Y,
)
from physics.kernels.recording import CUE_BALL, note_crossing
from physics.kernels.resolve.ball_ball import normal
from physics.kernels.resolve.cushion import EAST, NORTH, SOUTH, WEST
from physics.kernels.tolerances import TOUCH

NO_CUSHION = -1


@kernel
def neighbours(p, w, k, i, time):
    """Bit set of the balls that touch ball ``i``, which is anchored at ``time``."""
    near = 2.0 * load(p, P_RADIUS) + TOUCH
    limit = near * near
    x = load(w, X + i)
    y = load(w, Y + i)
    found = 0
    for j in range(LANES):
        dt = time - load(w, SINCE + j)
        dx = along(load(w, X + j), load(w, VX + j), load(w, HX + j), dt) - x
        dy = along(load(w, Y + j), load(w, VY + j), load(w, HY + j), dt) - y
        found |= int(dx * dx + dy * dy <= limit) << j
    return found & ~(1 << i)


@kernel
def neighbours_of_two(p, w, i, j, time):
    """``neighbours`` of two balls anchored at ``time``, in one pass: (of i, of j)."""
    near = 2.0 * load(p, P_RADIUS) + TOUCH
    limit = near * near
    x_i, y_i, x_j, y_j = load(w, X + i), load(w, Y + i), load(w, X + j), load(w, Y + j)
    found = 0
    for n in range(LANES):
        dt = time - load(w, SINCE + n)
        x = along(load(w, X + n), load(w, VX + n), load(w, HX + n), dt)
        y = along(load(w, Y + n), load(w, VY + n), load(w, HY + n), dt)
        at_i = (x - x_i) * (x - x_i) + (y - y_i) * (y - y_i) <= limit
        at_j = (x - x_j) * (x - x_j) + (y - y_j) * (y - y_j) <= limit
        found |= int(at_i) << n | int(at_j) << (n + LANES)
    return found & 0xFFFF & ~(1 << i), found >> LANES & ~(1 << j)


@small_kernel
def bring(p, w, k, facts, i, time):
    """Advance ball ``i`` to ``time``, noting on the way whether the cue ball crosses the head string."""
    if i == CUE_BALL:
        note_crossing(p, w, k, facts, time)
    advance(p, w, k, i, time)


@kernel
def gather(p, w, k, facts, seeds, time):
    """Bit set of the cluster of balls linked by touching to ``seeds``, all brought to ``time``.

    Lists its touching pairs, lower ball first, in ascending order.
    """
    members = seeds
    waiting = seeds
    links = 0
    while waiting != 0:
        rest = waiting
        while rest != 0:
            i = lowest_bit(rest)
            rest &= rest - 1
            waiting &= ~(1 << i)
            bring(p, w, k, facts, i, time)
            found = neighbours(p, w, k, i, time)
            links |= found
            waiting |= found & ~members
            members |= found
    store_integer(k, N_PAIRS, 0)
    if links != 0:
        list_pairs(p, w, k, members, time)
    return members


@kernel
def list_pairs(p, w, k, members, time):
    """List the touching pairs among ``members`` with their normals: where balls are does not change at an instant."""
    count = 0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        found = neighbours(p, w, k, i, time)
        for j in range(i + 1, LANES):
            if found >> j & 1:
                store_integer(k, PAIRS + count, i * LANES + j)
                nx, ny, _ = normal(w, i, j)
                store(w, NORMAL_X + count, nx)
                store(w, NORMAL_Y + count, ny)
                count += 1
    store_integer(k, N_PAIRS, count)


@small_kernel
def touched_cushion(p, w, k, i):
    """Cushion that ball ``i`` touches, or NO_CUSHION; a side mouth is none. At most one: the corners are cut off."""
    if load_integer(k, MOTION + i) >= POCKETED:
        return NO_CUSHION
    x = load(w, X + i)
    y = load(w, Y + i)
    line_x = load(p, P_LINE_X) - TOUCH
    line_y = load(p, P_LINE_Y) - TOUCH
    if abs(x) >= line_x and abs(y) >= load(p, P_SIDE):
        return EAST if x > 0.0 else WEST
    if abs(y) >= line_y:
        return NORTH if y > 0.0 else SOUTH
    return NO_CUSHION


@small_kernel
def towards_cushion(w, cushion, x_row, y_row, i):
    """Component towards the cushion of a vector stored in two rows."""
    if cushion == WEST:
        return -load(w, x_row + i)
    if cushion == EAST:
        return load(w, x_row + i)
    if cushion == SOUTH:
        return -load(w, y_row + i)
    return load(w, y_row + i)
