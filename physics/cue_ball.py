"""The cue ball as the tip leaves it: the closed forms of the strike, for whoever aims.

Same equations as the kernels (docs/physics.md, eq. 1-4 and 38-42) over arrays of strokes. Simulations do not use them,
so their last bits may differ between machines.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from physics.errors import InvalidShot
from physics.kernels.tolerances import LIFT
from physics.real_table import RealTable
from physics.shot import Shot
from physics.table import Table

Floats = NDArray[np.float64]


class StruckBall(NamedTuple):
    """The cue ball just after the strike, for each of n strokes.

    Attributes:
        speed: m/s, along the cloth. squirt: deg, from the stroke's azimuth, counter-clockwise.
        follow, side, twist: m/s, R times the spin that rolls the ball along the azimuth (a ball with follow = speed
            rolls), that turns it counter-clockwise seen from above, and about the azimuth itself: this one is what
            bends the way of a ball struck to a side with a raised cue.
        slips: whether the tip slips off: a miscue.
    """

    speed: Floats
    squirt: Floats
    follow: Floats
    side: Floats
    twist: Floats
    slips: NDArray[np.bool_]


def squirt(table: Table, shot: Shot) -> float:
    """By how much the cue ball leaves off the azimuth of the stroke, deg, counter-clockwise.

    Right english (a > 0) sends it to the left. 0 where the end of the cue has no mass, as on the Olympiad's table.

    Raises:
        InvalidShot: ``shot`` is not a ``Shot``, or its tip is off the ball.
    """
    if not isinstance(shot, Shot):
        raise InvalidShot("shot", shot, "must be a physics.Shot")
    if shot.a * shot.a + shot.b * shot.b > 1e6 * table.ball_radius * table.ball_radius:
        raise InvalidShot(
            "a, b", (shot.a, shot.b), f"must satisfy a^2 + b^2 <= R^2 with R = {1e3 * table.ball_radius} mm"
        )
    return float(struck_ball(table, [[shot.v, shot.phi, shot.theta, shot.a, shot.b]]).squirt[0])


def struck_ball(table: Table, strokes: ArrayLike) -> StruckBall:
    """What strokes make of the cue ball.

    Args:
        strokes: (n, 5), columns v, phi, theta, a, b in Olympiad units; a tip off the ball counts as at its edge.
    """
    v, _, theta, a, b = np.asarray(strokes, np.float64).T
    radius = table.ball_radius
    a, b = 1e-3 * a / radius, 1e-3 * b / radius
    depth = np.sqrt(np.maximum(0.0, 1.0 - a * a - b * b))
    cosine, sine = np.cos(np.radians(theta)), np.sin(np.radians(theta))
    kappa, g = depth * cosine + b * sine, b * cosine - depth * sine
    s = np.hypot(a, g)
    end, e_tip, mu_tip = _tip(table)
    y = 1.0 + end * (1.0 + 2.5 * kappa * kappa)
    tau = 2.5 * kappa * s * end / y
    aside, turning = 2.5 * kappa * end / y, (1.0 + end) / y
    ratio = table.ball_mass / table.cue_mass
    inverse = 1.0 + ratio + 2.5 * s * s * turning
    slips = np.logical_and(end > 0.0, s - kappa * tau > mu_tip * (kappa + s * tau))
    if slips.any():
        slid = np.where(slips, (s - mu_tip * kappa) / np.where(slips, kappa + mu_tip * s, 1.0), 0.0)
        across = 1.0 + 2.5 * kappa * kappa + 1.0 / end
        aside = np.where(slips, slid / np.where(slips, s, 1.0), aside)
        turning = np.where(slips, 1.0 - kappa * slid / np.where(slips, s, 1.0), turning)
        freely = 1.0 + ratio + 2.5 * s * s - 5.0 * s * kappa * slid + across * slid * slid
        inverse = np.where(slips, freely, inverse)
    force = (1.0 + e_tip) * v / inverse
    forth, left = cosine - g * aside * sine, a * aside
    turn = 2.5 * force * turning
    velocity, spin = (force * forth, force * left), (turn * a * sine, turn * g)
    if table.flies:
        velocity, spin = _answered_by_cloth(table, velocity, force * (sine + g * aside * cosine), spin)
    speed, off = np.hypot(*velocity), np.degrees(np.arctan2(velocity[1], velocity[0]))
    return StruckBall(speed, off, spin[1], turn * a * cosine, spin[0], slips)


def _answered_by_cloth(
    table: Table, velocity: tuple[Floats, Floats], down: Floats, spin: tuple[Floats, Floats]
) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
    """Velocity and R times spin, each along the azimuth and to its left, after the blow `down` into the cloth (eq. 45)

    m/s. A blow upwards meets no cloth.
    """
    assert isinstance(table, RealTable)
    bounces = table.e_strike * down >= LIFT
    push = np.maximum(0.0, np.where(bounces, 1.0 + table.e_strike, 1.0) * down)
    along, across = velocity[0] - spin[1], velocity[1] + spin[0]
    slip = np.hypot(along, across)
    share = np.minimum(table.mu_slide * push, 2.0 / 7.0 * slip) / np.where(slip > 0.0, slip, 1.0)
    return (
        (velocity[0] - share * along, velocity[1] - share * across),
        (spin[0] - 2.5 * share * across, spin[1] + 2.5 * share * along),
    )


def friction_between_balls(table: Table, slip: Floats) -> Floats:
    """Coefficient of friction of two balls that slip at ``slip`` m/s, by the table's law (docs/physics.md, eq. 36)."""
    if isinstance(table, RealTable) and table.ball == "alciatore":
        found: Floats = 9.951e-3 + 0.108 * np.exp(-1.088 * slip)
        return found
    return np.full_like(slip, table.mu_ball)


def _tip(table: Table) -> tuple[float, float, float]:
    """(end mass over ball mass, restitution, friction) of the tip."""
    if isinstance(table, RealTable):
        return table.cue_end_mass / table.ball_mass, table.e_tip, table.mu_tip
    return 0.0, 1.0, 0.0
