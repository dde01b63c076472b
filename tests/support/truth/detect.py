"""When the next thing happens to a ball or a pair: transitions, cushions and mouths, ball-ball contacts."""

from collections.abc import Iterator

from mpmath import mp, mpf
from support.truth.flight import rise_path
from support.truth.model import MOVING, OUT_OF_PLAY, Ball, Motion, RealWorld, World, dot
from support.truth.moments import Event, deflated, may_reach, moving_until, path, stays_clear
from support.truth.motion import lifetime
from support.truth.octagon import Line, in_side_mouth, lines, touched_cushions
from support.truth.rails import Rails
from support.truth.roots import first_fall

STILL = 1e-30
"""m/s, m/s^2; a ball that runs along a cushion has no velocity and no acceleration across it but rounding."""


def pair_contact(world: World, one: Ball, two: Ball, time: mpf) -> Event | None:
    """The earliest root of the contact quartic inside both motions, approached from outside."""
    end = min(moving_until(world, one), moving_until(world, two))
    if end == mp.inf or end <= time:
        return None
    p, q = path(world, one, time), path(world, two, time)
    c, b, a = (y - x for x, y in zip(p, q, strict=True))
    zc, zb, za = (y - x for x, y in zip(rise_path(world, one, time), rise_path(world, two, time), strict=True))
    distance = mp.sqrt(dot(c, c) + zc * zc)
    touch = distance - 2 * world.radius <= world.touch
    if not touch and not may_reach(c, b, a, float(end - time), 2 * float(world.radius)):
        return None
    quartic = [
        dot(c, c) + zc * zc - 4 * world.radius**2,
        2 * (dot(b, c) + zb * zc),
        dot(b, b) + zb * zb + 2 * (dot(a, c) + za * zc),
        2 * (dot(a, b) + za * zb),
        dot(a, a) + za * za,
    ]
    if touch:
        quartic = deflated(quartic, (dot(b, c) + zb * zc) / distance, world)
    t = first_fall(quartic, end - time)
    return None if t is None else Event(time + t, "ball_collision", *sorted((one.number, two.number)))


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


class Octagon:
    """The boundary of a table with straight mouths."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.sides = lines(world)

    def meets(self, ball: Ball, time: mpf) -> Iterator[Event]:
        """Each side's first contact with the ball from ``time`` on."""
        for line in self.sides:
            event = line_contact(self.world, ball, line, time)
            if event:
                yield event

    def touched(self, ball: Ball) -> Iterator[Line]:
        """Cushions the ball touches."""
        return touched_cushions(self.world, self.sides, ball)


Boundary = Octagon | Rails


def boundary_of(world: World) -> Boundary:
    return Rails(world) if isinstance(world, RealWorld) else Octagon(world)


def own_event(world: World, boundary: Boundary, ball: Ball, time: mpf) -> Event | None:
    """The ball's next transition, cushion or pocket."""
    if ball.motion in (Motion.STATIONARY, *OUT_OF_PLAY):
        return None
    end = Event(ball.since + lifetime(world, ball), "transition", ball.number)
    return min([end, *boundary.meets(ball, time)], key=Event.key)
