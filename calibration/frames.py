"""Units and frames of data, and how they become the table's: metres and seconds, origin at the south-west corner."""

import dataclasses
import re
from typing import Final

import numpy as np
from numpy.typing import NDArray

from physics import Table

LENGTHS: Final = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "in": 0.0254}
"""Units of length, in metres."""
TIMES: Final = {"s": 1.0, "ms": 1e-3}
"""Units of time, in seconds; ``240 Hz`` counts frames."""
FRAMES: Final = ("corner", "centre", "corner lengthwise", "centre lengthwise")
"""Where the origin is, and which way x points: across the table, or along it."""
STRIKES: Final = ("known", "unknown")
_RATE = re.compile(r"(\d+(?:\.\d+)?)\s*Hz")


@dataclasses.dataclass(frozen=True, slots=True)
class Frame:
    """What the numbers of a data set mean.

    Attributes:
        length: m, of the unit of places. time: s, of the unit of times.
        frame: one of ``FRAMES``: ``corner`` is the product's own; ``lengthwise`` has x along the table's length, y to
            the left of it.
        sigma: m, noise of one coordinate, or None. strike_known: whether time 0 is the strike.
    """

    length: float
    time: float
    frame: str
    sigma: float | None = None
    strike_known: bool = True

    @property
    def turn(self) -> float:
        """deg, from the data's x to the table's."""
        return 90.0 if self.frame.endswith("lengthwise") else 0.0

    def places(self, table: Table, written: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n, 2) places in the table's frame, m."""
        scaled = self.length * written
        size = np.array([table.width, table.length])
        if self.frame.endswith("lengthwise"):
            scaled = np.column_stack((-scaled[:, 1], scaled[:, 0]))
            return scaled + (0.5 * size if self.frame.startswith("centre") else np.array([table.width, 0.0]))
        return scaled + 0.5 * size if self.frame.startswith("centre") else scaled


def seconds_of(text: str) -> float | None:
    """s, of a unit of time or the time between frames at a rate; None for anything else."""
    rate = _RATE.fullmatch(text)
    if rate is None:
        return TIMES.get(text)
    return 1.0 / float(rate[1]) if float(rate[1]) > 0.0 else None
