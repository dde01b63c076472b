"""Mouths with jaws for the arbitrary-precision engine: pieces in jaw coordinates, met by root isolation.

Derived from the table's parameters at full precision where they are given so; or taken as the doubles of a shape, to
judge the kernels' solvers alone.
"""

from dataclasses import dataclass
from typing import Any

from mpmath import mpf
from support.truth.roots import first_fall

Pair = tuple[Any, Any]


@dataclass(frozen=True)
class JawTruth:
    """One jaw in its coordinates (s, d): nose, horn, facing; ``rho``: the contact distance in plan."""

    nose_end: mpf
    horn_radius: mpf
    start: Pair
    normal: Pair
    length: mpf
    rho: mpf

    @classmethod
    def of(cls, shape: Any, rho: float) -> "JawTruth":
        """The jaw of a ``physics.mouths.Mouth``, its doubles taken as exact."""
        start, normal = (tuple(mpf(x) for x in pair) for pair in (shape.facing_start, shape.facing_normal))
        return cls(mpf(shape.nose_end), mpf(shape.horn_radius), start, normal, mpf(shape.facing_length), mpf(rho))


def exact(pair: Pair) -> Pair:
    return mpf(pair[0]), mpf(pair[1])


def dot(a: Pair, b: Pair) -> mpf:
    return a[0] * b[0] + a[1] * b[1]


def horn_polynomial(jaw: JawTruth, place: Pair, velocity: Pair, half: Pair) -> list[mpf]:
    """|p - horn|^2 - (r + rho)^2 along p = place + velocity t + half t^2, ascending."""
    c, b, a = (place[0] - jaw.nose_end, place[1] + jaw.horn_radius), velocity, half
    reach = jaw.horn_radius + jaw.rho
    return [dot(c, c) - reach * reach, 2 * dot(b, c), dot(b, b) + 2 * dot(a, c), 2 * dot(a, b), dot(a, a)]


def facing_polynomial(jaw: JawTruth, place: Pair, velocity: Pair, half: Pair) -> list[mpf]:
    """Gap from the facing's line, less rho."""
    c = place[0] - jaw.start[0], place[1] - jaw.start[1]
    return [dot(c, jaw.normal) - jaw.rho, dot(velocity, jaw.normal), dot(half, jaw.normal)]


def foot(jaw: JawTruth, place: Pair) -> mpf:
    """Place along the facing, from its start into the pocket."""
    c = place[0] - jaw.start[0], place[1] - jaw.start[1]
    return c[1] * jaw.normal[0] - c[0] * jaw.normal[1]


def on_path(place: Pair, velocity: Pair, half: Pair, t: mpf) -> Pair:
    return tuple(p + t * (v + t * h) for p, v, h in zip(place, velocity, half, strict=True))


def first_contact(
    jaw: JawTruth, place: Pair, velocity: Pair, half: Pair, lasts: float
) -> tuple[mpf | None, mpf | None]:
    """First time at which the path meets the horn, and the facing, each by itself; None if it does not."""
    path = exact(place), exact(velocity), exact(half)
    horn = first_fall(horn_polynomial(jaw, *path), mpf(lasts))
    facing = first_fall(facing_polynomial(jaw, *path), mpf(lasts))
    if facing is not None and not 0 <= foot(jaw, on_path(*path, facing)) <= jaw.length:
        facing = None
    return horn, facing
