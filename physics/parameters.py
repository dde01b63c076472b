"""A table as the kernels see it: one row of numbers."""

import numpy as np
from numpy.typing import NDArray

from physics.constants import BALL_MASS, EVENT_LIMIT
from physics.kernels import layout as at
from physics.mouths import Mouth
from physics.real_table import RealTable
from physics.table import Table

NO_SLIP, NO_SLIP_HISTORICAL = 1e-12, 1e-10
"""m/s. A slip below this is rolling and a speed below it is rest: rounding of a velocity is 1e-15 m/s. The second
value is the historical engine's."""

CUSHION_LAWS = {"factors": at.FACTORS, "han": at.HAN, "mathavan": at.MATHAVAN}
BALL_LAWS = {"consistent": at.CONSISTENT, "fastfiz": at.FASTFIZ, "alciatore": at.ALCIATORE}

_KEPT_AS = "_kernel_parameters"
LIMITS_KEPT = 8
"""Rows of one table that are kept, each with another limit of events: a game's and the physics' own are usual."""

REST_TIME, REST_TIME_HISTORICAL = 1e-3, 1e-6
"""s. A touching pair, or a ball at a cushion, that would meet again sooner is resting. Balls pressed together meet at
most once in this time; smaller, and persistent contact costs more events, larger, and it shows. The historical engine
had no such rule: there it only keeps a shot from collisions without end."""

REST_AT_SLIDE, REST_AT_ROLL = 0.2, 0.015
"""Cloth friction of the Olympiad's table, for which REST_TIME is meant. On a slower cloth everything takes longer, and
so does rest: else a shot of 1000 s could have a million meetings."""

HISTORICAL_BRACKET = 0.999425
HISTORICAL_INERTIA = 0.4 * 0.160 * 0.995473 / BALL_MASS
"""The historical strike: a factor on its bracket, and its moment of inertia over m R^2."""


def parameters(table: Table, event_limit: int = EVENT_LIMIT) -> NDArray[np.float64]:
    """(1, P_SIZE) float64, read-only; places: ``physics.kernels.layout``.

    Raises:
        ValueError: ``event_limit`` is not an integer from 1 to ``EVENT_LIMIT``.
    """
    rows = table.__dict__.get(_KEPT_AS)  # a cache keyed by the table would hash its 20 numbers at every shot
    if rows is None:
        rows = table.__dict__[_KEPT_AS] = {}
    known = rows.get(event_limit)
    if known is None or type(event_limit) is not int:  # True and 1.0 are found under 1
        known = _row(table, checked_event_limit(event_limit))
        if len(rows) == LIMITS_KEPT:
            rows.clear()
        rows[event_limit] = known
    return known


def checked_event_limit(value: int) -> int:
    """The limit as it was given.

    Raises:
        ValueError: it is not an integer from 1 to ``EVENT_LIMIT``.
    """
    if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= EVENT_LIMIT:
        raise ValueError(f"event_limit = {value!r}: must be an integer from 1 to {EVENT_LIMIT}")
    return value


def _rest_time(table: Table) -> float:
    return REST_TIME * max(1.0, REST_AT_SLIDE / table.mu_slide, REST_AT_ROLL / table.mu_roll)


def _row(table: Table, event_limit: int) -> NDArray[np.float64]:
    radius = table.ball_radius
    half_x, half_y = 0.5 * table.width, 0.5 * table.length
    historical = table.collisions == "fastfiz"
    spin = 5.0 * table.mu_spin * table.gravity / (2.0 * radius)
    values = {
        at.P_HALF_X: half_x,
        at.P_HALF_Y: half_y,
        at.P_LINE_X: half_x - radius,
        at.P_LINE_Y: half_y - radius,
        at.P_CORNER: half_x + half_y - table.corner_reach - radius,
        at.P_SIDE: 0.5 * table.side_mouth,
        at.P_RADIUS: radius,
        at.P_HEAD: table.head_string - half_y,
        at.P_SLIDE: table.mu_slide * table.gravity,
        at.P_ROLL: table.mu_roll * table.gravity,
        at.P_SPIN: spin,
        at.P_SPIN_SLIDING: 0.25 * spin if historical else spin,
        at.P_MU_BALL: table.mu_ball,
        at.P_E_BALL: table.e_ball,
        at.P_PARALLEL: table.cushion_parallel,
        at.P_PERPENDICULAR: table.cushion_perpendicular,
        at.P_KEEP_SPIN: table.cushion_spin,
        at.P_MASS_RATIO: table.ball_mass / table.cue_mass,
        at.P_HISTORICAL: float(historical),
        at.P_CUE_TEST: float(table.cue_test),
        at.P_CUE_LENGTH: table.cue_length,
        at.P_NOSE: table.nose_height,
        at.P_V_MAX: table.v_max,
        at.P_THETA_MAX: table.theta_max,
        at.P_NO_SLIP: NO_SLIP_HISTORICAL if historical else NO_SLIP,
        at.P_BRACKET: HISTORICAL_BRACKET if historical else 1.0,
        at.P_INERTIA: HISTORICAL_INERTIA if historical else 0.4,
        at.P_PER_RADIUS: 1.0 / radius,
        at.P_SLIDE_LASTS: 2.0 / (7.0 * table.mu_slide * table.gravity),
        at.P_ROLL_LASTS: 1.0 / (table.mu_roll * table.gravity),
        at.P_SPIN_LASTS: 1.0 / spin,
        at.P_REST_TIME: REST_TIME_HISTORICAL if historical else _rest_time(table),
        at.P_EVENT_LIMIT: float(event_limit),
    }
    size = at.P_SIZE
    if isinstance(table, RealTable):
        values |= _real_values(table)
        size = at.P_REAL_SIZE
    row = np.array([[values[place] for place in range(size)]])
    row.flags.writeable = False
    return row


def _real_values(table: RealTable) -> dict[int, float]:
    """What a table with jaws has besides, or otherwise."""
    rho, radius = table.contact_distance, table.ball_radius
    return {
        at.P_LINE_X: 0.5 * table.width - rho,
        at.P_LINE_Y: 0.5 * table.length - rho,
        at.P_RHO: rho,
        at.P_NOSE_COSINE: rho / radius,
        at.P_NOSE_SINE: -(table.nose_height - radius) / radius,
        at.P_CUSHION_LAW: CUSHION_LAWS[table.cushion],
        at.P_E_CUSHION: table.e_cushion,
        at.P_MU_CUSHION: table.mu_cushion,
        at.P_MU_SLIDE: table.mu_slide,
        at.P_BALL_LAW: BALL_LAWS[table.ball],
        at.P_END_RATIO: table.cue_end_mass / table.ball_mass,
        at.P_E_TIP: table.e_tip,
        at.P_MU_TIP: table.mu_tip,
        at.P_FLIGHT: float(table.flight),
        at.P_GRAVITY: table.gravity,
        at.P_NOSE_RISE: table.nose_height - radius,
        at.P_E_CLOTH: table.e_cloth,
        at.P_E_STRIKE: table.e_strike,
        at.P_E_PRESSED: table.e_pressed,
        at.P_E_RAIL: table.e_rail,
        at.P_MU_RAIL: table.mu_rail,
        at.P_CUSHION_WIDTH: table.cushion_width,
        at.P_RAIL_WIDTH: table.rail_width,
        **dict(enumerate(_mouth(table.corner_shape), at.P_CORNER_JAW)),
        **dict(enumerate(_mouth(table.side_shape), at.P_SIDE_JAW)),
    }


def _mouth(shape: Mouth) -> list[float]:
    """MOUTH_WIDTH numbers, in the order of the layout."""
    jaw = shape.nose_end, shape.horn_radius, *shape.facing_start, *shape.facing_normal, shape.facing_length
    return [*jaw, *shape.hole_centre, shape.hole_radius]
