"""How a table lies in a picture."""

from dataclasses import dataclass

from physics import Table
from pictures.elements import Point

MM = 1000.0
"""Units of a picture in a metre."""

FRAME = 0.11
"""Width of the rail around the noses where the table does not say, m."""


@dataclass(frozen=True, slots=True)
class Projection:
    """A table to scale, never mirrored: lying, the head string on the left, or upright, the head string on top."""

    table: Table
    upright: bool = False

    @property
    def frame(self) -> float:
        """Width of the rail, m."""
        return getattr(self.table, "rail_width", FRAME)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the picture, mm."""
        across, up = (self.table.width, self.table.length)[:: 1 if self.upright else -1]
        return (across + 2.0 * self.frame) * MM, (up + 2.0 * self.frame) * MM

    def at(self, point: Point) -> Point:
        """Where a place on the table (m) is in the picture (mm, y downwards)."""
        x, y = point
        frame, length, width = self.frame, self.table.length, self.table.width
        if self.upright:
            return (frame + x) * MM, (frame + length - y) * MM
        return (frame + length - y) * MM, (frame + width - x) * MM
