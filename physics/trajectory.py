"""Where every ball is at any time of a shot: exact, from the trace and the closed form."""

import dataclasses
from collections.abc import Sequence
from typing import Any, Self, overload

import numpy as np
from numpy.typing import NDArray

from physics.constants import N_BALLS
from physics.errors import InvalidState
from physics.events import KINDS, OUT_OF_PLAY, BallState, Event, EventKind, Motion
from physics.kernels import layout as at
from physics.placement import refuse_misplaced, refuse_overlapping
from physics.table import Table

Floats = NDArray[np.float64]
_KIND_VALUES = tuple([kind.value for kind in KINDS])
_MOTION_VALUES = tuple([motion.name.lower() for motion in Motion])
"""Kinds and motion states as JSON has them, by number."""

PLACE, VELOCITY, SPIN = slice(at.A_X, at.A_VX), slice(at.A_VX, at.A_WX), slice(at.A_WX, at.A_MOTION)
"""Columns of a ball's state."""


def state_width(table: Table) -> int:
    """Numbers of a ball's state in the kernels' rows: on a table with jaws there are a height and its speed."""
    return at.REAL_STATE_WIDTH if table.has_jaws else at.STATE_WIDTH


@dataclasses.dataclass(frozen=True, eq=False)
class Snapshot:
    """All balls at one time.

    Attributes:
        time: s.
        positions: (16, 2) m; NaN for a ball that is not on the table.
        velocities: (16, 2) m/s; spins: (16, 3) rad/s; 0 for a ball that is not on the table.
        motion: (16,) int8 of ``Motion``.
        heights: (16,) m, of the centres above where they rest on the cloth; vertical_velocities: (16,) m/s, upwards.
            0 unless told.
    """

    time: float
    positions: Floats
    velocities: Floats
    spins: Floats
    motion: NDArray[np.int8]
    heights: Floats = dataclasses.field(default_factory=lambda: np.zeros(N_BALLS))
    vertical_velocities: Floats = dataclasses.field(default_factory=lambda: np.zeros(N_BALLS))

    @classmethod
    def from_states(cls, time: float, states: Floats) -> Self:
        """From (16, n) rows x y vx vy wx wy wz motion and, with jaws, z vz; positions in the table's frame."""
        motion = states[:, at.A_MOTION].astype(np.int8)
        positions = states[:, PLACE].copy()
        positions[np.isin(motion, OUT_OF_PLAY)] = np.nan
        snapshot = cls(time, positions, states[:, VELOCITY].copy(), states[:, SPIN].copy(), motion)
        if states.shape[1] == at.REAL_STATE_WIDTH:
            snapshot.heights[:], snapshot.vertical_velocities[:] = states[:, at.A_Z], states[:, at.A_VZ]
        return snapshot

    def refuse_impossible(self, table: Table) -> None:
        """Raise InvalidState unless this can be an instant of a shot on ``table``.

        Shapes as above; ``motion`` a ``Motion``; a ball on the cloth within its cushion and mouth lines, a flying one
        clear of the cushions; no two overlapping by more than ``PLACEMENT_TOLERANCE``; velocities and spins finite and
        fitting the motion.
        """
        given = (self.positions, self.velocities, self.spins, self.motion, self.heights, self.vertical_velocities)
        shapes = tuple(np.shape(array) for array in given)
        n = N_BALLS
        if shapes != ((n, 2), (n, 2), (n, 3), (n,), (n,), (n,)):
            raise InvalidState("snapshot", shapes, "must have shapes (16, 2), (16, 2), (16, 3) and three times (16,)")
        for ball, number in enumerate(self.motion.tolist()):
            if number not in iter(Motion):
                raise InvalidState(f"motion[{ball}]", number, f"must be one of {[int(motion) for motion in Motion]}")
        here = np.flatnonzero(~np.isin(self.motion, OUT_OF_PLAY)).tolist()
        for ball in here:
            refuse_misplaced(self, table, ball)
            self._refuse_misfit(table, ball)
        refuse_overlapping(self, here)

    def _refuse_misfit(self, table: Table, ball: int) -> None:
        """Raise InvalidState unless a ball's velocity and spin are finite and such as its motion state has."""
        (vx, vy), (wx, wy, wz) = self.velocities[ball].tolist(), self.spins[ball].tolist()
        motion = Motion(int(self.motion[ball]))
        slips = vx - table.ball_radius * wy != 0.0 or vy + table.ball_radius * wx != 0.0
        moves = vx != 0.0 or vy != 0.0
        fits = slips if motion is Motion.SLIDING else moves == (motion is Motion.ROLLING)
        if not np.isfinite((vx, vy, wx, wy, wz)).all() or not (fits or motion is Motion.FLYING):
            allowed = f"must be finite and those of a ball that is {motion.name.lower()}"
            raise InvalidState(f"velocities[{ball}], spins[{ball}]", (vx, vy, wx, wy, wz), allowed)

    def to_states(self, table: Table) -> Floats:
        """(1, n): the kernels' rows, positions in the table's frame."""
        states = np.zeros((N_BALLS, state_width(table)))
        states[:, PLACE] = np.nan_to_num(self.positions)
        states[:, VELOCITY] = self.velocities
        states[:, SPIN] = self.spins
        states[:, at.A_MOTION] = self.motion
        if table.has_jaws:
            states[:, at.A_Z], states[:, at.A_VZ] = self.heights, self.vertical_velocities
        return states.reshape(1, -1)


class Events(Sequence[Event]):
    """The events of a shot: a sequence whose ``Event`` objects are built when read."""

    __slots__ = ("_flight", "_offset", "_rows")

    def __init__(self, table: Table, rows: Floats) -> None:
        self._rows = rows
        self._flight = table.flies
        self._offset = (0.5 * table.width, 0.5 * table.length)

    def __len__(self) -> int:
        return len(self._rows)

    def __repr__(self) -> str:
        return f"Events({len(self)}" + (f": {self[0]} ... {self[-1]})" if len(self) else ")")

    @overload
    def __getitem__(self, index: int) -> Event: ...

    @overload
    def __getitem__(self, index: slice) -> list[Event]: ...

    def __getitem__(self, index: int | slice) -> Event | list[Event]:
        places = range(len(self))[index]
        return self._event(places) if isinstance(places, int) else [self._event(place) for place in places]

    def of(self, kind: EventKind | str) -> list[Event]:
        """Return the events of one kind in order, e.g. ``result.events.of("rail_collision")``.

        Raises:
            ValueError: there is no such kind.
        """
        wanted = KINDS.index(EventKind(kind))
        return [self._event(place) for place in np.flatnonzero(self._rows[:, 1] == wanted).tolist()]

    def to_dicts(self) -> list[dict[str, Any]]:
        """What ``Event.to_dict`` gives for each, without the ``Event`` objects."""
        return [self._values(place, row) for place, row in enumerate(self._rows.tolist())]

    def _values(self, place: int, row: list[float]) -> dict[str, Any]:
        kind, ball, other = int(row[at.T_KIND]), int(row[at.T_BALL]), int(row[at.T_OTHER])
        states = [self._ball_values(ball, row, at.T_FIRST)]
        if kind == at.BALL_COLLISION:
            states.append(self._ball_values(other, row, (at.T_FIRST + len(row)) // 2))
        return {
            "index": place,
            "time": row[at.T_TIME],
            "kind": _KIND_VALUES[kind],
            "ball": ball,
            "other": other,
            "states": states,
        }

    def _ball_values(self, ball: int, row: list[float], first: int) -> dict[str, Any]:
        x, y, vx, vy, wx, wy, wz, motion = row[first : first + at.STATE_WIDTH]
        values = {
            "ball": ball,
            "position": [x + self._offset[0], y + self._offset[1]],
            "velocity": [vx, vy],
            "spin": [wx, wy, wz],
            "motion": _MOTION_VALUES[int(motion)],
        }
        if self._flight:
            values |= {"height": row[first + at.A_Z], "velocity_z": row[first + at.A_VZ]}
        return values

    def to_arrays(self) -> dict[str, NDArray[Any]]:
        """The events as columns of one length, such as ``pandas.DataFrame`` or ``polars.DataFrame`` take.

        ``time`` s; ``kind`` text; ``ball``, ``other`` as in ``Event``; then the ball's state after the event: ``x``,
        ``y`` m, ``vx``, ``vy`` m/s, ``wx``, ``wy``, ``wz`` rad/s, ``motion`` text; and that of the other ball of a
        ball collision by the same names after ``other_``, NaN and empty text where there is none. Where balls fly, with
        ``height`` m and ``velocity_z`` m/s.
        """
        rows, kinds = self._rows, np.array(KINDS, dtype=str)
        columns: dict[str, NDArray[Any]] = {
            "time": rows[:, at.T_TIME].copy(),
            "kind": kinds[rows[:, at.T_KIND].astype(int)],
            "ball": rows[:, at.T_BALL].astype(int),
            "other": rows[:, at.T_OTHER].astype(int),
        }
        two_balls = columns["kind"] == EventKind.BALL_COLLISION
        middle = (at.T_FIRST + rows.shape[1]) // 2
        first, second = rows[:, at.T_FIRST : middle], rows[:, middle:]
        return columns | self._state_columns("", first, True) | self._state_columns("other_", second, two_balls)

    def _state_columns(self, prefix: str, states: Floats, known: NDArray[np.bool_] | bool) -> dict[str, NDArray[Any]]:
        """Columns of the states of one ball an event, where they are ``known``."""
        names = ("x", "y", "vx", "vy", "wx", "wy", "wz")
        values = np.where(np.reshape(known, (-1, 1)), states[:, : len(names)], np.nan)
        values[:, :2] += self._offset
        motions = np.array([motion.name.lower() for motion in Motion] + [""])
        told = np.where(known, states[:, at.A_MOTION], len(motions) - 1).astype(int)
        columns = dict(zip(names, values.T, strict=True)) | {"motion": motions[told]}
        if self._flight:
            vertical = np.where(np.reshape(known, (-1, 1)), states[:, at.A_Z :], np.nan)
            columns |= {"height": vertical[:, 0], "velocity_z": vertical[:, 1]}
        return {prefix + name: column for name, column in columns.items()}

    def _event(self, place: int) -> Event:
        row = self._rows[place].tolist()
        kind, ball, other = KINDS[int(row[at.T_KIND])], int(row[at.T_BALL]), int(row[at.T_OTHER])
        middle = (at.T_FIRST + len(row)) // 2
        states: tuple[BallState, ...] = (self._state(ball, row[at.T_FIRST : middle]),)
        if kind is EventKind.BALL_COLLISION:
            states = (*states, self._state(other, row[middle:]))
        return Event(place, row[at.T_TIME], kind, ball, other, states)

    def _state(self, ball: int, values: list[float]) -> BallState:
        x, y, vx, vy, wx, wy, wz, motion, *vertical = values
        place = (x + self._offset[0], y + self._offset[1])
        height, rising = vertical or (0.0, 0.0)
        return BallState(ball, place, (vx, vy), (wx, wy, wz), Motion(int(motion)), height, rising, self._flight)


def resting_states(table: Table, positions: Floats) -> Floats:
    """(1, n) rows of balls at rest at ``positions`` (16, 2), in the table's frame."""
    states = np.zeros((N_BALLS, state_width(table)))
    absent = np.isnan(positions[:, 0])
    states[:, PLACE] = np.where(absent[:, None], 0.0, positions)
    states[:, at.A_MOTION] = np.where(absent, Motion.ABSENT, Motion.STATIONARY)
    return states.reshape(1, -1)
