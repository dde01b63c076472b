"""Step 1 of the contact rule: simultaneous impulses between touching balls (docs/physics.md, eq. 26-27)."""

from physics.kernels.compiling import (
    kernel,
    load,
    load_integer,
    lowest_bit,
    plain,
    small_kernel,
    store,
    store_integer,
)
from physics.kernels.layout import (
    CHANGE,
    CLOSING,
    LANES,
    LINKS,
    MOTION,
    N_PAIRS,
    NORMAL_X,
    NORMAL_Y,
    P_E_BALL,
    P_HISTORICAL,
    PAIRS,
    VX,
    VY,
    WX,
    WY,
    WZ,
)
from physics.kernels.motion import moves
from physics.kernels.resolve.ball_ball import add, approach, collide, collide_historically, part, rub
from physics.kernels.tolerances import SLOW_APPROACH


@kernel
def select_pairs(w, k):
    """Note how fast each touching pair closes, 0 unless faster than SLOW_APPROACH; how many act."""
    for i in range(LANES):
        store_integer(k, LINKS + i, 0)
    acting = 0
    for n in range(load_integer(k, N_PAIRS)):
        pair = load_integer(k, PAIRS + n)
        i, j = pair >> 4, pair & 15
        nx, ny = load(w, NORMAL_X + n), load(w, NORMAL_Y + n)
        closing = approach(w, i, j, nx, ny)
        if closing > SLOW_APPROACH:
            store(w, CLOSING + n, closing)
            store_integer(k, LINKS + i, load_integer(k, LINKS + i) + 1)
            store_integer(k, LINKS + j, load_integer(k, LINKS + j) + 1)
            acting += 1
        else:
            store(w, CLOSING + n, 0.0)
    return acting


@kernel
def linked_to(w, k, pair):
    """Bit set of the balls linked to a pair through acting pairs."""
    group = 1 << (pair >> 4) | 1 << (pair & 15)
    before = 0
    while group != before:
        before = group
        for n in range(load_integer(k, N_PAIRS)):
            other = load_integer(k, PAIRS + n)
            both = 1 << (other >> 4) | 1 << (other & 15)
            if load(w, CLOSING + n) > 0.0 and group & both:
                group |= both
    return group


@kernel
def clear_changes(w):
    """Set the changes of a round to zero."""
    for n in range(CHANGE + VX, CHANGE + WZ + LANES):
        store(w, n, 0.0)


@kernel
def apply_changes(w, members, scale):
    """Add the changes of a round, times ``scale``, to the velocities and spins of ``members``."""
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        for quantity in (VX, VY, WX, WY, WZ):
            add(w, quantity + i, scale * load(w, CHANGE + quantity + i))


@kernel
def push_group(w, k, group, bounce):
    """Normal impulses of a group of linked pairs; each pair's closing speed becomes its normal change of velocity.

    D is the sum of the changes of velocity that would take each pair's closing speed c alone; with
    lambda = (sum of c^2 / 2) / (D.D) 2 lambda D keeps the energy. ``bounce`` lambda D is the change;
    ``bounce``: 1 + e.
    """
    clear_changes(w)
    work = 0.0
    for n in range(load_integer(k, N_PAIRS)):
        closing = load(w, CLOSING + n)
        pair = load_integer(k, PAIRS + n)
        i, j = pair >> 4, pair & 15
        if closing > 0.0 and group >> i & 1:
            nx, ny = load(w, NORMAL_X + n), load(w, NORMAL_Y + n)
            part(w, i, j, nx, ny, 0.5 * closing, CHANGE)
            work += 0.5 * closing * closing
    size = 0.0
    for i in range(LANES):
        dx, dy = load(w, CHANGE + VX + i), load(w, CHANGE + VY + i)
        size += dx * dx + dy * dy
    scale = bounce * work / size
    apply_changes(w, group, scale)
    for n in range(load_integer(k, N_PAIRS)):
        i = load_integer(k, PAIRS + n) >> 4
        if group >> i & 1:
            store(w, CLOSING + n, 0.5 * scale * load(w, CLOSING + n))


@kernel
def rub_linked(p, w, k, members):
    """Friction of all linked pairs at once, from the slips their normal impulses left."""
    clear_changes(w)
    for n in range(load_integer(k, N_PAIRS)):
        pair = load_integer(k, PAIRS + n)
        i, j = pair >> 4, pair & 15
        share = max(load_integer(k, LINKS + i), load_integer(k, LINKS + j))
        change = load(w, CLOSING + n)
        if change > 0.0 and share > 1:
            nx, ny = load(w, NORMAL_X + n), load(w, NORMAL_Y + n)
            rub(p, w, i, j, nx, ny, change, float(share), CHANGE)
    apply_changes(w, members, 1.0)


@small_kernel
def push_alone(p, w, k, i, j, nx, ny, closing):
    """The collision of two balls that share it with no other; (nx, ny) from i to j."""
    if load(p, P_HISTORICAL) == 0.0:
        collide(p, w, i, j, nx, ny, closing)
    elif moves(load_integer(k, MOTION + i)):
        collide_historically(p, w, i, j, nx, ny, int(not moves(load_integer(k, MOTION + j))))
    else:
        collide_historically(p, w, j, i, -nx, -ny, plain(1))


@kernel
def push_pairs(p, w, k, members):
    """Let all touching pairs that approach act together; bit set of the balls involved."""
    if select_pairs(w, k) == 0:
        return 0
    done = 0
    joint = False
    for n in range(load_integer(k, N_PAIRS)):
        pair = load_integer(k, PAIRS + n)
        i, j = pair >> 4, pair & 15
        closing = load(w, CLOSING + n)
        if closing > 0.0 and done >> i & 1 == 0:
            if load_integer(k, LINKS + i) == 1 and load_integer(k, LINKS + j) == 1:
                nx, ny = load(w, NORMAL_X + n), load(w, NORMAL_Y + n)
                push_alone(p, w, k, i, j, nx, ny, closing)
                done |= 1 << i | 1 << j
            else:
                group = linked_to(w, k, pair)
                push_group(w, k, group, 1.0 + load(p, P_E_BALL))
                done |= group
                joint = True
    if joint:
        rub_linked(p, w, k, members)
    return done


@kernel
def settle_slow_pairs(w, k, members):
    """Give touching balls that approach by SLOW_APPROACH or less their mean normal speed; bit set of those changed."""
    changed = 0
    clear_changes(w)
    for n in range(load_integer(k, N_PAIRS)):
        pair = load_integer(k, PAIRS + n)
        i, j = pair >> 4, pair & 15
        nx, ny = load(w, NORMAL_X + n), load(w, NORMAL_Y + n)
        closing = approach(w, i, j, nx, ny)
        if closing > 0.0:
            part(w, i, j, nx, ny, 0.5 * closing, CHANGE)
            changed |= 1 << i | 1 << j
    if changed != 0:
        apply_changes(w, members, 1.0)
    return changed
