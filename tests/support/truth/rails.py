"""Cushions, jaws and holes of a table with jaws, built from its parameters at full precision, in the table's frame.

No broad phase: a moving ball is looked for at every nose, horn, facing and hole. Along a jaw's nose, away from its
mouth, is ``away``; off the nose line, into the table, is ``inward``.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from mpmath import cos, mp, mpc, mpf, radians, sin, sqrt, tan
from support.truth.air import Air, Edge
from support.truth.model import Ball, Motion, RealWorld, dot, unit
from support.truth.moments import Event, deflated, may_reach, moving_until, path, stays_clear
from support.truth.octagon import EAST, NORTH, SOUTH, WEST
from support.truth.roots import first_fall

CORNERS = (0, 2, 3, 5)


@dataclass(frozen=True)
class Wall:
    """A cushion where a ball touches it: ``inward`` from it to the ball's centre.

    ``bend``: radius of the arc the centre would follow round a horn, infinite along a straight piece. ``number``:
    cushion 0..3, or 4 + jaw.
    """

    inward: mpc
    number: int
    bend: mpf

    @property
    def cushion(self) -> int:
        return self.number


@dataclass(frozen=True)
class Strip:
    """A straight piece from ``start`` to ``end``; ``inward``: its normal, into the table or the mouth."""

    start: mpc
    end: mpc
    inward: mpc
    number: int

    def gap(self, place: mpc) -> mpf:
        return dot(place - self.start, self.inward)

    def is_beside(self, place: mpc) -> bool:
        along = unit(self.end - self.start)
        return 0 <= dot(place - self.start, along) <= abs(self.end - self.start)


@dataclass(frozen=True)
class Horn:
    centre: mpc
    radius: mpf
    number: int


@dataclass(frozen=True)
class Hole:
    centre: mpc
    radius: mpf
    pocket: int


@dataclass(frozen=True)
class Jaw:
    """``nose_end``: where the straight nose ends; ``away`` from the mouth along it, ``inward`` off its line."""

    nose_end: mpc
    horn: Horn
    facing: Strip
    away: mpc
    inward: mpc

    @property
    def nose(self) -> Strip:
        """Its nose line, as far as it matters here."""
        return Strip(self.nose_end, self.nose_end + self.away, self.inward, -1)


def jaw_of(world: RealWorld, number: int, corner: mpc, away: mpc, inward: mpc) -> Jaw:
    """Of the mouth whose middle, or corner of the nose lines, is ``corner``."""
    in_corner = number // 2 in CORNERS
    tip = corner + away * (world.corner_mouth / sqrt(2) if in_corner else world.side_mouth / 2)
    delta = radians(180 - (world.corner_cut if in_corner else world.side_cut))
    into = -away * cos(delta) - inward * sin(delta)
    normal = -away * sin(delta) + inward * cos(delta)
    tangent = world.horn_radius * tan(delta / 2)
    nose_end = tip + away * tangent
    horn = Horn(nose_end - inward * world.horn_radius, world.horn_radius, 4 + number)
    facing = Strip(tip + into * tangent, tip + into * (world.cushion_width / sin(delta)), normal, 4 + number)
    return Jaw(nose_end, horn, facing, away, inward)


def jaws(world: RealWorld) -> list[Jaw]:
    """All twelve, jaws 2p and 2p + 1 at pocket p = SW W NW NE E SE."""
    w, length = world.width, world.length
    east, north = mpc(1), mpc(0, 1)
    sw, nw, ne, se = mpc(0, 0), mpc(0, length), mpc(w, length), mpc(w, 0)
    west_side, east_side = mpc(0, length / 2), mpc(w, length / 2)
    placed = [
        *((sw, east, north), (sw, north, east), (west_side, -north, east), (west_side, north, east)),
        *((nw, -north, east), (nw, east, -north), (ne, -east, -north), (ne, -north, -east)),
        *((east_side, north, -east), (east_side, -north, -east), (se, north, -east), (se, -east, north)),
    ]
    return [jaw_of(world, number, *place) for number, place in enumerate(placed)]


def holes(world: RealWorld) -> list[Hole]:
    """A corner's front edge lies a shelf behind the middle of its mouth, a side's a shelf behind the nose line."""
    w, length, radius = world.width, world.length, world.corner_hole_radius
    deep = (world.corner_mouth / 2 - world.corner_shelf - radius) / sqrt(2)
    out = world.side_shelf + world.side_hole_radius
    corners = [mpc(deep, deep), mpc(deep, length - deep), mpc(w - deep, length - deep), mpc(w - deep, deep)]
    sides = {1: mpc(-out, length / 2), 4: mpc(w + out, length / 2)}
    return [
        *(Hole(centre, radius, pocket) for centre, pocket in zip(corners, CORNERS, strict=True)),
        *(Hole(centre, world.side_hole_radius, pocket) for pocket, centre in sides.items()),
    ]


class Rails:
    """The boundary of a table with jaws."""

    def __init__(self, world: RealWorld) -> None:
        self.world = world
        all_jaws = jaws(world)
        ends = [jaw.nose_end for jaw in all_jaws]
        between = ((1, 2, WEST), (3, 4, WEST), (5, 6, NORTH), (7, 8, EAST), (9, 10, EAST), (11, 0, SOUTH))
        inward = {WEST: mpc(1), EAST: mpc(-1), SOUTH: mpc(0, 1), NORTH: mpc(0, -1)}
        noses = [Strip(ends[a], ends[b], inward[cushion], cushion) for a, b, cushion in between]
        self.strips = [*noses, *(jaw.facing for jaw in all_jaws)]
        self.horns = [jaw.horn for jaw in all_jaws]
        self.holes = holes(world)
        self.jaws = all_jaws
        self.air = Air(world, self)

    def meets(self, ball: Ball, time: mpf) -> Iterator[Event]:
        """Each piece's first contact with the ball from ``time`` on."""
        if ball.motion is Motion.FLYING:
            yield from self.air.meets(ball, time)
        if ball.motion not in (Motion.SLIDING, Motion.ROLLING):
            return
        way, span = path(self.world, ball, time), moving_until(self.world, ball) - time
        for strip in self.strips:
            t = self.strip_contact(strip, way, span)
            if t is not None:
                yield Event(time + t, kind_at(strip.number), ball.number, number_at(strip.number))
        for horn in self.horns:
            t = self.circle_contact(horn.centre, horn.radius + self.world.rho, way, span, touchable=True)
            if t is not None:
                yield Event(time + t, kind_at(horn.number), ball.number, number_at(horn.number))
        for hole in self.holes:
            t = self.circle_contact(hole.centre, hole.radius, way, span, touchable=False)
            if t is not None:
                yield Event(time + t, "pocket_collision", ball.number, hole.pocket)

    def strip_contact(self, strip: Strip, way: tuple[mpc, mpc, mpc], span: mpf) -> mpf | None:
        c, b, a = way
        p = [strip.gap(c) - self.world.rho, dot(strip.inward, b), dot(strip.inward, a)]
        touch = abs(p[0]) <= self.world.touch
        if (
            not touch
            and p[0] > 0
            and stays_clear([float(p[0]), float(p[0] + p[1] * span / 2), float(p[0] + p[1] * span + p[2] * span**2)])
        ):
            return None
        t = first_fall(deflated(p, p[1], self.world) if touch else p, span)
        return t if t is not None and strip.is_beside(c + b * t + a * t * t) else None

    def circle_contact(
        self, centre: mpc, reach: mpf, way: tuple[mpc, mpc, mpc], span: mpf, *, touchable: bool
    ) -> mpf | None:
        c, b, a = way[0] - centre, way[1], way[2]
        touch = touchable and abs(c) - reach <= self.world.touch
        if not touch and not may_reach(c, b, a, float(span), float(reach)):
            return None
        quartic = [dot(c, c) - reach**2, 2 * dot(b, c), dot(b, b) + 2 * dot(a, c), 2 * dot(a, b), dot(a, a)]
        if touch:
            quartic = deflated(quartic, dot(b, c) / abs(c), self.world)
        return first_fall(quartic, span)

    def touched(self, ball: Ball) -> Iterator[Wall | Edge]:
        """The piece within ``touch`` of the ball's centre: at most one."""
        if ball.motion is Motion.FLYING:
            yield from self.air.touched(ball)
            return
        place, near = ball.position, self.world.rho + self.world.touch
        for strip in self.strips:
            if strip.is_beside(place) and abs(strip.gap(place)) <= near:
                yield Wall(strip.inward, strip.number, mp.inf)
                return
        for horn in self.horns:
            from_horn = place - horn.centre
            if abs(from_horn) <= horn.radius + near:
                yield Wall(unit(from_horn), horn.number, horn.radius + self.world.rho)
                return


def kind_at(number: int) -> str:
    return "rail_collision" if number < 4 else "jaw_collision"


def number_at(number: int) -> int:
    return number if number < 4 else number - 4
