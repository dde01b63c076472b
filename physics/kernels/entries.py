"""Entry points: what the Python layer calls. Arrays in, arrays out; compiled once and cached.

Every array is C-contiguous and two-dimensional, one shot a row: ``p`` (1, P_SIZE) float64; ``positions`` (n, 32) or
(1, 32) for all; ``states`` the same or (n, 128); ``shots`` (n, 5); ``facts`` (n, 138) int32 and ``facts_float``
(n, 69) float64 are two views of one structured array; ``trace`` (1, rows * TRACE_WIDTH).

``w`` (1, W_SIZE) float64 and ``k`` (1, K_SIZE) int64 are the memory a shot is worked out in. The caller holds them: an
array made in here would be released after its last use by name, while kernels still address it.
"""

from typing import Any

import numba
import numpy as np
from numba import types

from physics.kernels.advance import advance
from physics.kernels.compiling import kernel, load, load_integer, row, small_kernel, store
from physics.kernels.detect.contact import contact
from physics.kernels.detect.line import may_lie
from physics.kernels.layout import (
    ABSENT,
    BALL_COLLISION,
    F_POCKET,
    LANES,
    LOOKS,
    MOTION,
    P_HALF_X,
    P_HALF_Y,
    POCKETED,
    SINCE,
    STATE_WIDTH,
    T_BALL,
    T_FIRST,
    T_KIND,
    T_OTHER,
    T_SECOND,
    T_TIME,
    TRACE_WIDTH,
    VX,
    X,
    Y,
)
from physics.kernels.loop import go_on, play
from physics.kernels.recording import write_state
from physics.kernels.resolve.cloth import begin
from physics.kernels.start import place, put_away, restore
from physics.kernels.strike import MILLIMETRE, direction, lowest_elevation, obstacle, unplayable
from physics.kernels.tolerances import TOUCH

READ = types.Array(types.float64, 2, "C", readonly=True)
WRITTEN = types.Array(types.float64, 2, "C")
INTEGERS, FACTS = types.Array(types.int64, 2, "C"), types.Array(types.int32, 2, "C")
POCKETS, STATUS = types.Array(types.int8, 2, "C"), types.Array(types.int8, 1, "C")
FLOAT, INTEGER, NONE = types.float64, types.int64, types.void


def entry(result: Any, *arguments: Any) -> Any:
    """Decorator: compiled when loaded, for these types alone, and kept where ``physics.engine`` says, if anywhere.

    What a kernel only reads may be a read-only array or another: both are taken as they are.
    """
    kept = bool(numba.config.CACHE_DIR)
    return numba.njit(result(*arguments), error_model="numpy", nogil=True, cache=kept)


NUDGES, NUDGE = 16, 1.0 - 2.0**-52
"""How often, and by what factor, a ball that stopped on a mouth line is drawn towards the centre of the table."""

ABSENT_FROM_START = -2
"""Value of a batch's ``pocket`` for a ball that was not on the table; -1 is one that stayed on it."""


@kernel
def legal_place(p, x, y):
    """A place in the table's frame, as it reads back from there off the mouth lines; (x, y) from the centre.

    A ball may stop within rounding of a mouth line, and the change of frame may round it onto the line, where no ball
    may start. Such a one is drawn towards the centre, some 1e-16 m at a time.
    """
    half_x, half_y = load(p, P_HALF_X), load(p, P_HALF_Y)
    for _ in range(NUDGES):
        out_x, out_y = x + half_x, y + half_y
        if may_lie(p, out_x - half_x, out_y - half_y, TOUCH):
            break
        x *= NUDGE
        y *= NUDGE
    return x + half_x, y + half_y


@small_kernel
def collect(p, w, k, start, stride, final):
    """Write where the balls lie, in the table's frame; a ball that never moved keeps the bits it came with.

    ``start``: x and y of each ball, ``stride`` numbers apart.
    """
    half_x, half_y = load(p, P_HALF_X), load(p, P_HALF_Y)
    for i in range(LANES):
        on_table = load_integer(k, MOTION + i) < POCKETED
        x, y = load(start, stride * i), load(start, stride * i + 1)
        new_x, new_y = load(w, X + i), load(w, Y + i)
        still = (new_x == x - half_x) & (new_y == y - half_y)
        if on_table and not still:
            x, y = legal_place(p, new_x, new_y)
        store(final, 2 * i, x if on_table else np.nan)
        store(final, 2 * i + 1, y if on_table else np.nan)


@entry(
    NONE,
    *(READ, WRITTEN, INTEGERS, READ, READ),
    *(WRITTEN, POCKETS, STATUS, FACTS, WRITTEN, WRITTEN),
    *(INTEGER, INTEGERS, INTEGER, INTEGER),
)
def simulate_rows(
    p, w, k, states, shots, final, pockets, status, facts, facts_float, trace, rows, counters, first, last
):
    """Simulate rows ``first`` to ``last`` - 1.

    ``states``: positions at rest, of width 32, each struck by its shot; or balls in motion, of width 128, which go on
    (``shots`` is not read then). ``rows``: events ``trace`` has room for, of one shot. ``counters``: (n, 4) int64,
    filled with the work done (predictions, pairs past the filter, contacts solved, boundary looks), or (0, 4).
    """
    table, floats, integers, events = row(p, 0), row(w, 0), row(k, 0), row(trace, 0)
    moving = states.shape[1] != 2 * LANES
    for n in range(first, last):
        given = row(states, n if states.shape[0] > 1 else 0)
        fact, fact_float = row(facts, n), row(facts_float, n)
        if moving:
            status[n] = go_on(table, floats, integers, fact, fact_float, events, rows, given)
        else:
            status[n] = play(table, floats, integers, fact, fact_float, events, rows, given, row(shots, n))
        collect(table, floats, integers, given, STATE_WIDTH if moving else 2, row(final, n))
        for i in range(LANES):
            motion = k[0, MOTION + i]
            pockets[n, i] = ABSENT_FROM_START if motion == ABSENT else facts[n, F_POCKET + i]
        if counters.shape[0] > 0:
            for c in range(4):
                counters[n, c] = k[0, LOOKS + c]


@kernel
def take_state(p, w, k, memory, at, i, time):
    """Put ball ``i`` into a state of the trace, anchored at ``time``."""
    store(w, X + i, load(memory, at))
    store(w, Y + i, load(memory, at + 1))
    for n in range(5):
        store(w, VX + n * LANES + i, load(memory, at + 2 + n))
    store(w, SINCE + i, time)
    motion = int(load(memory, at + 7))
    if motion >= POCKETED:
        put_away(w, k, i, motion)
    else:
        begin(p, w, k, i, motion)


@entry(NONE, READ, WRITTEN, INTEGERS, READ, READ, INTEGER, FLOAT, WRITTEN)
def state_at(p, w, k, states, trace, rows, time, out):
    """States of all balls at ``time``, from the states at the start and the trace; (1, 128), from the centre."""
    table, floats, integers, events = row(p, 0), row(w, 0), row(k, 0), row(trace, 0)
    restore(table, floats, integers, row(states, 0))
    last = np.full(LANES, -1)
    for n in range(rows):
        start = n * TRACE_WIDTH
        if trace[0, start + T_TIME] > time:
            break
        last[int(trace[0, start + T_BALL])] = start + T_FIRST
        if int(trace[0, start + T_KIND]) == BALL_COLLISION:
            last[int(trace[0, start + T_OTHER])] = start + T_SECOND
    for i in range(LANES):
        if last[i] >= 0:
            since = trace[0, last[i] // TRACE_WIDTH * TRACE_WIDTH + T_TIME]
            take_state(table, floats, integers, events, last[i], i, since)
        if load_integer(integers, MOTION + i) < POCKETED:
            advance(table, floats, integers, i, time)
        write_state(floats, integers, i, row(out, 0), i * STATE_WIDTH)


@entry(types.UniTuple(INTEGER, 2), READ, WRITTEN, INTEGERS, READ, READ)
def check_shot(p, w, k, positions, shot):
    """(status, obstacle) of a shot: 0 and -1 when it can be played."""
    table, floats, integers = row(p, 0), row(w, 0), row(k, 0)
    place(table, floats, integers, row(positions, 0))
    v, phi, theta = shot[0, 0], shot[0, 1], shot[0, 2]
    a, b = shot[0, 3] * MILLIMETRE, shot[0, 4] * MILLIMETRE
    aim = direction(phi, theta)
    status = unplayable(table, floats, integers, v, theta, aim, a, b)
    return status, obstacle(table, floats, aim, a, b) if status == 1 else -1


@entry(FLOAT, READ, WRITTEN, INTEGERS, READ, FLOAT, FLOAT, FLOAT)
def elevation_needed(p, w, k, positions, phi, a, b):
    """Smallest free elevation in deg, NaN if none; a and b in mm, on the ball."""
    table, floats, integers = row(p, 0), row(w, 0), row(k, 0)
    place(table, floats, integers, row(positions, 0))
    return lowest_elevation(table, floats, phi, a * MILLIMETRE, b * MILLIMETRE)


@entry(FLOAT, FLOAT, FLOAT, FLOAT, FLOAT, FLOAT, FLOAT, FLOAT, FLOAT)
def time_of_contact(cx, cy, bx, by, ax, ay, t_max, distance):
    """Earliest contact in [0, t_max], NaN if none: the loop's solver."""
    return contact(cx, cy, bx, by, ax, ay, t_max, t_max, distance)


@entry(types.UniTuple(INTEGER, 3), READ, READ, FLOAT, FLOAT, INTEGER, INTEGER)
def first_bad_row(p, positions, least_squared, slack, first, last):
    """(row, ball, other) of the first state with a bad place or an overlap (then ``other`` >= 0); (-1, -1, -1).

    Rows ``first`` to ``last`` - 1 are looked at.
    """
    table = row(p, 0)
    for n in range(first, last):
        for i in range(LANES):
            x, y = positions[n, 2 * i], positions[n, 2 * i + 1]
            if x != x and y != y:
                continue
            if not may_lie(table, x - load(table, P_HALF_X), y - load(table, P_HALF_Y), slack):
                return n, i, -1
            for j in range(i):
                dx, dy = x - positions[n, 2 * j], y - positions[n, 2 * j + 1]
                if dx * dx + dy * dy < least_squared:
                    return n, i, j
    return -1, -1, -1
