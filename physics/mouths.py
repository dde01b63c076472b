"""The shape of a pocket mouth with jaws, derived from what tables are specified by.

Jaw coordinates (s, d), m: s along the nose away from the middle of the mouth, d from the nose line into the table.
Nose line and facing line meet at the virtual tip (tip, 0), between which mouths are measured; a horn of radius r rounds
it, so that the straight nose begins at ``nose_end``. The cut is the angle between nose and facing, inside the cushion:
with delta = 180 deg - cut the facing runs into the pocket along (-cos delta, -sin delta), to the cushion's depth.

Both jaws of a mouth are alike. In a corner one has s = U, d = V and the other s = V, d = U, where U and V are the
distances from the long and the short nose line; at a side mouth d = U, and s is the distance from the table's middle.
Sines and cosines come from a fixed sequence (``kernels/angles.py``): the same bits on every machine.
"""

import dataclasses
import math
from typing import Final

from physics.kernels.angles import sine_cosine

Point = tuple[float, float]

ROOT_TWO: Final = math.sqrt(2.0)


@dataclasses.dataclass(frozen=True, slots=True)
class Mouth:
    """One kind of pocket mouth, in jaw coordinates; lengths in m.

    Attributes:
        in_corner: whether it is a corner mouth.
        tip: s of the virtual tip. nose_end: s from which on the nose is straight.
        horn_radius: of the rounded horn, whose centre is (nose_end, -horn_radius).
        facing_start, facing_end: (s, d) of the facing's ends. facing_normal: unit vector from it into the mouth.
        facing_length: from end to end.
        hole_centre: corner: (U, V); side: (U, distance from the middle). hole_radius: of the drop edge.
        throat: between the two facings' ends.
        clearance: least distance between the two jaws.
    """

    in_corner: bool
    tip: float
    nose_end: float
    horn_radius: float
    facing_start: Point
    facing_end: Point
    facing_normal: Point
    facing_length: float
    hole_centre: Point
    hole_radius: float
    throat: float
    clearance: float

    @property
    def horn_centre(self) -> Point:
        """(s, d) of the horn's centre."""
        return self.nose_end, -self.horn_radius

    def beside_end(self, distance: float) -> Point:
        """(s, d) of a centre that touches the facing's end at ``distance``."""
        (s, d), (normal_s, normal_d) = self.facing_end, self.facing_normal
        return s + distance * normal_s, d + distance * normal_d

    @property
    def before_ends(self) -> Point:
        """(s, d) of the point nearest to the table of what lies beyond the facings' ends.

        It is where the normals in both ends meet on the axis, if that is before the line from end to end.
        """
        (s, d), (normal_s, normal_d) = self.facing_end, self.facing_normal
        if self.in_corner:
            if normal_s + normal_d <= 0.0:
                middle = 0.5 * (s + d)
                return middle, middle
            far = (s - d) / (normal_d - normal_s)
        else:
            far = s / -normal_s
        return s + far * normal_s, d + far * normal_d


def corner_mouth(mouth: float, cut: float, shelf: float, hole_radius: float, horn_radius: float, depth: float) -> Mouth:
    """A corner mouth.

    Args:
        mouth: m, between the virtual tips. cut: deg. shelf: m, from the mouth's line to the drop edge, in the middle.
        hole_radius, horn_radius: m. depth: m, width of the cushion.
    """
    tip = mouth / ROOT_TWO
    nose_end, start, end, normal, length = _jaw(tip, cut, horn_radius, depth)
    centre = (0.5 * mouth - shelf - hole_radius) / ROOT_TWO
    throat = ROOT_TWO * (end[0] - end[1])
    # From the diagonal that halves the mouth: the facing's ends, and the horn.
    near = min(end[0] - end[1], start[0] - start[1], nose_end + horn_radius - ROOT_TWO * horn_radius)
    clearance = ROOT_TWO * near
    hole = (centre, centre)
    return Mouth(True, tip, nose_end, horn_radius, start, end, normal, length, hole, hole_radius, throat, clearance)


def side_mouth(mouth: float, cut: float, shelf: float, hole_radius: float, horn_radius: float, depth: float) -> Mouth:
    """A side mouth; arguments as for ``corner_mouth``."""
    tip = 0.5 * mouth
    nose_end, start, end, normal, length = _jaw(tip, cut, horn_radius, depth)
    clearance = 2.0 * min(end[0], start[0], nose_end - horn_radius)
    hole = (-(shelf + hole_radius), 0.0)
    return Mouth(
        False, tip, nose_end, horn_radius, start, end, normal, length, hole, hole_radius, 2.0 * end[0], clearance
    )


def _jaw(tip: float, cut: float, horn_radius: float, depth: float) -> tuple[float, Point, Point, Point, float]:
    """(nose end, facing's start, end, normal and length) of a jaw, in its coordinates."""
    sine, cosine = sine_cosine(180.0 - cut)
    tangent = horn_radius * (sine / (1.0 + cosine))  # r tan(delta/2): from the virtual tip to where the horn begins
    whole = depth / sine
    start = tip - tangent * cosine, -(tangent * sine)
    end = tip - whole * cosine, -depth
    return tip + tangent, start, end, (-sine, cosine), whole - tangent
