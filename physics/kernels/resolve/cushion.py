"""Ball and cushion: the collision law, and a cushion that only stops a ball (docs/physics.md, eq. 20-21)."""

from physics.kernels import layout as at
from physics.kernels.compiling import load, small_kernel, store


@small_kernel
def towards_cushion(s, cushion, x_row, i):
    """Component towards the cushion of a vector of ball ``i`` whose x stands in ``x_row``, and y in the next row."""
    if cushion == at.WEST:
        return -load(s.w, x_row + i)
    if cushion == at.EAST:
        return load(s.w, x_row + i)
    if cushion == at.SOUTH:
        return -load(s.w, x_row + at.LANES + i)
    return load(s.w, x_row + at.LANES + i)


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
