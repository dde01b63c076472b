"""Ball and cloth: which motion state a ball is in, its acceleration, and when the state ends ([I], section 3)."""

import math

from physics.kernels.compiling import kernel, load, load_integer, small_kernel, store, store_integer
from physics.kernels.layout import (
    END,
    HX,
    HY,
    MOTION,
    P_HISTORICAL,
    P_NO_SLIP,
    P_PER_RADIUS,
    P_RADIUS,
    P_ROLL,
    P_ROLL_LASTS,
    P_SLIDE,
    P_SLIDE_LASTS,
    P_SPIN_LASTS,
    ROLLING,
    ROLLING_SPINNING,
    ROLLING_STATIONARY,
    SINCE,
    SLIDING,
    SLIDING_ROLLING,
    SLIDING_SPINNING,
    SLIDING_STATIONARY,
    SPINNING,
    SPINNING_STATIONARY,
    STATIONARY,
    VX,
    VY,
    WX,
    WY,
    WZ,
)


@small_kernel
def classify(p, vx, vy, wx, wy, wz):
    """Motion state of a ball on the cloth from its velocity and spin."""
    limit = load(p, P_NO_SLIP)
    radius = load(p, P_RADIUS)
    ux = vx - radius * wy
    uy = vy + radius * wx
    moves = vx * vx + vy * vy > limit * limit
    slips = ux * ux + uy * uy > limit * limit
    if slips and (moves or load(p, P_HISTORICAL) == 0.0):
        return SLIDING
    if moves:
        return ROLLING
    if wz != 0.0:
        return SPINNING
    return STATIONARY


@small_kernel
def begin(p, w, k, i, motion):
    """Put ball ``i``, anchored where it is, into ``motion``: its acceleration and the time the state ends."""
    store_integer(k, MOTION + i, motion)
    hx = 0.0
    hy = 0.0
    lasts = math.inf
    if motion == SLIDING:
        radius = load(p, P_RADIUS)
        ux = load(w, VX + i) - radius * load(w, WY + i)
        uy = load(w, VY + i) + radius * load(w, WX + i)
        slip = math.sqrt(ux * ux + uy * uy)
        pull = -0.5 * load(p, P_SLIDE) / slip
        hx = pull * ux
        hy = pull * uy
        lasts = slip * load(p, P_SLIDE_LASTS)
    elif motion == ROLLING:
        vx = load(w, VX + i)
        vy = load(w, VY + i)
        store(w, WX + i, -vy * load(p, P_PER_RADIUS))
        store(w, WY + i, vx * load(p, P_PER_RADIUS))
        speed = math.sqrt(vx * vx + vy * vy)
        pull = -0.5 * load(p, P_ROLL) / speed
        hx = pull * vx
        hy = pull * vy
        lasts = speed * load(p, P_ROLL_LASTS)
    else:
        store(w, VX + i, 0.0)
        store(w, VY + i, 0.0)
        store(w, WX + i, 0.0)
        store(w, WY + i, 0.0)
        if motion == SPINNING:
            lasts = abs(load(w, WZ + i)) * load(p, P_SPIN_LASTS)
    store(w, HX + i, hx)
    store(w, HY + i, hy)
    store(w, END + i, load(w, SINCE + i) + lasts)


@kernel
def transition(p, w, k, i):
    """End the motion state of ball ``i``, already advanced to the end of it; the kind of event it is."""
    motion = load_integer(k, MOTION + i)
    spins = load(w, WZ + i) != 0.0
    vx, vy, limit = load(w, VX + i), load(w, VY + i), load(p, P_NO_SLIP)
    if motion == SLIDING and vx * vx + vy * vy > limit * limit:
        after, event = ROLLING, SLIDING_ROLLING
    elif motion != SPINNING and spins:
        after, event = SPINNING, SLIDING_SPINNING if motion == SLIDING else ROLLING_SPINNING
    else:
        store(w, WZ + i, 0.0)
        event = SLIDING_STATIONARY if motion == SLIDING else SPINNING_STATIONARY
        after, event = STATIONARY, ROLLING_STATIONARY if motion == ROLLING else event
    begin(p, w, k, i, after)
    return event
