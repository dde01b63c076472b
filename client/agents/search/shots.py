"""Strokes under consideration, thousands at a time: plain arrays, no objects."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Groups = NDArray[np.int8]

V, PHI, THETA, A, B = range(5)
"""Columns of a stroke, as the physics takes them: m/s, deg, deg, mm, mm."""

CHANCE, SEEN, LAYOUT, PLACED, EVEN = range(5)
"""Columns of a survey, what a table offers to a group: chance of its best pot; 1 if any of its balls can be struck
straight; how hard its layout is, minus the sum of the logarithms of its balls' chances; chance with ball in hand; what
the best pot takes to either side alike, rad."""

MADE, MISSED, SAFE, HIDDEN = range(4)
"""Situations of a race: the shooter has made a ball and plays on, misses, plays safe, or plays safe without seeing a
ball."""

WIDTH, LENGTH, RADIUS, NOSE, CUE_LENGTH, MOUTHS = range(6)
"""Places in the row of a table (`engine.table_row`), m; from MOUTHS on, PER_POCKET numbers a pocket:"""
MOUTH_X, MOUTH_Y, INWARD_X, INWARD_Y, HALF_MOUTH, HOLE_X, HOLE_Y, ENTRANCE, PER_POCKET = range(9)
"""middle of the mouth line, m; its inward normal; half its length, m; on a table with jaws the hole's centre, m, and
where in the row its entrance begins, 0 on others. An entrance (`client.geometry.entering`):"""
FIRST, STEP, REACH, COUNT, EDGES = range(5)
"""first direction and step, rad; greatest offset, m; how many directions; so many low edges and then high ones, m."""


@dataclass(frozen=True, slots=True, eq=False)
class Tables:
    """Positions to shoot from.

    Attributes:
        positions: (s, 16, 2) m, the cue ball on the table.
        group: (s,) int8, the shooter's group: -1 open, 0 solids, 1 stripes.
    """

    positions: Floats
    group: Groups

    def __len__(self) -> int:
        return len(self.group)

    def __getitem__(self, rows: NDArray[np.int64] | NDArray[np.bool_] | slice) -> "Tables":
        return Tables(self.positions[rows], self.group[rows])


@dataclass(frozen=True, slots=True, eq=False)
class Shots:
    """Strokes with their calls.

    Attributes:
        tables: what they are played on. table: (k,) which of them.
        strokes: (k, 5), columns v, phi, theta, a, b.
        ball, pocket: (k,) the call; ball -1 is a safety.
        margin: (k,) deg, half of the directions that pot the ball, as far as known; 0 where there is no straight pot.
    """

    tables: Tables
    table: Integers
    strokes: Floats
    ball: Integers
    pocket: Integers
    margin: Floats

    def __len__(self) -> int:
        return len(self.table)

    def __getitem__(self, rows: NDArray[np.int64] | NDArray[np.bool_] | slice) -> "Shots":
        return Shots(self.tables, *(getattr(self, name)[rows] for name in _ARRAYS))

    def joined(self, other: "Shots") -> "Shots":
        """These strokes and others on the same tables."""
        return Shots(self.tables, *(np.concatenate((getattr(self, name), getattr(other, name))) for name in _ARRAYS))

    def aimed(self, phi: Floats) -> "Shots":
        """The same strokes in other directions (deg)."""
        strokes = self.strokes.copy()
        strokes[:, PHI] = phi
        return replace(self, strokes=strokes)

    def before(self) -> Floats:
        """(k, 16, 2): the position each stroke is played from."""
        return self.tables.positions[self.table]

    def group(self) -> Groups:
        """(k,): the shooter's group."""
        return self.tables.group[self.table]


_ARRAYS = ("table", "strokes", "ball", "pocket", "margin")
