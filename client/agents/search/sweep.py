"""Everything but straight pots: strokes at every ball that may be struck, thin to full, straight, off a cushion, or
over the balls in the way.

What such a stroke is called is seen from what it does: if it sends a ball that may be called into a pocket, that ball
(a bank, a combination, a kick, a plant); else it is a safety.
"""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from client.agents.search.evaluate import Evaluator, Thinking
from client.agents.search.jumps import leaps, uncalled
from client.agents.search.shots import PHI, B, Floats, Shots, Tables, V
from physics import Batch, Table
from physics.facts import NEVER
from referee.rules.batch_rulings import SAFETY_CALL, target_balls

SPEEDS = (1.1, 2.0, 3.4, 5.5)
"""m/s of the cue."""
HEIGHTS = (0.0, 9.0, -9.0)
"""mm of the tip, one after the other: plain, follow, draw."""
THINNEST = 0.97
"""Of the sum of radii: how far beside its centre a ball is struck at the thinnest."""
REBOUND, REBOUND_BESIDE_JAWS = 1.5, 1.05
"""Tangent of the angle off a cushion over that of the angle to it: 0.9 of the speed along, 0.6 of that across it; and a
typical one of cushions that know spin and speed, where it is 0.8 to 1.4."""
AROUND = 7.0
"""Degrees to either side of a kick's reckoned direction that are tried: spin and speed bend it."""


def directions(table: Table, position: Floats, targets: NDArray[np.bool_], each: int) -> Floats:
    """Azimuths (deg) that meet one of the targets: `each` a ball straight, as many off the cushions."""
    cue = position[0]
    balls = position[np.flatnonzero(targets)]
    offsets = np.linspace(-THINNEST, THINNEST, each)
    found = [_straight(table, cue, ball, offsets) for ball in balls]
    spread = np.linspace(-AROUND, AROUND, max(3, each // 3))
    found += [kick + spread for ball in balls for kick in _kicks(table, cue, ball)]
    return np.concatenate(found) % 360.0 if found else np.empty(0)


def _straight(table: Table, cue: Floats, ball: Floats, offsets: Floats) -> Floats:
    """Directions that strike a ball so far beside its centre, in shares of the sum of radii."""
    dx, dy = ball - cue
    reach = 2.0 * table.ball_radius / max(math.hypot(dx, dy), 2.0 * table.ball_radius)
    turned: Floats = math.degrees(math.atan2(dy, dx)) + np.degrees(np.arcsin(np.clip(offsets * reach, -1.0, 1.0)))
    return turned


def _kicks(table: Table, cue: Floats, ball: Floats) -> list[float]:
    """Directions (deg) that reach a ball off one cushion."""
    radius, rebound = table.ball_radius, REBOUND_BESIDE_JAWS if table.has_jaws else REBOUND
    found = []
    for axis, line in ((0, radius), (0, table.width - radius), (1, radius), (1, table.length - radius)):
        first, second = line - cue[axis], abs(line - ball[axis])
        along = ball[1 - axis] - cue[1 - axis]
        across = abs(first) + rebound * second
        if across < 1e-6:
            continue
        step = [0.0, 0.0]
        step[axis], step[1 - axis] = math.copysign(1.0, first), along / across
        found.append(math.degrees(math.atan2(step[1], step[0])))
    return found


def sweep(evaluator: Evaluator, tables: Tables, each: int, jumps: bool) -> Thinking[Shots]:
    """Strokes on the first of `tables`, called by what they do without noise.

    Args:
        each: directions for a ball. jumps: whether strokes over balls in the way are among them.
    """
    targets = target_balls(tables.positions[:1], tables.group[:1])[0]
    phi = directions(evaluator.table, tables.positions[0], targets, each)
    count = len(phi) * len(SPEEDS)
    strokes = np.zeros((count, 5))
    strokes[:, V], strokes[:, PHI] = np.tile(SPEEDS, len(phi)), np.repeat(phi, len(SPEEDS))
    strokes[:, B] = np.resize(np.array(HEIGHTS), count)
    shots = evaluator.values.sight.raised(uncalled(tables, strokes))
    if jumps:
        shots = shots.joined(leaps(evaluator, tables, targets))
    if not len(shots):
        return shots
    batch = yield from evaluator.simulated(shots)
    return called(shots, batch, targets)


def called(shots: Shots, batch: Batch, targets: NDArray[np.bool_]) -> Shots:
    """The strokes, each calling the first of the targets that it pockets; a safety if it pockets none."""
    fell = (batch.facts["pocketed"] != NEVER) & targets[None, :]
    ball = np.where(fell.any(axis=1), fell.argmax(axis=1), SAFETY_CALL)
    pocket = np.where(ball >= 0, batch.pocket[np.arange(len(shots)), np.maximum(ball, 0)], SAFETY_CALL)
    return replace(shots, ball=ball.astype(np.int64), pocket=pocket.astype(np.int64))
