"""The event loop ([I], figure 1): strike, then event after event until every ball is at rest."""

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
from physics.kernels.detect.prediction import predict, release
from physics.kernels.layout import (
    CUE_STRIKE,
    END,
    F_DURATION,
    F_EVENTS,
    F_POCKET,
    F_POCKETED,
    F_STATUS,
    KIND,
    LANES,
    LOOK_AGAIN,
    MEET_BALL,
    MEET_POCKET,
    MOTION,
    N_EVENTS,
    NEXT,
    NOTHING,
    P_EVENT_LIMIT,
    PARTNER,
    POCKET_COLLISION,
    POCKETED,
    SPINNING_STATIONARY,
    TRANSITION,
    VX,
    VY,
    WX,
    WY,
    WZ,
)
from physics.kernels.recording import CUE_BALL, record
from physics.kernels.resolve.cloth import transition
from physics.kernels.resolve.cluster import FAILED, NOBODY, restate, settle
from physics.kernels.resolve.touching import NO_CUSHION, bring, touched_cushion
from physics.kernels.start import note_frozen, note_start, place, put_away, reset, restore
from physics.kernels.strike import MILLIMETRE, direction, strike, unplayable
from physics.kernels.tolerances import STEPS_PER_EVENT

AT_REST, TOO_MANY_EVENTS = 0, 5
"""Numbers of physics.Status."""


@small_kernel
def least_of_four(w, at):
    """The least of four numbers from place ``at`` on: no chain of sixteen comparisons that wait for each other."""
    return min(min(load(w, at), load(w, at + 1)), min(load(w, at + 2), load(w, at + 3)))


@small_kernel
def earliest(w, k):
    """Ball with the earliest next event, and its time. Ties: ball, cushion, pocket, transition, lowest number."""
    time = min(least_of_four(w, NEXT), least_of_four(w, NEXT + 4))
    time = min(time, min(least_of_four(w, NEXT + 8), least_of_four(w, NEXT + 12)))
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
def pocket(p, w, k, facts, trace, i, time):
    """Ball ``i`` reaches a mouth: it is recorded where it crosses, and out of play."""
    bring(p, w, k, facts, i, time)
    number = load_integer(k, PARTNER + i)
    store_integer(k, MOTION + i, POCKETED)
    event = record(w, k, trace, time, plain(POCKET_COLLISION), i, number)
    store_fact(facts, F_POCKETED + i, event)
    store_fact(facts, F_POCKET + i, number)
    put_away(w, k, i, POCKETED)


@small_kernel
def end_motion(p, w, k, facts, facts_float, trace, alive, i, time):
    """Ball ``i`` ends its motion state; bit set of the balls still to predict, or FAILED.

    Its new acceleration may press it against what it touches: then the contact rule has its say.
    """
    bring(p, w, k, facts, i, time)
    event = transition(p, w, k, i)
    record(w, k, trace, time, event, i, plain(NOBODY))
    touched = predict(p, w, k, alive, i, time)
    if event != SPINNING_STATIONARY and (touched != 0 or touched_cushion(p, w, k, i) != NO_CUSHION):
        return settle(p, w, k, facts, facts_float, trace, i, plain(NOBODY), time)
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
    limit = int(load(p, P_EVENT_LIMIT))
    predict_all(p, w, k, alive, changed, now)
    for _ in range(STEPS_PER_EVENT * limit):
        if load_integer(k, N_EVENTS) >= limit:
            break
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
    rest = alive
    while rest != 0:  # else the balls would be left at different times
        bring(p, w, k, facts, lowest_bit(rest), now)
        rest &= rest - 1
    return TOO_MANY_EVENTS, now


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
    aim = direction(phi, theta)
    status = unplayable(p, w, k, v, theta, aim, a, b)
    if status != AT_REST:
        return finish(k, facts, facts_float, status, 0.0)
    vx, vy, wx, wy, wz = strike(p, v, aim, a, b)
    store(w, VX, vx)
    store(w, VY, vy)
    store(w, WX, wx)
    store(w, WY, wy)
    store(w, WZ, wz)
    restate(p, w, k, plain(1 << CUE_BALL))
    record(w, k, trace, 0.0, plain(CUE_STRIKE), plain(CUE_BALL), plain(NOBODY))
    note_start(p, w, k, facts)
    changed = settle(p, w, k, facts, facts_float, trace, plain(CUE_BALL), plain(NOBODY), 0.0)
    if changed == FAILED:
        return finish(k, facts, facts_float, plain(TOO_MANY_EVENTS), 0.0)
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
