"""Which balls stand in the way of a ball that moves along a straight line."""

from collections.abc import Iterable

import numpy as np

from client.geometry.aim import Point
from physics import TableState


def blockers(state: TableState, start: Point, end: Point, radius: float, ignore: Iterable[int] = ()) -> tuple[int, ...]:
    """Balls that a ball of `radius` (m) moving from `start` to `end` would hit, in order of their numbers.

    `ignore` names the balls that do not count: the mover itself, and the ball it is meant to strike.
    """
    along = np.subtract(end, start)
    square = float(along @ along)
    to_ball = state.positions - np.asarray(start)
    share = np.clip(to_ball @ along / square, 0.0, 1.0) if square > 0.0 else np.zeros(len(to_ball))
    gap = to_ball - share[:, None] * along
    hit = (gap * gap).sum(axis=1) < 4.0 * radius * radius  # False for NaN: balls off the table
    hit[list(ignore)] = False
    return tuple(np.flatnonzero(hit).tolist())


def is_clear(state: TableState, start: Point, end: Point, radius: float, ignore: Iterable[int] = ()) -> bool:
    """Whether no ball but those of `ignore` stands in the way from `start` to `end`."""
    return not blockers(state, start, end, radius, ignore)
