"""Ball and cloth: which motion state a ball is in, its acceleration, and when the state ends ([I], section 3)."""

import math

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, small_kernel, store, store_integer
from physics.kernels.resolve.flight import is_airborne, keep_down, land_for_good, take_off
from physics.kernels.workspace import by_table


@small_kernel
def state_on_cloth(s, i):
    """Motion state of ball ``i`` on the cloth from its velocity and spin (eq. 10-11)."""
    limit = load(s.p, at.P_NO_SLIP)
    radius = load(s.p, at.P_RADIUS)
    vx, vy = load(s.w, at.VX + i), load(s.w, at.VY + i)
    # u = v + R k x w, of the lowest point
    ux = vx - radius * load(s.w, at.WY + i)
    uy = vy + radius * load(s.w, at.WX + i)
    moves = vx * vx + vy * vy > limit * limit
    slips = ux * ux + uy * uy > limit * limit
    if slips and (moves or load(s.p, at.P_HISTORICAL) == 0.0):
        return at.SLIDING
    if moves:
        return at.ROLLING
    if load(s.w, at.WZ + i) != 0.0:
        return at.SPINNING
    return at.STATIONARY


@small_kernel
def state_anywhere(s, i):
    """See ``classify``."""
    return at.FLYING if is_airborne(s, i) else state_on_cloth(s, i)


classify = by_table(state_on_cloth, state_anywhere)
"""``classify(s, i)``: motion state of ball ``i`` from where it is, its velocity and spin."""


@small_kernel
def begin_on_cloth(s, i, motion):
    """See ``begin``."""
    store_integer(s.k, at.MOTION + i, motion)
    hx = 0.0
    hy = 0.0
    lasts = math.inf
    if motion == at.SLIDING:
        # a = -mu g u / |u|, and |u| falls at 7/2 mu g: T = 2 |u| / 7 mu g (eq. 5-7)
        radius = load(s.p, at.P_RADIUS)
        ux = load(s.w, at.VX + i) - radius * load(s.w, at.WY + i)
        uy = load(s.w, at.VY + i) + radius * load(s.w, at.WX + i)
        slip = math.sqrt(ux * ux + uy * uy)
        pull = -0.5 * load(s.p, at.P_SLIDE) / slip
        hx = pull * ux
        hy = pull * uy
        lasts = slip * load(s.p, at.P_SLIDE_LASTS)
    elif motion == at.ROLLING:
        # a = -mu_r g v / |v|, T = |v| / mu_r g (eq. 8)
        vx = load(s.w, at.VX + i)
        vy = load(s.w, at.VY + i)
        store(s.w, at.WX + i, -vy * load(s.p, at.P_PER_RADIUS))
        store(s.w, at.WY + i, vx * load(s.p, at.P_PER_RADIUS))
        speed = math.sqrt(vx * vx + vy * vy)
        pull = -0.5 * load(s.p, at.P_ROLL) / speed
        hx = pull * vx
        hy = pull * vy
        lasts = speed * load(s.p, at.P_ROLL_LASTS)
    else:
        store(s.w, at.VX + i, 0.0)
        store(s.w, at.VY + i, 0.0)
        store(s.w, at.WX + i, 0.0)
        store(s.w, at.WY + i, 0.0)
        if motion == at.SPINNING:
            lasts = abs(load(s.w, at.WZ + i)) * load(s.p, at.P_SPIN_LASTS)  # eq. 9
    store(s.w, at.HX + i, hx)
    store(s.w, at.HY + i, hy)
    store(s.w, at.END + i, load(s.w, at.SINCE + i) + lasts)


@kernel
def begin_anywhere(s, i, motion):
    """See ``begin``."""
    if motion == at.FLYING:
        take_off(s, i)
    else:
        land_for_good(s, i)
        begin_on_cloth(s, i, motion)


begin = by_table(begin_on_cloth, begin_anywhere)
"""``begin(s, i, motion)``: put ball ``i``, anchored where it is, into ``motion``: its acceleration and when it ends."""


@small_kernel
def restate(s, changed):
    """Give each ball whose velocity changed the motion state its velocity and spin call for.

    The others keep theirs: one that is about to end its state does so by an event of its own.
    """
    rest = changed
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        keep_down(s, i)
        begin(s, i, classify(s, i))


@kernel
def transition(s, i):
    """End the motion state of ball ``i``, already advanced to the end of it; the kind of event it is."""
    motion = load_integer(s.k, at.MOTION + i)
    spins = load(s.w, at.WZ + i) != 0.0
    vx, vy, limit = load(s.w, at.VX + i), load(s.w, at.VY + i), load(s.p, at.P_NO_SLIP)
    if motion == at.SLIDING and vx * vx + vy * vy > limit * limit:
        after, event = at.ROLLING, at.SLIDING_ROLLING
    elif motion != at.SPINNING and spins:
        after, event = at.SPINNING, at.SLIDING_SPINNING if motion == at.SLIDING else at.ROLLING_SPINNING
    else:
        store(s.w, at.WZ + i, 0.0)
        event = at.SLIDING_STATIONARY if motion == at.SLIDING else at.SPINNING_STATIONARY
        after, event = at.STATIONARY, at.ROLLING_STATIONARY if motion == at.ROLLING else event
    begin(s, i, after)
    return event
