"""Ball and cushion: the collision law, and a cushion that only stops a ball (docs/physics.md, eq. 20-21)."""

from physics.kernels.compiling import load, small_kernel, store
from physics.kernels.layout import (
    P_KEEP_SPIN,
    P_LINE_X,
    P_LINE_Y,
    P_PARALLEL,
    P_PERPENDICULAR,
    VX,
    VY,
    WX,
    WY,
    WZ,
    X,
    Y,
)

WEST, EAST, SOUTH, NORTH = 0, 1, 2, 3


@small_kernel
def put_on_line(p, w, i, cushion):
    """Put a ball that touches a cushion exactly on its line: rounding never adds up along a cushion."""
    if cushion == WEST:
        store(w, X + i, -load(p, P_LINE_X))
    elif cushion == EAST:
        store(w, X + i, load(p, P_LINE_X))
    elif cushion == SOUTH:
        store(w, Y + i, -load(p, P_LINE_Y))
    else:
        store(w, Y + i, load(p, P_LINE_Y))


@small_kernel
def rebound(p, w, i, cushion):
    """A rail collision: parallel and perpendicular factors on the velocity, one factor on all spin."""
    put_on_line(p, w, i, cushion)
    along = load(p, P_PARALLEL)
    across = -load(p, P_PERPENDICULAR)
    keep = load(p, P_KEEP_SPIN)
    if cushion <= EAST:
        store(w, VX + i, across * load(w, VX + i))
        store(w, VY + i, along * load(w, VY + i))
    else:
        store(w, VX + i, along * load(w, VX + i))
        store(w, VY + i, across * load(w, VY + i))
    store(w, WX + i, keep * load(w, WX + i))
    store(w, WY + i, keep * load(w, WY + i))
    store(w, WZ + i, keep * load(w, WZ + i))


@small_kernel
def stop(p, w, i, cushion):
    """An approach that is rounding: no velocity across the cushion; the spin is kept, for it may carry the ball off."""
    put_on_line(p, w, i, cushion)
    if cushion <= EAST:
        store(w, VX + i, 0.0)
    else:
        store(w, VY + i, 0.0)


@small_kernel
def hold(p, w, i, cushion):
    """A soft touch: no velocity across the cushion, no spin about its direction; nothing else changes."""
    put_on_line(p, w, i, cushion)
    if cushion <= EAST:
        store(w, VX + i, 0.0)
        store(w, WY + i, 0.0)
    else:
        store(w, VY + i, 0.0)
        store(w, WX + i, 0.0)
