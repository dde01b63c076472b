"""Where a cue ball in hand may be put down (rules R37 and R40)."""

import numpy as np

from client.geometry.aim import Point
from physics import Table, TableState

CLEARANCE = 1e-6
"""Metres. Touching another ball counts as overlap, so a place keeps this far off: wide of rounding, far
below a shot's
error."""


def is_free(table: Table, state: TableState, place: Point, kitchen: bool = False) -> bool:
    """Whether the cue ball's centre may be put at `place` (m), wherever it lies now.

    With `kitchen` the place has to be behind the head string, strictly.
    """
    if not table.contains(*place) or (kitchen and place[1] <= table.head_string):
        return False
    gap = state.positions[1:] - np.asarray(place)
    least = 2.0 * table.ball_radius + CLEARANCE
    return not bool(((gap * gap).sum(axis=1) < least * least).any())


def lattice(table: Table, state: TableState, columns: int, rows: int, kitchen: bool = False) -> list[Point]:
    """The free places of a regular lattice over the table, or over the kitchen, from the west, row by row."""
    radius = table.ball_radius
    low = table.head_string + CLEARANCE if kitchen else radius
    xs = np.linspace(radius, table.width - radius, columns)
    ys = np.linspace(low, table.length - radius, rows)
    places = [(float(x), float(y)) for y in ys for x in xs]
    return [place for place in places if is_free(table, state, place, kitchen)]
