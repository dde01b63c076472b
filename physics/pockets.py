"""Pockets as they lie on a table, for whoever draws them or aims at them. Metres, in the table's frame."""

import dataclasses
from collections.abc import Callable
from typing import Any, Final

from physics.constants import N_POCKETS, POCKET_NAMES
from physics.mouths import Mouth, Point

CORNERS: Final = (0, 2, 3, 5)
"""Pockets SW, NW, NE, SE; the others are the side pockets W and E."""

SIGNS: Final = ((-1, -1), (-1, 0), (-1, 1), (1, 1), (1, 0), (1, -1))
"""Where each pocket lies, seen from the table's middle."""

ON_END_RAIL: Final = (0, 5, 6, 11)
"""Jaws that end a short cushion."""

UPPER: Final = (3, 8)
"""Of the side mouths' jaws, those farther from the foot of the table."""


@dataclasses.dataclass(frozen=True, slots=True)
class Jaw:
    """One jaw of a mouth.

    Attributes:
        number: 0..11, as in jaw collisions: 2p and 2p + 1 are those of pocket p, in the order SW W NW NE E SE round the
            table, so that jaw 0 ends the south cushion and jaw 1 the west cushion in the south-west corner.
        tip: where nose line and facing line meet; mouths are measured between tips.
        nose_end: where the straight nose ends. horn_centre, horn_radius: the rounding between nose and facing.
        facing_start, facing_end: the facing. facing_normal: unit vector from it into the mouth.
    """

    number: int
    tip: Point
    nose_end: Point
    horn_centre: Point
    horn_radius: float
    facing_start: Point
    facing_end: Point
    facing_normal: Point

    def to_dict(self) -> dict[str, Any]:
        """Plain values, for JSON."""
        return {
            key: list(value) if isinstance(value, tuple) else value for key, value in dataclasses.asdict(self).items()
        }


@dataclasses.dataclass(frozen=True, slots=True)
class Pocket:
    """One pocket.

    Attributes:
        number: 0..5. name: SW W NW NE E SE.
        mouth: the two ends of the mouth: virtual tips, or where a straight mouth cuts the nose lines.
        jaws: two, or none where the mouth is a straight line.
        hole_centre, hole_radius: of the drop edge; None where the mouth's line is it.
    """

    number: int
    name: str
    mouth: tuple[Point, Point]
    jaws: tuple[Jaw, ...] = ()
    hole_centre: Point | None = None
    hole_radius: float | None = None

    def to_dict(self) -> dict[str, Any]:
        """Plain values, for JSON."""
        return {
            "number": self.number,
            "name": self.name,
            "mouth": [list(end) for end in self.mouth],
            "jaws": [jaw.to_dict() for jaw in self.jaws],
            "hole_centre": None if self.hole_centre is None else list(self.hole_centre),
            "hole_radius": self.hole_radius,
        }


def straight_pockets(width: float, length: float, corner_reach: float, side_mouth: float) -> tuple[Pocket, ...]:
    """The pockets of a table with straight mouths; ``corner_reach``: a corner mouth's length along each nose line."""
    pockets = []
    for number in range(N_POCKETS):
        place = _placing(width, length, *SIGNS[number])
        if number in CORNERS:
            ends = place(corner_reach, 0.0), place(0.0, corner_reach)
        else:
            ends = place(0.0, -0.5 * side_mouth), place(0.0, 0.5 * side_mouth)
        pockets.append(Pocket(number, POCKET_NAMES[number], ends))
    return tuple(pockets)


def pockets_with_jaws(width: float, length: float, corner: Mouth, side: Mouth) -> tuple[Pocket, ...]:
    """The pockets of a table with jaws."""
    pockets = []
    for number in range(N_POCKETS):
        mouth = corner if number in CORNERS else side
        jaws = tuple(_jaw(width, length, mouth, jaw) for jaw in (2 * number, 2 * number + 1))
        centre = _placing(width, length, *SIGNS[number])(*mouth.hole_centre)
        ends = jaws[0].tip, jaws[1].tip
        pockets.append(Pocket(number, POCKET_NAMES[number], ends, jaws, centre, mouth.hole_radius))
    return tuple(pockets)


def _jaw(width: float, length: float, mouth: Mouth, number: int) -> Jaw:
    place = _from_jaw(_placing(width, length, *SIGNS[number // 2]), number)
    direct = _from_jaw(_turning(*SIGNS[number // 2]), number)
    return Jaw(
        number,
        place(mouth.tip, 0.0),
        place(mouth.nose_end, 0.0),
        place(*mouth.horn_centre),
        mouth.horn_radius,
        place(*mouth.facing_start),
        place(*mouth.facing_end),
        direct(*mouth.facing_normal),
    )


Placer = Callable[[float, float], Point]


def _placing(width: float, length: float, sign_x: int, sign_y: int) -> Placer:
    """Of distances (U, V) from the two nose lines of a corner, or (U, y - L/2) at a side, the point of the table."""

    def place(u: float, v: float) -> Point:
        x = u if sign_x < 0 else width - u
        return x, 0.5 * length + v if sign_y == 0 else v if sign_y < 0 else length - v

    return place


def _turning(sign_x: int, sign_y: int) -> Placer:
    """The same of directions."""

    def turn(u: float, v: float) -> Point:
        return -sign_x * u, v if sign_y == 0 else -sign_y * v

    return turn


def _from_jaw(place: Placer, number: int) -> Placer:
    """``place`` of jaw coordinates (s, d)."""
    if number in ON_END_RAIL:
        return place
    if number // 2 in CORNERS:
        return lambda s, d: place(d, s)
    return (lambda s, d: place(d, s)) if number in UPPER else (lambda s, d: place(d, -s))
