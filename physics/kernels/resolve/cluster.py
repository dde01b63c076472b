"""The contact rule: what happens at one instant to balls that touch one another and cushions.

Pairwise impulses in some order are no answer: which ball of a struck rack moves would depend on numbering. The rule
acts in rounds, each from one common set of velocities (docs/physics.md, "Contacts"):

1. balls: all touching pairs approaching faster than SLOW_APPROACH act together (impulses.py);
2. cushions, only when no pair approaches; where balls fly, then the cloth;
3. resting: pairs and cushions that would meet again within REST_TIME are parted or held (resting.py).

What friction is for balls on the cloth, nothing is for a ball that others hold up: gravity presses it anew for ever. So
where a ball flies, what the collisions of the instant took may go into parting it: a ball that rests on others bounces
by a micrometre, a thousand times a second, as if elastic, until it has come down or is perched.

Nothing looks at ball numbers, left or right. Every round parts what approached by at least SLOW_APPROACH, and a pair
left alone meets at most once in REST_TIME: it ends.
"""

from physics.kernels import layout as at
from physics.kernels.apart import apart
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, plain, small_kernel, store_integer
from physics.kernels.recording import note_contact, note_cushion, record
from physics.kernels.resolve.ball_ball import approach, push_alone, touch_of
from physics.kernels.resolve.boundary import (
    hold,
    is_leaving,
    is_same,
    rebound,
    report,
    returns_at_once,
    speed_towards,
    stop,
    touched_cushion,
)
from physics.kernels.resolve.cloth import restate
from physics.kernels.resolve.flight import any_flies
from physics.kernels.resolve.impulses import push_pairs, settle_slow_pairs
from physics.kernels.resolve.landing import count_partings, is_landing, landing_balls, meet_cloths, press_down
from physics.kernels.resolve.resting import energy, lay_still, part_pressed_pairs, scale_down
from physics.kernels.resolve.touching import bring, gather, neighbours, neighbours_of_two, pair
from physics.kernels.tolerances import ROUND_LIMIT, SLOW_APPROACH, SOFT_CUSHION, STOP_BELOW
from physics.kernels.workspace import RealWorkspace

UNSETTLED = -1
"""Returned instead of a bit set when ROUND_LIMIT was reached."""


@kernel
def free_from_cushions(s, members):
    """Forget that a ball was frozen to a cushion at the start once it is leaving it."""
    rest = members & load_integer(s.k, at.FROZEN_BALLS)
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        cushion = load_integer(s.k, at.FROZEN + i)
        if is_leaving(s, i, cushion):
            store_integer(s.k, at.FROZEN_BALLS, load_integer(s.k, at.FROZEN_BALLS) & ~(1 << i))


@small_kernel
def report_collision(s, i, j, first, time):
    """Record a collision; ``first``: the cue ball had struck nothing before this round."""
    event = record(s, time, plain(at.BALL_COLLISION), i, j)
    if i == at.CUE_BALL and first:
        store_integer(s.k, at.CONTACT_SEEN, 1)
        note_contact(s, j, event)


@kernel
def report_collisions(s, time):
    """Record the pairs that acted in this round, with the states after it; bit set of the balls involved."""
    involved = 0
    first = load_integer(s.k, at.CONTACT_SEEN) == 0
    for n in range(load_integer(s.k, at.N_PAIRS)):
        if load(s.w, at.CLOSING + n) > 0.0:
            i, j = pair(s, n)
            report_collision(s, i, j, first, time)
            involved |= 1 << i | 1 << j
    return involved


@small_kernel
def rebound_and_report(s, i, cushion, time):
    """A rail collision of ball ``i``, recorded."""
    rebound(s, i, cushion)
    restate(s, 1 << i)
    event = report(s, i, cushion, time)
    if not (load_integer(s.k, at.FROZEN_BALLS) >> i & 1 and is_same(s, load_integer(s.k, at.FROZEN + i), cushion)):
        note_cushion(s, i, event)


@kernel
def rebound_approaching(s, members, time):
    """Rail collisions of the members that approach a cushion faster than SOFT_CUSHION; bit set of them."""
    changed = 0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        cushion = touched_cushion(s, i)
        if cushion != at.NO_CUSHION and speed_towards(s, i, cushion) > SOFT_CUSHION:
            rebound_and_report(s, i, cushion, time)
            changed |= 1 << i
    return changed


@kernel
def hold_at_cushions(s, members, also_returning):
    """Hold the members that approach a cushion softly, or whose own acceleration brings them back at once.

    An approach of at most SLOW_APPROACH is rounding: it is stopped, and costs no spin.

    Returns the bit set of them; ``also_returning`` (0 or 1) asks for the second kind.
    """
    changed = 0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        cushion = touched_cushion(s, i)
        if cushion != at.NO_CUSHION:
            speed = speed_towards(s, i, cushion)
            soft = SLOW_APPROACH < speed <= SOFT_CUSHION
            if soft or (also_returning != 0 and returns_at_once(s, i, cushion)):
                hold(s, i, cushion)
                changed |= 1 << i
            elif speed > 0.0:
                stop(s, i, cushion)
                changed |= 1 << i
    return changed


@small_kernel
def calm(s, members, allowed, in_air, quiet, time):
    """After the rounds: bound the energy, stop what hardly moves; record the balls in ``quiet`` and those changed here.

    A contact event tells of every ball that changed since its last event.
    """
    if scale_down(s, members, allowed, in_air):
        quiet = members
        restate(s, members)
    pressed = press_down(s, members)
    restate(s, pressed)
    quiet |= pressed
    stilled = lay_still(s, members)
    restate(s, stilled)
    quiet |= stilled
    free_from_cushions(s, members)
    rest = quiet
    while rest != 0:
        record(s, time, plain(at.CONTACT), lowest_bit(rest), plain(at.NOBODY))
        rest &= rest - 1


@apart(int, RealWorkspace, int, float)
@kernel
def settle_cluster(s, i, time):
    """``settle`` in full, round by round."""
    members = gather(s, 1 << i, time)
    quiet = 0  # balls changed since their last event
    allowed = -1.0  # energy before anything was held or parted
    resting = False  # step 3 has begun
    parted = 0  # balls that step 3 has changed
    landing = landing_balls(s, members)  # by a flight that ends here
    in_air = any_flies(s, members)
    if in_air:
        allowed = energy(s, members)
    for _ in range(ROUND_LIMIT):
        pushed = 0 if resting else push_pairs(s, members)
        if pushed != 0:
            restate(s, pushed)
            quiet &= ~report_collisions(s, time)
            continue
        rebounding = rebound_approaching(s, members, time)
        before = energy(s, members)
        held = hold_at_cushions(s, members, plain(0))
        restate(s, held)
        quiet = quiet & ~rebounding | held
        if held != 0 and allowed < 0.0:
            allowed = before
        if resting:
            fallen = press_down(s, members)
            restate(s, fallen)
        else:
            fallen = meet_cloths(s, members, landing, time)
        quiet = (quiet | fallen) & ~(fallen & landing)
        landing &= ~fallen
        if rebounding | held | fallen:
            continue
        if not resting:
            resting = True
            changed = settle_slow_pairs(s, members)
            changed |= press_down(s, members)
            restate(s, changed)
            quiet |= changed
        if allowed < 0.0:
            allowed = energy(s, members)
        changed = part_pressed_pairs(s) | hold_at_cushions(s, members, plain(1))
        restate(s, changed)
        quiet |= changed
        parted |= changed
        if changed == 0 or (not in_air and STOP_BELOW * energy(s, members) > allowed):
            count_partings(s, parted)
            calm(s, members, allowed, in_air, quiet, time)
            return members
    return UNSETTLED


@small_kernel
def meet_cushion_alone(s, i, cushion, time):
    """A ball that touches nothing but a cushion; whether that settles it."""
    if speed_towards(s, i, cushion) <= SOFT_CUSHION:
        return False
    rebound_and_report(s, i, cushion, time)
    free_from_cushions(s, 1 << i)
    return not returns_at_once(s, i, cushion)


@small_kernel
def meet_ball_alone(s, i, j, time):
    """Two balls that touch nothing but each other; whether that settles them."""
    touch = touch_of(s, i, j)
    closing = approach(s, touch)
    if closing <= SLOW_APPROACH:
        return False
    push_alone(s, touch, closing)
    restate(s, 1 << i | 1 << j)
    first = load_integer(s.k, at.CONTACT_SEEN) == 0
    report_collision(s, i, j, first, time)
    free_from_cushions(s, 1 << i | 1 << j)
    # No pair is pressed harder than by sliding friction on both balls.
    return -approach(s, touch) > load(s.p, at.P_SLIDE) * load(s.p, at.P_REST_TIME)


@apart(int, RealWorkspace, int, int, float)
@kernel
def settle(s, i, j, time):
    """Resolve the touching cluster of ball ``i`` at ``time``; ``j``: the ball it meets there, or NOBODY.

    Returns the bit set of all its members, anchored at ``time`` in their new motion states, or UNSETTLED. Two balls
    alone, and a ball alone at a cushion, are the rule's first round and nothing else: they take a short way.
    """
    bring(s, i, time)
    cushion = touched_cushion(s, i)
    if j != at.NOBODY and cushion == at.NO_CUSHION:
        bring(s, j, time)
        near_i, near_j = neighbours_of_two(s, i, j, time)
        alone = near_i == 1 << j and near_j == 1 << i and touched_cushion(s, j) == at.NO_CUSHION
        if alone and not any_flies(s, 1 << i | 1 << j):
            low, high = min(i, j), max(i, j)
            if meet_ball_alone(s, low, high, time):
                return 1 << i | 1 << j
    elif (
        neighbours(s, i, time) == 0
        and not is_landing(s, i)
        and (cushion == at.NO_CUSHION or meet_cushion_alone(s, i, cushion, time))
    ):
        return 1 << i
    return settle_cluster(s, i, time)
