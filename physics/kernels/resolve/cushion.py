"""Ball and cushion: the collision law, and a cushion that only stops a ball (docs/physics.md, eq. 20-21)."""

from physics.kernels import layout as at
from physics.kernels.compiling import load, load_integer, plain, small_kernel, store
from physics.kernels.motion import on_table
from physics.kernels.recording import record
from physics.kernels.tolerances import TOUCH


@small_kernel
def touched(s, i):
    """Cushion that ball ``i`` touches, or NO_CUSHION; a side mouth is none. At most one: the corners are cut off."""
    if not on_table(load_integer(s.k, at.MOTION + i)):
        return at.NO_CUSHION
    x = load(s.w, at.X + i)
    y = load(s.w, at.Y + i)
    line_x = load(s.p, at.P_LINE_X) - TOUCH
    line_y = load(s.p, at.P_LINE_Y) - TOUCH
    if abs(x) >= line_x and abs(y) >= load(s.p, at.P_SIDE):
        return at.EAST if x > 0.0 else at.WEST
    if abs(y) >= line_y:
        return at.NORTH if y > 0.0 else at.SOUTH
    return at.NO_CUSHION


@small_kernel
def towards(s, cushion, x_row, i):
    """Component towards the cushion of a vector of ball ``i`` whose x stands in ``x_row``, and y in the next row."""
    if cushion == at.WEST:
        return -load(s.w, x_row + i)
    if cushion == at.EAST:
        return load(s.w, x_row + i)
    if cushion == at.SOUTH:
        return -load(s.w, x_row + at.LANES + i)
    return load(s.w, x_row + at.LANES + i)


@small_kernel
def speed_towards(s, i, cushion):
    """Speed of ball ``i`` towards a cushion, m/s."""
    return towards(s, cushion, at.VX, i)


@small_kernel
def put_on_line(s, i, cushion):
    """Put a ball that touches a cushion exactly on its line: rounding never adds up along a cushion."""
    if cushion == at.WEST:
        store(s.w, at.X + i, -load(s.p, at.P_LINE_X))
    elif cushion == at.EAST:
        store(s.w, at.X + i, load(s.p, at.P_LINE_X))
    elif cushion == at.SOUTH:
        store(s.w, at.Y + i, -load(s.p, at.P_LINE_Y))
    else:
        store(s.w, at.Y + i, load(s.p, at.P_LINE_Y))


@small_kernel
def rebound(s, i, cushion):
    """A rail collision: factors on the velocity along and across (eq. 20), one factor on all spin (eq. 21)."""
    put_on_line(s, i, cushion)
    along = load(s.p, at.P_PARALLEL)
    across = -load(s.p, at.P_PERPENDICULAR)
    keep = load(s.p, at.P_KEEP_SPIN)
    if cushion <= at.EAST:
        store(s.w, at.VX + i, across * load(s.w, at.VX + i))
        store(s.w, at.VY + i, along * load(s.w, at.VY + i))
    else:
        store(s.w, at.VX + i, along * load(s.w, at.VX + i))
        store(s.w, at.VY + i, across * load(s.w, at.VY + i))
    store(s.w, at.WX + i, keep * load(s.w, at.WX + i))
    store(s.w, at.WY + i, keep * load(s.w, at.WY + i))
    store(s.w, at.WZ + i, keep * load(s.w, at.WZ + i))


@small_kernel
def stop(s, i, cushion):
    """An approach that is rounding: no velocity across the cushion; the spin is kept, for it may carry the ball off."""
    put_on_line(s, i, cushion)
    if cushion <= at.EAST:
        store(s.w, at.VX + i, 0.0)
    else:
        store(s.w, at.VY + i, 0.0)


@small_kernel
def hold(s, i, cushion):
    """A soft touch: no velocity across the cushion, no spin about its direction; nothing else changes."""
    put_on_line(s, i, cushion)
    if cushion <= at.EAST:
        store(s.w, at.VX + i, 0.0)
        store(s.w, at.WY + i, 0.0)
    else:
        store(s.w, at.VY + i, 0.0)
        store(s.w, at.WX + i, 0.0)


@small_kernel
def returns(s, i, cushion):
    """Whether ball ``i``'s own acceleration brings it back to a cushion it touches within the rest time."""
    half = towards(s, cushion, at.HX, i)
    # gap(t) = -v t - half t^2 with v the speed towards it: 0 again at t = -v / half
    return half > 0.0 and -towards(s, cushion, at.VX, i) < half * load(s.p, at.P_REST_TIME)


@small_kernel
def leaves(s, i, cushion):
    """Whether a ball that has touched a cushion ever since is leaving it."""
    speed = towards(s, cushion, at.VX, i)
    return speed < 0.0 or (speed == 0.0 and towards(s, cushion, at.HX, i) < 0.0)


@small_kernel
def is_same(_s, one, other):
    """Whether two cushions are one."""
    return one == other


@small_kernel
def report(s, i, cushion, time):
    """Record a collision with a cushion; its ordinal."""
    return record(s, time, plain(at.RAIL_COLLISION), i, cushion)
