"""A cue ball in hand, put where it is asked for or where there is room next to that."""

import math

from client.learn.compiled import layout as to
from client.learn.compiled.compiling import inner
from physics.kernels import layout as at
from physics.kernels.tasks import may_lie


@inner
def is_free(s, table, before, x, y, kitchen):
    """Whether the cue ball may be put there: see `client.geometry.are_free`."""
    if kitchen and not y > table[to.T_HEAD]:
        return False
    if not may_lie(s, x - 0.5 * table[to.T_WIDTH], y - 0.5 * table[to.T_LENGTH], table[to.T_SLACK]):
        return False
    least = table[to.T_CLEAR]
    for ball in range(1, at.LANES):
        dx, dy = before[ball, 0] - x, before[ball, 1] - y
        if dx * dx + dy * dy < least * least:
            return False
    return True


@inner
def put(s, table, lattice, game, before, share):
    """Put a cue ball in hand where it is asked for, or at the nearest free place of the lattice."""
    radius = table[to.T_RADIUS]
    kitchen = game[to.AREA] == to.KITCHEN
    low = table[to.T_HEAD] if kitchen else radius
    x = radius + share[to.PLACE_X] * (table[to.T_WIDTH] - 2.0 * radius)
    y = low + share[to.PLACE_Y] * (table[to.T_LENGTH] - radius - low)
    if not is_free(s, table, before, x, y, kitchen):
        best, wanted_x, wanted_y = math.inf, x, y
        for up in lattice[2 if kitchen else 1]:
            for across in lattice[0]:
                if up == up and across == across and is_free(s, table, before, across, up, kitchen):
                    far = math.sqrt((across - wanted_x) ** 2 + (up - wanted_y) ** 2)
                    if far < best:
                        best, x, y = far, across, up
    before[0, 0], before[0, 1] = x, y
