"""When the next thing happens to a ball or a pair: transitions, cushions and mouths, ball-ball contacts.

A float filter discards what stays clear by a wide margin (Bernstein coefficients bound a polynomial from below);
everything else is decided in full precision.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from mpmath import mp, mpc, mpf
from support.truth.model import MOVING, Ball, Motion, World, dot
from support.truth.motion import acceleration, lifetime
from support.truth.octagon import Line, in_side_mouth
from support.truth.roots import first_fall

CLEAR = 1e-7
"""Margin of the float filter (m for lines, m^2 for squared distances): a million times its rounding."""

STILL = 1e-30
"""m/s, m/s^2; a ball that runs along a cushion has no velocity and no acceleration across it but rounding."""

ORDER = ("ball_collision", "rail_collision", "pocket_collision", "transition")


@dataclass(frozen=True)
class Event:
    """Something predicted or recorded; ``other`` is a ball, cushion or pocket number, -1 if none."""

    time: mpf
    kind: str
    ball: int
    other: int = -1

    def key(self) -> tuple[mpf, int, int, int]:
        return self.time, ORDER.index(self.kind), self.ball, self.other


def path(world: World, ball: Ball, time: mpf) -> tuple[mpc, mpc, mpc]:
    """Position from ``time`` on as c + b t + a t^2."""
    if ball.motion not in MOVING:
        return ball.position, mpc(0), mpc(0)
    a, t = acceleration(world, ball), time - ball.since
    return ball.position + ball.velocity * t + a * t * t / 2, ball.velocity + a * t, a / 2


def moving_until(world: World, ball: Ball) -> mpf:
    return ball.since + lifetime(world, ball) if ball.motion in MOVING else mp.inf


def stays_clear(points: Sequence[float], depth: int = 6) -> bool:
    """Proof that a polynomial with these Bernstein coefficients stays above ``CLEAR``."""
    if min(points) > CLEAR:
        return True
    if depth == 0 or min(points[0], points[-1]) <= CLEAR:
        return False
    left, right, row = [], [], list(points)
    while row:
        left.append(row[0])
        right.append(row[-1])
        row = [(p + q) / 2 for p, q in pairwise(row)]
    return stays_clear(left, depth - 1) and stays_clear(right[::-1], depth - 1)


def may_touch(world: World, c: mpc, b: mpc, a: mpc, span: float) -> bool:
    """Float filter for a pair: can |c + b t + a t^2| come near 2R within the span?"""
    p0 = complex(c)
    p1, p2 = p0 + complex(b) * span / 2, p0 + complex(b) * span + complex(a) * span**2
    gap = 4 * float(world.radius) ** 2
    d01, d12 = (p0 * p1.conjugate()).real, (p1 * p2.conjugate()).real
    middle = ((p0 * p2.conjugate()).real + 2 * abs(p1) ** 2) / 3
    return not stays_clear([x - gap for x in (abs(p0) ** 2, d01, middle, d12, abs(p2) ** 2)])


def pair_contact(world: World, one: Ball, two: Ball, time: mpf) -> Event | None:
    """The earliest root of the contact quartic inside both motions, approached from outside."""
    end = min(moving_until(world, one), moving_until(world, two))
    if end == mp.inf or end <= time:
        return None
    p, q = path(world, one, time), path(world, two, time)
    c, b, a = (y - x for x, y in zip(p, q, strict=True))
    touch = abs(c) - 2 * world.radius <= world.touch
    if not touch and not may_touch(world, c, b, a, float(end - time)):
        return None
    quartic = [
        dot(c, c) - 4 * world.radius**2,
        2 * dot(b, c),
        dot(b, b) + 2 * dot(a, c),
        2 * dot(a, b),
        dot(a, a),
    ]
    if touch:
        quartic = deflated(quartic, dot(b, c) / abs(c), world)
    t = first_fall(quartic, end - time)
    return None if t is None else Event(time + t, "ball_collision", *sorted((one.number, two.number)))


def deflated(p: list[mpf], opening: mpf, world: World) -> list[mpf]:
    """A touch at time 0 taken out: a single root if the bodies part, a double root if they rest on each other."""
    return p[2:] if abs(opening) <= world.v_creep else p[1:]


def line_contact(world: World, ball: Ball, line: Line, time: mpf) -> Event | None:
    """When the ball's centre reaches a side of the octagon from inside."""
    if ball.motion not in MOVING:
        return None
    c, b, a = path(world, ball, time)
    span = moving_until(world, ball) - time
    p = [line.height(c), dot(line.inward, b), dot(line.inward, a)]
    touch = abs(p[0]) <= world.touch
    f0, f1, s = float(p[0]), float(p[0] + p[1] * span / 2), float(p[0] + p[1] * span + p[2] * span**2)
    if not touch and stays_clear([f0, f1, s]):
        return None
    t = first_fall(deflated(p, p[1], world) if touch else p, span)
    if t is None:
        rides = touch and line.side_pocket >= 0 and max(abs(p[1]), abs(p[2])) < STILL
        return horn_contact(world, ball, line, time) if rides else None
    pocket = line.side_pocket if in_side_mouth(world, line, c + b * t + a * t * t) else line.pocket
    if pocket >= 0:
        return Event(time + t, "pocket_collision", ball.number, pocket)
    return Event(time + t, "rail_collision", ball.number, line.cushion)


def horn_contact(world: World, ball: Ball, line: Line, time: mpf) -> Event | None:
    """When a ball that runs along a long cushion comes to the side mouth's horn, where the mouth opens under it."""
    c, b, a = path(world, ball, time)
    side = 1 if c.imag > world.length / 2 else -1
    p = [side * (c.imag - world.length / 2) - world.side_mouth / 2, side * b.imag, side * a.imag]
    t = first_fall(p, moving_until(world, ball) - time)
    return None if t is None else Event(time + t, "pocket_collision", ball.number, line.side_pocket)


def own_event(world: World, sides: Sequence[Line], ball: Ball, time: mpf) -> Event | None:
    """The ball's next transition, cushion or pocket."""
    if ball.motion in (Motion.STATIONARY, Motion.POCKETED):
        return None
    end = Event(ball.since + lifetime(world, ball), "transition", ball.number)
    meets = [line_contact(world, ball, line, time) for line in sides]
    return min([end, *(event for event in meets if event)], key=Event.key)
