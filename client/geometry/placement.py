"""Where a cue ball in hand may be put down (rules R37 and R40)."""

import numpy as np
from numpy.typing import NDArray

from client.geometry.aim import Point
from physics import Table, TableState

CLEARANCE = 1e-6
"""Metres. Touching another ball counts as overlap, so a place keeps this far off: wide of rounding, far below a
shot's error."""


def is_free(table: Table, state: TableState, place: Point, kitchen: bool = False) -> bool:
    """Whether the cue ball's centre may be put at `place` (m), wherever it lies now.

    With `kitchen` the place has to be behind the head string, strictly.
    """
    (x, y), least = place, 2.0 * table.ball_radius + CLEARANCE
    if not table.contains(x, y) or (kitchen and not y > table.head_string):
        return False
    others = state.positions.tolist()[1:]  # an absent ball's distance is NaN, and no less than any
    return not any((a - x) * (a - x) + (b - y) * (b - y) < least * least for a, b in others)


def are_free(
    table: Table, positions: NDArray[np.float64], places: NDArray[np.float64], kitchen: NDArray[np.bool_]
) -> NDArray[np.bool_]:
    """`is_free` for m places on each of n tables, (n, m).

    Args:
        positions: (n, 16, 2) m, of the balls. places: (n, m, 2) m; n may be 1 for the same on all.
        kitchen: (n,) whether the places have to be behind the head string.
    """
    x, y = places[..., 0], places[..., 1]
    allowed = table.contains(x, y) & ((y > table.head_string) | ~kitchen[:, None])
    gap = positions[:, None, 1:, :] - places[:, :, None, :]
    least = 2.0 * table.ball_radius + CLEARANCE
    free: NDArray[np.bool_] = allowed & ~((gap * gap).sum(axis=3) < least * least).any(axis=2)
    return free


def lattice(table: Table, state: TableState, columns: int, rows: int, kitchen: bool = False) -> list[Point]:
    """The free places of a regular lattice over the table, or over the kitchen, from the west, row by row."""
    radius = table.ball_radius
    low = table.head_string + CLEARANCE if kitchen else radius
    xs = np.linspace(radius, table.width - radius, columns)
    ys = np.linspace(low, table.length - radius, rows)
    places = np.stack(np.meshgrid(xs, ys), axis=-1).reshape(1, -1, 2)
    free = are_free(table, state.positions[None], places, np.array([kitchen]))
    return [(x, y) for x, y in places[free].tolist()]
