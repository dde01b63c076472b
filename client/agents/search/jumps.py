"""Jump shots: over the balls that hide a target, on tables where balls leave the cloth."""

import math

import numpy as np
from numpy.typing import NDArray

from client.agents.search.evaluate import Evaluator
from client.agents.search.shots import THETA, Floats, Shots, Tables
from physics import RealTable, Table
from referee.rules.batch_rulings import SAFETY_CALL

SPEEDS = (3.0, 4.2, 6.0, 8.5)
"""m/s of the cue."""
ELEVATIONS = (30.0, 38.0, 46.0, 54.0, 62.0)
"""Degrees: lower ones do not lift the ball over another within half a metre, higher ones leave no way to go."""
THICKNESS = (-0.8, -0.55, -0.3, -0.1, 0.1, 0.3, 0.55, 0.8)
"""How far beside its centre the target is struck, of the sum of radii: a jump is no finer than that."""
TIP = -3.0
"""mm: a little draw, so that the ball leaves the cloth at once."""
NEAREST = 2.5
"""Radii between the cue ball and one that is jumped: nearer ones are in the cue ball's way up."""


def leaps(evaluator: Evaluator, tables: Tables, targets: NDArray[np.bool_]) -> Shots:
    """Strokes over balls at targets that they hide, on the first of the tables; nothing is called yet."""
    table, sight = evaluator.table, evaluator.values.sight
    shots = uncalled(tables, _strokes(table, tables.positions[0], targets) if flies(table) else np.empty((0, 5)))
    extra = shots.strokes[:, THETA] - sight.least(shots)
    lifted = np.flatnonzero(extra > 0.0)
    return sight.raised(shots[lifted], extra[lifted])


def uncalled(tables: Tables, strokes: Floats) -> Shots:
    """Strokes on the first of the tables that call nothing yet."""
    nothing = np.full(len(strokes), SAFETY_CALL)
    return Shots(tables, np.zeros(len(strokes), np.int64), strokes, nothing, nothing, np.zeros(len(strokes)))


def flies(table: Table) -> bool:
    """Whether balls leave the cloth of a table."""
    return isinstance(table, RealTable) and table.flight


def _strokes(table: Table, position: Floats, targets: NDArray[np.bool_]) -> Floats:
    """(k, 5): at every hidden part of every target, at all speeds and elevations."""
    found = [phi for ball in np.flatnonzero(targets) for phi in _hidden(table, position, int(ball))]
    steep = [theta for theta in ELEVATIONS if theta <= table.theta_max]
    fast = [v for v in SPEEDS if v <= table.v_max]
    rows = [(v, phi, theta, 0.0, TIP) for phi in found for theta in steep for v in fast]
    return np.array(rows).reshape(-1, 5)


def _hidden(table: Table, position: Floats, ball: int) -> list[float]:
    """Azimuths (deg) that would strike a ball, were no other ball in the way of the cue ball."""
    cue, diameter = position[0], 2.0 * table.ball_radius
    dx, dy = position[ball] - cue
    far = math.hypot(dx, dy)
    azimuths = [
        math.atan2(dy, dx) + math.asin(max(-1.0, min(1.0, thick * diameter / max(far, diameter))))
        for thick in THICKNESS
    ]
    return [math.degrees(phi) % 360.0 for phi in azimuths if _is_blocked(table, position, ball, phi, far)]


def _is_blocked(table: Table, position: Floats, ball: int, phi: float, far: float) -> bool:
    """Whether a ball that can be jumped lies in the cue ball's way."""
    step = np.array((math.cos(phi), math.sin(phi)))
    gap = position - position[0]
    along, aside = gap @ step, np.abs(gap @ np.array((-step[1], step[0])))
    others = (np.arange(len(position)) != ball) & (np.arange(len(position)) != 0)
    between = others & (along > 0.0) & (along < far) & (aside < 2.0 * table.ball_radius)
    near = others & (np.hypot(gap[:, 0], gap[:, 1]) < NEAREST * table.ball_radius) & (along > 0.0)
    return bool(between.any() and not (between & near).any())
