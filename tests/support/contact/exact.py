"""The contact problem in exact arithmetic: Sturm sequences over the integers, then a verdict on an answer."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise
from math import gcd, lcm

Polynomial = list[int]
"""Integer coefficients, ascending, no leading zero."""

SHALLOW = Fraction(1, 10**12)
"""m; rounding of the data decides whether a contact this shallow is one: either answer is right."""

RESIDUAL = Fraction(1, 10**14)
"""m; how exactly a returned time must meet the distance."""

CREEP = Fraction(1, 10**9)
"""m/s; a touch that opens faster than this is no contact."""


def integral(p: Sequence[Fraction]) -> Polynomial:
    """A positive multiple with integer coefficients."""
    scale = lcm(*(x.denominator for x in p)) if p else 1
    return primitive([int(x * scale) for x in p])


def primitive(p: Sequence[int]) -> Polynomial:
    """Leading zeros and the (positive) common factor removed."""
    q = list(p)
    while q and q[-1] == 0:
        q.pop()
    common = gcd(*q) if q else 1
    return [x // common for x in q]


def sign_at(p: Polynomial, t: Fraction) -> int:
    """Sign of p(t), by Horner's rule on integers."""
    n, d, total, power = t.numerator, t.denominator, 0, 1
    for coefficient in reversed(p):
        total = total * n + coefficient * power
        power *= d
    return (total > 0) - (total < 0)


def derivative(p: Polynomial) -> Polynomial:
    return primitive([k * x for k, x in enumerate(p)][1:])


def negative_remainder(p: Polynomial, q: Polynomial) -> Polynomial:
    """A positive multiple of -(p mod q)."""
    r, lead = list(p), abs(q[-1])
    sign = 1 if q[-1] > 0 else -1
    while len(r) >= len(q):
        factor, shift = r[-1] * sign, len(r) - len(q)
        r = [x * lead for x in r]
        for k, x in enumerate(q):
            r[shift + k] -= factor * x
        r.pop()
        while r and r[-1] == 0:
            r.pop()
    return primitive([-x for x in r])


def quotient(p: Polynomial, q: Polynomial) -> Polynomial:
    """A positive multiple of p / q, where q divides p."""
    r, lead, result = list(p), abs(q[-1]), [0] * (len(p) - len(q) + 1)
    sign = 1 if q[-1] > 0 else -1
    for shift in reversed(range(len(result))):
        result = [x * lead for x in result]
        result[shift] = r[-1] * sign
        factor = r[-1] * sign
        r = [x * lead for x in r]
        for k, x in enumerate(q):
            r[shift + k] -= factor * x
        r.pop()
    return primitive(result)


def chain_from(p: Polynomial) -> list[Polynomial]:
    chain = [p, derivative(p)]
    while chain[-1]:
        chain.append(negative_remainder(chain[-2], chain[-1]))
    return chain[:-1]


def sturm_chain(p: Polynomial) -> list[Polynomial]:
    """The Sturm sequence of p with its multiple roots made simple."""
    chain = chain_from(p)
    return chain if len(chain[-1]) == 1 else chain_from(quotient(p, chain[-1]))


def variations(chain: list[Polynomial], t: Fraction) -> int:
    signs = [s for s in (sign_at(p, t) for p in chain) if s]
    return sum(s != u for s, u in pairwise(signs))


def isolate(chain: list[Polynomial], low: Fraction, high: Fraction) -> list[tuple[Fraction, Fraction]]:
    """Half-open intervals (low, high], ascending, each with exactly one distinct root of chain[0]."""
    count = variations(chain, low) - variations(chain, high)
    if count == 0:
        return []
    if count == 1:
        return [(low, high)]
    middle = (low + high) / 2
    return isolate(chain, low, middle) + isolate(chain, middle, high)


def first_fall(p: Polynomial, t_max: Fraction) -> tuple[Fraction, Fraction] | None:
    """An interval holding the earliest t in [0, t_max] after which p is negative and before which it is not.

    A start with p(0) < 0 counts as a fall at 0 if p is still decreasing there, as in ``quartics.json``.
    """
    zero = Fraction(0)
    if not p or t_max <= 0:
        return None
    if sign_at(p, zero) < 0 and sign_at(derivative(p), zero) < 0:
        return zero, zero
    chain = sturm_chain(p)
    roots = isolate(chain, zero, t_max)
    signs = [sign_after(p, chain, edge, t_max) for edge in (zero, *(high for _, high in roots))]
    if sign_at(p, zero) == 0 and signs[0] < 0:
        return zero, zero
    for root, before, after in zip(roots, signs, signs[1:], strict=False):
        if before > 0 > after:
            return root
    return None


def sign_after(p: Polynomial, chain: list[Polynomial], edge: Fraction, t_max: Fraction) -> int:
    """Sign of p just after ``edge``, or at t_max if that is the edge."""
    step = t_max - edge
    while step and variations(chain, edge) != variations(chain, edge + step):
        step /= 2
    return sign_at(p, edge + step)


def refined(p: Polynomial, interval: tuple[Fraction, Fraction], width: Fraction) -> tuple[Fraction, Fraction]:
    """The interval of a fall made narrower, by bisection."""
    low, high = interval
    while high - low > width:
        middle = (low + high) / 2
        low, high = (middle, high) if sign_at(p, middle) > 0 else (low, middle)
    return low, high


Vector = Sequence[float]


def squared_distance(c: Vector, b: Vector, a: Vector) -> list[Fraction]:
    """|c + b t + a t^2|^2, ascending, the doubles taken as exact."""
    total = [Fraction(0)] * 5
    for axis in (0, 1):
        c0, b0, a0 = Fraction(float(c[axis])), Fraction(float(b[axis])), Fraction(float(a[axis]))
        terms = (c0 * c0, 2 * c0 * b0, b0 * b0 + 2 * c0 * a0, 2 * b0 * a0, a0 * a0)
        total = [x + y for x, y in zip(total, terms, strict=True)]
    return total


def gap_polynomial(squared: Sequence[Fraction], distance: Fraction) -> Polynomial:
    return integral([squared[0] - distance * distance, *squared[1:]])


def value(p: Sequence[Fraction], t: Fraction) -> Fraction:
    total = Fraction(0)
    for coefficient in reversed(p):
        total = total * t + coefficient
    return total


def falls_deep(squared: Sequence[Fraction], distance: Fraction, until: Fraction) -> bool:
    """Does the gap get below -SHALLOW within [0, until]?"""
    deep = gap_polynomial(squared, distance - SHALLOW)
    return sign_at(deep, Fraction(0)) < 0 or first_fall(deep, until) is not None


def is_opening(squared: Sequence[Fraction], distance: Fraction, t: Fraction) -> bool:
    """Opening faster than CREEP at t after never having closed before."""
    slope = [k * x for k, x in enumerate(squared)][1:]
    if value(slope, t) <= 2 * distance * CREEP:
        return False
    rising = integral(slope)
    return sign_at(rising, Fraction(0)) >= 0 and first_fall(rising, t) is None


def judge(c: Vector, b: Vector, a: Vector, t_max: float, answer: float, distance: float) -> str:
    """``ok``, or what is wrong with an answer: outside, missed, late, residual, opening.

    No contact deeper than SHALLOW may be missed or passed over; a time must meet the distance to RESIDUAL, or to
    SHALLOW where no contact is deeper than that; and it must be a fall, not the opening of a touch.
    """
    squared, size = squared_distance(c, b, a), Fraction(distance)
    end = Fraction(t_max)
    if answer != answer:
        return "missed" if falls_deep(squared, size, end) else "ok"
    if not 0 <= answer <= t_max:
        return "outside"
    t = Fraction(answer)
    if falls_deep(squared, size, t):
        return "late"
    if not meets(squared, size, t, RESIDUAL) and (
        falls_deep(squared, size, end) or not meets(squared, size, t, SHALLOW)
    ):
        return "residual"
    return "opening" if is_opening(squared, size, t) else "ok"


def meets(squared: Sequence[Fraction], distance: Fraction, t: Fraction, within: Fraction) -> bool:
    """| |d(t)| - distance | <= within, exactly."""
    return (distance - within) ** 2 <= value(squared, t) <= (distance + within) ** 2
