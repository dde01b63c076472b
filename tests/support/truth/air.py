"""A flying ball and a table with jaws, at any precision: every nose, horn, facing, hole, the rails; no broad phase.

A contact with an edge is the ball's centre coming within R of it (FLIGHT, 2.6-2.8, 2.10). Polynomials: of degree 4 at a
straight edge, of degree 8 at a horn.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mpmath import mp, mpc, mpf
from support.truth.flight import impact, rise_path
from support.truth.model import Ball, RealWorld, dot, unit
from support.truth.moments import Event, moving_until, path
from support.truth.octagon import EAST, NORTH, SOUTH, WEST
from support.truth.roots import Polynomial, falls, first_fall
from support.truth.space import Space, inner, push, spin, velocity

FAR = 1e-6
"""m. Of a piece that a flight does not come so near to, no root is looked for."""


@dataclass(frozen=True)
class Edge:
    """An edge where a flying ball touches it: ``direction`` from it to the centre; in plan ``inward``, ``gap`` away.

    ``number`` as of a wall; ``far``: of the centre from the middle of a horn, infinite at a straight edge.
    """

    direction: Space
    inward: mpc
    gap: mpf
    far: mpf
    number: int

    @property
    def cushion(self) -> int:
        return self.number


@dataclass(frozen=True)
class Flight:
    """The path of a flying ball: straight in plan, ``zeta`` above the nose, ``height`` above rest."""

    start: mpc
    speed: mpc
    height: tuple[mpf, mpf, mpf]
    zeta: tuple[mpf, mpf, mpf]
    span: mpf

    @classmethod
    def of(cls, world: RealWorld, ball: Ball, time: mpf) -> "Flight":
        start, speed, _ = path(world, ball, time)
        c, b, a = rise_path(world, ball, time)
        nose = world.nose_height - world.radius
        return cls(start, speed, (c, b, a), (c - nose, b, a), moving_until(world, ball) - time)

    def place(self, t: mpf) -> mpc:
        return self.start + t * self.speed

    def comes_near(self, point: mpc, reach: float) -> bool:
        """Whether the straight path in plan comes within ``reach`` of a point."""
        way, speed = complex(point - self.start), complex(self.speed)
        length = abs(speed) ** 2
        t = min(max((way * speed.conjugate()).real / length, 0.0), float(self.span)) if length > 0.0 else 0.0
        return abs(way - t * speed) <= reach + FAR


def times(p: Polynomial, q: Polynomial) -> list[mpf]:
    total = [mpf(0)] * (len(p) + len(q) - 1)
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            total[i + j] += x * y
    return total


def less(p: Polynomial, number: mpf) -> list[mpf]:
    return [p[0] - number, *p[1:]]


def both(p: Polynomial, q: Polynomial) -> list[mpf]:
    n = max(len(p), len(q))
    return [(p[k] if k < len(p) else mpf(0)) + (q[k] if k < len(q) else mpf(0)) for k in range(n)]


def at(p: Polynomial, t: mpf) -> mpf:
    total = mpf(0)
    for coefficient in reversed(p):
        total = total * t + coefficient
    return total


def without_touch(world: RealWorld, p: list[mpf], start_gap: mpf, opening: mpf) -> list[mpf]:
    """A touch at time 0 taken out of a polynomial, as ``moments.deflated`` does."""
    if start_gap > world.touch:
        return p
    return p[2:] if abs(opening) <= world.v_creep else p[1:]


def strip_contact(world: RealWorld, strip: Any, flight: Flight) -> mpf | None:
    """The first fall within R of a straight edge, beside it and not behind."""
    gap = [strip.gap(flight.start), dot(strip.inward, flight.speed)]
    squared = both(times(gap, gap), times(flight.zeta, flight.zeta))
    distance = mp.sqrt(squared[0])
    beside = strip.is_beside(flight.start) and gap[0] >= 0
    start_gap = distance - world.radius if beside else mp.inf
    p = less(squared, world.radius**2)
    if start_gap <= world.touch:
        p = without_touch(world, p, start_gap, squared[1] / (2 * distance))
    for t in falls(p, flight.span):
        if at(gap, t) >= 0 and strip.is_beside(flight.place(t)):
            return t
    return None


def ring_contact(world: RealWorld, horn: Any, flight: Flight) -> mpf | None:
    """The first fall of (q - r)^2 + zeta^2 through R^2 outside the horn's disc.

    With A = q^2 + r^2 + zeta^2 - R^2 that is where A^2 - 4 r^2 q^2 falls, and A >= 0.
    """
    if not flight.comes_near(horn.centre, float(horn.radius + world.radius)):
        return None
    c, b = flight.start - horn.centre, flight.speed
    q2 = [dot(c, c), 2 * dot(b, c), dot(b, b)]
    a = less(both(q2, times(flight.zeta, flight.zeta)), world.radius**2 - horn.radius**2)
    p = both(times(a, a), [-4 * horn.radius**2 * x for x in q2])
    q = abs(c)
    if q >= horn.radius:
        out = q - horn.radius
        distance = mp.sqrt(out**2 + flight.zeta[0] ** 2)
        opening = (out * dot(c, b) / q + flight.zeta[0] * flight.zeta[1]) / distance
        p = without_touch(world, p, distance - world.radius, opening)
    for t in falls(p, flight.span):
        if at(a, t) >= 0 and at(q2, t) >= horn.radius**2:
            return t
    return None


class Air:
    """What a flying ball may meet besides balls and cloth."""

    def __init__(self, world: RealWorld, rails: Any) -> None:
        self.world = world
        self.rails = rails

    def meets(self, ball: Ball, time: mpf) -> Iterator[Event]:
        """Each piece's first contact from ``time`` on."""
        flight = Flight.of(self.world, ball, time)
        for strip in self.rails.strips:
            t = strip_contact(self.world, strip, flight)
            if t is not None:
                yield self.event(time + t, ball, strip.number)
        for horn in self.rails.horns:
            t = ring_contact(self.world, horn, flight)
            if t is not None:
                yield self.event(time + t, ball, horn.number)
        for hole in self.rails.holes:
            t = self.liner(hole, flight)
            if t is not None:
                yield Event(time + t, "pocket_collision", ball.number, hole.pocket)
        t = first_fall(less(flight.zeta, self.world.radius), flight.span)
        if t is not None and self.is_over_rail(flight.place(t)):
            yield Event(time + t, "rail_top", ball.number, self.rail_at(flight.place(t)))
        t = self.outer_edge(flight)
        if t is not None:
            yield Event(time + t, "off_table", ball.number)

    @staticmethod
    def event(time: mpf, ball: Ball, number: int) -> Event:
        if number < 4:
            return Event(time, "rail_collision", ball.number, number)
        return Event(time, "jaw_collision", ball.number, number - 4)

    def liner(self, hole: Any, flight: Flight) -> mpf | None:
        """When the ball leaves the hole's circle, not back to the shelf, and no higher than the rail's cap."""
        if not flight.comes_near(hole.centre, float(hole.radius)):
            return None
        c, b = flight.start - hole.centre, flight.speed
        inside = [hole.radius**2 - dot(c, c), -2 * dot(b, c), -dot(b, b)]
        for t in falls(inside, flight.span):
            place = flight.place(t)
            facings = [s for s in self.rails.strips[6:] if (s.number - 4) // 2 == hole.pocket]
            out = self.outward(hole.pocket)
            on_shelf = all(s.gap(place) > 0 for s in facings) and dot(place - hole.centre, out) < 0
            if not on_shelf and at(flight.height, t) < self.world.rail_cap:
                return t
        return None

    def outward(self, pocket: int) -> mpc:
        middle = mpc(self.world.width, self.world.length) / 2
        centre = next(h.centre for h in self.rails.holes if h.pocket == pocket)
        way = centre - middle
        return mpc(mp.sign(way.real), 0 if pocket in (1, 4) else mp.sign(way.imag))

    def outer_edge(self, flight: Flight) -> mpf | None:
        w = self.world
        lines = [
            [flight.start.real + w.rail_width, flight.speed.real],
            [w.width + w.rail_width - flight.start.real, -flight.speed.real],
            [flight.start.imag + w.rail_width, flight.speed.imag],
            [w.length + w.rail_width - flight.start.imag, -flight.speed.imag],
        ]
        found = [t for t in (first_fall(p, flight.span) for p in lines) if t is not None]
        return min(found, default=None)

    def over_hole(self, place: mpc) -> int | None:
        return next((h.pocket for h in self.rails.holes if abs(place - h.centre) < h.radius), None)

    def rail_at(self, place: mpc) -> int:
        """The rail a place is farther beyond."""
        x, y = place.real - self.world.width / 2, place.imag - self.world.length / 2
        if abs(x) - self.world.width / 2 >= abs(y) - self.world.length / 2:
            return EAST if x > 0 else WEST
        return NORTH if y > 0 else SOUTH

    def is_over_rail(self, place: mpc) -> bool:
        w = self.world
        u = w.width / 2 - abs(place.real - w.width / 2)
        v = w.length / 2 - abs(place.imag - w.length / 2)
        if u > 0 and v > 0:
            return False
        if u < -w.cushion_width or v < -w.cushion_width:
            return self.over_hole(place) is None
        noses = self.rails.strips[:6]
        if any(s.is_beside(place) and s.gap(place) <= 0 and s.gap(place) >= -w.cushion_width for s in noses):
            return True
        return any(self.is_over_jaw(jaw, place) for jaw in self.rails.jaws)

    def is_over_jaw(self, jaw: Any, place: mpc) -> bool:
        """Behind nose line and facing line, on the mouth's side of the nose's end, not in what the horn rounds off."""
        nose, facing, horn = jaw.nose, jaw.facing, jaw.horn
        if not -self.world.cushion_width <= nose.gap(place) <= 0 or facing.gap(place) > 0:
            return False
        along_nose = dot(place - jaw.nose_end, jaw.away)
        if along_nose >= 0 or abs(place - jaw.nose_end) > mpf("0.2"):
            return False
        before_facing = dot(place - facing.start, unit(facing.end - facing.start)) < 0
        return not (before_facing and abs(place - horn.centre) > horn.radius)

    def touched(self, ball: Ball) -> Iterator[Edge]:
        """The edge within ``touch`` of R: at most one."""
        zeta, near = ball.height - (self.world.nose_height - self.world.radius), self.world.radius + self.world.touch
        for strip in self.rails.strips:
            gap = strip.gap(ball.position)
            if gap >= 0 and strip.is_beside(ball.position) and mp.sqrt(gap**2 + zeta**2) <= near:
                yield edge(strip.inward, gap, zeta, mp.inf, strip.number)
                return
        for horn in self.rails.horns:
            way = ball.position - horn.centre
            gap = abs(way) - horn.radius
            if gap >= 0 and mp.sqrt(gap**2 + zeta**2) <= near:
                yield edge(unit(way), gap, zeta, abs(way), horn.number)
                return


def edge(inward: mpc, gap: mpf, zeta: mpf, far: mpf, number: int) -> Edge:
    distance = mp.sqrt(gap**2 + zeta**2)
    return Edge((inward * gap / distance, zeta / distance), inward, gap, far, number)


def rebound(world: RealWorld, ball: Ball, one: Edge, time: mpf) -> None:
    """The impact law; a nose over the ball's middle presses it down for a while."""
    v, w = impact(world, velocity(ball), spin(ball), one.direction, world.e_cushion, world.mu_cushion)
    (ball.velocity, ball.rise), (ball.w_xy, ball.w_z) = v, w
    if one.direction[1] < 0 and ball.rise < 0:
        ball.pressed = time + world.press_time


def half_towards(world: RealWorld, ball: Ball, one: Edge) -> mpf:
    """Half the acceleration at which gravity, less what the arc takes, brings a ball back to an edge."""
    opening = inner(velocity(ball), one.direction)
    across = dot(ball.velocity, one.inward)
    along = dot(ball.velocity, 1j * one.inward)
    curved = across**2 + ball.rise**2 - opening**2 + one.gap * along**2 / one.far
    return -(curved / world.radius - world.gravity * one.direction[1]) / 2


def part_from(world: RealWorld, ball: Ball, one: Edge, share: mpf) -> None:
    half = max(half_towards(world, ball, one), mpf(0))
    wanted = max(share * half * world.rest_time, 2 * world.v_creep)
    push(ball, one.direction, wanted - inner(velocity(ball), one.direction))


def stop_at(ball: Ball, one: Edge) -> None:
    push(ball, one.direction, -inner(velocity(ball), one.direction))
