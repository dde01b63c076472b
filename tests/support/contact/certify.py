"""The same verdict from double-precision intervals, for many answers at once; what it cannot decide it says so.

Bernstein coefficients of |d(t)|^2 on an interval bound it from below. The control points of d carry a rounding error
of a few units of the largest coordinate; ``ROUNDING`` allows four times as much.
"""

import numpy as np
from numpy.typing import NDArray
from support.contact.cases import DISTANCE, FLOATS, Cases
from support.contact.exact import CREEP, RESIDUAL, SHALLOW

BOOLS = NDArray[np.bool_]
ROUNDING = 64 * np.finfo(np.float64).eps
LONG_ROUNDING = 64 * float(np.finfo(np.longdouble).eps)
MAX_DEPTH = 40
MAX_PIECES = 2_000_000


def control_points(cases: Cases, until: FLOATS) -> FLOATS:
    """(n, 3, 2): the Bezier points of the path over [0, until]."""
    t = until[:, None]
    half = 0.5 * cases.b * t
    return np.stack([cases.c, cases.c + half, cases.c + 2 * half + cases.a * (t * t)], axis=1)


def least_squares(p: FLOATS) -> FLOATS:
    """The smallest Bernstein coefficient of |d|^2: a lower bound over the piece, before rounding."""
    dots = np.einsum("nik,njk->nij", p, p)
    middle = (dots[:, 0, 2] + 2 * dots[:, 1, 1]) / 3
    candidates = np.stack([dots[:, 0, 0], dots[:, 0, 1], middle, dots[:, 1, 2], dots[:, 2, 2]])
    return candidates.min(axis=0)


def halves(p: FLOATS) -> FLOATS:
    """Both halves of each piece, by de Casteljau."""
    left, right = 0.5 * (p[:, 0] + p[:, 1]), 0.5 * (p[:, 1] + p[:, 2])
    middle = 0.5 * (left + right)
    first = np.stack([p[:, 0], left, middle], axis=1)
    return np.concatenate([first, np.stack([middle, right, p[:, 2]], axis=1)])


def never_deep(cases: Cases, until: FLOATS) -> BOOLS:
    """Proof, where True, that the gap stays above -SHALLOW over [0, until]."""
    reach = sum(np.abs(x).max(axis=1) * s for x, s in ((cases.c, 1.0), (cases.b, until), (cases.a, until * until)))
    level = (DISTANCE - float(SHALLOW)) ** 2 + ROUNDING * reach * reach
    pieces, row = control_points(cases, until), np.arange(len(cases))
    undecided = np.zeros(len(cases), dtype=bool)
    for _ in range(MAX_DEPTH):
        open_pieces = least_squares(pieces) <= level[row]
        pieces, row = pieces[open_pieces], row[open_pieces]
        ends = np.einsum("nik,nik->ni", pieces[:, ::2], pieces[:, ::2]).min(axis=1) if len(row) else np.empty(0)
        undecided[row[ends <= level[row]]] = True
        keep = ~undecided[row]
        pieces, row = halves(pieces[keep]), np.tile(row[keep], 2)
        if not len(row) or len(row) > MAX_PIECES:
            break
    undecided[row] = True
    return ~undecided


def meets_distance(cases: Cases, t: FLOATS) -> BOOLS:
    """Proof that | |d(t)| - distance | <= RESIDUAL, in extended precision."""
    c, b, a, s = (x.astype(np.longdouble) for x in (cases.c, cases.b, cases.a, t[:, None]))
    d = c + s * (b + s * a)
    size = np.abs(c).max(axis=1) + np.abs(b).max(axis=1) * t + np.abs(a).max(axis=1) * t * t
    off = np.abs(np.sqrt(d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1]) - np.longdouble(DISTANCE))
    return np.asarray(off + LONG_ROUNDING * size <= float(RESIDUAL), dtype=bool)


def falling(cases: Cases, t: FLOATS) -> BOOLS:
    """Proof that the gap is not opening at t faster than CREEP."""
    s = t[:, None]
    d, speed = cases.c + s * (cases.b + s * cases.a), cases.b + 2 * s * cases.a
    slope = np.einsum("nk,nk->n", d, speed) / DISTANCE
    size = np.abs(cases.b).max(axis=1) + 2 * np.abs(cases.a).max(axis=1) * t
    return slope + ROUNDING * size < float(CREEP)


def certainly_right(cases: Cases, answers: FLOATS) -> BOOLS:
    """Answers (NaN: no contact) that are proved right; the others need exact arithmetic."""
    none = np.isnan(answers)
    inside = none | ((answers >= 0) & (answers <= cases.t_max))
    until = np.where(none, cases.t_max, np.where(inside, answers, 0.0))
    proved = inside & never_deep(cases, until)
    return proved & (none | (meets_distance(cases, until) & falling(cases, until)))
