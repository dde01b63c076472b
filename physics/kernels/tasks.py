"""What entry points do, in the workspace of either kind of table. Arrays: see ``entries``."""

import math

import numpy as np

from physics.kernels import layout as at
from physics.kernels.advance import advance
from physics.kernels.apart import apart
from physics.kernels.compiling import kernel, load, load_integer, row, small_kernel, store
from physics.kernels.detect.line import may_lie_inside
from physics.kernels.detect.mouths import may_stand
from physics.kernels.entry import COUNTERS, FACTS, POCKETS, READ, WRITTEN
from physics.kernels.loop import play
from physics.kernels.motion import on_table
from physics.kernels.recording import state_width, write_state
from physics.kernels.resolve.cloth import begin
from physics.kernels.start import place, put_away, read_speeds, reset, restore
from physics.kernels.strike import MILLIMETRE, lowest_elevation, obstacle, playable, read_stroke
from physics.kernels.tolerances import TOUCH
from physics.kernels.workspace import RealWorkspace, Workspace, by_table, with_facts

may_lie = by_table(may_lie_inside, may_stand)
"""``may_lie(s, x, y, slack)``: whether a centre may rest at (x, y), from the table's centre."""

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


@small_kernel
def simulate_row(s, n, states, shots, final, pockets, facts, rows, counters):
    """Simulate shot ``n`` of ``simulate_rows``."""
    moving = int(states.shape[1] != 2 * at.LANES)
    given = row(states, n if states.shape[0] > 1 else 0)
    reset(s, rows)
    play(s, moving, given, row(shots, n if moving == 0 else 0))
    collect(s, given, state_width(s) if moving else 2, row(final, n))
    for i in range(at.LANES):
        absent = load_integer(s.k, at.MOTION + i) == at.ABSENT
        pockets[n, i] = at.ABSENT_FROM_START if absent else facts[n, at.F_POCKET + i]
    if counters.shape[0] > 0:
        for c in range(at.N_COUNTERS):
            counters[n, c] = load_integer(s.k, at.LOOKS + c)


@apart(None, (Workspace, RealWorkspace), READ, READ, WRITTEN, POCKETS, FACTS, int, COUNTERS)
@kernel
def simulate_rows(s, states, shots, final, pockets, facts, rows, counters):
    """See ``entries.simulate_rows``; ``rows``: events the trace has room for."""
    for n in range(final.shape[0]):
        simulate_row(with_facts(s, row(facts, n)), n, states, shots, final, pockets, facts, rows, counters)


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


@kernel
def states_at(s, states, trace, times, out):
    """States of all balls at ascending ``times`` (1, n), from the states at the start and the trace; a row of ``out``
    each, from the centre."""
    last = np.full(at.LANES, -1)
    width = state_width(s)
    stride = at.T_FIRST + 2 * width
    event = 0
    for n in range(times.shape[1]):
        time = times[0, n]
        while event < trace.shape[1] // stride and trace[0, event * stride + at.T_TIME] <= time:
            start = event * stride
            last[int(trace[0, start + at.T_BALL])] = start + at.T_FIRST
            if int(trace[0, start + at.T_KIND]) == at.BALL_COLLISION:
                last[int(trace[0, start + at.T_OTHER])] = start + at.T_FIRST + width
            event += 1
        restore(s, row(states, 0))
        for i in range(at.LANES):
            if last[i] >= 0:
                since = trace[0, last[i] // stride * stride + at.T_TIME]
                take_state(s, i, row(trace, 0), last[i], since)
            if on_table(load_integer(s.k, at.MOTION + i)):
                advance(s, i, time)
            write_state(s, i, row(out, n), i * width)


@kernel
def check_shot(s, positions, shot):
    """(status, obstacle) of a shot: AT_REST and NOBODY when it can be played."""
    place(s, row(positions, 0))
    stroke = read_stroke(row(shot, 0))
    status = playable(s, stroke)
    return status, obstacle(s, stroke) if status == at.CUE_OBSTRUCTED else at.NOBODY


@kernel
def elevation_needed(s, positions, phi, a, b):
    """Smallest free elevation in deg, NaN if none; a and b in mm, on the ball."""
    place(s, row(positions, 0))
    return lowest_elevation(s, phi, a * MILLIMETRE, b * MILLIMETRE)


@kernel
def first_bad_row(s, positions, least_squared, slack):
    """(row, ball, other) of the first state with a bad place or an overlap (then ``other`` >= 0); (-1, -1, -1)."""
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
