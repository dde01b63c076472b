"""Other solvers of the contact quartic |c + b t + a t^2|^2 = D^2: the textbook's formulas and companion matrices.

Each answers as the engine's own solver does: the earliest t in [0, t_max] at which the balls, approaching, are at the
distance; NaN if none.
"""

import math
from typing import Any

import numba
import numpy as np

from benchmarks.scenes import Floats

compiled = numba.njit(error_model="numpy", nogil=True)

IMAGINARY = 1e-8
"""A root counts as real when its imaginary part is no larger, relative to the larger of its real part and 1 s."""

BEFORE = 1e-9
"""s. A root this little before 0 counts as 0."""


@compiled
def coefficients(cx, cy, bx, by, ax, ay, distance):
    """Coefficients of the quartic, the highest power first ([II] eq. 7)."""
    return (
        ax * ax + ay * ay,
        2.0 * (ax * bx + ay * by),
        bx * bx + by * by + 2.0 * (ax * cx + ay * cy),
        2.0 * (bx * cx + by * cy),
        cx * cx + cy * cy - distance * distance,
    )


@compiled
def earliest(roots, q4, q3, q2, q1, t_max):
    """The earliest root that is real, in [0, t_max] and approached from outside."""
    best = math.inf
    for root in roots:
        t = root.real
        if abs(root.imag) <= IMAGINARY * max(1.0, abs(t)) and -BEFORE <= t <= t_max and t < best:
            slope = q1 + t * (2.0 * q2 + t * (3.0 * q3 + t * 4.0 * q4))
            if slope < 0.0:
                best = t
    return math.nan if best == math.inf else max(best, 0.0)


@compiled
def ferrari(q4, q3, q2, q1, q0):
    """The four roots by Ferrari's formulas with Cardano's for the resolvent cubic, as textbooks print them.

    NaN where the formulas divide by 0.
    """
    if q4 == 0.0:
        nothing = complex(math.nan)
        return nothing, nothing, nothing, nothing
    b, c, d, e = q3 / q4, q2 / q4, q1 / q4, q0 / q4
    p = c - 0.375 * b * b
    q = 0.125 * b * b * b - 0.5 * b * c + d
    r = -3.0 / 256.0 * b * b * b * b + c * b * b / 16.0 - 0.25 * b * d + e
    shift = -0.25 * b
    if q == 0.0:
        inner = np.sqrt(complex(p * p - 4.0 * r))
        u, v = np.sqrt(0.5 * (-p + inner)), np.sqrt(0.5 * (-p - inner))
        return shift + u, shift - u, shift + v, shift - v
    p3 = -p * p / 12.0 - r
    q3 = -p * p * p / 108.0 + p * r / 3.0 - 0.125 * q * q
    u = (-0.5 * q3 + np.sqrt(complex(0.25 * q3 * q3 + p3 * p3 * p3 / 27.0))) ** (1.0 / 3.0)
    y = -5.0 / 6.0 * p + (u - p3 / (3.0 * u) if u != 0.0 else -(complex(q3) ** (1.0 / 3.0)))
    w = np.sqrt(p + 2.0 * y)
    if w == 0.0:
        nothing = complex(math.nan)
        return nothing, nothing, nothing, nothing
    s, t = np.sqrt(-(3.0 * p + 2.0 * y + 2.0 * q / w)), np.sqrt(-(3.0 * p + 2.0 * y - 2.0 * q / w))
    return shift + 0.5 * (w + s), shift + 0.5 * (w - s), shift + 0.5 * (-w + t), shift + 0.5 * (-w - t)


@compiled
def textbook(cx, cy, bx, by, ax, ay, t_max, limit, distance):
    """First contact by the textbook's closed form."""
    q4, q3, q2, q1, q0 = coefficients(cx, cy, bx, by, ax, ay, distance)
    t = earliest(ferrari(q4, q3, q2, q1, q0), q4, q3, q2, q1, t_max)
    return t if t <= limit else math.nan


@compiled
def companion(cx, cy, bx, by, ax, ay, t_max, limit, distance):
    """First contact by the eigenvalues of the companion matrix; NaN where the leading coefficient is 0."""
    q4, q3, q2, q1, q0 = coefficients(cx, cy, bx, by, ax, ay, distance)
    if q4 == 0.0 or not math.isfinite(q0 / q4) or not math.isfinite(q1 / q4) or not math.isfinite(q2 / q4):
        return math.nan
    matrix = np.zeros((4, 4), np.complex128)
    matrix[1, 0] = matrix[2, 1] = matrix[3, 2] = 1.0
    matrix[0, 3], matrix[1, 3], matrix[2, 3], matrix[3, 3] = -q0 / q4, -q1 / q4, -q2 / q4, -q3 / q4
    t = earliest(np.linalg.eigvals(matrix), q4, q3, q2, q1, t_max)
    return t if t <= limit else math.nan


@compiled
def polished(t, cx, cy, bx, by, ax, ay, distance):
    """A root after Newton steps on the path itself; NaN if the balls do not touch there, to 1e-13 m."""
    for _ in range(4):
        dx, dy = cx + t * (bx + t * ax), cy + t * (by + t * ay)
        f = dx * dx + dy * dy - distance * distance
        slope = 2.0 * (dx * (bx + 2.0 * t * ax) + dy * (by + 2.0 * t * ay))
        if slope >= 0.0:
            return math.nan
        t = max(t - f / slope, 0.0)
    dx, dy = cx + t * (bx + t * ax), cy + t * (by + t * ay)
    return t if abs(math.sqrt(dx * dx + dy * dy) - distance) <= 1e-13 else math.nan


def in_the_engine(solve: Any, usual: Any) -> Any:
    """A solver fit to take the place of the engine's own, ``usual``, which stays in charge of balls that touch.

    Its roots are polished, and those at which the balls do not touch are dropped: the engine acts on balls that
    touch to 1e-12 m, and with a root that is off by more it would look at the same instant for ever.
    """

    from physics.kernels.detect.contact import LATER, MEETS, Root

    @compiled
    def contact(path, t_max, limit, distance):
        cx, cy, bx, by, ax, ay = path
        near = distance + 1e-12
        if cx * cx + cy * cy <= near * near:
            return usual(path, t_max, limit, distance)
        t = polished(solve(cx, cy, bx, by, ax, ay, t_max, limit, distance), cx, cy, bx, by, ax, ay, distance)
        return Root(t, MEETS) if t <= limit else Root(math.nan, LATER)

    return contact


def of_numbers(usual: Any) -> Any:
    """The engine's own solver, ``usual``, as the others are called."""
    from physics.kernels.path import Path

    @compiled
    def solve(cx, cy, bx, by, ax, ay, t_max, limit, distance):
        return usual(Path(cx, cy, bx, by, ax, ay), t_max, limit, distance).time

    return solve


@compiled
def first_of_each(roots, quartics, t_max):
    """``earliest`` of rows of roots (n, 4) and coefficients (n, 5)."""
    out = np.empty(len(t_max))
    for n in range(len(t_max)):
        q = quartics[n]
        out[n] = earliest(roots[n], q[0], q[1], q[2], q[3], t_max[n])
    return out


def companion_in_bulk(c: Floats, b: Floats, a: Floats, t_max: Floats, distance: float) -> Floats:
    """All first contacts by numpy's eigenvalues of stacked real companion matrices; NaN for a leading 0."""
    quartics = np.stack(coefficients(*c.T, *b.T, *a.T, distance), axis=1)
    out = np.full(len(t_max), np.nan)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        monic = quartics[:, :0:-1] / quartics[:, :1]
    fit = np.isfinite(monic).all(axis=1)
    matrices = np.zeros((int(fit.sum()), 4, 4))
    matrices[:, (1, 2, 3), (0, 1, 2)] = 1.0
    matrices[:, :, 3] = -monic[fit]
    out[fit] = first_of_each(np.linalg.eigvals(matrices).astype(np.complex128), quartics[fit], t_max[fit])
    return out
