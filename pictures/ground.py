"""The table without its balls: rails, cushions with their jaws, holes, cloth, marks."""

import math

from physics import Jaw, Pocket, Table
from pictures.elements import Point, circle, element, number, place, polyline
from pictures.projection import MM, Projection
from pictures.theme import Theme

CUSHION = 0.0508
"""Width of a cushion where the table does not say, m."""

STRAIGHT_HOLE = 0.0635
"""Least radius of the hole behind a straight mouth, m: such a table says only at which line a ball drops."""

CORNER_FLARE, SIDE_FLARE = 1.28, 0.25
"""Towards a straight mouth, a cushion grows longer by this times its width from nose to rail."""

SPOT, SIGHT = 7.0, 6.5
"""Radii of a spot and of a sight, mm."""


def ground(view: Projection, theme: Theme) -> str:
    """The table."""
    table = view.table
    width, height = view.size
    sights = [circle(view.at(sight), SIGHT, fill=theme.mark) for sight in _sights(view)]
    holes = [circle(view.at(centre), radius * MM, fill=theme.hole) for centre, radius in map(hole_of, table.pockets)]
    return element(
        "g",
        element("rect", width=width, height=height, rx=0.45 * view.frame * MM, fill=theme.rail),
        *sights,
        element("path", d=_area(view, _bed(table)), fill=theme.shelf),
        *holes,
        element("path", d=_area(view, _cloth(table)), fill=theme.cloth),
        *_cushions(view, theme),
        *_marks(view, theme),
    )


def hole_of(pocket: Pocket) -> tuple[Point, float]:
    """Centre and radius of the hole, m; behind a straight mouth, the least one that its line is a chord of."""
    if pocket.hole_centre is not None and pocket.hole_radius is not None:
        return pocket.hole_centre, pocket.hole_radius
    (x1, y1), (x2, y2) = pocket.mouth
    half = 0.5 * math.dist(*pocket.mouth)
    radius = max(STRAIGHT_HOLE, half)
    back = math.sqrt(radius * radius - half * half) / (2.0 * half)
    x = 0.5 * (x1 + x2) + math.copysign(back * (y2 - y1), -1.0 if "W" in pocket.name else 1.0)
    y = 0.5 * (y1 + y2) + math.copysign(back * (x2 - x1), -1.0 if "S" in pocket.name else 1.0)
    return (x, y), radius


def nearest_hole(table: Table, place: Point) -> Point:
    """Centre of the hole that a ball pocketed at ``place`` drops into, m."""
    return min((hole_of(pocket)[0] for pocket in table.pockets), key=lambda centre: math.dist(centre, place))


def _area(view: Projection, corners: list[Point]) -> str:
    return polyline([view.at(corner) for corner in corners]) + "Z"


def _bed(table: Table) -> list[Point]:
    """What lies within the rails: noses and cushions."""
    low, right, top = -_wide(table), table.width + _wide(table), table.length + _wide(table)
    return [(low, low), (right, low), (right, top), (low, top)]


def _wide(table: Table) -> float:
    return float(getattr(table, "cushion_width", CUSHION))


def _cloth(table: Table) -> list[Point]:
    """The playing surface: the rectangle of the noses, less what lies beyond straight mouths."""
    width, length = table.width, table.length
    cut = 0.0 if table.has_jaws else table.corner_reach
    return [
        *((cut, 0.0), (width - cut, 0.0), (width, cut), (width, length - cut)),
        *((width - cut, length), (cut, length), (0.0, length - cut), (0.0, cut)),
    ]


def _cushions(view: Projection, theme: Theme) -> list[str]:
    """The six cushions, seen from above; each goes from one mouth to the next."""
    pockets = view.table.pockets
    paths = []
    for here, there in zip(pockets, (*pockets[1:], pockets[0]), strict=True):
        if here.jaws:
            paths.append(f"M{_out_of_mouth(view, here.jaws[1])}L{_into_mouth(view, there.jaws[0])}Z")
        else:
            paths.append(_area(view, _straight_cushion(view.table, here, there)))
    look = {"fill": theme.cushion, "stroke": theme.outline, "stroke_linejoin": "round"}
    return [element("path", d=path, stroke_width=1.5, **look) for path in paths]


def _out_of_mouth(view: Projection, jaw: Jaw) -> str:
    """A jaw's outline from the end of its facing to its nose."""
    facing = polyline([view.at(jaw.facing_end), view.at(jaw.facing_start)]).removeprefix("M")
    return facing + _horn(view, jaw, jaw.facing_start, jaw.nose_end)


def _into_mouth(view: Projection, jaw: Jaw) -> str:
    """A jaw's outline from its nose to the end of its facing."""
    horn = _horn(view, jaw, jaw.nose_end, jaw.facing_start)
    return f"{place(view.at(jaw.nose_end))}{horn}L{place(view.at(jaw.facing_end))}"


def _horn(view: Projection, jaw: Jaw, start: Point, end: Point) -> str:
    """The arc of a horn."""
    (x, y), (from_x, from_y), (to_x, to_y) = map(view.at, (jaw.horn_centre, start, end))
    sweep = int((from_x - x) * (to_y - y) - (from_y - y) * (to_x - x) > 0.0)
    radius = number(jaw.horn_radius * MM)
    return f"A{radius} {radius} 0 0 {sweep} {place((to_x, to_y))}"


def _straight_cushion(table: Table, here: Pocket, there: Pocket) -> list[Point]:
    """Corners of a cushion between straight mouths: the ends of its nose, and what is behind them."""
    on_one_line = [(a, b) for a in here.mouth for b in there.mouth if a[0] == b[0] or a[1] == b[1]]
    first, last = min(on_one_line, key=lambda ends: math.dist(*ends))
    upright = first[0] == last[0]
    beyond = 0.5 * (table.width if upright else table.length)
    out = math.copysign(_wide(table), first[0 if upright else 1] - beyond)

    def behind(end: Point, other: Point, pocket: Pocket) -> Point:
        flare = _wide(table) * (SIDE_FLARE if len(pocket.name) == 1 else CORNER_FLARE)
        along = math.copysign(flare, (end[1] - other[1]) if upright else (end[0] - other[0]))
        return (end[0] + out, end[1] + along) if upright else (end[0] + along, end[1] + out)

    return [behind(first, last, here), first, last, behind(last, first, there)]


def _sights(view: Projection) -> list[Point]:
    """The marks on the rail: quarters of the width, eighths of the length, none at a pocket."""
    table = view.table
    behind = 0.5 * (view.frame + _wide(table))
    ends = [(part * table.width / 4.0, y) for part in (1, 2, 3) for y in (-behind, table.length + behind)]
    sides = [(x, part * table.length / 8.0) for part in (1, 2, 3, 5, 6, 7) for x in (-behind, table.width + behind)]
    return ends + sides


def _marks(view: Projection, theme: Theme) -> list[str]:
    """Head string and foot spot."""
    table = view.table
    line = polyline([view.at((x, table.head_string)) for x in (0.0, table.width)])
    string = element("path", d=line, fill="none", stroke=theme.mark, stroke_width=2.0, opacity="0.5")
    return [string, circle(view.at(table.foot_spot), SPOT, fill=theme.mark, opacity="0.6")]
