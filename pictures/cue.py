"""The cue behind the cue ball."""

import math

from physics import Shot
from physics.constants import BALL_RADIUS
from pictures.elements import Point, element, polyline
from pictures.projection import Projection

PARTS = ((0.0, 1.0, 9.0, "#d9b27c"), (0.55, 1.0, 13.0, "#3b2618"), (0.0, 0.012, 10.0, "#6fb7e8"))
"""From, to (shares of the length), width (mm) and colour: shaft, butt, tip."""

GAP = 0.012
"""Between tip and ball, m."""


def cue(view: Projection, at: Point, shot: Shot) -> str:
    """The cue of ``shot``, seen from above: ``a`` moves it aside, ``theta`` shortens it."""
    phi, theta = math.radians(math.fmod(shot.phi, 360.0)), math.radians(shot.theta)
    aim, aside = (math.cos(phi), math.sin(phi)), (math.sin(phi), -math.cos(phi))
    flat = math.cos(theta)

    def along(share: float) -> Point:
        back = BALL_RADIUS + (GAP + share * view.table.cue_length) * flat
        return (
            at[0] - back * aim[0] + 1e-3 * shot.a * aside[0],
            at[1] - back * aim[1] + 1e-3 * shot.a * aside[1],
        )

    parts = [
        element("path", d=polyline([view.at(along(start)), view.at(along(end))]), stroke=colour, stroke_width=width)
        for start, end, width, colour in PARTS
    ]
    return element("g", *parts, fill="none", stroke_linecap="butt")
