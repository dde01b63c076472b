"""Step 1 of the contact rule: simultaneous impulses between touching balls (docs/physics.md, eq. 26-27)."""

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, store, store_integer
from physics.kernels.resolve.ball_ball import add, approach, part, push_alone, rub
from physics.kernels.resolve.touching import listed, pair
from physics.kernels.resolve.vertical import add_vertical_change, clear_vertical_changes, plus_square, vertical_change
from physics.kernels.tolerances import SLOW_APPROACH


@kernel
def select_pairs(s):
    """Note how fast each touching pair closes, 0 unless faster than SLOW_APPROACH; how many act."""
    for i in range(at.LANES):
        store_integer(s.k, at.LINKS + i, 0)
    acting = 0
    for n in range(load_integer(s.k, at.N_PAIRS)):
        touch = listed(s, n)
        closing = approach(s, touch)
        if closing > SLOW_APPROACH:
            store(s.w, at.CLOSING + n, closing)
            store_integer(s.k, at.LINKS + touch.i, load_integer(s.k, at.LINKS + touch.i) + 1)
            store_integer(s.k, at.LINKS + touch.j, load_integer(s.k, at.LINKS + touch.j) + 1)
            acting += 1
        else:
            store(s.w, at.CLOSING + n, 0.0)
    return acting


@kernel
def linked_to(s, first, second):
    """Bit set of the balls linked to two touching balls through acting pairs."""
    group = 1 << first | 1 << second
    before = 0
    while group != before:
        before = group
        for n in range(load_integer(s.k, at.N_PAIRS)):
            i, j = pair(s, n)
            both = 1 << i | 1 << j
            if load(s.w, at.CLOSING + n) > 0.0 and group & both:
                group |= both
    return group


@kernel
def clear_changes(s):
    """Set the changes of a round to zero."""
    clear_vertical_changes(s)
    for n in range(at.VX_CHANGE, at.WZ_CHANGE + at.LANES):
        store(s.w, n, 0.0)


@kernel
def apply_changes(s, members, scale):
    """Add the changes of a round, times ``scale``, to the velocities and spins of ``members``."""
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        for quantity in at.SPEEDS:
            add(s.w, quantity + i, scale * load(s.w, at.CHANGE + quantity + i))
        add_vertical_change(s, i, scale)


@kernel
def push_group(s, group, bounce):
    """Normal impulses of a group of linked pairs; each pair's closing speed becomes its normal change of velocity.

    D is the sum of the changes of velocity that would take each pair's closing speed c alone; with
    lambda = (sum of c^2 / 2) / (D.D) 2 lambda D keeps the energy. ``bounce`` lambda D is the change;
    ``bounce``: 1 + e.
    """
    clear_changes(s)
    work = 0.0
    for n in range(load_integer(s.k, at.N_PAIRS)):
        closing = load(s.w, at.CLOSING + n)
        touch = listed(s, n)
        if closing > 0.0 and group >> touch.i & 1:
            part(s, touch, 0.5 * closing, at.CHANGE)
            work += 0.5 * closing * closing
    size = 0.0
    for i in range(at.LANES):
        dx, dy = load(s.w, at.VX_CHANGE + i), load(s.w, at.VY_CHANGE + i)
        size += plus_square(s, dx * dx + dy * dy, vertical_change(s, i))
    # v.D = -sum of c^2 / 2 = -work, so that |v + x D|^2 - |v|^2 = x (x D.D - 2 work): 0 at x = 2 lambda (eq. 26)
    scale = bounce * work / size
    apply_changes(s, group, scale)
    for n in range(load_integer(s.k, at.N_PAIRS)):
        i, _ = pair(s, n)
        if group >> i & 1:
            store(s.w, at.CLOSING + n, 0.5 * scale * load(s.w, at.CLOSING + n))


@kernel
def rub_linked(s, members):
    """Friction of all linked pairs at once, from the slips their normal impulses left (eq. 27)."""
    clear_changes(s)
    for n in range(load_integer(s.k, at.N_PAIRS)):
        touch = listed(s, n)
        share = max(load_integer(s.k, at.LINKS + touch.i), load_integer(s.k, at.LINKS + touch.j))
        change = load(s.w, at.CLOSING + n)
        if change > 0.0 and share > 1:
            rub(s, touch, change, float(share), at.CHANGE)
    apply_changes(s, members, 1.0)


@kernel
def push_pairs(s, members):
    """Let all touching pairs that approach act together; bit set of the balls involved."""
    if select_pairs(s) == 0:
        return 0
    done = 0
    joint = False
    for n in range(load_integer(s.k, at.N_PAIRS)):
        i, j = pair(s, n)
        closing = load(s.w, at.CLOSING + n)
        if closing > 0.0 and done >> i & 1 == 0:
            if load_integer(s.k, at.LINKS + i) == 1 and load_integer(s.k, at.LINKS + j) == 1:
                push_alone(s, listed(s, n), closing)
                done |= 1 << i | 1 << j
            else:
                group = linked_to(s, i, j)
                push_group(s, group, 1.0 + load(s.p, at.P_E_BALL))
                done |= group
                joint = True
    if joint:
        rub_linked(s, members)
    return done


@kernel
def settle_slow_pairs(s, members):
    """Give touching balls that approach by SLOW_APPROACH or less their mean normal speed; bit set of those changed."""
    changed = 0
    clear_changes(s)
    for n in range(load_integer(s.k, at.N_PAIRS)):
        touch = listed(s, n)
        closing = approach(s, touch)
        if closing > 0.0:
            part(s, touch, 0.5 * closing, at.CHANGE)
            changed |= 1 << touch.i | 1 << touch.j
    if changed != 0:
        apply_changes(s, members, 1.0)
    return changed
