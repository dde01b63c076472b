"""Where to aim a stroke so that the object ball leaves as meant, whatever squirt, swerve and throw do.

A cue whose end has mass sends the cue ball off its azimuth when it strikes it to a side (``physics.squirt``), and a
raised one bends its way. Friction
between the balls throws the object ball off the line of centres, towards where the cue ball's surface moves: by up to 5
degrees on a real table, most for a slow cue ball that slides over the cloth without turning, and by 0.6 at most on the
Olympiad's.
"""

import dataclasses
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from client.geometry.pots import Pot
from physics import Shot, Table, TableState
from physics.cue_ball import StruckBall, friction_between_balls, struck_ball

Floats = NDArray[np.float64]

ROUNDS = 3
"""Of aiming: the throw depends on the cut, and the cut on the throw."""
LEAST_SPEED = 0.05
"""m/s. A cue ball that would not arrive is aimed as if it came at this speed."""
THINNEST = 0.05
"""Cosine of the thinnest cut that is reckoned with."""


class Arriving(NamedTuple):
    """A cue ball at contact, for each of n strokes.

    Attributes:
        speed: m/s. follow, side: as in ``StruckBall``.
        bend: rad, by how far the point it comes to is off its first direction, counter-clockwise. turn: rad, by how
            much its way has turned there.
    """

    speed: Floats
    follow: Floats
    side: Floats
    bend: Floats
    turn: Floats


def aimed(table: Table, state: TableState, pot: Pot, shot: Shot) -> Shot:
    """The shot, turned so that the ball of `pot` leaves for its pocket.

    What `shot` has for speed, elevation and tip counts, its azimuth does not.
    """
    cue_ball, ball = state.position(0), state.position(pot.ball)
    if cue_ball is None or ball is None:
        raise ValueError(f"pot = {pot!r}: must be of a ball on this table, and the cue ball on it too")
    leaving = math.degrees(math.atan2(ball[1] - pot.ghost[1], ball[0] - pot.ghost[0]))
    strokes = [[shot.v, pot.phi, shot.theta, shot.a, shot.b]]
    return dataclasses.replace(shot, phi=float(azimuths(table, [cue_ball], [ball], [leaving], strokes)[0]))


def azimuths(
    table: Table, cue_balls: ArrayLike, balls: ArrayLike, leaving: ArrayLike, strokes: ArrayLike
) -> NDArray[np.float64]:
    """`aimed` for n strokes, (n,) deg in [0, 360).

    Args:
        cue_balls, balls: (n, 2) m. leaving: (n,) deg, where the balls are to go. strokes: (n, 5), their azimuths not
            used.
    """
    cue, ball, rows = (np.asarray(each, np.float64) for each in (cue_balls, balls, strokes))
    way = np.radians(np.asarray(leaving, np.float64))
    struck = struck_ball(table, rows)
    thrown = np.zeros(len(rows))
    for _ in range(ROUNDS):
        normal = way - thrown
        to_ghost = ball - 2.0 * table.ball_radius * np.column_stack((np.cos(normal), np.sin(normal))) - cue
        comes = arriving(table, struck, np.hypot(*to_ghost.T))
        first = np.arctan2(to_ghost[:, 1], to_ghost[:, 0]) - comes.bend
        thrown = throw(table, comes, normal - first - comes.turn)
    found: Floats = (np.degrees(first) - struck.squirt) % 360.0
    return np.where(found < 360.0, found, 0.0)


def arriving(table: Table, struck: StruckBall, reach: Floats) -> Arriving:
    """The cue ball `reach` (m) further on: it slides until it rolls, and then rolls.

    Friction acts against the slip of the ball's lowest point, whose direction stays as it is while the ball slides; it
    ends after 2/7 of the slip over mu g.
    """
    slide, roll = table.mu_slide * table.gravity, table.mu_roll * table.gravity
    slip = np.maximum(np.hypot(struck.speed - struck.follow, struck.twist), 1e-12)
    braked, aside = (struck.speed - struck.follow) / slip * slide, -struck.twist / slip * slide
    until = 2.0 * slip / (7.0 * slide)
    slid = (struck.speed - 0.5 * braked * until) * until
    sliding = np.sqrt(np.maximum(struck.speed * struck.speed - 2.0 * braked * reach, 0.0))
    rolling = np.maximum(struck.speed - braked * until, 0.0)
    rolled = np.sqrt(np.maximum(rolling * rolling - 2.0 * roll * (reach - slid), 0.0))
    still_slides = reach < slid
    speed = np.maximum(np.where(still_slides, sliding, rolled), LEAST_SPEED)
    follow = np.where(still_slides, struck.follow + 2.5 * (struck.speed - sliding), speed)
    # In the time of the slide, and beyond it straight on.
    time = np.where(still_slides, 2.0 * reach / np.maximum(struck.speed + sliding, LEAST_SPEED), until)
    heading = aside * time / np.maximum(np.where(still_slides, sliding, rolling), LEAST_SPEED)
    off = 0.5 * aside * time * time + np.where(still_slides, 0.0, heading * (reach - slid))
    return Arriving(speed, follow, struck.side, np.arctan2(off, reach), np.arctan(heading))


def throw(table: Table, cue_ball: Arriving, cut: Floats) -> Floats:
    """By how much the object ball leaves off the line of centres, rad, counter-clockwise.

    Args:
        cut: rad, from the cue ball's way to the line of centres, counter-clockwise. Same law as the kernels'
            (docs/physics.md, eq. 14-17); the historical law's own faults are left out.
    """
    closing = cue_ball.speed * np.maximum(np.cos(cut), THINNEST)
    across = cue_ball.side - cue_ball.speed * np.sin(cut)
    slip = np.maximum(np.hypot(across, cue_ball.follow * np.cos(cut)), 1e-12)
    pushed = 0.5 * (1.0 + table.e_ball) * closing
    rubbed = np.minimum(friction_between_balls(table, slip) * pushed, slip / 7.0)
    thrown: Floats = np.arctan2(rubbed * across / slip, pushed)
    return thrown
