"""Every constant of the physics with its meaning, unit, size and source.

Dimensions and masses are those of the Computational Pool Olympiad's table (FastFiz 0.2). Tolerances of the
contact rule are explained in ``docs/physics.md``; ``benchmarks/`` measures what each of them changes.
"""

from typing import Final

N_BALLS: Final = 16
"""Cue ball 0, solids 1-7, the 8, stripes 9-15."""

N_POCKETS: Final = 6
"""SW, W, NW, NE, E, SE = 0..5: counter-clockwise seen from the pocket at the origin up the west side."""

POCKET_NAMES: Final = ("SW", "W", "NW", "NE", "E", "SE")

CUSHION_NAMES: Final = ("W", "E", "S", "N")
"""Cushion numbers 0..3 of rail events: x = 0, x = width, y = 0, y = length."""

BALL_RADIUS: Final = 0.028575
"""m; a 2.25 inch ball. The same on every table: ``TableState`` checks overlap with it."""

BALL_MASS: Final = 0.16301
"""kg."""

CUE_MASS: Final = 0.160 / 0.302631579
"""kg, about 0.5287. Written as the quotient the historical engine used: at 1e-9 the digits matter."""

GRAVITY: Final = 9.81
"""m/s^2."""

PLACEMENT_TOLERANCE: Final = 1e-9
"""m. A placement that overlaps another ball or a line by no more than this counts as touching: a position
that went through a text format with ten digits is still a legal start. A nanometre is 1e-5 of a hair."""

V_MAX: Final = 10.0
"""m/s, the greatest cue speed of the Olympiad."""

THETA_MAX: Final = 70.0
"""deg, the greatest cue elevation of the Olympiad."""

EVENT_LIMIT: Final = 1_000_000
"""Events after which a shot ends with ``Status.EVENT_LIMIT`` unless told otherwise; a break has about a hundred."""
