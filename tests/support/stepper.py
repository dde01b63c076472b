"""Balls in small time steps: no events, no roots, no closed forms. It converges to the truth at first order.

Each step moves every ball by its present velocity, then looks for bodies that overlap and approach, and gives them the
impact law. Laws and geometry are written anew here, in plain floats; nothing of the kernels is used.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from physics import RealTable

Vector = tuple[float, float, float]
G = 9.81


@dataclass
class Body:
    """A ball: centre m with the height above rest, velocity m/s, spin rad/s."""

    place: Vector
    velocity: Vector
    spin: Vector = (0.0, 0.0, 0.0)
    pressed: float = field(default=-math.inf)

    @property
    def in_air(self) -> bool:
        return self.place[2] > 0.0 or self.velocity[2] != 0.0


def plus(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def size(a: Vector) -> float:
    return math.sqrt(dot(a, a))


class Stepper:
    """Some bodies on a table that flies."""

    def __init__(self, table: RealTable, bodies: list[Body]) -> None:
        self.table, self.bodies, self.time = table, bodies, 0.0
        self.radius, self.above = table.ball_radius, table.nose_height - table.ball_radius

    def run(self, until: float, dt: float) -> None:
        while self.time < until - 1e-12:
            self.step(min(dt, until - self.time))

    def step(self, dt: float) -> None:
        self.time += dt
        for body in self.bodies:
            self.move(body, dt)
        for k, one in enumerate(self.bodies):
            for two in self.bodies[k + 1 :]:
                self.meet_ball(one, two)
        for body in self.bodies:
            for edge in self.edges(body):
                self.meet_edge(body, edge)
            self.meet_cloth(body)

    def move(self, body: Body, dt: float) -> None:
        body.place = plus(body.place, body.velocity, dt)
        if body.in_air:
            body.velocity = plus(body.velocity, (0.0, 0.0, -G), dt)
            return
        vx, vy, _ = body.velocity
        wx, wy, wz = body.spin
        ux, uy = vx - self.radius * wy, vy + self.radius * wx
        slip, pull = math.hypot(ux, uy), self.table.mu_slide * G
        if slip > 3.5 * pull * dt:
            ax, ay = -pull * ux / slip, -pull * uy / slip
            turn = 2.5 / self.radius
            body.spin = wx + turn * ay * dt, wy - turn * ax * dt, wz
            body.velocity = vx + ax * dt, vy + ay * dt, 0.0
            return
        speed = math.hypot(vx, vy)
        left = max(0.0, speed - self.table.mu_roll * G * dt) / speed if speed > 0.0 else 0.0
        body.velocity = vx * left, vy * left, 0.0
        body.spin = -body.velocity[1] / self.radius, body.velocity[0] / self.radius, wz

    def impact(self, body: Body, normal: Vector, e: float, mu: float) -> None:
        """The law of a fixed body."""
        closing = dot(body.velocity, normal)
        push = -(1.0 + e) * closing
        slip = plus(plus(body.velocity, normal, -closing), cross(body.spin, normal), -self.radius)
        body.velocity = plus(body.velocity, normal, push)
        if size(slip) > 0.0:
            rub = min(mu * push, 2.0 * size(slip) / 7.0) / size(slip)
            body.velocity = plus(body.velocity, slip, -rub)
            body.spin = plus(body.spin, cross(normal, slip), 2.5 * rub / self.radius)

    def meet_cloth(self, body: Body) -> None:
        x, y, z = body.place
        if z > 0.0 or (z == 0.0 and body.velocity[2] >= 0.0):
            return
        body.place = (x, y, 0.0)
        vx, vy, vz = body.velocity
        if vz >= 0.0:
            return
        if self.time < body.pressed:
            body.velocity = (vx, vy, 0.0)
            return
        bounces = -self.table.e_cloth * vz >= 0.05
        self.impact(body, (0.0, 0.0, 1.0), self.table.e_cloth if bounces else 0.0, self.table.mu_slide)
        if not bounces:
            body.velocity = body.velocity[0], body.velocity[1], 0.0

    def edges(self, body: Body) -> Iterator[tuple[Vector, float]]:
        """(vector from the nearest point of an edge to the centre, its length) of the cushions near by."""
        x, y, z = body.place
        zeta = z - self.above
        half_x, half_y = 0.5 * self.table.width, 0.5 * self.table.length
        u, v = half_x - abs(x - half_x), half_y - abs(y - half_y)
        if min(u, v) > self.radius:
            return
        corner, side = self.table.corner_shape, self.table.side_shape
        east, north = math.copysign(1.0, x - half_x), math.copysign(1.0, y - half_y)
        if v >= corner.nose_end and abs(y - half_y) >= side.nose_end and u >= 0.0:
            yield (-east * u, 0.0, zeta), math.hypot(u, zeta)
        if u >= corner.nose_end and v >= 0.0:
            yield (0.0, -north * v, zeta), math.hypot(v, zeta)
        for pocket in self.table.pockets:
            for jaw in pocket.jaws:
                yield from self.jaw_edges(jaw, x, y, zeta)

    def jaw_edges(self, jaw: object, x: float, y: float, zeta: float) -> Iterator[tuple[Vector, float]]:
        (hx, hy), r = jaw.horn_centre, self.table.horn_radius  # type: ignore[attr-defined]
        (sx, sy), (ex, ey) = jaw.facing_start, jaw.facing_end  # type: ignore[attr-defined]
        nx, ny = jaw.facing_normal  # type: ignore[attr-defined]
        far = math.hypot(x - hx, y - hy)
        if r <= far <= r + self.radius:
            out = far - r
            yield ((x - hx) / far * out, (y - hy) / far * out, zeta), math.hypot(out, zeta)
        length = math.hypot(ex - sx, ey - sy)
        along = ((x - sx) * (ex - sx) + (y - sy) * (ey - sy)) / length
        gap = (x - sx) * nx + (y - sy) * ny
        if 0.0 <= along <= length and 0.0 <= gap <= self.radius:
            yield (gap * nx, gap * ny, zeta), math.hypot(gap, zeta)

    def meet_edge(self, body: Body, edge: tuple[Vector, float]) -> None:
        way, distance = edge
        if distance >= self.radius or distance == 0.0:
            return
        normal = (way[0] / distance, way[1] / distance, way[2] / distance)
        if dot(body.velocity, normal) >= 0.0:
            return
        on_cloth = not body.in_air
        self.impact(body, normal, self.table.e_cushion, self.table.mu_cushion)
        if on_cloth:
            body.velocity = (body.velocity[0], body.velocity[1], 0.0)
        elif normal[2] < 0.0 and body.velocity[2] < 0.0:
            body.pressed = self.time + 5e-3

    def meet_ball(self, one: Body, two: Body) -> None:
        way = plus(two.place, one.place, -1.0)
        distance = size(way)
        if distance >= 2.0 * self.radius:
            return
        n = (way[0] / distance, way[1] / distance, way[2] / distance)
        closing = dot(plus(one.velocity, two.velocity, -1.0), n)
        if closing <= 0.0:
            return
        in_air = one.place[2] > 0.0 or two.place[2] > 0.0
        push = 0.5 * (1.0 + self.table.e_ball) * closing
        spins = plus(one.spin, two.spin)
        slip = plus(plus(one.velocity, two.velocity, -1.0), n, -closing)
        slip = plus(slip, cross(n, spins), -self.radius)
        mu = 9.951e-3 + 0.108 * math.exp(-1.088 * size(slip))
        rub = min(mu * push, size(slip) / 7.0) / size(slip) if size(slip) > 0.0 else 0.0
        turn = cross(n, slip)
        for body, sign in ((one, -1.0), (two, 1.0)):
            body.velocity = plus(plus(body.velocity, n, sign * push), slip, sign * rub)
            if not in_air or (body.place[2] == 0.0 and 0.0 < body.velocity[2] <= 0.05):
                body.velocity = (body.velocity[0], body.velocity[1], 0.0)
            body.spin = plus(body.spin, turn, -2.5 * rub / self.radius)
