"""Which strokes are possible: the tip must be on the ball, and the cue must not pass through anything."""

import dataclasses

import numpy as np
from numpy.typing import NDArray

from physics.constants import BALL_RADIUS, CUSHION_NAMES, N_BALLS
from physics.engine import kernels, workspace
from physics.errors import InvalidShot, InvalidState
from physics.kernels.layout import BEHIND_CUSHION, THROUGH_CUE_BALL
from physics.parameters import parameters
from physics.shot import FIELDS, Shot
from physics.simulation import checked_positions
from physics.state import TableState
from physics.status import Status
from physics.table import Table


@dataclasses.dataclass(frozen=True, slots=True)
class Unplayable:
    """Why a shot cannot be played.

    Attributes:
        status: the status ``simulate`` would give it. reason: the same in words, naming what is in the way.
    """

    status: Status
    reason: str

    def __str__(self) -> str:
        return self.reason


def check(table: Table, state: TableState, shot: Shot) -> Unplayable | None:
    """None if the shot can be played, else why not.

    Raises:
        InvalidState: a ball lies off the table.
        InvalidShot: ``shot`` is not a ``Shot``.
    """
    if not isinstance(shot, Shot):
        raise InvalidShot("shot", shot, "must be a physics.Shot")
    stroke = np.array([[shot.v, shot.phi, shot.theta, shot.a, shot.b]])
    number, obstacle = kernels(table.has_jaws).check_shot(
        parameters(table), workspace(), checked_positions(table, state), stroke
    )
    status = Status(number)
    if status is Status.AT_REST:
        return None
    if status is Status.OUT_OF_RANGE:
        return Unplayable(status, _beyond(table, shot))
    if status is not Status.CUE_OBSTRUCTED:
        return Unplayable(status, status.explain())
    return Unplayable(status, f"the cue is blocked by {_obstacle_name(obstacle)} at theta = {shot.theta} deg")


def min_elevation(table: Table, state: TableState, phi: float, a: float = 0.0, b: float = 0.0) -> float:
    """Smallest elevation at which nothing blocks the cue, deg; NaN if there is none up to the table's theta_max.

    Args:
        phi: azimuth of the stroke, deg; a, b: tip offsets, mm.

    Raises:
        InvalidShot: a parameter is not finite, or the tip is off the ball.
        InvalidState: a ball lies off the table, or there is no cue ball.
    """
    shot = Shot(0.0, phi, 0.0, a, b)
    if shot.a * shot.a + shot.b * shot.b > 1e6 * BALL_RADIUS * BALL_RADIUS:
        raise InvalidShot("a, b", (a, b), f"must satisfy a^2 + b^2 <= R^2 with R = {1e3 * BALL_RADIUS} mm")
    positions = checked_positions(table, state)
    if state.position(0) is None:
        raise InvalidState("positions[0]", None, "there must be a cue ball on the table")
    if not table.cue_test:
        return 0.0
    return float(
        kernels(table.has_jaws).elevation_needed(parameters(table), workspace(), positions, shot.phi, shot.a, shot.b)
    )


def min_elevations(
    table: Table,
    positions: NDArray[np.float64],
    phi: NDArray[np.float64],
    a: NDArray[np.float64],
    b: NDArray[np.float64],
) -> NDArray[np.float64]:
    """``min_elevation`` of a stroke on each of n tables that are known to be valid, (n,) deg.

    Args:
        positions: (n, 16, 2) float64 m, C-contiguous. phi: (n,) deg. a, b: (n,) mm, on the ball.
    """
    if not table.cue_test:
        return np.zeros(len(positions))
    find, row, work = kernels(table.has_jaws).elevation_needed, parameters(table), workspace()
    flat, columns = positions.reshape(-1, 1, 2 * N_BALLS), zip(phi.tolist(), a.tolist(), b.tolist(), strict=True)
    return np.array([find(row, work, one, *column) for one, column in zip(flat, columns, strict=True)])


def are_playable(table: Table, positions: NDArray[np.float64], shots: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether ``check`` finds nothing against a stroke on each of n tables that are known to be valid, (n,).

    Args:
        positions: (n, 16, 2) float64 m, shots: (n, 5) float64; both C-contiguous.
    """
    test, row, work = kernels(table.has_jaws).check_shot, parameters(table), workspace()
    flat, strokes = positions.reshape(-1, 1, 2 * N_BALLS), shots.reshape(-1, 1, len(FIELDS))
    return np.array([test(row, work, one, shot)[0] == Status.AT_REST for one, shot in zip(flat, strokes, strict=True)])


def _beyond(table: Table, shot: Shot) -> str:
    """In words, which parameter is out of the table's range."""
    try:
        shot.refuse_beyond(table)
    except InvalidShot as refusal:
        return str(refusal)
    return Status.OUT_OF_RANGE.explain()


def _obstacle_name(number: int) -> str:
    if number < THROUGH_CUE_BALL:
        return f"ball {number}"
    if number == THROUGH_CUE_BALL:
        return "the cue ball itself"
    return f"the {CUSHION_NAMES[number - BEHIND_CUSHION]} cushion"
