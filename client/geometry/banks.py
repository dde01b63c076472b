"""Bank shots and kicks: one cushion on the way of the object ball, or on the way of the cue ball.

A cushion is taken for a mirror, on every table. A real one is not: speed, spin and friction change the angle by some
degrees, so a bank from here is a place to start from, and a simulation tells the rest. How far off the mirror is: a
rolling ball leaves the nine-foot table's cushion with 0.8 to 1.4 times the tangent of the angle it came at (up to 60
degrees, 2.5 to 7 m/s), the Olympiad's with 1.5 to 1.6 times.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from client.geometry.aim import Point, azimuth, cut_angle, distance, ghost_ball
from client.geometry.openings import opening
from client.geometry.paths import blockers
from client.geometry.pots import STEEPEST_CUT, places_of
from physics import RealTable, Table, TableState
from physics.pocket_names import pocket_number

CUSHIONS = range(4)
"""W, E, S, N, as rail collisions number them."""


@dataclass(frozen=True, slots=True)
class Bank:
    """One way to send one ball into one pocket over one cushion.

    `kick` says whose cushion it is: the cue ball's (True) or the object ball's. `bounce` (m) is where that ball's
    centre is at the cushion, `ghost` (m) where the cue ball has to be at contact, `phi` (deg) the shot's direction,
    `cut` (deg) the cut angle, `length` (m) of both balls' paths together, `blockers` the balls in the way of either.
    """

    ball: int
    pocket: int
    cushion: int
    kick: bool
    bounce: Point
    ghost: Point
    phi: float
    cut: float
    length: float
    blockers: tuple[int, ...]

    @property
    def is_open(self) -> bool:
        """Whether nothing is in the way and the cut can be played."""
        return not self.blockers and self.cut <= STEEPEST_CUT


def bank(table: Table, state: TableState, ball: int, pocket: int | str, cushion: int) -> Bank | None:
    """The bank of `ball` off `cushion` (0 to 3: W E S N) into `pocket`; None when no cushion is there to be hit.

    `pocket` is a number or a name (`"SW"`).

    Raises `ValueError` when the cue ball or the ball is not on the table, the ball is the cue ball, or there is no such
    pocket.
    """
    cue_ball, place = places_of(state, ball)
    pocket = pocket_number(pocket)
    bounce = _bounce(table, cushion, place, opening(table, place, pocket).target)
    if bounce is None:
        return None
    target, radius = opening(table, bounce, pocket).target, table.ball_radius
    bounce = _bounce(table, cushion, place, target)
    if bounce is None:
        return None
    ghost = ghost_ball(place, bounce, radius)
    if ghost == cue_ball:
        return None
    in_the_way = _blockers(state, ball, radius, (cue_ball, ghost), (place, bounce), (bounce, target))
    length = distance(cue_ball, ghost) + distance(place, bounce) + distance(bounce, target)
    cut = cut_angle(cue_ball, place, bounce, radius)
    return Bank(ball, pocket, cushion, False, bounce, ghost, azimuth(cue_ball, ghost), cut, length, in_the_way)


def kick(table: Table, state: TableState, ball: int, pocket: int | str, cushion: int) -> Bank | None:
    """The cue ball off `cushion` and then on to `ball`, which goes straight into `pocket`; as `bank` otherwise."""
    cue_ball, place = places_of(state, ball)
    pocket = pocket_number(pocket)
    target, radius = opening(table, place, pocket).target, table.ball_radius
    ghost = ghost_ball(place, target, radius)
    bounce = _bounce(table, cushion, cue_ball, ghost)
    if bounce is None:
        return None
    in_the_way = _blockers(state, ball, radius, (cue_ball, bounce), (bounce, ghost), (place, target))
    length = distance(cue_ball, bounce) + distance(bounce, ghost) + distance(place, target)
    cut = cut_angle(bounce, place, target, radius)
    return Bank(ball, pocket, cushion, True, bounce, ghost, azimuth(cue_ball, bounce), cut, length, in_the_way)


def banks(table: Table, state: TableState, balls: Iterable[int], pockets: Iterable[int | str] = range(6)) -> list[Bank]:
    """The open banks and kicks of `balls` into `pockets` over one cushion, the shortest first."""
    into = tuple(map(pocket_number, pockets))
    found = [
        made(table, state, ball, pocket, cushion)
        for ball in balls
        for pocket in into
        for cushion in CUSHIONS
        for made in (bank, kick)
    ]
    return sorted((each for each in found if each is not None and each.is_open), key=lambda each: each.length)


def _bounce(table: Table, cushion: int, start: Point, end: Point) -> Point | None:
    """Where a mirror at the cushion's line for ball centres sends `start` to `end`; None beyond the cushion."""
    if cushion not in CUSHIONS:
        raise ValueError(f"cushion is {cushion}; cushions are 0 to 3: W, E, S, N")
    axis = 0 if cushion < 2 else 1
    nose = table.contact_distance if isinstance(table, RealTable) else table.ball_radius
    line = nose if cushion % 2 == 0 else (table.width, table.length)[axis] - nose
    before, after = abs(start[axis] - line), abs(end[axis] - line)
    if before <= 0.0 or after <= 0.0:  # it lies on the cushion, or its pocket does: nothing to bounce off
        return None
    along = start[1 - axis] + (end[1 - axis] - start[1 - axis]) * before / (before + after)
    bounce = (line, along) if axis == 0 else (along, line)
    return bounce if table.contains(*bounce) and not _between_jaws(table, axis, along) else None


def _between_jaws(table: Table, axis: int, along: float) -> bool:
    """Whether there is no straight nose at a place along a cushion, but a pocket with jaws."""
    if not isinstance(table, RealTable):
        return False
    extent, corner = (table.length, table.width)[axis], table.corner_shape.nose_end
    beside = axis == 0 and abs(along - 0.5 * extent) < table.side_shape.nose_end
    return beside or not corner <= along <= extent - corner


def _blockers(state: TableState, ball: int, radius: float, *paths: tuple[Point, Point]) -> tuple[int, ...]:
    """The balls in the way of any of the paths, each once."""
    found = {other for start, end in paths for other in blockers(state, start, end, radius, ignore=(0, ball))}
    return tuple(sorted(found))
