"""Balls that leave the cloth and meet it again: launches, landings, the top of the rails (docs/physics.md, eq. 43-46).

Z and VZ of a ball on the cloth are exactly 0. A ball at Z = 0 with VZ < 0 is about to meet the cloth, in the same
instant.
"""

import math

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load, load_integer, plain, small_kernel, store, store_integer
from physics.kernels.path import Rise
from physics.kernels.recording import record
from physics.kernels.resolve.fixed import impact
from physics.kernels.tolerances import LIFT, SOFT_CUSHION
from physics.kernels.workspace import by_table

UP = (0.0, 0.0, 1.0)


@small_kernel
def is_airborne(s, i):
    """Whether ball ``i`` is off the cloth, or has a velocity that takes it off, or into it."""
    return (load(s.w, at.Z + i) > 0.0) | (load(s.w, at.VZ + i) != 0.0)


@small_kernel
def nothing_flies(_s, _balls):
    """See ``any_flies``."""
    return False


@small_kernel
def some_flies(s, balls):
    """See ``any_flies``."""
    return load_integer(s.k, at.FLYING_BALLS) & balls != 0


any_flies = by_table(nothing_flies, some_flies)
"""``any_flies(s, balls)``: whether one of a bit set of balls is in the air."""


@small_kernel
def fall_time(rise, gravity):
    """s until a flight is back at height 0: the later root, without cancellation (eq. 44)."""
    root = math.sqrt(rise.vz * rise.vz + 2.0 * gravity * rise.z)
    return 2.0 * rise.z / (root - rise.vz) if rise.vz < 0.0 else (rise.vz + root) / gravity


@small_kernel
def take_off(s, i):
    """Ball ``i`` flies from where it is: it lands at END unless it meets something before."""
    store_integer(s.k, at.MOTION + i, at.FLYING)
    store_integer(s.k, at.FLYING_BALLS, load_integer(s.k, at.FLYING_BALLS) | 1 << i)
    gravity = load(s.p, at.P_GRAVITY)
    store(s.w, at.HX + i, 0.0)
    store(s.w, at.HY + i, 0.0)
    store(s.w, at.HZ + i, -0.5 * gravity)
    lasts = fall_time(Rise(load(s.w, at.Z + i), load(s.w, at.VZ + i), 0.0), gravity)
    store(s.w, at.END + i, load(s.w, at.SINCE + i) + lasts)


@small_kernel
def land_for_good(s, i):
    """Ball ``i`` is on the cloth: nothing about it is vertical."""
    if load_integer(s.k, at.FLYING_BALLS) >> i & 1:
        store_integer(s.k, at.FLYING_BALLS, load_integer(s.k, at.FLYING_BALLS) & ~(1 << i))
        store(s.w, at.Z + i, 0.0)
        store(s.w, at.VZ + i, 0.0)
        store(s.w, at.HZ + i, 0.0)


@small_kernel
def lies_down(_s, _i):
    """See ``keep_down``."""


@small_kernel
def lift_or_stay(s, i):
    """See ``keep_down``."""
    if load(s.w, at.Z + i) == 0.0 and 0.0 < load(s.w, at.VZ + i) <= LIFT:
        store(s.w, at.VZ + i, 0.0)


keep_down = by_table(lies_down, lift_or_stay)
"""``keep_down(s, i)``: a ball on the cloth that is lifted by LIFT or less stays there."""


@small_kernel
def velocity_of(s, i):
    """Velocity of ball ``i``, three components."""
    return load(s.w, at.VX + i), load(s.w, at.VY + i), load(s.w, at.VZ + i)


@small_kernel
def spin_of(s, i):
    """Spin of ball ``i``, three components."""
    return load(s.w, at.WX + i), load(s.w, at.WY + i), load(s.w, at.WZ + i)


@small_kernel
def set_motion(s, i, v, w):
    """Give ball ``i`` a velocity and a spin of three components."""
    store(s.w, at.VX + i, v[0])
    store(s.w, at.VY + i, v[1])
    store(s.w, at.VZ + i, v[2])
    store(s.w, at.WX + i, w[0])
    store(s.w, at.WY + i, w[1])
    store(s.w, at.WZ + i, w[2])


@small_kernel
def meet_plate(radius, v, w, e, mu):
    """Velocity and spin after falling on something level: plastic if the rebound would not be faster than LIFT."""
    bounces = -e * v[2] >= LIFT
    (vx, vy, vz), turned = impact(radius, v, w, UP, e if bounces else 0.0, mu)
    return (vx, vy, vz if bounces else 0.0), turned


@small_kernel
def pressed_up(s, speed):
    """Upward speed of a ball that a cushion has pressed onto the cloth at ``speed`` > 0, m/s."""
    rebound = load(s.p, at.P_E_PRESSED) * speed
    return rebound if rebound > LIFT else 0.0


@kernel
def meet_cloth(s, i, time):
    """Ball ``i``, at height 0 and going down, meets the cloth.

    Pressed down by a cushion it does not rub: so the law of a cushion is the same on the cloth and just above it. An
    approach as slow as SOFT_CUSHION is stopped.
    """
    v = velocity_of(s, i)
    store(s.w, at.Z + i, 0.0)
    if time < load(s.w, at.PRESSED + i):
        store(s.w, at.VZ + i, pressed_up(s, -v[2]))
    elif -v[2] <= SOFT_CUSHION:
        store(s.w, at.VZ + i, 0.0)
    else:
        v, w = meet_plate(load(s.p, at.P_RADIUS), v, spin_of(s, i), load(s.p, at.P_E_CLOTH), load(s.p, at.P_MU_SLIDE))
        set_motion(s, i, v, w)


@kernel
def struck_off(s, v, w):
    """Velocity and spin of the cue ball when the cloth has answered a strike: ``e_strike`` if it went down."""
    if v[2] < 0.0:
        return meet_plate(load(s.p, at.P_RADIUS), v, w, load(s.p, at.P_E_STRIKE), load(s.p, at.P_MU_SLIDE))
    return (v[0], v[1], v[2] if v[2] > LIFT else 0.0), w


@kernel
def fall_on_rail(s, i):
    """Ball ``i`` falls on the top of a rail; whether it bounces."""
    store(s.w, at.Z + i, load(s.p, at.P_NOSE))
    radius, e, mu = load(s.p, at.P_RADIUS), load(s.p, at.P_E_RAIL), load(s.p, at.P_MU_RAIL)
    v, w = meet_plate(radius, velocity_of(s, i), spin_of(s, i), e, mu)
    set_motion(s, i, v, w)
    return v[2] > 0.0


@small_kernel
def report_landing(s, i, time):
    """Record that ball ``i`` has landed."""
    record(s, time, plain(at.LANDING), i, plain(at.NOBODY))
