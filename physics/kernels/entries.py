"""Entry points: what the Python layer calls. Arrays in, arrays out; compiled once and cached.

Every array is C-contiguous and two-dimensional, one shot a row: ``p`` (1, P_SIZE) float64; ``positions`` (n, 32) or
(1, 32) for all; ``states`` the same or (n, 128); ``shots`` (n, SHOT_WIDTH); ``facts`` (n, FACTS_WIDTH) int32, a view of
the structured array; ``trace`` (1, rows * TRACE_WIDTH).

``work`` (1, W_SIZE + K_SIZE) float64 is the memory a shot is worked out in. The caller holds it: an array made in here
would be released after its last use by name, while kernels still address it.
"""

import math
from typing import Any

import numba
import numpy as np
from numba import types

from physics.kernels import layout as at
from physics.kernels.advance import advance
from physics.kernels.compiling import kernel, load, load_integer, row, small_kernel, store
from physics.kernels.detect.contact import contact_time
from physics.kernels.detect.line import may_lie
from physics.kernels.loop import play
from physics.kernels.motion import on_table
from physics.kernels.path import Path
from physics.kernels.recording import write_state
from physics.kernels.resolve.cloth import begin
from physics.kernels.start import place, put_away, read_speeds, reset, restore
from physics.kernels.strike import MILLIMETRE, lowest_elevation, obstacle, playable, read_stroke
from physics.kernels.tolerances import EVENT_LIMIT, TOUCH
from physics.kernels.workspace import bare_workspace, workspace

READ = types.Array(types.float64, 2, "C", readonly=True)
WRITTEN = types.Array(types.float64, 2, "C")
COUNTERS, FACTS = types.Array(types.int64, 2, "C"), types.Array(types.int32, 2, "C")
POCKETS = types.Array(types.int8, 2, "C")
FLOAT, INTEGER, NONE = types.float64, types.int64, types.void


def entry(result: Any, *arguments: Any) -> Any:
    """Decorator: compiled when loaded, for these types alone, and kept where ``physics.engine`` says, if anywhere.

    What a kernel only reads may be a read-only array or another: both are taken as they are.
    """
    kept = bool(numba.config.CACHE_DIR)
    return numba.njit(result(*arguments), error_model="numpy", nogil=True, cache=kept)


NUDGES, NUDGE = 16, 1.0 - 2.0**-52
"""How often, and by what factor, a ball that stopped on a mouth line is drawn towards the centre of the table."""


@kernel
def legal_place(s, x, y):
    """A place in the table's frame, as it reads back from there off the mouth lines; (x, y) from the centre.

    A ball may stop within rounding of a mouth line, and the change of frame may round it onto the line, where no ball
    may start. Such a one is drawn towards the centre, some 1e-16 m at a time.
    """
    half_x, half_y = load(s.p, at.P_HALF_X), load(s.p, at.P_HALF_Y)
    for _ in range(NUDGES):
        out_x, out_y = x + half_x, y + half_y
        if may_lie(s, out_x - half_x, out_y - half_y, TOUCH):
            break
        x *= NUDGE
        y *= NUDGE
    return x + half_x, y + half_y


@small_kernel
def collect(s, start, stride, final):
    """Write where the balls lie, in the table's frame; a ball that never moved keeps the bits it came with.

    ``start``: x and y of each ball, ``stride`` numbers apart.
    """
    half_x, half_y = load(s.p, at.P_HALF_X), load(s.p, at.P_HALF_Y)
    for i in range(at.LANES):
        here = on_table(load_integer(s.k, at.MOTION + i))
        x, y = load(start, stride * i), load(start, stride * i + 1)
        new_x, new_y = load(s.w, at.X + i), load(s.w, at.Y + i)
        still = (new_x == x - half_x) & (new_y == y - half_y)
        if here and not still:
            x, y = legal_place(s, new_x, new_y)
        store(final, 2 * i, x if here else np.nan)
        store(final, 2 * i + 1, y if here else np.nan)


@entry(NONE, READ, WRITTEN, READ, READ, WRITTEN, POCKETS, FACTS, WRITTEN, COUNTERS)
def simulate_rows(p, work, states, shots, final, pockets, facts, trace, counters):
    """Simulate n shots.

    ``states``: positions at rest, of width 32, each struck by its shot; or balls in motion, of width 128, which go on
    (``shots`` is not read then). One row is for all. ``final`` (n, 32), ``pockets`` (n, 16) and ``facts`` are filled;
    ``trace``: events of one shot, as many as it has room for. ``counters``: (n, N_COUNTERS) int64, filled with the work
    done (predictions, pairs past the filter, contacts solved, boundary looks), or of no rows.
    """
    moving = int(states.shape[1] != 2 * at.LANES)
    rows = trace.shape[1] // at.TRACE_WIDTH
    for n in range(final.shape[0]):
        given = row(states, n if states.shape[0] > 1 else 0)
        s = workspace(p, work, row(facts, n), trace)
        reset(s, rows, EVENT_LIMIT)
        play(s, moving, given, row(shots, n if moving == 0 else 0))
        collect(s, given, at.STATE_WIDTH if moving else 2, row(final, n))
        for i in range(at.LANES):
            absent = load_integer(s.k, at.MOTION + i) == at.ABSENT
            pockets[n, i] = at.ABSENT_FROM_START if absent else facts[n, at.F_POCKET + i]
        if counters.shape[0] > 0:
            for c in range(at.N_COUNTERS):
                counters[n, c] = load_integer(s.k, at.LOOKS + c)


@kernel
def take_state(s, i, memory, start, time):
    """Put ball ``i`` into a state of the trace, anchored at ``time``."""
    store(s.w, at.X + i, load(memory, start + at.A_X))
    store(s.w, at.Y + i, load(memory, start + at.A_Y))
    read_speeds(s, i, memory, start)
    store(s.w, at.SINCE + i, time)
    motion = int(load(memory, start + at.A_MOTION))
    if on_table(motion):
        begin(s, i, motion)
    else:
        put_away(s, i, motion)


@entry(NONE, READ, WRITTEN, READ, READ, FLOAT, WRITTEN)
def state_at(p, work, states, trace, time, out):
    """States of all balls at ``time``, from the states at the start and the trace; (1, 128), from the centre."""
    s = bare_workspace(p, work)
    restore(s, row(states, 0))
    last = np.full(at.LANES, -1)
    for n in range(trace.shape[1] // at.TRACE_WIDTH):
        start = n * at.TRACE_WIDTH
        if trace[0, start + at.T_TIME] > time:
            break
        last[int(trace[0, start + at.T_BALL])] = start + at.T_FIRST
        if int(trace[0, start + at.T_KIND]) == at.BALL_COLLISION:
            last[int(trace[0, start + at.T_OTHER])] = start + at.T_SECOND
    for i in range(at.LANES):
        if last[i] >= 0:
            since = trace[0, last[i] // at.TRACE_WIDTH * at.TRACE_WIDTH + at.T_TIME]
            take_state(s, i, row(trace, 0), last[i], since)
        if on_table(load_integer(s.k, at.MOTION + i)):
            advance(s, i, time)
        write_state(s, i, row(out, 0), i * at.STATE_WIDTH)


@entry(types.UniTuple(INTEGER, 2), READ, WRITTEN, READ, READ)
def check_shot(p, work, positions, shot):
    """(status, obstacle) of a shot: AT_REST and NOBODY when it can be played."""
    s = bare_workspace(p, work)
    place(s, row(positions, 0))
    stroke = read_stroke(row(shot, 0))
    status = playable(s, stroke)
    return status, obstacle(s, stroke) if status == at.CUE_OBSTRUCTED else at.NOBODY


@entry(FLOAT, READ, WRITTEN, READ, FLOAT, FLOAT, FLOAT)
def elevation_needed(p, work, positions, phi, a, b):
    """Smallest free elevation in deg, NaN if none; a and b in mm, on the ball."""
    s = bare_workspace(p, work)
    place(s, row(positions, 0))
    return lowest_elevation(s, phi, a * MILLIMETRE, b * MILLIMETRE)


@entry(FLOAT, READ, FLOAT, FLOAT)
def time_of_contact(path, t_max, distance):
    """Earliest contact in [0, t_max] on a relative path (1, 6) of x y vx vy hx hy, NaN if none: the loop's solver."""
    relative = Path(path[0, 0], path[0, 1], path[0, 2], path[0, 3], path[0, 4], path[0, 5])
    return contact_time(relative, t_max, distance)


@entry(types.UniTuple(INTEGER, 3), READ, WRITTEN, READ, FLOAT, FLOAT)
def first_bad_row(p, work, positions, least_squared, slack):
    """(row, ball, other) of the first state with a bad place or an overlap (then ``other`` >= 0); (-1, -1, -1)."""
    s = bare_workspace(p, work)
    half_x, half_y = load(s.p, at.P_HALF_X), load(s.p, at.P_HALF_Y)
    for n in range(positions.shape[0]):
        for i in range(at.LANES):
            x, y = positions[n, 2 * i], positions[n, 2 * i + 1]
            if math.isnan(x) and math.isnan(y):
                continue
            if not may_lie(s, x - half_x, y - half_y, slack):
                return n, i, at.NOBODY
            for j in range(i):
                dx, dy = x - positions[n, 2 * j], y - positions[n, 2 * j + 1]
                if dx * dx + dy * dy < least_squared:
                    return n, i, j
    return -1, -1, -1
