"""The event loop ([I], figure 1): strike; then detect the next event, advance to it, resolve it, until all rest."""

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
from physics.kernels.detect.prediction import predict, release
from physics.kernels.flights import cut_flights, end_flight, is_at_rail, is_flying, meet_rail, still_in_play
from physics.kernels.out_of_play import pocket
from physics.kernels.recording import record
from physics.kernels.resolve.boundary import touched_cushion
from physics.kernels.resolve.cloth import restate, transition
from physics.kernels.resolve.cluster import UNSETTLED, settle
from physics.kernels.resolve.touching import bring
from physics.kernels.start import note_frozen, note_start, place, restore
from physics.kernels.strike import playable, read_stroke, strike
from physics.kernels.tolerances import STEPS_PER_EVENT


@small_kernel
def least_of_four(memory, place):
    """The least of four numbers from ``place`` on: no chain of sixteen comparisons that wait for each other."""
    return min(min(load(memory, place), load(memory, place + 1)), min(load(memory, place + 2), load(memory, place + 3)))


@small_kernel
def earliest(s):
    """Ball with the earliest next event, and its time. Ties: ball, cushion, pocket, transition, lowest number."""
    time = min(least_of_four(s.w, at.NEXT), least_of_four(s.w, at.NEXT + 4))
    time = min(time, min(least_of_four(s.w, at.NEXT + 8), least_of_four(s.w, at.NEXT + 12)))
    due = 0
    for i in range(at.LANES):
        due |= int(load(s.w, at.NEXT + i) == time) << i
    chosen = lowest_bit(due)
    due &= due - 1
    while due != 0:
        i = lowest_bit(due)
        due &= due - 1
        if load_integer(s.k, at.KIND + i) < load_integer(s.k, at.KIND + chosen):
            chosen = i
    return chosen, time


@kernel
def detect(s, alive, changed, now):
    """Predict the next events of the balls in ``changed``."""
    rest = changed
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        release(s, i)
        store(s.w, at.NEXT + i, load(s.w, at.END + i))
        store_integer(s.k, at.KIND + i, at.TRANSITION if load(s.w, at.END + i) < math.inf else at.NOTHING)
    rest = changed
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        predict(s, alive, i, now)


@small_kernel
def end_motion(s, alive, i, time):
    """Ball ``i`` ends its motion state; bit set of the balls still to predict, or UNSETTLED.

    Its new acceleration may press it against what it touches: then the contact rule has its say.
    """
    if is_flying(s, i):
        return end_flight(s, i, time)
    bring(s, i, time)
    event = transition(s, i)
    record(s, time, event, i, plain(at.NOBODY))
    touched = predict(s, alive, i, time)
    if event != at.SPINNING_STATIONARY and (touched != 0 or touched_cushion(s, i) != at.NO_CUSHION):
        return settle(s, i, plain(at.NOBODY), time)
    return 0


@small_kernel
def run(s, alive, changed):
    """Go from event to event, after the balls in ``changed`` were set in motion at time 0: (why it ended, duration)."""
    now = 0.0
    ended = at.OUT_OF_STEPS
    limit = int(load(s.p, at.P_EVENT_LIMIT))
    detect(s, alive, changed, now)
    for _ in range(STEPS_PER_EVENT * limit):
        if load_integer(s.k, at.N_EVENTS) >= limit:
            ended = at.OUT_OF_EVENTS
            break
        i, time = earliest(s)
        if time == math.inf:
            return at.NOTHING_TO_COME, now
        kind = load_integer(s.k, at.KIND + i)
        if kind == at.LOOK_AGAIN:
            predict(s, alive, i, time)
            continue
        now = time
        if kind == at.TRANSITION:
            changed = end_motion(s, alive, i, now)
        elif kind == at.MEET_POCKET:
            pocket(s, i, now)
            alive &= ~(1 << i)
            changed = 0
        elif is_at_rail(s, kind):
            changed = meet_rail(s, i, now)
        else:
            partner = load_integer(s.k, at.PARTNER + i) if kind == at.MEET_BALL else at.NOBODY
            changed = settle(s, i, partner, now)
        if changed == UNSETTLED:
            ended = at.OUT_OF_ROUNDS
            break
        alive = still_in_play(s, alive, now)
        detect(s, alive, changed, now)
    rest = alive
    while rest != 0:  # else the balls would be left at different times
        bring(s, lowest_bit(rest), now)
        rest &= rest - 1
    return ended, now


@small_kernel
def finish(s, status, duration):
    """Note how the shot ended."""
    store_fact(s.facts, at.F_STATUS, status)
    store_fact(s.facts, at.F_EVENTS, load_integer(s.k, at.N_EVENTS))
    store_fact_number(s.facts, at.F_DURATION, duration)


@kernel
def strike_off(s, shot):
    """The cue's strike and the contacts it makes: (status, balls set in motion or UNSETTLED).

    ``shot``: v phi theta a b in Olympiad units.
    """
    stroke = read_stroke(shot)
    status = playable(s, stroke)
    if status != at.AT_REST:
        return status, 0
    vx, vy, wx, wy, wz = strike(s, stroke)
    store(s.w, at.VX + at.CUE_BALL, vx)
    store(s.w, at.VY + at.CUE_BALL, vy)
    store(s.w, at.WX + at.CUE_BALL, wx)
    store(s.w, at.WY + at.CUE_BALL, wy)
    store(s.w, at.WZ + at.CUE_BALL, wz)
    restate(s, plain(1 << at.CUE_BALL))
    record(s, 0.0, plain(at.CUE_STRIKE), plain(at.CUE_BALL), plain(at.NOBODY))
    note_start(s)
    return status, settle(s, plain(at.CUE_BALL), plain(at.NOBODY), 0.0)


@small_kernel
def play(s, moving, balls, shot):
    """Simulate one shot, after ``reset``.

    ``moving`` (0 or 1): ``balls`` are 16 states that go on (see ``restore``), else places at rest (see ``place``) that
    ``shot`` is played on. The loop stands here once for both, inlined: a second copy would take as long to compile.
    """
    alive = restore(s, balls) if moving != 0 else place(s, balls)
    note_frozen(s, alive)
    status, changed = at.AT_REST, alive
    if moving == 0:
        status, changed = strike_off(s, shot)
    elif alive >> at.CUE_BALL & 1:
        note_start(s)
    duration = 0.0
    if status == at.AT_REST:
        ended = at.OUT_OF_ROUNDS
        if changed != UNSETTLED:
            ended, duration = run(s, alive, changed)
        if ended != at.NOTHING_TO_COME:
            cut_flights(s, duration)
        store_integer(s.k, at.ENDED, ended)
        status = at.AT_REST if ended == at.NOTHING_TO_COME else at.EVENT_LIMIT
    finish(s, status, duration)
