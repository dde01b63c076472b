"""How far a pocket is open to a ball: where to aim it, and by how much it may miss.

On a table with straight mouths that is the middle of the mouth and half its width, seen from the ball. Jaws let a ball
in by another part of the mouth from every side: the directions in which it falls are those of
``client.geometry.entering``, and the aim is the middle of them.
"""

import math
from dataclasses import dataclass

from client.geometry.aim import Point, distance
from client.geometry.entering import Entrance, entrance
from physics import RealTable, Table
from physics.pocket_names import pocket_number

HALVINGS = 20
"""Of the angle in which the edge of an opening is looked for."""
NARROWEST = 1e-4
"""rad: a pocket that is open by less is closed."""
WIDEST = 1.0
"""rad to either side: a ball that hangs in the jaws may go anywhere, and a tangent must not."""
SIDES = (1, 4)
"""The pockets in the middle of the long cushions."""


@dataclass(frozen=True, slots=True)
class Opening:
    """A pocket as a ball sees it.

    Attributes:
        target: m, the point of the mouth to aim the ball at. room: m, by how much it may pass that point to either
            side; 0 where the pocket is closed to it.
    """

    target: Point
    room: float


def opening(table: Table, place: Point, pocket: int | str) -> Opening:
    """What a pocket, number or name, has for a ball at ``place`` (m), whatever lies between them.

    Raises:
        ValueError: there is no such pocket.
    """
    number = pocket_number(pocket)
    if isinstance(table, RealTable):
        return _between_jaws(table, place, number)
    target = mouth(table, number)
    run = distance(place, target)
    if run == 0.0:
        return Opening(target, 0.0)
    inward = _inward(table, number)
    facing = abs((place[0] - target[0]) * inward[0] + (place[1] - target[1]) * inward[1]) / run
    return Opening(target, _half_mouth(table, number) * facing)


def mouth(table: Table, pocket: int | str) -> Point:
    """Middle of a pocket's mouth: on its line for ball centres, or between its virtual tips."""
    x, y = table.mouths[pocket_number(pocket)]
    return float(x), float(y)


def entrance_of(table: RealTable, pocket: int) -> Entrance:
    """The entrance of a pocket with jaws."""
    return entrance(table, int(pocket in SIDES))


def _between_jaws(table: RealTable, place: Point, pocket: int) -> Opening:
    """The directions from ``place`` in which a ball falls, as the point in their middle and the room beside it."""
    hole, middle, known = table.pockets[pocket].hole_centre, mouth(table, pocket), entrance_of(table, pocket)
    if hole is None:
        raise ValueError(f"pocket = {pocket}: must have a hole")
    axis = math.atan2(hole[1] - middle[1], hole[0] - middle[0])
    far = distance(place, hole)
    bearing = math.remainder(math.atan2(hole[1] - place[1], hole[0] - place[0]) - axis, 2.0 * math.pi)
    low = _edge(known, known.low, bearing, far)
    high = _edge(known, known.high, bearing, far)
    is_open = high - low > NARROWEST
    turn = axis + (0.5 * (low + high) if is_open else bearing)
    ux, uy = math.cos(turn), math.sin(turn)
    run = max((middle[0] - place[0]) * ux + (middle[1] - place[1]) * uy, table.ball_radius)
    room = run * math.tan(min(0.5 * (high - low), WIDEST)) if is_open else 0.0
    return Opening((place[0] + run * ux, place[1] + run * uy), room)


def _edge(known: Entrance, offsets: tuple[float, ...], bearing: float, far: float) -> float:
    """The direction (rad from the axis) that leads from a ball along one edge of the entrance.

    The ball sees the hole's centre ``far`` (m) away in direction ``bearing`` (rad): a way in direction t passes the
    centre at far sin(t - bearing) to its left.
    """
    turn = math.asin(min(1.0, known.reach / far))
    left, right = bearing - turn, bearing + turn
    for _ in range(HALVINGS):
        middle = 0.5 * (left + right)
        if far * math.sin(middle - bearing) < _offset(known, offsets, middle):
            left = middle
        else:
            right = middle
    return 0.5 * (left + right)


def _offset(known: Entrance, offsets: tuple[float, ...], angle: float) -> float:
    """An edge of the entrance in a direction (rad), between those that are known."""
    place = min(max((math.degrees(angle) - known.first) / known.step, 0.0), len(offsets) - 1.0)
    before = min(int(place), len(offsets) - 2)
    share = place - before
    return (1.0 - share) * offsets[before] + share * offsets[before + 1]


def _half_mouth(table: Table, pocket: int) -> float:
    """Half the length of a straight mouth's line for ball centres (m)."""
    if pocket in SIDES:
        return 0.5 * table.side_mouth
    return (table.corner_reach - table.ball_radius) / math.sqrt(2.0)


def _inward(table: Table, pocket: int) -> Point:
    """Unit normal of a straight mouth's line, towards the table."""
    x, y = mouth(table, pocket)
    right, up = math.copysign(1.0, 0.5 * table.width - x), math.copysign(1.0, 0.5 * table.length - y)
    return (right, 0.0) if pocket in SIDES else (right / math.sqrt(2.0), up / math.sqrt(2.0))
