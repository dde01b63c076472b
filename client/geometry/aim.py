"""Where to send the cue ball so that an object ball goes where it should.

The *ghost ball* is the place of the cue ball's centre at the moment of contact: one ball diameter behind the
object ball on the line from the object ball to its target. Friction between the balls throws the object ball
off that line by at most atan(mu_ball), 0.6 degrees on the default table; simulate to see it.
"""

import math

Point = tuple[float, float]
"""A point of the cloth, (x, y) in metres from the south-west corner."""


def distance(start: Point, end: Point) -> float:
    """Distance between two points in metres."""
    return math.hypot(end[0] - start[0], end[1] - start[1])


def azimuth(start: Point, end: Point) -> float:
    """Direction from `start` to `end` in degrees in [0, 360), counter-clockwise from +x: a shot's `phi`."""
    if start == end:
        raise ValueError(f"start and end are both {start}; a direction needs two different points")
    degrees = math.degrees(math.atan2(end[1] - start[1], end[0] - start[0])) % 360.0
    return degrees if degrees < 360.0 else 0.0


def ghost_ball(ball: Point, target: Point, radius: float) -> Point:
    """Centre of the cue ball (m) when it strikes `ball` so that the ball leaves straight for `target`."""
    length = distance(ball, target)
    if length == 0.0:
        raise ValueError(f"ball and target are both {ball}; the ball is already there")
    reach = 2.0 * radius / length
    return ball[0] - reach * (target[0] - ball[0]), ball[1] - reach * (target[1] - ball[1])


def cut_angle(cue_ball: Point, ball: Point, target: Point, radius: float) -> float:
    """Angle in degrees, [0, 180], between the cue ball's path and the path the object ball has to take.

    0 is a straight shot; at 90 the cue ball can only graze, and above it cannot send the ball there.
    """
    ghost = ghost_ball(ball, target, radius)
    if ghost == cue_ball:
        return 0.0
    turn = abs(azimuth(cue_ball, ghost) - azimuth(ball, target))
    return min(turn, 360.0 - turn)


def looks_like_radians(phi: float) -> bool:
    """Whether an azimuth is a full circle at most in radians, and no round number of degrees."""
    return abs(phi) <= 2.0 * math.pi and phi != round(phi, 1)
