"""A ball seen from above: its colour, its stripe, its number."""

import math

from physics.constants import BALL_RADIUS
from pictures.digits import written
from pictures.elements import Point, circle, element, place
from pictures.projection import MM
from pictures.theme import IVORY, Theme, colour_of, ink_of

RADIUS = BALL_RADIUS * MM

BAND = 0.68
"""Half the height of a stripe, in radii: its number has room on it."""

TALL, SHORT = 1.1, 0.95
"""Height of a number of one digit and of two, in radii."""


def ball(number: int, centre: Point, theme: Theme, opacity: float = 1.0) -> str:
    """A ball at ``centre`` in the picture."""
    parts = [circle((0.0, 0.0), RADIUS, fill=IVORY if number > 8 else colour_of(number))]
    if number > 8:
        parts.append(element("path", d=_band(), fill=colour_of(number)))
    if number > 0:
        parts.append(written(number, (TALL if number < 10 else SHORT) * RADIUS, ink_of(number)))
    parts.append(circle((0.0, 0.0), RADIUS, fill="none", stroke=theme.outline, stroke_width=2.5))
    attributes = {"opacity": f"{opacity:g}"} if opacity < 1.0 else {}
    return element("g", *parts, transform=f"translate({place(centre)})", **attributes)


def ghost(centre: Point, theme: Theme) -> str:
    """Where the cue ball is when it meets the first ball."""
    return circle(centre, RADIUS, fill="none", stroke=theme.cue_line, stroke_width=3.5, stroke_dasharray="9 7")


def ring(centre: Point, theme: Theme) -> str:
    """Round a ball that was called."""
    return circle(centre, RADIUS + 9.0, fill="none", stroke=theme.call, stroke_width=6.0)


def _band() -> str:
    high = BAND * RADIUS
    wide = math.sqrt(RADIUS * RADIUS - high * high)
    arc = f"A{RADIUS:.1f} {RADIUS:.1f} 0 0 1 "
    left, right = place((-wide, -high)), f"{place((wide, -high))}{arc}{place((wide, high))}"
    return f"M{left}L{right}L{place((-wide, high))}{arc}{left}Z"
