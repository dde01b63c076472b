"""Move a ball along its closed-form path ([I], eq. 4-14; docs/physics.md, eq. 5-9)."""

from physics.kernels.compiling import kernel, load, load_integer, small_kernel, store
from physics.kernels.layout import (
    HX,
    HY,
    MOTION,
    P_PER_RADIUS,
    P_SPIN,
    P_SPIN_SLIDING,
    ROLLING,
    SINCE,
    SLIDING,
    SPINNING,
    VX,
    VY,
    WX,
    WY,
    WZ,
    X,
    Y,
)


@small_kernel
def along(start, speed, half, dt):
    """Coordinate after ``dt``: start + speed dt + half dt^2."""
    return start + dt * (speed + dt * half)


@small_kernel
def decayed(spin, rate, dt):
    """Spin about the vertical after ``dt``: it falls at ``rate`` and stops at 0."""
    loss = rate * dt
    if spin > loss:
        return spin - loss
    if spin < -loss:
        return spin + loss
    return 0.0


@kernel
def advance(p, w, k, i, time):
    """Move the anchor of ball ``i`` to ``time``: position, velocity and spin there."""
    dt = time - load(w, SINCE + i)
    store(w, SINCE + i, time)
    motion = load_integer(k, MOTION + i)
    if dt == 0.0 or motion == 0:
        return
    if motion == SPINNING:
        store(w, WZ + i, decayed(load(w, WZ + i), load(p, P_SPIN), dt))
        return
    vx, vy, hx, hy = load(w, VX + i), load(w, VY + i), load(w, HX + i), load(w, HY + i)
    per_radius = load(p, P_PER_RADIUS)
    store(w, X + i, along(load(w, X + i), vx, hx, dt))
    store(w, Y + i, along(load(w, Y + i), vy, hy, dt))
    vx = vx + 2.0 * hx * dt
    vy = vy + 2.0 * hy * dt
    store(w, VX + i, vx)
    store(w, VY + i, vy)
    if motion == SLIDING:
        turn = 5.0 * dt * per_radius
        store(w, WX + i, load(w, WX + i) + turn * hy)
        store(w, WY + i, load(w, WY + i) - turn * hx)
        store(w, WZ + i, decayed(load(w, WZ + i), load(p, P_SPIN_SLIDING), dt))
    elif motion == ROLLING:
        store(w, WX + i, -vy * per_radius)
        store(w, WY + i, vx * per_radius)
        store(w, WZ + i, decayed(load(w, WZ + i), load(p, P_SPIN), dt))
