"""When things happen on a path: events, paths, and the float filter that discards what stays clear by a wide margin.

Bernstein coefficients bound a polynomial from below; everything the filter leaves is decided in full precision.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from mpmath import mp, mpc, mpf
from support.truth.model import MOVING, Ball, World
from support.truth.motion import acceleration, lifetime

CLEAR = 1e-7
"""Margin of the float filter (m for lines, m^2 for squared distances): a million times its rounding."""

ORDER = ("ball_collision", "rail_collision", "jaw_collision", "pocket_collision", "rail_top", "off_table", "transition")


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


def may_reach(c: mpc, b: mpc, a: mpc, span: float, reach: float) -> bool:
    """Float filter: can |c + b t + a t^2| come near ``reach`` within the span?"""
    p0 = complex(c)
    p1, p2 = p0 + complex(b) * span / 2, p0 + complex(b) * span + complex(a) * span**2
    gap = reach**2
    d01, d12 = (p0 * p1.conjugate()).real, (p1 * p2.conjugate()).real
    middle = ((p0 * p2.conjugate()).real + 2 * abs(p1) ** 2) / 3
    return not stays_clear([x - gap for x in (abs(p0) ** 2, d01, middle, d12, abs(p2) ** 2)])


def deflated(p: list[mpf], opening: mpf, world: World) -> list[mpf]:
    """A touch at time 0 taken out: a single root if the bodies part, a double root if they rest on each other."""
    return p[2:] if abs(opening) <= world.v_creep else p[1:]
