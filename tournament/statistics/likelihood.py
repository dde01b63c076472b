"""The likelihood of five cells of pairs under a given mean score.

Pairs are independent of each other; the two games of a pair are not (same racks, same level). So pairs are what is
counted: five cells, 0, 1/2, 1, 3/2, 2 points. Nothing else is assumed: the likelihood of a mean score is the greatest
one of all distributions over the cells that have this mean, Owen's empirical likelihood (Biometrika 75, 1988, 237-249),
as in Stockfish's testing framework (LLRcalc.py).
"""

import math
from collections.abc import Sequence

CELL_SCORES = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Share of a pair's points in each cell."""

EMPTY_CELL = 1e-3
"""What an empty cell counts as, as in Stockfish's testing framework: small enough to move no result by a visible
digit, and the likelihood under any mean in (0, 1) stays finite.
"""

_ROUNDS, _PRECISION = 200, 1e-12


def regularised(counts: Sequence[float]) -> list[float]:
    """The counts with nothing empty."""
    return [max(float(count), EMPTY_CELL) for count in counts]


def mean_score(counts: Sequence[float]) -> float:
    """Mean share of the points; a half for no pairs."""
    total = sum(counts)
    return sum(count * cell for count, cell in zip(counts, CELL_SCORES, strict=True)) / total if total else 0.5


def profile(weights: Sequence[float], score: float) -> float:
    """Greatest log-likelihood of the weights under a mean ``score`` in (0, 1), less that under their own mean; <= 0.

    With a Lagrange multiplier x: q_i = p_i / (1 + x (a_i - s)), where x solves sum_i p_i (a_i - s) / (1 + x (a_i - s))
    = 0. The log-likelihood then falls short by sum_i w_i log(1 + x (a_i - s)).
    """
    away = [cell - score for cell in CELL_SCORES]
    x = _multiplier(weights, away)
    return -sum(weight * math.log1p(x * far) for weight, far in zip(weights, away, strict=True))


def _multiplier(weights: Sequence[float], away: Sequence[float]) -> float:
    """The root between the two poles: Newton's method, halving wherever it would leave the bracket."""
    low, high = -1.0 / away[-1], -1.0 / away[0]
    x = 0.0
    for _ in range(_ROUNDS):
        shares = [far / (1.0 + x * far) for far in away]
        value = sum(weight * share for weight, share in zip(weights, shares, strict=True))
        slope = -sum(weight * share * share for weight, share in zip(weights, shares, strict=True))
        low, high = (x, high) if value > 0.0 else (low, x)
        following = x - value / slope
        if not low < following < high:
            following = 0.5 * (low + high)
        if abs(following - x) <= _PRECISION * (high - low) or following in (low, high):
            return following
        x = following
    return x
