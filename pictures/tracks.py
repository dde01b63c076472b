"""Where each ball goes during a shot, as curves that a picture can draw exactly.

Between two events a ball has a constant acceleration in plan, none in the air, so its path is a parabola: the quadratic
Bezier curve from start to end whose control point lies half the time along the first velocity.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from physics import BallState, EventKind, Motion, Result
from physics.constants import N_BALLS
from pictures.elements import Point


@dataclass(frozen=True, slots=True)
class Piece:
    """One ball between two events; times in s, places in m. ``start``, ``control``, ``end``: of the Bezier curve."""

    begins: float
    ends: float
    start: Point
    control: Point
    end: Point

    def at(self, time: float) -> Point:
        """The place at a time, m; before it begins its start, after it ends its end."""
        span = self.ends - self.begins
        part = min(1.0, max(0.0, (time - self.begins) / span)) if span > 0.0 else 0.0
        rest = 1.0 - part
        first, second, third = rest * rest, 2.0 * rest * part, part * part
        x, y = (first * a + second * b + third * c for a, b, c in zip(self.start, self.control, self.end, strict=True))
        return x, y


@dataclass(frozen=True, slots=True)
class Track:
    """What one ball does.

    Attributes:
        ball: its number.
        pieces: of its path, in order, at least one; between them it rests.
        pocketed: the time at which it drops, s, or None. left: at which it leaves the table otherwise.
    """

    ball: int
    pieces: tuple[Piece, ...]
    pocketed: float | None
    left: float | None = None

    @property
    def start(self) -> Point:
        """Where it is at first, m."""
        return self.pieces[0].start

    @property
    def end(self) -> Point:
        """Where it is last seen, m."""
        return self.pieces[-1].end

    @property
    def stays(self) -> bool:
        """Whether it is on the table at the end."""
        return self.pocketed is None and self.left is None

    @property
    def moves(self) -> bool:
        """Whether it ever does."""
        return self.pieces[0].ends > 0.0

    def at(self, time: float) -> Point:
        """Where it is at a time, m."""
        piece = next((piece for piece in reversed(self.pieces) if piece.begins <= time), self.pieces[0])
        return piece.at(time)


@dataclass(frozen=True, slots=True)
class _Knot:
    """A ball at an event of its own."""

    time: float
    place: Point
    velocity: Point
    moves: bool

    @classmethod
    def of(cls, time: float, state: BallState) -> "_Knot":
        return cls(time, state.position, state.velocity, state.motion in MOVING)


MOVING = (Motion.SLIDING, Motion.ROLLING, Motion.FLYING)
"""Motion states in which a ball changes its place."""


def tracks(result: Result) -> tuple[Track, ...]:
    """Of every ball that was on the table, by number.

    Raises:
        ValueError: the shot was simulated with ``trace=False``.
    """
    start = result.start
    knots = {
        ball: [_Knot(0.0, _point(start.positions[ball]), _point(start.velocities[ball]), start.motion[ball] in MOVING)]
        for ball in range(N_BALLS)
        if not np.isnan(start.positions[ball, 0])
    }
    dropped: dict[int, float] = {}
    left: dict[int, float] = {}
    for event in result.events:
        for state in event.states:
            knots[state.ball].append(_Knot.of(event.time, state))
        if event.kind is EventKind.POCKET_COLLISION:
            dropped[event.ball] = event.time
        elif event.kind is EventKind.OFF_TABLE:
            left[event.ball] = event.time
    for ball in knots:
        final = result.final.position(ball)
        if final is not None:  # the end of a shot is an event of no ball
            knots[ball].append(_Knot(result.duration, final, (0.0, 0.0), moves=False))
    return tuple(Track(ball, _pieces(knots[ball]), dropped.get(ball), left.get(ball)) for ball in knots)


def _point(row: NDArray[np.float64]) -> Point:
    x, y = row.tolist()
    return x, y


def _pieces(knots: list[_Knot]) -> tuple[Piece, ...]:
    """From knot to knot; a ball that rests all the time has one piece of no length."""
    pieces = []
    for here, there in pairwise(knots):
        half = 0.5 * (there.time - here.time)
        if here.moves and half > 0.0:
            control = here.place[0] + half * here.velocity[0], here.place[1] + half * here.velocity[1]
            pieces.append(Piece(here.time, there.time, here.place, control, there.place))
    first = knots[0]
    return tuple(pieces) or (Piece(0.0, 0.0, first.place, first.place, first.place),)
