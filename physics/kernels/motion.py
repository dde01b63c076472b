"""What a ball's motion code says about it."""

from physics.kernels.compiling import small_kernel
from physics.kernels.layout import ROLLING, SLIDING


@small_kernel
def moves(motion):
    """Whether a ball in this motion state changes its place: a ball that only spins does not."""
    return (motion == SLIDING) | (motion == ROLLING)
