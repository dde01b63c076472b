"""R1 to R5 and R50: the rack, and who breaks it."""

from math import dist, sqrt
from typing import Final

from physics.constants import PLACEMENT_TOLERANCE
from physics.rack import rack
from physics.state import TableState
from physics.table import Table
from referee.game import EIGHT
from referee.rules.stroke_facts import CUE_BALL, group_of_ball

RACK_TOLERANCE: Final = 1e-5
"""m, how far a racked ball may lie from its place in the triangle: twenty times the jitter of a rack, and
five thousand times less than a ball's width."""

ROWS: Final = 5


def new_rack(table: Table, rack_seed: int | bytes) -> TableState:
    """R4: a rack drawn from its seed; the same seed always gives the same rack."""
    return rack(table, "eight_ball", seed=rack_seed)


def places(table: Table) -> tuple[tuple[tuple[float, float], ...], ...]:
    """The triangle's places row by row from the apex, each row from west to east, m."""
    x, y = table.foot_spot
    spacing = 2.0 * table.ball_radius + table.rack_gap
    return tuple(
        tuple((x + spacing * (place - row / 2.0), y - spacing * row * sqrt(0.75)) for place in range(row + 1))
        for row in range(ROWS)
    )


def ball_at(state: TableState, place: tuple[float, float]) -> int | None:
    """The ball racked at ``place``, None if there is none."""
    found = (ball for ball in state.balls if dist(state.positions[ball].tolist(), place) <= RACK_TOLERANCE)
    return next(found, None)


def apex_on_foot_spot(table: Table, state: TableState) -> bool:
    """R1: the apex ball lies on the foot spot, and the other fourteen in a triangle behind it."""
    return all(ball_at(state, place) not in (None, CUE_BALL) for row in places(table) for place in row)


def eight_in_third_row(table: Table, state: TableState) -> bool:
    """R2: the 8 in the centre of the third row."""
    return ball_at(state, places(table)[2][1]) == EIGHT


def back_corners_differ(table: Table, state: TableState) -> bool:
    """R3: one solid and one stripe in the two back corners."""
    west, east = (ball_at(state, places(table)[-1][corner]) for corner in (0, -1))
    return west is not None and east is not None and group_of_ball(west) is not group_of_ball(east)


def balls_separated(table: Table, state: TableState) -> bool:
    """R5: no two balls overlap, and neighbours are no further apart than the rack's gap allows."""
    apart = [
        dist(state.positions[one].tolist(), state.positions[other].tolist())
        for one in range(1, 16)
        for other in range(1, one)
    ]
    diameter = 2.0 * table.ball_radius
    neighbours = sum(distance < diameter + table.rack_gap + RACK_TOLERANCE for distance in apart)
    return min(apart) >= diameter - PLACEMENT_TOLERANCE and neighbours == ROWS * (ROWS - 1) * 3 // 2


def breaker(first: int, game: int) -> int:
    """R50: the seat that breaks game ``game`` (from 0) of a match in which ``first`` broke first."""
    return (first + game) % 2
