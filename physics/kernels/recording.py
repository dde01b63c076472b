"""What a shot leaves behind: the trace of events, if asked for, and the facts rules need, always."""

from physics.kernels.advance import along
from physics.kernels.compiling import (
    kernel,
    load,
    load_integer,
    small_kernel,
    store,
    store_fact,
    store_integer,
)
from physics.kernels.layout import (
    BALL_COLLISION,
    CONTACT_SEEN,
    CROSSED,
    CUSHION_AFTER_SEEN,
    CUSHION_SEEN,
    F_CROSSED,
    F_CROSSED_BEFORE,
    F_CUE_X,
    F_CUE_Y,
    F_CUSHION,
    F_CUSHION_AFTER,
    F_FIRST,
    HY,
    MOTION,
    N_EVENTS,
    P_HALF_X,
    P_HALF_Y,
    P_HEAD,
    SINCE,
    STRETCH,
    T_BALL,
    T_FIRST,
    T_KIND,
    T_OTHER,
    T_SECOND,
    T_TIME,
    TRACE_ROWS,
    TRACE_WIDTH,
    VX,
    VY,
    WX,
    WY,
    WZ,
    X,
    Y,
)

CUE_BALL = 0


@small_kernel
def write_state(w, k, i, memory, at):
    """Write x y vx vy wx wy wz motion of ball ``i`` to ``memory`` from place ``at`` on."""
    store(memory, at, load(w, X + i))
    store(memory, at + 1, load(w, Y + i))
    store(memory, at + 2, load(w, VX + i))
    store(memory, at + 3, load(w, VY + i))
    store(memory, at + 4, load(w, WX + i))
    store(memory, at + 5, load(w, WY + i))
    store(memory, at + 6, load(w, WZ + i))
    store(memory, at + 7, float(load_integer(k, MOTION + i)))


@kernel
def record(w, k, trace, time, kind, ball, other):
    """Count an event and, while the trace has room, write its row; its ordinal."""
    event = load_integer(k, N_EVENTS)
    store_integer(k, N_EVENTS, event + 1)
    if ball == CUE_BALL:
        store_integer(k, STRETCH, event)
    if event < load_integer(k, TRACE_ROWS):
        start = event * TRACE_WIDTH
        store(trace, start + T_TIME, time)
        store(trace, start + T_KIND, float(kind))
        store(trace, start + T_BALL, float(ball))
        store(trace, start + T_OTHER, float(other))
        write_state(w, k, ball, trace, start + T_FIRST)
        if kind == BALL_COLLISION:
            write_state(w, k, other, trace, start + T_SECOND)
    return event


@kernel
def note_crossing(p, w, k, facts, time):
    """Note when the cue ball's stretch up to ``time`` reaches the head string from behind."""
    if load_integer(k, CROSSED) != 0:
        return
    head = load(p, P_HEAD)
    start, speed, half = load(w, Y), load(w, VY), load(w, HY)
    dt = time - load(w, SINCE)
    lowest = min(start, along(start, speed, half, dt))
    if speed < 0.0 and half > 0.0:
        turning = -0.5 * speed / half
        if turning < dt:
            lowest = along(start, speed, half, turning)
    if lowest <= head:
        store_integer(k, CROSSED, 1)
        event = load_integer(k, STRETCH)
        store_fact(facts, F_CROSSED, event)
        if load_integer(k, CONTACT_SEEN) == 0:
            store_fact(facts, F_CROSSED_BEFORE, event)


@kernel
def note_contact(p, w, facts, facts_float, ball, event):
    """Note a ball the cue ball strikes in the first round of contacts it makes."""
    store_fact(facts, F_FIRST + ball, event)
    store(facts_float, F_CUE_X, load(w, X) + load(p, P_HALF_X))
    store(facts_float, F_CUE_Y, load(w, Y) + load(p, P_HALF_Y))


@kernel
def note_cushion(k, facts, ball, event):
    """Note that a ball was driven to a cushion."""
    bit = 1 << ball
    seen = load_integer(k, CUSHION_SEEN)
    if seen & bit == 0:
        store_integer(k, CUSHION_SEEN, seen | bit)
        store_fact(facts, F_CUSHION + ball, event)
    if load_integer(k, CONTACT_SEEN) != 0:
        seen = load_integer(k, CUSHION_AFTER_SEEN)
        if seen & bit == 0:
            store_integer(k, CUSHION_AFTER_SEEN, seen | bit)
            store_fact(facts, F_CUSHION_AFTER + ball, event)
