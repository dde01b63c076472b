"""Which straight ways into a pocket with jaws end in its hole, at the usual speeds of a rolling ball.

What jaws let in is no straight line: a corner takes a ball that slides along the rail and touches the far facing, a
side pocket refuses one that comes steeply and touches the near horn, and a fast ball rattles out where a slow one
falls. So the ways are tried, once for each table: a lone ball is rolled along each, in steps of direction and of offset
from the hole's centre, and the edges of what falls are halved in. A pocket's mouth is its own mirror image, and all
corners are alike, as both sides are: two halves of a pocket tell everything.
"""

import functools
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from physics import RealTable, simulate_batch
from physics.constants import N_BALLS
from physics.cue_ball import struck_ball
from physics.shot import FIELDS

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

SPEEDS: Final = (1.0, 2.0, 4.0)
"""m/s at the mouth: a way counts if a ball falls at all of them. Slower ones fall more easily."""
WIDEST: Final = {0: 65.0, 1: 80.0}
"""deg from the axis of a corner and of a side pocket: no steeper way ends in the hole."""
STEP: Final = 1.0
"""deg between the directions that are tried."""
COLUMNS: Final = 61
"""Offsets tried in each direction before the edges are halved ``HALVINGS`` times."""
HALVINGS: Final = 8
BACK: Final = 1.0
"""m before the hole: where ways begin, or as far as the table reaches; along a rail, not beyond a side pocket."""
BEFORE: Final = 0.02
"""m. A shorter way comes through a cushion."""
RATTLES: Final = 0.6
"""m that a ball may go to and fro in the jaws. One that comes back from another cushion has gone farther."""
ON_BED: Final = 1e-9
"""m off the cushions: where the way of a ball that is frozen to one begins."""
ROLLS_AT: Final = 0.4
"""Of the radius: a level cue so far above the centre makes the ball roll at once."""


class Entrance(NamedTuple):
    """Which parallel ways end in the hole, by their direction.

    Attributes:
        first, step: deg, directions from the axis that leads into the pocket, counter-clockwise.
        reach: m, beyond the greatest of the offsets.
        low, high: (k,) m, between which offsets to the left of the hole's centre ways end in it; equal where none does.
    """

    first: float
    step: float
    reach: float
    low: tuple[float, ...]
    high: tuple[float, ...]


@functools.lru_cache(maxsize=32)
def entrance(table: RealTable, pocket: int) -> Entrance:
    """The entrance of pocket 0, a corner, or 1, a side pocket; loads the physics."""
    angles = np.arange(0.0, WIDEST[pocket] + STEP, STEP)
    hole, middle = table.pockets[pocket].hole_centre, table.mouths[pocket]
    reach = float(np.hypot(*np.subtract(middle, hole or (0.0, 0.0)))) + table.corner_mouth
    low, high = _Trial(table, pocket).edges(angles, np.linspace(-reach, reach, COLUMNS))
    # Seen from the other side, left is right.
    both = np.concatenate((-high[:0:-1], low)), np.concatenate((-low[:0:-1], high))
    return Entrance(-float(angles[-1]), STEP, reach, tuple(both[0].tolist()), tuple(both[1].tolist()))


class _Trial:
    """Balls rolled into one pocket of an empty table."""

    def __init__(self, table: RealTable, pocket: int) -> None:
        self._table, self._pocket = table.replace(cue_test=False), pocket
        self._hole = np.array(table.pockets[pocket].hole_centre)
        into = self._hole - table.mouths[pocket]
        self._axis = np.arctan2(into[1], into[0])
        nose = table.contact_distance + ON_BED
        self._low, self._high = np.array([nose, nose]), np.array([table.width - nose, table.length - nose])

    def edges(self, angles: Floats, offsets: Floats) -> tuple[Floats, Floats]:
        """The least and greatest offset of the widest run of ways that end in the hole, for each direction."""
        count = len(offsets)
        every = np.repeat(angles, count), np.tile(offsets, len(angles))
        inside = self._fall(*every).reshape(len(angles), count)
        known = np.flatnonzero(inside.any(axis=1))
        first, last = _longest_run(inside[known])
        good = np.concatenate((offsets[first], offsets[last]))
        bad = np.concatenate((offsets[np.maximum(first - 1, 0)], offsets[np.minimum(last + 1, count - 1)]))
        low, high = np.split(self._halved(np.tile(angles[known], 2), good, bad), 2)
        # Where none does, the edges meet: in between two directions the entrance narrows to nothing.
        middle = np.interp(angles, angles[known], 0.5 * (low + high))
        lowest, highest = middle.copy(), middle.copy()
        lowest[known], highest[known] = low, high
        return lowest, highest

    def _halved(self, angles: Floats, good: Floats, bad: Floats) -> Floats:
        """The edge between an offset that ends in the hole and one that does not, on the good side."""
        for _ in range(HALVINGS):
            middle = 0.5 * (good + bad)
            ends = self._fall(angles, middle)
            good, bad = np.where(ends, middle, good), np.where(ends, bad, middle)
        return good

    def _fall(self, angles: Floats, offsets: Floats) -> Flags:
        """Whether balls fall at all speeds: directions in deg from the axis, offsets in m to the left of the hole."""
        turned = self._axis + np.radians(angles)
        u = np.column_stack((np.cos(turned), np.sin(turned)))
        passed = self._hole + offsets[:, None] * np.column_stack((-u[:, 1], u[:, 0]))
        start, run = self._on_bed(passed, u)
        falls = run > BEFORE
        for speed in SPEEDS:
            rows = np.flatnonzero(falls)
            falls[rows] = self._rolled(start[rows], turned[rows], run[rows], speed)
        return falls

    def _on_bed(self, passed: Floats, u: Floats) -> tuple[Floats, Floats]:
        """Where ways begin, and how far it is from there to where they leave the bed; not more than 0 for no way."""
        with np.errstate(divide="ignore"):
            one, other = (passed - self._low) / u, (passed - self._high) / u  # backwards from the hole
        enters = np.minimum(np.maximum(one, other).min(axis=1), BACK)
        return passed - enters[:, None] * u, enters - np.minimum(one, other).max(axis=1)

    def _rolled(self, start: Floats, turned: Floats, run: Floats, speed: float) -> Flags:
        """Whether balls fall that come to the mouth rolling at ``speed``, at once."""
        table, count = self._table, len(start)
        positions = np.full((count, N_BALLS, 2), np.nan)
        positions[:, 0] = start
        strokes = np.zeros((count, len(FIELDS)))
        strokes[:, 0] = np.sqrt(speed * speed + 2.0 * table.mu_roll * table.gravity * run) / self._per_cue_speed
        strokes[:, 1] = np.degrees(turned)
        strokes[:, 4] = 1e3 * ROLLS_AT * table.ball_radius
        batch = simulate_batch(table, positions, strokes)
        fell: Flags = (batch.pocket[:, 0] == self._pocket) & (batch.duration * speed < run + RATTLES)
        return fell

    @functools.cached_property
    def _per_cue_speed(self) -> float:
        """The speed of a ball that rolls at once, for 1 m/s of the cue."""
        return float(
            struck_ball(self._table, [[1.0, 0.0, 0.0, 0.0, 1e3 * ROLLS_AT * self._table.ball_radius]]).speed[0]
        )


def _longest_run(inside: Flags) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """First and last column of the longest run of True in each row."""
    run = np.zeros(inside.shape, np.int64)
    run[:, 0] = inside[:, 0]
    for column in range(1, inside.shape[1]):
        run[:, column] = (run[:, column - 1] + 1) * inside[:, column]
    last = run.argmax(axis=1)
    return last - run.max(axis=1) + 1, last
