"""The event loop ([I], figure 1): strike, then event after event until every ball is at rest."""

import math

from physics.kernels.compiling import (
    kernel,
    load,
    load_integer,
    lowest_bit,
    small_kernel,
    store,
    store_fact,
    store_integer,
)
from physics.kernels.detect.prediction import predict, release
from physics.kernels.layout import (
    ABSENT,
    CROSSED,
    CUE_STRIKE,
    END,
    F_CROSSED,
    F_CROSSED_BEFORE,
    F_CUE_X,
    F_CUE_Y,
    F_DURATION,
    F_EVENTS,
    F_FROZEN_CUE,
    F_FROZEN_CUSHION,
    F_INTEGERS,
    F_POCKET,
    F_POCKETED,
    F_STATUS,
    FROZEN,
    HX,
    HY,
    KIND,
    LANES,
    LOOK_AGAIN,
    MEET_BALL,
    MEET_POCKET,
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
    PARTNER,
    POCKET_COLLISION,
    POCKETED,
    SINCE,
    SPINNING_STATIONARY,
    STATE_WIDTH,
    STATIONARY,
    TRACE_ROWS,
    TRANSITION,
    VX,
    VY,
    WX,
    WY,
    WZ,
    X,
    Y,
)
from physics.kernels.recording import CUE_BALL, record
from physics.kernels.resolve.cloth import begin, transition
from physics.kernels.resolve.cluster import FAILED, NOBODY, restate, settle
from physics.kernels.resolve.touching import NO_CUSHION, bring, neighbours, touched_cushion
from physics.kernels.strike import MILLIMETRE, strike, unplayable
from physics.kernels.tolerances import EVENT_LIMIT, TOUCH

AT_REST, TOO_MANY_EVENTS = 0, 5
"""Numbers of physics.Status."""

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
def earliest(w, k):
    """Ball with the earliest next event, and its time. Ties: ball, cushion, pocket, transition, lowest number."""
    time = load(w, NEXT)
    for i in range(1, LANES):
        time = min(time, load(w, NEXT + i))
    due = 0
    for i in range(LANES):
        due |= int(load(w, NEXT + i) == time) << i
    chosen = lowest_bit(due)
    due &= due - 1
    while due != 0:
        i = lowest_bit(due)
        due &= due - 1
        if load_integer(k, KIND + i) < load_integer(k, KIND + chosen):
            chosen = i
    return chosen, time


@kernel
def note_frozen(p, w, k, facts, alive):
    """Note which balls touch a cushion or the cue ball at the start."""
    for n in range(F_FROZEN_CUSHION, F_FROZEN_CUE + LANES):
        store_fact(facts, n, 0)
    rest = neighbours(p, w, k, CUE_BALL, 0.0) if alive & 1 else 0
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
            store_integer(k, FROZEN + i, cushion + 1)
            store_fact(facts, F_FROZEN_CUSHION + i, 1)


@small_kernel
def note_start(p, w, k, facts):
    """Note whether the cue ball starts on or beyond the head string."""
    if load(w, Y) <= load(p, P_HEAD):
        store_integer(k, CROSSED, 1)
        store_fact(facts, F_CROSSED, 0)
        store_fact(facts, F_CROSSED_BEFORE, 0)


@kernel
def pocket(p, w, k, facts, trace, i, time):
    """Ball ``i`` reaches a mouth: it is recorded where it crosses, and out of play."""
    release(k, i)
    bring(p, w, k, facts, i, time)
    number = load_integer(k, PARTNER + i)
    store_integer(k, MOTION + i, POCKETED)
    event = record(w, k, trace, time, POCKET_COLLISION, i, number)
    store_fact(facts, F_POCKETED + i, event)
    store_fact(facts, F_POCKET + i, number)
    put_away(w, k, i, POCKETED)


@kernel
def end_motion(p, w, k, facts, facts_float, trace, alive, i, time):
    """Ball ``i`` ends its motion state; bit set of the balls still to predict, or FAILED.

    Its new acceleration may press it against what it touches: then the contact rule has its say.
    """
    bring(p, w, k, facts, i, time)
    event = transition(p, w, k, i)
    record(w, k, trace, time, event, i, -1)
    touched = predict(p, w, k, alive, i, time)
    if event != SPINNING_STATIONARY and (touched != 0 or touched_cushion(p, w, k, i) != NO_CUSHION):
        return settle(p, w, k, facts, facts_float, trace, i, NOBODY, time)
    return 0


@kernel
def predict_all(p, w, k, alive, changed, now):
    """Predict the next events of the balls in ``changed``."""
    rest = changed
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        release(k, i)
        store(w, NEXT + i, load(w, END + i))
        store_integer(k, KIND + i, TRANSITION if load(w, END + i) < math.inf else NOTHING)
    rest = changed
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        predict(p, w, k, alive, i, now)


@kernel
def run(p, w, k, facts, facts_float, trace, alive, changed):
    """Go from event to event, after the balls in ``changed`` were set in motion at time 0; (status, duration)."""
    now = 0.0
    predict_all(p, w, k, alive, changed, now)
    while load_integer(k, N_EVENTS) < EVENT_LIMIT:
        i, time = earliest(w, k)
        if time == math.inf:
            return AT_REST, now
        kind = load_integer(k, KIND + i)
        if kind == LOOK_AGAIN:
            predict(p, w, k, alive, i, time)
            continue
        now = time
        if kind == TRANSITION:
            changed = end_motion(p, w, k, facts, facts_float, trace, alive, i, now)
        elif kind == MEET_POCKET:
            pocket(p, w, k, facts, trace, i, now)
            alive &= ~(1 << i)
            changed = 0
        else:
            partner = load_integer(k, PARTNER + i) if kind == MEET_BALL else NOBODY
            changed = settle(p, w, k, facts, facts_float, trace, i, partner, now)
        if changed == FAILED:
            break
        predict_all(p, w, k, alive, changed, now)
    return TOO_MANY_EVENTS, now


@small_kernel
def clear(w, k):
    """No ball is on the table."""
    for n in range(VX, END):
        store(w, n, 0.0)
    for i in range(LANES):
        store(w, X + i, FAR_AWAY * float(i + 1))
        store(w, Y + i, 0.0)
        store(w, END + i, math.inf)
        store(w, NEXT + i, math.inf)
        store_integer(k, MOTION + i, ABSENT)
        store_integer(k, KIND + i, NOTHING)
        store_integer(k, FROZEN + i, 0)


@kernel
def place(p, w, k, positions):
    """Lay out balls at rest from 32 numbers x0 y0 x1 y1 ... in the table's frame; NaN for a ball that is not there.

    Returns the bit set of balls on the table.
    """
    clear(w, k)
    alive = 0
    for i in range(LANES):
        x = load(positions, 2 * i)
        if x == x:
            store_integer(k, MOTION + i, STATIONARY)
            store(w, X + i, x - load(p, P_HALF_X))
            store(w, Y + i, load(positions, 2 * i + 1) - load(p, P_HALF_Y))
            alive |= 1 << i
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


@small_kernel
def finish(k, facts, facts_float, status, duration):
    """Note how the shot ended."""
    store_fact(facts, F_STATUS, status)
    store_fact(facts, F_EVENTS, load_integer(k, N_EVENTS))
    store(facts_float, F_DURATION, duration)
    return status


@kernel
def play(p, w, k, facts, facts_float, trace, rows, positions, shot):
    """Simulate one shot from rest; its status. ``shot``: v phi theta a b in Olympiad units."""
    reset(k, facts, facts_float, rows)
    alive = place(p, w, k, positions)
    note_frozen(p, w, k, facts, alive)
    v, phi, theta = load(shot, 0), load(shot, 1), load(shot, 2)
    a, b = load(shot, 3) * MILLIMETRE, load(shot, 4) * MILLIMETRE
    status = unplayable(p, w, k, v, phi, theta, a, b)
    if status != AT_REST:
        return finish(k, facts, facts_float, status, 0.0)
    vx, vy, wx, wy, wz = strike(p, v, phi, theta, a, b)
    store(w, VX, vx)
    store(w, VY, vy)
    store(w, WX, wx)
    store(w, WY, wy)
    store(w, WZ, wz)
    restate(p, w, k, 1)
    record(w, k, trace, 0.0, CUE_STRIKE, CUE_BALL, -1)
    note_start(p, w, k, facts)
    changed = settle(p, w, k, facts, facts_float, trace, CUE_BALL, NOBODY, 0.0)
    if changed == FAILED:
        return finish(k, facts, facts_float, TOO_MANY_EVENTS, 0.0)
    status, duration = run(p, w, k, facts, facts_float, trace, alive, changed)
    return finish(k, facts, facts_float, status, duration)


@kernel
def go_on(p, w, k, facts, facts_float, trace, rows, states):
    """Simulate on from balls in motion; its status. ``states``: see ``restore``."""
    reset(k, facts, facts_float, rows)
    alive = restore(p, w, k, states)
    note_frozen(p, w, k, facts, alive)
    if alive & 1:
        note_start(p, w, k, facts)
    status, duration = run(p, w, k, facts, facts_float, trace, alive, alive)
    return finish(k, facts, facts_float, status, duration)
