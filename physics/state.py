"""Where the balls lie between two shots."""

from collections.abc import Mapping
from math import isfinite
from typing import Any, Self, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from physics import notebook
from physics.constants import BALL_RADIUS, N_BALLS, PLACEMENT_TOLERANCE
from physics.errors import InvalidState
from physics.table import Table

_KEYS = tuple(str(ball) for ball in range(N_BALLS))
_LEAST_SQUARED = (2.0 * BALL_RADIUS - PLACEMENT_TOLERANCE) ** 2
"""m^2, between the centres of two balls that do not overlap."""


@final
class TableState:
    """Positions of the balls at rest. Immutable; equal and hashed by bits.

    Build one with ``from_positions``, ``from_dict`` or ``physics.rack``.
    """

    __slots__ = ("_balls", "_positions", "_valid_on")

    _balls: tuple[int, ...] | None
    _positions: NDArray[np.float64]
    _valid_on: Table | None

    def __init__(self) -> None:
        raise TypeError("use TableState.from_positions, TableState.from_dict or physics.rack")

    @classmethod
    def from_positions(cls, positions: Mapping[int, ArrayLike] | ArrayLike) -> Self:
        """Make a state from positions in metres.

        Args:
            positions: ball number to (x, y), or an array (16, 2) with NaN for balls off the table.

        Raises:
            InvalidState: an unknown ball, a position that is not two finite numbers, or two balls overlapping
                by more than ``PLACEMENT_TOLERANCE``.
        """
        array = _from_mapping(positions) if isinstance(positions, Mapping) else _from_array(positions)
        array += 0.0  # no negative zeros: equal states have equal bytes
        _refuse_overlap(array)
        return cls.trusted(array)

    @classmethod
    def trusted(cls, positions: NDArray[np.float64]) -> Self:
        """Wrap an array (16, 2) that is known to be valid, without copy or check; it is made read-only."""
        state = cls.__new__(cls)
        positions.flags.writeable = False
        state._positions = positions
        state._balls = None
        state._valid_on = None
        return state

    def is_known_on(self, table: Table) -> bool:
        """Whether ``valid_on`` was asked about this table last, and said yes."""
        return self._valid_on is table

    def valid_on(self, table: Table, known: bool = False) -> Self:
        """This state, if every ball lies inside the table's cushion lines and outside its pocket mouths.

        ``known``: the caller has found that they do.

        Raises:
            InvalidState: naming the first ball that does not.
        """
        if not known and not self.is_known_on(table):
            for ball in self.balls:
                x, y = self._positions[ball].tolist()
                if not table.contains(x, y):
                    allowed = "must lie inside the cushion lines and outside the pocket mouths"
                    raise InvalidState(f"positions[{ball}]", (x, y), allowed)
        self._valid_on = table
        return self

    @property
    def positions(self) -> NDArray[np.float64]:
        """(16, 2) float64, m, read-only; NaN where the ball is not on the table."""
        return self._positions

    @property
    def balls(self) -> tuple[int, ...]:
        """Numbers of the balls on the table, ascending."""
        if self._balls is None:
            self._balls = tuple([ball for ball, (x, _) in enumerate(self._positions.tolist()) if x == x])
        return self._balls

    def by_ball(self) -> dict[int, tuple[float, float]]:
        """Ball number to (x, y) in metres, for the balls on the table."""
        return {ball: (x, y) for ball, (x, y) in enumerate(self._positions.tolist()) if x == x}

    def position(self, ball: int) -> tuple[float, float] | None:
        """(x, y) in metres, or None when the ball is not on the table."""
        x, y = self._positions[ball].tolist()
        return None if x != x else (x, y)

    def moved(self, ball: int, position: ArrayLike) -> Self:
        """A copy with one ball placed at ``position`` (m).

        Raises:
            InvalidState: as for ``from_positions``.
        """
        positions = self._positions + 0.0
        positions[_number(ball, position)] = _point(ball, position)
        positions[ball] += 0.0
        places = positions.tolist()
        x, y = places.pop(ball)
        if any((x - a) * (x - a) + (y - b) * (y - b) < _LEAST_SQUARED for a, b in places):
            _refuse_overlap(positions)
        return self.trusted(positions)

    def removed(self, *balls: int) -> Self:
        """A copy without these balls."""
        positions = self._positions.copy()
        positions[list(balls)] = np.nan
        return self.trusted(positions)

    def to_dict(self) -> dict[str, list[float]]:
        """Ball number (as text, for JSON) to [x, y], for the balls on the table."""
        return {key: place for key, place in zip(_KEYS, self._positions.tolist(), strict=True) if place[0] == place[0]}

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """Read what ``to_dict`` wrote.

        Raises:
            InvalidState: as for ``from_positions``.
        """
        if not isinstance(values, Mapping):
            raise InvalidState("positions", values, "must be a mapping of ball numbers to [x, y]")
        positions = {}
        for key, value in values.items():
            if key not in _KEYS:
                raise InvalidState(f"positions[{key!r}]", value, f"balls are numbered 0 to {N_BALLS - 1}")
            positions[int(key)] = value
        return cls.from_positions(positions)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, TableState):
            return NotImplemented
        return self._positions.tobytes() == other._positions.tobytes()

    def __hash__(self) -> int:
        return hash(self._positions.tobytes())

    def __repr__(self) -> str:
        return f"TableState.from_positions({ {ball: self.position(ball) for ball in self.balls} })"

    def _repr_svg_(self) -> str:
        return notebook.picture(self, self._valid_on)

    def __reduce__(self) -> tuple[Any, tuple[NDArray[np.float64]]]:
        return TableState.trusted, (self._positions.copy(),)


def _from_mapping(positions: Mapping[int, ArrayLike]) -> NDArray[np.float64]:
    array = np.full((N_BALLS, 2), np.nan)
    for ball, position in positions.items():
        array[_number(ball, position)] = _point(ball, position)
    return array


def _number(ball: Any, position: Any) -> int:
    """A ball's number as such; raises InvalidState for anything else."""
    if isinstance(ball, bool) or not isinstance(ball, int | np.integer) or not 0 <= ball < N_BALLS:
        raise InvalidState(f"positions[{ball!r}]", position, f"balls are numbered 0 to {N_BALLS - 1}")
    return int(ball)


def _point(ball: int, position: ArrayLike) -> ArrayLike:
    """Two finite numbers; raises InvalidState for anything else."""
    if isinstance(position, tuple | list) and len(position) == 2 and all(map(_is_finite, position)):
        return position  # as JSON has them: what follows takes ten times as long
    try:
        point = np.asarray(position, dtype=np.float64)
    except (TypeError, ValueError):
        point = np.empty(0)
    if point.shape != (2,) or not np.isfinite(point).all():
        raise InvalidState(f"positions[{ball}]", position, "must be two finite numbers (x, y) in metres")
    return point


def _is_finite(value: object) -> bool:
    return type(value) is float and isfinite(value)


def _from_array(positions: ArrayLike) -> NDArray[np.float64]:
    try:
        array = np.array(positions, dtype=np.float64)
    except (TypeError, ValueError):
        raise InvalidState("positions", positions, f"must be numbers of shape ({N_BALLS}, 2)") from None
    if array.shape != (N_BALLS, 2):
        raise InvalidState("positions", array.shape, f"must have shape ({N_BALLS}, 2)")
    absent = np.isnan(array)
    for ball in np.flatnonzero((absent[:, 0] != absent[:, 1]) | np.isinf(array).any(axis=1)).tolist():
        raise InvalidState(f"positions[{ball}]", array[ball].tolist(), "must be two finite numbers, or NaN twice")
    array[absent] = np.nan  # one bit pattern of NaN, so that equal states have equal bytes
    return array


_FIRST, _SECOND = np.triu_indices(N_BALLS, 1)
"""Every pair of balls once."""


def _refuse_overlap(positions: NDArray[np.float64]) -> None:
    x, y = (positions[_FIRST] - positions[_SECOND]).T
    overlapping = np.flatnonzero(x * x + y * y < _LEAST_SQUARED)
    if len(overlapping):
        pair = overlapping[0]
        first, second = int(_FIRST[pair]), int(_SECOND[pair])
        distance = float(x[pair] * x[pair] + y[pair] * y[pair]) ** 0.5
        raise InvalidState(
            f"positions[{second}]",
            positions[second].tolist(),
            f"overlaps ball {first}: centres {distance!r} m apart, must be at least {2.0 * BALL_RADIUS} m",
        )
