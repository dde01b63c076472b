"""Whose balls are whose: a seat's group, and when the 8 is all that is left of it."""

from client.learn.compiled import layout as to
from client.learn.compiled.compiling import inner
from physics.kernels import layout as at

EIGHT = 8


@inner
def group_of(game, seat):
    """OPEN, or the seat's group."""
    group = game[to.GROUP]
    return group if group == to.OPEN or seat == 0 else 1 - group


@inner
def in_group(ball, group):
    """Whether an object ball is of a group; on an open table every one but the 8 is."""
    if ball == at.CUE_BALL or ball == EIGHT:
        return False
    return group == to.OPEN or (ball > EIGHT) == (group == 1)


@inner
def is_on_eight(before, group):
    """R27: none of the shooter's group is left."""
    if group == to.OPEN:
        return False
    for ball in range(at.LANES):  # noqa: SIM110 - kernels have no generators
        if in_group(ball, group) and before[ball, 0] == before[ball, 0]:
            return False
    return True
