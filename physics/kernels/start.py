"""How a shot starts: the balls laid out, at rest or in motion, and what is noted before the cue strikes."""

import math

from physics.kernels.compiling import (
    kernel,
    load,
    load_integer,
    lowest_bit,
    plain,
    small_kernel,
    store,
    store_fact,
    store_integer,
)
from physics.kernels.layout import (
    ABSENT,
    CROSSED,
    END,
    F_CROSSED,
    F_CROSSED_BEFORE,
    F_CUE_X,
    F_CUE_Y,
    F_DURATION,
    F_FROZEN_CUE,
    F_FROZEN_CUSHION,
    F_INTEGERS,
    FROZEN,
    FROZEN_BALLS,
    HX,
    HY,
    KIND,
    LANES,
    MOTION,
    N_EVENTS,
    NEXT,
    NOTHING,
    P_HALF_X,
    P_HALF_Y,
    P_HEAD,
    P_LINE_X,
    P_LINE_Y,
    PAIRS,
    POCKETED,
    SINCE,
    STATE_WIDTH,
    STATIONARY,
    TRACE_ROWS,
    VX,
    VY,
    WX,
    WY,
    WZ,
    X,
    Y,
)
from physics.kernels.recording import CUE_BALL
from physics.kernels.resolve.cloth import begin
from physics.kernels.resolve.touching import NO_CUSHION, neighbours, touched_cushion
from physics.kernels.tolerances import TOUCH

FAR_AWAY = 1000.0
"""m. Balls off the table wait this far out, each at its own multiple, where nothing meets them."""


@kernel
def put_away(w, k, i, motion):
    """Take ball ``i`` out of play."""
    store_integer(k, MOTION + i, motion)
    store_integer(k, KIND + i, NOTHING)
    for quantity in (VX, VY, WX, WY, WZ, HX, HY, SINCE, Y):
        store(w, quantity + i, 0.0)
    store(w, X + i, FAR_AWAY * float(i + 1))
    store(w, END + i, math.inf)
    store(w, NEXT + i, math.inf)


@small_kernel
def clear(w, k):
    """Nothing moves and nothing is to come."""
    for n in range(VX, END):
        store(w, n, 0.0)
    for i in range(LANES):
        store(w, END + i, math.inf)
        store(w, NEXT + i, math.inf)
        store_integer(k, KIND + i, NOTHING)


@kernel
def place(p, w, k, positions):
    """Lay out balls at rest from 32 numbers x0 y0 x1 y1 ... in the table's frame; NaN for a ball that is not there.

    Returns the bit set of balls on the table.
    """
    clear(w, k)
    alive = 0
    half_x, half_y = load(p, P_HALF_X), load(p, P_HALF_Y)
    for i in range(LANES):
        x, y = load(positions, 2 * i), load(positions, 2 * i + 1)
        there = x == x
        store_integer(k, MOTION + i, STATIONARY if there else ABSENT)
        store(w, X + i, x - half_x if there else FAR_AWAY * float(i + 1))
        store(w, Y + i, y - half_y if there else 0.0)
        alive |= int(there) << i
    return alive


@kernel
def restore(p, w, k, states):
    """Lay out balls in motion from 16 states x y vx vy wx wy wz motion; bit set of balls on the table.

    Positions in the table's frame.
    """
    clear(w, k)
    alive = 0
    for i in range(LANES):
        at = i * STATE_WIDTH
        motion = int(load(states, at + 7))
        store_integer(k, MOTION + i, motion)
        store(w, X + i, FAR_AWAY * float(i + 1))
        store(w, Y + i, 0.0)
        if motion < POCKETED:
            store(w, X + i, load(states, at) - load(p, P_HALF_X))
            store(w, Y + i, load(states, at + 1) - load(p, P_HALF_Y))
            for n in range(5):
                store(w, VX + n * LANES + i, load(states, at + 2 + n))
            begin(p, w, k, i, motion)
            alive |= 1 << i
    return alive


@small_kernel
def reset(k, facts, facts_float, rows):
    """Nothing has happened yet; the trace has room for ``rows`` events."""
    for n in range(F_INTEGERS):
        store_fact(facts, n, -1)
    store(facts_float, F_DURATION, 0.0)
    store(facts_float, F_CUE_X, math.nan)
    store(facts_float, F_CUE_Y, math.nan)
    for n in range(N_EVENTS, PAIRS):
        store_integer(k, n, 0)
    store_integer(k, TRACE_ROWS, rows)


@kernel
def note_frozen(p, w, k, facts, alive):
    """Note which balls touch a cushion or the cue ball at the start."""
    for n in range(F_FROZEN_CUSHION, F_FROZEN_CUE + LANES):
        store_fact(facts, n, 0)
    rest = neighbours(p, w, k, plain(CUE_BALL), 0.0) if alive & 1 else 0
    while rest != 0:
        store_fact(facts, F_FROZEN_CUE + lowest_bit(rest), 1)
        rest &= rest - 1
    near_x, near_y = load(p, P_LINE_X) - TOUCH, load(p, P_LINE_Y) - TOUCH
    rest = 0
    for i in range(LANES):
        rest |= int((abs(load(w, X + i)) >= near_x) | (abs(load(w, Y + i)) >= near_y)) << i
    rest &= alive
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        cushion = touched_cushion(p, w, k, i)
        if cushion != NO_CUSHION:
            store_integer(k, FROZEN + i, cushion)
            store_integer(k, FROZEN_BALLS, load_integer(k, FROZEN_BALLS) | 1 << i)
            store_fact(facts, F_FROZEN_CUSHION + i, 1)


@small_kernel
def note_start(p, w, k, facts):
    """Note whether the cue ball starts on or beyond the head string."""
    if load(w, Y) <= load(p, P_HEAD):
        store_integer(k, CROSSED, 1)
        store_fact(facts, F_CROSSED, 0)
        store_fact(facts, F_CROSSED_BEFORE, 0)
