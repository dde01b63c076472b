"""Move a ball along its closed-form path ([I], eq. 4-14; docs/physics.md, eq. 5-9)."""

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load, load_integer, small_kernel, store
from physics.kernels.path import along
from physics.kernels.workspace import by_table


@small_kernel
def decayed(spin, rate, dt):
    """Spin about the vertical after ``dt``: it falls at ``rate`` and stops at 0 (eq. 9)."""
    loss = rate * dt
    if spin > loss:
        return spin - loss
    if spin < -loss:
        return spin + loss
    return 0.0


@small_kernel
def stays_on_cloth(_s, _i, _motion, _dt):
    """See ``fly_on``."""
    return False


@small_kernel
def fly(s, i, motion, dt):
    """See ``fly_on``: straight in plan, a parabola upwards, the spin as it is (eq. 43)."""
    if motion != at.FLYING:
        return False
    vz, hz = load(s.w, at.VZ + i), load(s.w, at.HZ + i)
    store(s.w, at.X + i, load(s.w, at.X + i) + dt * load(s.w, at.VX + i))
    store(s.w, at.Y + i, load(s.w, at.Y + i) + dt * load(s.w, at.VY + i))
    store(s.w, at.Z + i, max(along(load(s.w, at.Z + i), vz, hz, dt), 0.0))
    store(s.w, at.VZ + i, vz + 2.0 * hz * dt)
    return True


fly_on = by_table(stays_on_cloth, fly)
"""``fly_on(s, i, motion, dt)``: move a ball that flies by ``dt``; whether it does."""


@kernel
def advance(s, i, time):
    """Move the anchor of ball ``i`` to ``time``: position, velocity and spin there."""
    dt = time - load(s.w, at.SINCE + i)
    store(s.w, at.SINCE + i, time)
    motion = load_integer(s.k, at.MOTION + i)
    if dt == 0.0 or motion == at.STATIONARY:
        return
    if motion == at.SPINNING:
        store(s.w, at.WZ + i, decayed(load(s.w, at.WZ + i), load(s.p, at.P_SPIN), dt))
        return
    if fly_on(s, i, motion, dt):
        return
    vx, vy, hx, hy = load(s.w, at.VX + i), load(s.w, at.VY + i), load(s.w, at.HX + i), load(s.w, at.HY + i)
    per_radius = load(s.p, at.P_PER_RADIUS)
    store(s.w, at.X + i, along(load(s.w, at.X + i), vx, hx, dt))
    store(s.w, at.Y + i, along(load(s.w, at.Y + i), vy, hy, dt))
    vx = vx + 2.0 * hx * dt
    vy = vy + 2.0 * hy * dt
    store(s.w, at.VX + i, vx)
    store(s.w, at.VY + i, vy)
    if motion == at.SLIDING:
        # Friction F = 2 m h at the lowest point -R k: I w' = -R k x F with I = 2/5 m R^2, so w' = 5/R (h_y, -h_x).
        turn = 5.0 * dt * per_radius
        store(s.w, at.WX + i, load(s.w, at.WX + i) + turn * hy)
        store(s.w, at.WY + i, load(s.w, at.WY + i) - turn * hx)
        store(s.w, at.WZ + i, decayed(load(s.w, at.WZ + i), load(s.p, at.P_SPIN_SLIDING), dt))
    elif motion == at.ROLLING:
        # No slip: v = R w x k, so w = k x v / R (eq. 8).
        store(s.w, at.WX + i, -vy * per_radius)
        store(s.w, at.WY + i, vx * per_radius)
        store(s.w, at.WZ + i, decayed(load(s.w, at.WZ + i), load(s.p, at.P_SPIN), dt))
