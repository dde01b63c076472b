"""How a shot starts: the balls laid out, at rest or in motion, and what is noted before the cue strikes."""

import math

from physics.kernels import layout as at
from physics.kernels.compiling import (
    kernel,
    load,
    load_integer,
    lowest_bit,
    plain,
    small_kernel,
    store,
    store_fact,
    store_fact_number,
    store_integer,
)
from physics.kernels.motion import on_table
from physics.kernels.recording import state_width
from physics.kernels.resolve.boundary import touched_cushion
from physics.kernels.resolve.cloth import begin
from physics.kernels.resolve.touching import neighbours
from physics.kernels.tolerances import TOUCH
from physics.kernels.workspace import by_table

FAR_AWAY = 1000.0
"""m. Balls off the table wait this far out, each at its own multiple, where nothing meets them."""


@small_kernel
def stay_down(_s, _i):
    """See ``take_away``."""


@small_kernel
def take_from_air(s, i):
    """See ``take_away``."""
    for quantity in (at.Z, at.VZ, at.HZ):
        store(s.w, quantity + i, 0.0)
    store_integer(s.k, at.FLYING_BALLS, load_integer(s.k, at.FLYING_BALLS) & ~(1 << i))
    store_integer(s.k, at.GONE_BALLS, load_integer(s.k, at.GONE_BALLS) | 1 << i)


take_away = by_table(stay_down, take_from_air)
"""``take_away(s, i)``: nothing about a ball out of play is vertical; note that it is."""


@small_kernel
def nothing_to_clear(_s):
    """See ``clear_heights``."""


@small_kernel
def clear_air(s):
    """See ``clear_heights``."""
    for i in range(at.LANES):
        store(s.w, at.Z + i, 0.0)
        store(s.w, at.VZ + i, 0.0)
        store(s.w, at.HZ + i, 0.0)
        store(s.w, at.PRESSED + i, -math.inf)
        store_integer(s.k, at.PARTINGS + i, 0)
    store_integer(s.k, at.FLYING_BALLS, 0)


clear_heights = by_table(nothing_to_clear, clear_air)
"""``clear_heights(s)``: nothing flies."""


@small_kernel
def no_heights(_s, _i, _memory, _place):
    """See ``read_height``."""


@small_kernel
def take_height(s, i, memory, place):
    """See ``read_height``."""
    store(s.w, at.Z + i, load(memory, place + at.A_Z))
    store(s.w, at.VZ + i, load(memory, place + at.A_VZ))


read_height = by_table(no_heights, take_height)
"""``read_height(s, i, memory, place)``: take the vertical part of a state, where states have one."""


@kernel
def put_away(s, i, motion):
    """Take ball ``i`` out of play."""
    take_away(s, i)
    store_integer(s.k, at.MOTION + i, motion)
    store_integer(s.k, at.KIND + i, at.NOTHING)
    for quantity in (at.VX, at.VY, at.WX, at.WY, at.WZ, at.HX, at.HY, at.SINCE, at.Y):
        store(s.w, quantity + i, 0.0)
    store(s.w, at.X + i, FAR_AWAY * float(i + 1))
    store(s.w, at.END + i, math.inf)
    store(s.w, at.NEXT + i, math.inf)


@small_kernel
def clear(s):
    """Nothing moves and nothing is to come."""
    clear_heights(s)
    for n in range(at.VX, at.END):
        store(s.w, n, 0.0)
    for i in range(at.LANES):
        store(s.w, at.END + i, math.inf)
        store(s.w, at.NEXT + i, math.inf)
        store_integer(s.k, at.KIND + i, at.NOTHING)


@kernel
def place(s, positions):
    """Lay out balls at rest from 32 numbers x0 y0 x1 y1 ... in the table's frame; NaN for a ball that is not there.

    Returns the bit set of balls on the table.
    """
    clear(s)
    alive = 0
    half_x, half_y = load(s.p, at.P_HALF_X), load(s.p, at.P_HALF_Y)
    for i in range(at.LANES):
        x, y = load(positions, 2 * i), load(positions, 2 * i + 1)
        there = x == x
        store_integer(s.k, at.MOTION + i, at.STATIONARY if there else at.ABSENT)
        store(s.w, at.X + i, x - half_x if there else FAR_AWAY * float(i + 1))
        store(s.w, at.Y + i, y - half_y if there else 0.0)
        alive |= int(there) << i
    return alive


@small_kernel
def read_speeds(s, i, memory, place):
    """Take velocity and spin of ball ``i`` from a state in ``memory``."""
    store(s.w, at.VX + i, load(memory, place + at.A_VX))
    store(s.w, at.VY + i, load(memory, place + at.A_VY))
    store(s.w, at.WX + i, load(memory, place + at.A_WX))
    store(s.w, at.WY + i, load(memory, place + at.A_WY))
    store(s.w, at.WZ + i, load(memory, place + at.A_WZ))
    read_height(s, i, memory, place)


@kernel
def restore(s, states):
    """Lay out balls in motion from 16 states, positions in the table's frame; bit set of balls on the table."""
    clear(s)
    alive = 0
    for i in range(at.LANES):
        place = i * state_width(s)
        motion = int(load(states, place + at.A_MOTION))
        store_integer(s.k, at.MOTION + i, motion)
        store(s.w, at.X + i, FAR_AWAY * float(i + 1))
        store(s.w, at.Y + i, 0.0)
        if on_table(motion):
            store(s.w, at.X + i, load(states, place + at.A_X) - load(s.p, at.P_HALF_X))
            store(s.w, at.Y + i, load(states, place + at.A_Y) - load(s.p, at.P_HALF_Y))
            read_speeds(s, i, states, place)
            begin(s, i, motion)
            alive |= 1 << i
    return alive


@small_kernel
def reset(s, rows):
    """Nothing has happened yet. The trace has room for ``rows`` events."""
    for n in range(at.F_INTEGERS):
        store_fact(s.facts, n, -1)
    store_fact(s.facts, at.F_MISCUE, 0)
    store_fact_number(s.facts, at.F_DURATION, 0.0)
    store_fact_number(s.facts, at.F_CUE_X, math.nan)
    store_fact_number(s.facts, at.F_CUE_Y, math.nan)
    for n in range(at.SCALARS, at.PAIRS):
        store_integer(s.k, n, 0)
    store_integer(s.k, at.TRACE_ROWS, rows)


@kernel
def note_frozen(s, alive):
    """Note which balls touch a cushion or the cue ball at the start."""
    for n in range(at.F_FROZEN_CUSHION, at.F_FROZEN_CUE + at.LANES):
        store_fact(s.facts, n, 0)
    rest = neighbours(s, plain(at.CUE_BALL), 0.0) if alive & 1 else 0
    while rest != 0:
        store_fact(s.facts, at.F_FROZEN_CUE + lowest_bit(rest), 1)
        rest &= rest - 1
    near_x, near_y = load(s.p, at.P_LINE_X) - TOUCH, load(s.p, at.P_LINE_Y) - TOUCH
    rest = 0
    for i in range(at.LANES):
        rest |= int((abs(load(s.w, at.X + i)) >= near_x) | (abs(load(s.w, at.Y + i)) >= near_y)) << i
    rest &= alive
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        cushion = touched_cushion(s, i)
        if cushion != at.NO_CUSHION:
            store_integer(s.k, at.FROZEN + i, cushion)
            store_integer(s.k, at.FROZEN_BALLS, load_integer(s.k, at.FROZEN_BALLS) | 1 << i)
            store_fact(s.facts, at.F_FROZEN_CUSHION + i, 1)


@small_kernel
def note_start(s):
    """Note whether the cue ball starts on or beyond the head string."""
    if load(s.w, at.Y) <= load(s.p, at.P_HEAD):
        store_integer(s.k, at.CROSSED, 1)
        store_fact(s.facts, at.F_CROSSED, 0)
        store_fact(s.facts, at.F_CROSSED_BEFORE, 0)
