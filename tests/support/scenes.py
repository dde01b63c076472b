"""Scenes and strokes for property tests: scattered, touching, frozen and collinear balls, and how often each came."""

import math
from collections import Counter
from dataclasses import dataclass, field

from hypothesis import strategies as st

WIDTH, LENGTH, RADIUS = 1.116, 2.236, 0.028575
CORNER = 0.11 / math.sqrt(2)
SIDE = 0.06

TALLY: Counter[str] = Counter()
"""How many scenes of each kind the properties have drawn in this run."""

Position = tuple[float, float]


@dataclass(frozen=True)
class Scene:
    """Balls at rest, ball 0 first, and a stroke (v, phi, theta, a, b)."""

    kind: str
    positions: dict[int, Position]
    stroke: tuple[float, float, float, float, float]
    touching: bool = field(default=False)


def placeable(x: float, y: float) -> bool:
    """On the table, clear of the mouths by a hair."""
    inside = RADIUS <= x <= WIDTH - RADIUS and RADIUS <= y <= LENGTH - RADIUS
    side, end = abs(x - WIDTH / 2), abs(y - LENGTH / 2)
    corner = side + end > WIDTH / 2 + LENGTH / 2 - CORNER - RADIUS - 1e-6
    mouth = side > WIDTH / 2 - RADIUS - 1e-6 and end < SIDE + 1e-6
    return inside and not corner and not mouth


def clear(positions: list[Position], x: float, y: float) -> bool:
    """Not overlapping by more than rounding."""
    return all((x - p) ** 2 + (y - q) ** 2 >= (2 * RADIUS - 1e-15) ** 2 for p, q in positions)


def pack(wanted: list[Position]) -> dict[int, Position]:
    """The balls that fit, numbered in order."""
    kept: list[Position] = []
    for x, y in wanted:
        if placeable(x, y) and clear(kept, x, y) and len(kept) < 16:
            kept.append((x, y))
    return dict(enumerate(kept))


def beside(parent: Position, degrees: float, gap: float = 0.0) -> Position:
    angle = math.radians(degrees)
    reach = 2 * RADIUS + gap
    return parent[0] + reach * math.cos(angle), parent[1] + reach * math.sin(angle)


fractions = st.floats(0.0, 1.0)
anywhere = st.builds(
    lambda p, q: (RADIUS + p * (WIDTH - 2 * RADIUS), RADIUS + q * (LENGTH - 2 * RADIUS)), fractions, fractions
)
inner = st.builds(lambda p, q: (0.2 + p * 0.7, 0.2 + q * 1.8), fractions, fractions)
compass = st.sampled_from([0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0])
turns = st.one_of(compass, st.sampled_from([30.0, 60.0, 120.0, 150.0, 210.0, 240.0, 300.0, 330.0]), st.floats(0, 360))


@st.composite
def scattered(draw: st.DrawFn) -> list[Position]:
    return (
        [(0.5, 1.2), *draw(st.lists(anywhere, max_size=15))]
        if draw(st.booleans())
        else draw(st.lists(inner, min_size=1, max_size=16))
    )


@st.composite
def touching(draw: st.DrawFn) -> list[Position]:
    """Trees of touching balls; the cue ball in one of them or apart."""
    balls = [draw(inner)]
    for _ in range(draw(st.integers(1, 7))):
        parent = balls[draw(st.integers(0, len(balls) - 1))]
        balls.append(beside(parent, draw(turns)))
    return balls if draw(st.booleans()) else [draw(inner), *balls]


@st.composite
def frozen(draw: st.DrawFn) -> list[Position]:
    """Balls on cushions, some in pairs; the cue ball one of them or apart."""
    balls = [] if draw(st.booleans()) else [draw(inner)]
    for _ in range(draw(st.integers(1, 6))):
        p = draw(st.floats(0.1, 0.9))
        x, y = RADIUS + p * (WIDTH - 2 * RADIUS), RADIUS + p * (LENGTH - 2 * RADIUS)
        balls.append(draw(st.sampled_from([(RADIUS, y), (WIDTH - RADIUS, y), (x, RADIUS), (x, LENGTH - RADIUS)])))
        if draw(st.booleans()):
            balls.append(beside(balls[-1], draw(compass)))
    return balls


@st.composite
def collinear(draw: st.DrawFn) -> list[Position]:
    """A straight line of balls, touching or apart."""
    balls, heading = [draw(inner)], draw(compass)
    for _ in range(draw(st.integers(1, 5))):
        balls.append(beside(balls[-1], heading, draw(st.sampled_from([0.0, 0.0, 1e-10, 1e-6, 0.01, 0.1]))))
    return balls


BUILDERS = {"scattered": scattered, "touching": touching, "frozen": frozen, "collinear": collinear}


@st.composite
def strokes(draw: st.DrawFn, positions: dict[int, Position]) -> tuple[float, float, float, float, float]:
    """Speeds from creeping to full; aimed at a ball, along a compass direction, or anywhere."""
    v = draw(st.one_of(st.sampled_from([10.0, 0.001]), st.floats(0.01, 10.0)))
    if len(positions) > 1 and draw(st.booleans()):
        x, y = positions[draw(st.integers(1, len(positions) - 1))]
        phi = math.degrees(math.atan2(y - positions[0][1], x - positions[0][0])) + draw(st.floats(-8.0, 8.0))
    else:
        phi = draw(turns)
    theta = draw(st.one_of(st.sampled_from([0.0, 70.0]), st.floats(0.0, 70.0)))
    a = draw(st.one_of(st.just(0.0), st.floats(-14.0, 14.0)))
    b = draw(st.one_of(st.just(0.0), st.floats(-14.0, 14.0)))
    return v, phi, theta, a, b


@st.composite
def scenes(draw: st.DrawFn, kinds: tuple[str, ...] = tuple(BUILDERS)) -> Scene:
    """Any kind of scene with the same chance, so that most are special; counted in ``TALLY``."""
    kind = draw(st.sampled_from(kinds))
    positions = pack(draw(BUILDERS[kind]()))
    if not positions:
        positions = {0: (0.5, 1.0)}
    stroke = draw(strokes(positions))
    TALLY[kind] += 1
    return Scene(kind, positions, stroke, has_touch(positions))


def has_touch(positions: dict[int, Position]) -> bool:
    """Do any two balls touch, or nearly so?"""
    places = list(positions.values())
    return any(math.dist(p, q) < 2 * RADIUS + 1e-11 for i, p in enumerate(places) for q in places[i + 1 :])
