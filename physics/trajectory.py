"""Where every ball is at any time of a shot: exact, from the trace and the closed form."""

import dataclasses
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from physics.constants import N_BALLS
from physics.events import KINDS, BallState, Event, EventKind, Motion
from physics.table import Table

Floats = NDArray[np.float64]


@dataclasses.dataclass(frozen=True, eq=False)
class Snapshot:
    """All balls at one time.

    Attributes:
        time: s.
        positions: (16, 2) m; NaN for a ball that is not on the table.
        velocities: (16, 2) m/s; spins: (16, 3) rad/s; 0 for a ball that is not on the table.
        motion: (16,) int8 of ``Motion``.
    """

    time: float
    positions: Floats
    velocities: Floats
    spins: Floats
    motion: NDArray[np.int8]

    @classmethod
    def from_states(cls, table: Table, time: float, states: Floats) -> Self:
        """From (16, 8) rows x y vx vy wx wy wz motion, positions from the table's centre."""
        motion = states[:, 7].astype(np.int8)
        away = motion >= Motion.POCKETED
        positions = states[:, :2] + (0.5 * table.width, 0.5 * table.length)
        positions[away] = np.nan
        return cls(time, positions, states[:, 2:4].copy(), states[:, 4:7].copy(), motion)

    def to_states(self) -> Floats:
        """(1, 128): the kernels' rows, positions in the table's frame."""
        states = np.zeros((N_BALLS, 8))
        states[:, :2] = np.nan_to_num(self.positions)
        states[:, 2:4] = self.velocities
        states[:, 4:7] = self.spins
        states[:, 7] = self.motion
        return states.reshape(1, -1)


class Events:
    """The events of a shot: a sequence whose ``Event`` objects are built when read."""

    __slots__ = ("_offset", "_rows")

    def __init__(self, table: Table, rows: Floats) -> None:
        self._rows = rows
        self._offset = (0.5 * table.width, 0.5 * table.length)

    def __len__(self) -> int:
        return len(self._rows)

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[n] for n in range(*index.indices(len(self)))]
        position = range(len(self))[index]
        row = self._rows[position].tolist()
        kind, ball, other = KINDS[int(row[1])], int(row[2]), int(row[3])
        states: tuple[BallState, ...] = (self._state(ball, row[4:12]),)
        if kind is EventKind.BALL_COLLISION:
            states = (*states, self._state(other, row[12:20]))
        return Event(position, row[0], kind, ball, other, states)

    def __iter__(self) -> Any:
        return (self[n] for n in range(len(self)))

    def _state(self, ball: int, values: list[float]) -> BallState:
        x, y, vx, vy, wx, wy, wz, motion = values
        place = (x + self._offset[0], y + self._offset[1])
        return BallState(ball, place, (vx, vy), (wx, wy, wz), Motion(int(motion)))


def resting_states(positions: Floats) -> Floats:
    """(1, 128) rows of balls at rest at ``positions`` (16, 2), in the table's frame."""
    states = np.zeros((N_BALLS, 8))
    absent = np.isnan(positions[:, 0])
    states[:, :2] = np.where(absent[:, None], 0.0, positions)
    states[:, 7] = np.where(absent, Motion.ABSENT, Motion.STATIONARY)
    return states.reshape(1, -1)
