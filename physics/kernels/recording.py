"""What a shot leaves behind: the trace of events, if asked for, and the facts rules need, always."""

from physics.kernels import layout as at
from physics.kernels.compiling import (
    kernel,
    load,
    load_integer,
    small_kernel,
    store,
    store_fact,
    store_fact_number,
    store_integer,
)
from physics.kernels.path import along
from physics.kernels.workspace import by_table


@small_kernel
def flat_width(_s):
    """See ``state_width``."""
    return at.STATE_WIDTH


@small_kernel
def real_width(_s):
    """See ``state_width``."""
    return at.REAL_STATE_WIDTH


state_width = by_table(flat_width, real_width)
"""``state_width(s)``: numbers of a ball's state."""


@small_kernel
def no_height(_s, _i, _memory, _place):
    """See ``write_height``."""


@small_kernel
def height_too(s, i, memory, place):
    """See ``write_height``."""
    store(memory, place + at.A_Z, load(s.w, at.Z + i))
    store(memory, place + at.A_VZ, load(s.w, at.VZ + i))


write_height = by_table(no_height, height_too)
"""``write_height(s, i, memory, place)``: the vertical part of a state, where states have one."""


@small_kernel
def write_state(s, i, memory, place):
    """Write the state of ball ``i`` to ``memory`` from ``place`` on."""
    store(memory, place + at.A_X, load(s.w, at.X + i))
    store(memory, place + at.A_Y, load(s.w, at.Y + i))
    store(memory, place + at.A_VX, load(s.w, at.VX + i))
    store(memory, place + at.A_VY, load(s.w, at.VY + i))
    store(memory, place + at.A_WX, load(s.w, at.WX + i))
    store(memory, place + at.A_WY, load(s.w, at.WY + i))
    store(memory, place + at.A_WZ, load(s.w, at.WZ + i))
    store(memory, place + at.A_MOTION, float(load_integer(s.k, at.MOTION + i)))
    write_height(s, i, memory, place)


@kernel
def record(s, time, kind, ball, other):
    """Count an event and, while the trace has room, write its row, 0 where there is no second ball; its ordinal."""
    event = load_integer(s.k, at.N_EVENTS)
    store_integer(s.k, at.N_EVENTS, event + 1)
    if ball == at.CUE_BALL:
        store_integer(s.k, at.STRETCH, event)
    if event < load_integer(s.k, at.TRACE_ROWS):
        width = state_width(s)
        second = at.T_FIRST + width
        start = event * (second + width)
        store(s.trace, start + at.T_TIME, time)
        store(s.trace, start + at.T_KIND, float(kind))
        store(s.trace, start + at.T_BALL, float(ball))
        store(s.trace, start + at.T_OTHER, float(other))
        write_state(s, ball, s.trace, start + at.T_FIRST)
        if kind == at.BALL_COLLISION:
            write_state(s, other, s.trace, start + second)
        else:
            for n in range(second, second + width):
                store(s.trace, start + n, 0.0)
    return event


@kernel
def note_crossing(s, time):
    """Note when the cue ball's stretch up to ``time`` reaches the head string from behind."""
    if load_integer(s.k, at.CROSSED) != 0:
        return
    head = load(s.p, at.P_HEAD)
    start, speed, half = load(s.w, at.Y), load(s.w, at.VY), load(s.w, at.HY)
    dt = time - load(s.w, at.SINCE)
    lowest = min(start, along(start, speed, half, dt))
    if speed < 0.0 and half > 0.0:
        turning = -0.5 * speed / half  # y' = speed + 2 half t = 0
        if turning < dt:
            lowest = along(start, speed, half, turning)
    if lowest <= head:
        store_integer(s.k, at.CROSSED, 1)
        event = load_integer(s.k, at.STRETCH)
        store_fact(s.facts, at.F_CROSSED, event)
        if load_integer(s.k, at.CONTACT_SEEN) == 0:
            store_fact(s.facts, at.F_CROSSED_BEFORE, event)


@kernel
def note_contact(s, ball, event):
    """Note a ball the cue ball strikes in the first round of contacts it makes."""
    store_fact(s.facts, at.F_FIRST + ball, event)
    store_fact_number(s.facts, at.F_CUE_X, load(s.w, at.X) + load(s.p, at.P_HALF_X))
    store_fact_number(s.facts, at.F_CUE_Y, load(s.w, at.Y) + load(s.p, at.P_HALF_Y))


@kernel
def note_cushion(s, ball, event):
    """Note that a ball was driven to a cushion."""
    bit = 1 << ball
    seen = load_integer(s.k, at.CUSHION_SEEN)
    if seen & bit == 0:
        store_integer(s.k, at.CUSHION_SEEN, seen | bit)
        store_fact(s.facts, at.F_CUSHION + ball, event)
    if load_integer(s.k, at.CONTACT_SEEN) != 0:
        seen = load_integer(s.k, at.CUSHION_AFTER_SEEN)
        if seen & bit == 0:
            store_integer(s.k, at.CUSHION_AFTER_SEEN, seen | bit)
            store_fact(s.facts, at.F_CUSHION_AFTER + ball, event)
