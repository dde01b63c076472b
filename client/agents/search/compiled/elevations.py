"""How low the cue may lie: over the balls and the cushions behind the cue ball."""

import math
from typing import NamedTuple

import numpy as np

from client.agents.search import shots as at
from client.agents.search.compiled.compiling import compiled, inner


class LevelCue(NamedTuple):
    """A level cue along (ux, uy); seen from the cue ball's centre its tip is `depth` back and `tip` up, m."""

    ux: float
    uy: float
    depth: float
    tip: float
    length: float


@inner
def over_ball(dx, dy, cue, radius):
    """Elevation (rad) at which the cue passes over a ball at (dx, dy); 0 if it need not, 2 if it cannot."""
    along = -(dx * cue.ux + dy * cue.uy) - cue.depth  # behind the tip
    aside = cue.ux * dy - cue.uy * dx
    if along <= -radius or along > cue.length + radius or abs(aside) >= radius:
        return 0.0
    rise = math.sqrt(radius * radius - aside * aside)
    far = math.sqrt(along * along + cue.tip * cue.tip)
    if rise >= far:
        return 2.0
    return max(0.0, math.asin(rise / far) - math.atan2(cue.tip, along))


@inner
def over_cushion(start, step, line, rise, length):
    """Elevation (rad) at which the cue clears a nose `rise` above its tip at `line`; 0 when it does not come so far."""
    if abs(step) < 1e-12:
        return 0.0
    far = (line - start) / step
    if far <= 0.0 or far > length:
        return 0.0
    return math.atan2(rise, far) if rise > 0.0 else 0.0


@compiled
def elevations(table, positions, which, strokes, aside, out):
    """The least elevation, deg, at which nothing blocks the cue, turned by `aside` (deg) to either side too; else NaN.

    Args:
        which: (n,) row of `positions`. strokes: (phi in deg, a in mm, b in mm), each (n,).
    """
    phi, a, b = strokes
    radius = table[at.RADIUS]
    for n in range(which.shape[0]):
        row = positions[which[n]]
        side, tip = 1e-3 * a[n], 1e-3 * b[n]
        depth = math.sqrt(max(0.0, radius * radius - side * side - tip * tip))
        rise = table[at.NOSE] - (radius + tip)
        least = 0.0
        for turn in (0.0, -aside, aside):
            angle = math.radians(phi[n] + turn)
            cue = LevelCue(math.cos(angle), math.sin(angle), depth, tip, table[at.CUE_LENGTH])
            for other in range(1, 16):
                if row[other, 0] == row[other, 0]:
                    dx = row[other, 0] - row[0, 0] - side * cue.uy
                    dy = row[other, 1] - row[0, 1] + side * cue.ux
                    least = max(least, over_ball(dx, dy, cue, radius))
            x, y = row[0, 0] - depth * cue.ux + side * cue.uy, row[0, 1] - depth * cue.uy - side * cue.ux
            for start, step, wall in ((x, -cue.ux, table[at.WIDTH]), (y, -cue.uy, table[at.LENGTH])):
                for line in (0.0, wall):
                    least = max(least, over_cushion(start, step, line, rise, cue.length))
        out[n] = math.degrees(least) if least < 1.5 else np.nan
