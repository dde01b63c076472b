"""What a ball's motion code says about it. No kernel compares codes by size."""

from physics.kernels import layout as at
from physics.kernels.compiling import small_kernel


@small_kernel
def moves(motion):
    """Whether a ball in this motion state changes its place: a ball that only spins does not."""
    return (motion == at.SLIDING) | (motion == at.ROLLING) | (motion == at.FLYING)


@small_kernel
def on_table(motion):
    """Whether a ball in this motion state is in play: neither pocketed nor absent nor driven off."""
    return (motion != at.POCKETED) & (motion != at.ABSENT) & (motion != at.DRIVEN_OFF)
