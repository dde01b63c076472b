"""A table as the kernels see it: one row of numbers."""

import numpy as np
from numpy.typing import NDArray

from physics.constants import BALL_MASS
from physics.errors import InvalidTable
from physics.real_table import RealTable
from physics.table import Table

NO_SLIP, NO_SLIP_HISTORICAL = 1e-12, 1e-10
"""m/s. A slip below this is rolling and a speed below it is rest: rounding of a velocity is 1e-15 m/s. The second
value is the historical engine's."""

_KEPT_AS = "_kernel_parameters"

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


def parameters(table: Table) -> NDArray[np.float64]:
    """(1, P_SIZE) float64, read-only; the order is that of ``physics.kernels.layout``."""
    known = table.__dict__.get(_KEPT_AS)  # a cache keyed by the table would hash its 20 numbers at every shot
    if known is None:
        known = table.__dict__[_KEPT_AS] = _row(table)
    return known


def _rest_time(table: Table) -> float:
    return REST_TIME * max(1.0, REST_AT_SLIDE / table.mu_slide, REST_AT_ROLL / table.mu_roll)


def _row(table: Table) -> NDArray[np.float64]:
    if isinstance(table, RealTable):
        raise InvalidTable(
            "name", table.name, "must be olympiad or fastfiz: shots on tables with jaws are not simulated yet"
        )
    radius = table.ball_radius
    half_x, half_y = 0.5 * table.width, 0.5 * table.length
    historical = table.collisions == "fastfiz"
    spin = 5.0 * table.mu_spin * table.gravity / (2.0 * radius)
    row = np.array(
        [
            *(half_x, half_y, half_x - radius, half_y - radius),
            half_x + half_y - table.corner_reach - radius,
            0.5 * table.side_mouth,
            radius,
            table.head_string - half_y,
            *(table.mu_slide * table.gravity, table.mu_roll * table.gravity, spin),
            0.25 * spin if historical else spin,
            *(table.mu_ball, table.e_ball),
            *(table.cushion_parallel, table.cushion_perpendicular, table.cushion_spin),
            table.ball_mass / table.cue_mass,
            1.0 if historical else 0.0,
            *(1.0 if table.cue_test else 0.0, table.cue_length, table.nose_height),
            *(table.v_max, table.theta_max),
            NO_SLIP_HISTORICAL if historical else NO_SLIP,
            *((HISTORICAL_BRACKET, HISTORICAL_INERTIA) if historical else (1.0, 0.4)),
            1.0 / radius,
            *(2.0 / (7.0 * table.mu_slide * table.gravity), 1.0 / (table.mu_roll * table.gravity), 1.0 / spin),
            REST_TIME_HISTORICAL if historical else _rest_time(table),
        ]
    )
    row.flags.writeable = False
    return row.reshape(1, -1)
