"""The first time a polynomial falls through zero, by real-root isolation.

Between two neighbouring roots of its derivative a polynomial is monotone: a change of sign there brackets exactly one
root. Applied to the derivatives first, this isolates every real root with nothing but signs.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise

from mpmath import mp, mpf

Polynomial = Sequence[mpf]
"""Coefficients, ascending."""


def value(p: Polynomial, t: mpf) -> mpf:
    total = mpf(0)
    for coefficient in reversed(p):
        total = total * t + coefficient
    return total


def derivative(p: Polynomial) -> list[mpf]:
    return [k * coefficient for k, coefficient in enumerate(p)][1:]


def trimmed(p: Polynomial) -> list[mpf]:
    q = list(p)
    while q and q[-1] == 0:
        q.pop()
    return q


def bracketed_root(p: Polynomial, low: mpf, high: mpf) -> mpf:
    """The root in ``[low, high]``, where ``p`` changes sign: Newton steps kept inside a shrinking bracket."""
    slope, rising = derivative(p), value(p, high) > 0
    middle = (low + high) / 2
    resolution = mp.eps * max(abs(low), abs(high)) * 4
    while high - low > resolution:
        at_middle = value(p, middle)
        if at_middle == 0:
            return middle
        if (at_middle > 0) == rising:
            high = middle
        else:
            low = middle
        steepness = value(slope, middle)
        step = at_middle / steepness if steepness else mp.inf
        if abs(step) <= resolution:
            return middle - step
        middle = middle - step if low < middle - step < high else (low + high) / 2
    return (low + high) / 2


def monotone_pieces(p: Polynomial, low: mpf, high: mpf) -> Iterator[tuple[mpf, mpf]]:
    """The intervals between the roots of the derivative."""
    edges = [low, *real_roots(derivative(p), low, high), high]
    return pairwise(edges)


def real_roots(p: Polynomial, low: mpf, high: mpf) -> list[mpf]:
    """Places in ``(low, high)`` where ``p`` changes sign, ascending."""
    p = trimmed(p)
    if len(p) < 2:
        return []
    if len(p) == 2:
        root = -p[0] / p[1]
        return [root] if low < root < high else []
    found = []
    for left, right in monotone_pieces(p, low, high):
        at_left, at_right = value(p, left), value(p, right)
        if at_left == 0 and left > low:
            found.append(left)
        elif at_left * at_right < 0:
            found.append(bracketed_root(p, left, right))
    return found


def falls(p: Polynomial, t_max: mpf) -> Iterator[mpf]:
    """Every t in [0, t_max] at which ``p`` goes from >= 0 to < 0, ascending."""
    p = trimmed(p)
    if len(p) < 2:
        return
    for left, right in monotone_pieces(p, mpf(0), t_max):
        if value(p, right) < 0 <= value(p, left):
            yield left if value(p, left) == 0 else bracketed_root(p, left, right)


def first_fall(p: Polynomial, t_max: mpf) -> mpf | None:
    """The earliest of them, or None."""
    return next(falls(p, t_max), None)
