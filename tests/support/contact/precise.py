"""The contact problem at 50 digits: the entry time, and bounds on it, with none of the exact code."""

from collections.abc import Sequence

from mpmath import mp, mpf
from support.contact.cases import DISTANCE
from support.truth.roots import first_fall

DIGITS = 50
SHALLOW = 1e-12
CLOSE = 2e-14
"""m; twice the residual a returned time may have."""

Vector = Sequence[float]


def gap_quartic(c: Vector, b: Vector, a: Vector, distance: mpf) -> list[mpf]:
    (cx, cy), (bx, by), (ax, ay) = ([mpf(float(x)) for x in v] for v in (c, b, a))
    return [
        cx * cx + cy * cy - distance**2,
        2 * (cx * bx + cy * by),
        bx * bx + by * by + 2 * (cx * ax + cy * ay),
        2 * (bx * ax + by * ay),
        ax * ax + ay * ay,
    ]


def fall_through(c: Vector, b: Vector, a: Vector, t_max: float, distance: mpf) -> mpf | None:
    """When |c + b t + a t^2| falls through the distance; 0 for a start inside that does not open."""
    p = gap_quartic(c, b, a, distance)
    if p[0] <= 0 and (p[1] < 0 or (p[1] == 0 and p[2] < 0)):
        return mpf(0)
    return first_fall(p, mpf(float(t_max)))


def entry(c: Vector, b: Vector, a: Vector, t_max: float) -> mpf | None:
    """The contact time at 50 digits, or None."""
    with mp.workdps(DIGITS):
        return fall_through(c, b, a, t_max, mpf(DISTANCE))


def agrees(c: Vector, b: Vector, a: Vector, t_max: float, answer: float) -> bool | None:
    """Is the answer right? None where the contact, or its absence, is shallower than SHALLOW."""
    with mp.workdps(DIGITS):
        if fall_through(c, b, a, t_max, DISTANCE - mpf(SHALLOW)) is None:
            starts_near = gap_quartic(c, b, a, DISTANCE + mpf(SHALLOW))[0] <= 0
            comes_near = starts_near or fall_through(c, b, a, t_max, DISTANCE + mpf(SHALLOW)) is not None
            return None if comes_near else bool(answer != answer)
        if answer != answer:
            return False
        first = fall_through(c, b, a, t_max, DISTANCE + mpf(CLOSE))
        last = fall_through(c, b, a, t_max, DISTANCE - mpf(CLOSE))
        return bool((first or 0) <= mpf(answer) <= (mp.inf if last is None else last))
