"""The normal and Student distributions, without a statistics library: they are needed wherever results are read."""

import math

from physics.generator import normal_quantile

__all__ = ["normal_cdf", "normal_quantile", "student_cdf", "student_quantile"]

_LARGE = 1e6
"""Degrees of freedom beyond which Student's distribution is the normal one to 6 digits."""
_TINY = 1e-300
_STEPS = 300


def normal_cdf(x: float) -> float:
    """Probability that a standard normal number is at most ``x``."""
    return 0.5 * math.erfc(-x / math.sqrt(2.0))


def student_cdf(t: float, dof: float) -> float:
    """Probability that Student's t with ``dof`` degrees of freedom is at most ``t``.

    1 - I_x(dof/2, 1/2) / 2 for t > 0, x = dof / (dof + t^2) (Abramowitz & Stegun 26.7.1).
    """
    if dof >= _LARGE:
        return normal_cdf(t)
    tail = 0.5 * _incomplete_beta(dof / 2.0, 0.5, dof / (dof + t * t))
    return 1.0 - tail if t > 0.0 else tail


def student_quantile(p: float, dof: float) -> float:
    """The t that ``student_cdf`` maps to ``p`` in (0, 1), by halving."""
    if p < 0.5:
        return -student_quantile(1.0 - p, dof)
    if dof >= _LARGE or p == 0.5:
        return normal_quantile(p)
    low, high = 0.0, 1.0
    while student_cdf(high, dof) < p and high < 1e12:
        high *= 2.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if student_cdf(middle, dof) < p else (low, middle)
    return 0.5 * (low + high)


def _incomplete_beta(a: float, b: float, x: float) -> float:
    """The regularised incomplete beta function I_x(a, b) for x in [0, 1]."""
    if x <= 0.0 or x >= 1.0:
        return 0.0 if x <= 0.0 else 1.0
    if x > (a + 1.0) / (a + b + 2.0):  # beyond, the fraction converges slowly: the mirror image is used
        return 1.0 - _incomplete_beta(b, a, 1.0 - x)
    log_front = math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b) + a * math.log(x) + b * math.log1p(-x)
    return math.exp(log_front) * _fraction(a, b, x) / a


def _fraction(a: float, b: float, x: float) -> float:
    """The continued fraction of DLMF 8.17.22, by the modified Lentz method (Thompson & Barnett 1986)."""
    value, c, d = _TINY, _TINY, 0.0
    for step in range(_STEPS):
        m = step // 2
        if step == 0:
            term = 1.0
        elif step % 2:
            term = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0))
        else:
            term = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m))
        d = 1.0 / _away_from_zero(1.0 + term * d)
        c = _away_from_zero(1.0 + term / c)
        value *= c * d
        if abs(c * d - 1.0) < 1e-15:
            break
    return value


def _away_from_zero(value: float) -> float:
    return value if abs(value) > _TINY else _TINY
