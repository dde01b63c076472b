"""Where balls may be at an instant of a shot: on the cloth or clear of the cushions in the air, none in another."""

import math
from typing import Any

import numpy as np

from physics.constants import BALL_RADIUS, PLACEMENT_TOLERANCE
from physics.errors import InvalidState
from physics.events import Motion
from physics.table import Table


def refuse_misplaced(snapshot: Any, table: Table, ball: int) -> None:
    """Raise InvalidState unless a ball of a ``physics.Snapshot`` is where one of its motion state can be."""
    x, y = snapshot.positions[ball].tolist()
    height, rising = float(snapshot.heights[ball]), float(snapshot.vertical_velocities[ball])
    if Motion(int(snapshot.motion[ball])) is Motion.FLYING:
        if not table.flies:
            raise InvalidState(f"motion[{ball}]", "flying", "must be another on a table whose balls do not fly")
        if not (math.isfinite(height) and math.isfinite(rising) and height >= 0.0):
            raise InvalidState(
                f"heights[{ball}], vertical_velocities[{ball}]",
                (height, rising),
                "must be finite, the height 0 m or more",
            )
        if not table.in_air(x, y, height):
            allowed = "must be over the table, clear of its cushions and rails"
            raise InvalidState(f"positions[{ball}], heights[{ball}]", (x, y, height), allowed)
        return
    if height != 0.0 or rising != 0.0:
        raise InvalidState(
            f"heights[{ball}], vertical_velocities[{ball}]", (height, rising), "must be 0 unless the ball is flying"
        )
    if not (math.isfinite(x) and math.isfinite(y)):
        raise InvalidState(f"positions[{ball}]", [x, y], "must be two finite numbers (x, y) in metres")
    if not table.in_play(x, y):
        raise InvalidState(f"positions[{ball}]", [x, y], "must lie on the table")


def refuse_overlapping(snapshot: Any, here: list[int]) -> None:
    """Raise InvalidState for two balls that are nearer than ``PLACEMENT_TOLERANCE`` allows."""
    places = np.column_stack([snapshot.positions, snapshot.heights])
    for place, second in enumerate(here):
        for first in here[:place]:
            distance = math.dist(places[first], places[second])
            if distance < 2.0 * BALL_RADIUS - PLACEMENT_TOLERANCE:
                raise InvalidState(
                    f"positions[{second}]",
                    snapshot.positions[second].tolist(),
                    f"overlaps ball {first}: centres {distance!r} m apart, must be at least {2.0 * BALL_RADIUS} m",
                )
