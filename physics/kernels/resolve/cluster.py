"""The contact rule: what happens at one instant to balls that touch one another and cushions.

Pairwise impulses in some order are no answer: which ball of a struck rack moves would depend on numbering. The rule
acts in rounds, each from one common set of velocities (docs/physics.md, "Contacts"):

1. balls: all touching pairs approaching faster than SLOW_APPROACH act together (impulses.py);
2. cushions, only when no pair approaches;
3. resting: pairs and cushions that would meet again within REST_TIME are parted or held (resting.py).

Nothing looks at ball numbers, left or right. Every round parts what approached by at least SLOW_APPROACH, and a pair
left alone meets at most once in REST_TIME: it ends.
"""

from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, plain, small_kernel, store_integer
from physics.kernels.layout import (
    BALL_COLLISION,
    CLOSING,
    CONTACT,
    CONTACT_SEEN,
    FROZEN,
    FROZEN_BALLS,
    HX,
    HY,
    N_PAIRS,
    P_REST_TIME,
    P_SLIDE,
    PAIRS,
    RAIL_COLLISION,
    VX,
    VY,
    WX,
    WY,
    WZ,
)
from physics.kernels.recording import CUE_BALL, note_contact, note_cushion, record
from physics.kernels.resolve.ball_ball import approach, normal
from physics.kernels.resolve.cloth import begin, classify
from physics.kernels.resolve.cushion import hold, rebound, stop
from physics.kernels.resolve.impulses import push_alone, push_pairs, settle_slow_pairs
from physics.kernels.resolve.resting import energy, lay_still, part_pressed_pairs, returns_at_once, scale_down
from physics.kernels.resolve.touching import (
    NO_CUSHION,
    bring,
    gather,
    neighbours,
    neighbours_of_two,
    touched_cushion,
    towards_cushion,
)
from physics.kernels.tolerances import ROUND_LIMIT, SLOW_APPROACH, SOFT_CUSHION, STOP_BELOW

FAILED = -1
"""Returned instead of a bit set when ROUND_LIMIT was reached."""

NOBODY = -1
"""In place of a ball's number."""


@small_kernel
def restate(p, w, k, changed):
    """Give each ball whose velocity changed the motion state its velocity and spin call for.

    The others keep theirs: one that is about to end its state does so by an event of its own.
    """
    rest = changed
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        motion = classify(p, load(w, VX + i), load(w, VY + i), load(w, WX + i), load(w, WY + i), load(w, WZ + i))
        begin(p, w, k, i, motion)


@kernel
def free_from_cushions(w, k, members):
    """Forget that a ball was frozen to a cushion at the start once it is leaving it."""
    rest = members & load_integer(k, FROZEN_BALLS)
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        cushion = load_integer(k, FROZEN + i)
        speed = towards_cushion(w, cushion, VX, VY, i)
        if speed < 0.0 or (speed == 0.0 and towards_cushion(w, cushion, HX, HY, i) < 0.0):
            store_integer(k, FROZEN_BALLS, load_integer(k, FROZEN_BALLS) & ~(1 << i))


@small_kernel
def report_collision(p, w, k, facts, facts_float, trace, i, j, first, time):
    """Record a collision; ``first``: the cue ball had struck nothing before this round."""
    event = record(w, k, trace, time, plain(BALL_COLLISION), i, j)
    if i == CUE_BALL and first:
        store_integer(k, CONTACT_SEEN, 1)
        note_contact(p, w, facts, facts_float, j, event)


@kernel
def report_collisions(p, w, k, facts, facts_float, trace, time):
    """Record the pairs that acted in this round, with the states after it; bit set of the balls involved."""
    involved = 0
    first = load_integer(k, CONTACT_SEEN) == 0
    for n in range(load_integer(k, N_PAIRS)):
        if load(w, CLOSING + n) > 0.0:
            pair = load_integer(k, PAIRS + n)
            i, j = pair >> 4, pair & 15
            report_collision(p, w, k, facts, facts_float, trace, i, j, first, time)
            involved |= 1 << i | 1 << j
    return involved


@small_kernel
def rebound_and_report(p, w, k, facts, trace, i, cushion, time):
    """A rail collision of ball ``i``, recorded."""
    rebound(p, w, i, cushion)
    restate(p, w, k, 1 << i)
    event = record(w, k, trace, time, plain(RAIL_COLLISION), i, cushion)
    if not (load_integer(k, FROZEN_BALLS) >> i & 1 and load_integer(k, FROZEN + i) == cushion):
        note_cushion(k, facts, i, event)


@kernel
def rebound_approaching(p, w, k, facts, trace, members, time):
    """Rail collisions of the members that approach a cushion faster than SOFT_CUSHION; bit set of them."""
    changed = 0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        cushion = touched_cushion(p, w, k, i)
        if cushion != NO_CUSHION and towards_cushion(w, cushion, VX, VY, i) > SOFT_CUSHION:
            rebound_and_report(p, w, k, facts, trace, i, cushion, time)
            changed |= 1 << i
    return changed


@kernel
def hold_at_cushions(p, w, k, members, also_returning):
    """Hold the members that approach a cushion softly, or whose own acceleration brings them back at once.

    An approach of at most SLOW_APPROACH is rounding: it is stopped, and costs no spin.

    Returns the bit set of them; ``also_returning`` (0 or 1) asks for the second kind.
    """
    changed = 0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        cushion = touched_cushion(p, w, k, i)
        if cushion != NO_CUSHION:
            speed = towards_cushion(w, cushion, VX, VY, i)
            soft = SLOW_APPROACH < speed <= SOFT_CUSHION
            if soft or (also_returning != 0 and returns_at_once(p, w, i, cushion)):
                hold(p, w, i, cushion)
                changed |= 1 << i
            elif speed > 0.0:
                stop(p, w, i, cushion)
                changed |= 1 << i
    return changed


@kernel
def settle_cluster(p, w, k, facts, facts_float, trace, i, time):
    """``settle`` in full, round by round."""
    members = gather(p, w, k, facts, 1 << i, time)
    quiet = 0  # balls changed since their last event
    allowed = -1.0  # energy before anything was held or parted
    resting = False  # step 3 has begun
    settled = False
    for _ in range(ROUND_LIMIT):
        pushed = 0 if resting else push_pairs(p, w, k, members)
        if pushed != 0:
            restate(p, w, k, pushed)
            quiet &= ~report_collisions(p, w, k, facts, facts_float, trace, time)
            continue
        rebounding = rebound_approaching(p, w, k, facts, trace, members, time)
        before = energy(p, w, members)
        held = hold_at_cushions(p, w, k, members, plain(0))
        restate(p, w, k, held)
        quiet = quiet & ~rebounding | held
        if held != 0 and allowed < 0.0:
            allowed = before
        if rebounding | held:
            continue
        if not resting:
            resting = True
            changed = settle_slow_pairs(w, k, members)
            restate(p, w, k, changed)
            quiet |= changed
        if allowed < 0.0:
            allowed = energy(p, w, members)
        changed = part_pressed_pairs(p, w, k) | hold_at_cushions(p, w, k, members, plain(1))
        restate(p, w, k, changed)
        quiet |= changed
        if changed == 0 or STOP_BELOW * energy(p, w, members) > allowed:
            settled = True
            break
    if not settled:
        return FAILED
    if scale_down(p, w, members, allowed):
        quiet = members
        restate(p, w, k, members)
    stilled = lay_still(p, w, members)
    restate(p, w, k, stilled)
    quiet |= stilled
    free_from_cushions(w, k, members)
    rest = quiet
    while rest != 0:
        record(w, k, trace, time, plain(CONTACT), lowest_bit(rest), plain(NOBODY))
        rest &= rest - 1
    return members


@small_kernel
def meet_cushion_alone(p, w, k, facts, trace, i, cushion, time):
    """A ball that touches nothing but a cushion; whether that settles it."""
    if towards_cushion(w, cushion, VX, VY, i) <= SOFT_CUSHION:
        return False
    rebound_and_report(p, w, k, facts, trace, i, cushion, time)
    free_from_cushions(w, k, 1 << i)
    return not returns_at_once(p, w, i, cushion)


@small_kernel
def meet_ball_alone(p, w, k, facts, facts_float, trace, i, j, time):
    """Two balls that touch nothing but each other; whether that settles them."""
    nx, ny, _ = normal(w, i, j)
    closing = approach(w, i, j, nx, ny)
    if closing <= SLOW_APPROACH:
        return False
    push_alone(p, w, k, i, j, nx, ny, closing)
    restate(p, w, k, 1 << i | 1 << j)
    first = load_integer(k, CONTACT_SEEN) == 0
    report_collision(p, w, k, facts, facts_float, trace, i, j, first, time)
    free_from_cushions(w, k, 1 << i | 1 << j)
    # No pair is pressed harder than by sliding friction on both balls.
    return -approach(w, i, j, nx, ny) > load(p, P_SLIDE) * load(p, P_REST_TIME)


@kernel
def settle(p, w, k, facts, facts_float, trace, i, j, time):
    """Resolve the touching cluster of ball ``i`` at ``time``; ``j``: the ball it meets there, or NOBODY.

    Returns the bit set of all its members, anchored at ``time`` in their new motion states, or FAILED. Two balls
    alone, and a ball alone at a cushion, are the rule's first round and nothing else: they take a short way.
    """
    bring(p, w, k, facts, i, time)
    cushion = touched_cushion(p, w, k, i)
    if j != NOBODY and cushion == NO_CUSHION:
        bring(p, w, k, facts, j, time)
        near_i, near_j = neighbours_of_two(p, w, i, j, time)
        if near_i == 1 << j and near_j == 1 << i and touched_cushion(p, w, k, j) == NO_CUSHION:
            low, high = min(i, j), max(i, j)
            if meet_ball_alone(p, w, k, facts, facts_float, trace, low, high, time):
                return 1 << i | 1 << j
    elif neighbours(p, w, k, i, time) == 0 and (
        cushion == NO_CUSHION or meet_cushion_alone(p, w, k, facts, trace, i, cushion, time)
    ):
        return 1 << i
    return settle_cluster(p, w, k, facts, facts_float, trace, i, time)
