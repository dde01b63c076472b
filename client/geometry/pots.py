"""Straight pots: one object ball, one pocket, the cue ball coming from where it lies.

The object ball is sent to the middle of what the pocket has open to it (`client.geometry.openings`).

A pot is judged by what an error of the cue's direction does to it. An error of `e` radians moves the cue
ball's place at contact by about `cue_distance * e`, which turns the object ball by that over `2 R
cos(cut)`, and moves it at the pocket by `ball_distance` times that turn. `tolerance` is the error that the pocket
just still takes.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from client.geometry.aim import Point, azimuth, cut_angle, distance, ghost_ball
from client.geometry.openings import Opening, opening
from client.geometry.paths import blockers
from physics import Table, TableState
from physics.pocket_names import pocket_number

STEEPEST_CUT = 85.0
"""Degrees. Beyond this cut a contact hardly moves the object ball, and a tenth of a degree misses it."""


@dataclass(frozen=True, slots=True)
class Pot:
    """One way to send one ball into one pocket.

    `ghost` (m) is where the cue ball's centre has to arrive, `phi` (deg) the direction that brings it
    there, `cut` (deg) the cut angle, `cue_distance` and `ball_distance` (m) the two straight paths,
    `blockers` the balls in the way of either, `tolerance` (deg) the error of direction that just still fits
    the pocket's mouth.
    """

    ball: int
    pocket: int
    ghost: Point
    phi: float
    cut: float
    cue_distance: float
    ball_distance: float
    blockers: tuple[int, ...]
    tolerance: float

    @property
    def is_open(self) -> bool:
        """Whether nothing is in the way and the cut can be played."""
        return not self.blockers and self.cut <= STEEPEST_CUT and self.tolerance > 0.0


def pot(table: Table, state: TableState, ball: int, pocket: int | str) -> Pot:
    """The straight pot of `ball` into `pocket` from where the cue ball lies, playable or not.

    `pocket` is a number or a name (`"SW"`).

    Raises `ValueError` when the cue ball or the ball is not on the table, the ball is the cue ball, or there is no such
    pocket.
    """
    cue_ball, place = places_of(state, ball)
    return _pot(table, state, ball, pocket_number(pocket), cue_ball, place, opening(table, place, pocket))


def _pot(table: Table, state: TableState, ball: int, pocket: int, cue_ball: Point, place: Point, entry: Opening) -> Pot:
    """The pot by the way that an opening gives."""
    target = entry.target
    ghost = ghost_ball(place, target, table.ball_radius)
    cut = cut_angle(cue_ball, place, target, table.ball_radius)
    phi = azimuth(cue_ball, ghost) if ghost != cue_ball else azimuth(place, target)
    reach = distance(cue_ball, ghost)
    run = distance(place, target)
    in_the_way = blockers(state, cue_ball, ghost, table.ball_radius, ignore=(0, ball)) + blockers(
        state, place, target, table.ball_radius, ignore=(0, ball)
    )
    slack = entry.room * 2.0 * table.ball_radius * math.cos(math.radians(min(cut, 90.0)))
    tolerance = math.degrees(math.atan2(slack, run * max(reach, table.ball_radius)))
    return Pot(ball, pocket, ghost, phi, cut, reach, run, in_the_way, tolerance)


def pots(table: Table, state: TableState, balls: Iterable[int], pockets: Iterable[int | str] = range(6)) -> list[Pot]:
    """The open straight pots of `balls` into `pockets`, the most forgiving first."""
    into = tuple(map(pocket_number, pockets))
    found = []
    for ball in balls:
        cue_ball, place = places_of(state, ball)
        for pocket in into:
            entry = opening(table, place, pocket)
            # quick to see, and true for half of all pairs
            if cut_angle(cue_ball, place, entry.target, table.ball_radius) <= STEEPEST_CUT:
                found.append(_pot(table, state, ball, pocket, cue_ball, place, entry))
    return sorted((each for each in found if each.is_open), key=lambda each: -each.tolerance)


def places_of(state: TableState, ball: int) -> tuple[Point, Point]:
    """Where the cue ball and `ball` lie."""
    if ball == 0:
        raise ValueError("ball is 0, the cue ball; a pot needs an object ball, 1 to 15")
    cue_ball, place = state.position(0), state.position(ball)
    if cue_ball is None or place is None:
        missing = 0 if cue_ball is None else ball
        raise ValueError(f"ball {missing} is not on the table; on it are {state.balls}")
    return cue_ball, place
