"""The table as a convex octagon for a ball's centre: four moved cushion lines, four corner mouths.

The side mouths lie on the west and east lines: a crossing strictly between their ends is a pocket.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from mpmath import mp, mpc, mpf
from support.truth.model import Ball, World, dot

SW, W, NW, NE, E, SE = range(6)
WEST, EAST, SOUTH, NORTH = range(4)


@dataclass(frozen=True)
class Line:
    """A side of the octagon: the ball is inside while ``dot(inward, r) > offset``."""

    inward: mpc
    offset: mpf
    cushion: int = -1
    pocket: int = -1
    side_pocket: int = -1

    def height(self, position: mpc) -> mpf:
        return dot(self.inward, position) - self.offset


def lines(world: World) -> list[Line]:
    w, length, r = world.width, world.length, world.radius
    near, diagonal = world.corner + r, mpc(1, 1)
    return [
        Line(mpc(1), r, cushion=WEST, side_pocket=W),
        Line(mpc(-1), r - w, cushion=EAST, side_pocket=E),
        Line(mpc(0, 1), r, cushion=SOUTH),
        Line(mpc(0, -1), r - length, cushion=NORTH),
        *(
            Line(inward / mp.sqrt(2), (near + dot(inward, corner)) / mp.sqrt(2), pocket=pocket)
            for pocket, corner, inward in (
                (SW, mpc(0, 0), diagonal),
                (NW, mpc(0, length), diagonal.conjugate()),
                (NE, mpc(w, length), -diagonal),
                (SE, mpc(w, 0), -diagonal.conjugate()),
            )
        ),
    ]


def in_side_mouth(world: World, line: Line, position: mpc) -> bool:
    return line.side_pocket >= 0 and abs(position.imag - world.length / 2) < world.side_mouth / 2


def touched_cushions(world: World, sides: list[Line], ball: Ball) -> Iterator[Line]:
    """Cushions within ``touch`` of the ball's centre, mouths excepted."""
    for line in sides:
        if line.cushion >= 0 and line.height(ball.position) <= world.touch:
            along_other = all(other.height(ball.position) >= -world.touch for other in sides if other.pocket >= 0)
            if along_other and not in_side_mouth(world, line, ball.position):
                yield line
