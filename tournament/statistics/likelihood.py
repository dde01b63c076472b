"""The likelihood of five cells of pairs under a given mean score.

Pairs are independent of each other; the two games of a pair are not (same racks, same level). So pairs are what is
counted: five cells, 0, 1/2, 1, 3/2, 2 points. Nothing else is assumed: the likelihood of a mean score is the greatest
one of all distributions over the cells that have this mean, Owen's empirical likelihood (Biometrika 75, 1988, 237-249),
as in Stockfish's testing framework (LLRcalc.py).

The distribution of greatest likelihood has the probabilities q_i ~ w_i / d_i with d_i = 1 - a_i + a_i e^u for weights
w_i, cell scores a_i and a number u, here called the tilt: 0 at the weights' own mean, positive below it. Owen's
Lagrange multiplier of the mean s is (e^u - 1) / (1 - s + s e^u). The tilt has no poles, and with weights in the two
outer cells alone it is the difference of two log odds.
"""

import math
from collections.abc import Sequence

CELL_SCORES = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Share of a pair's points in each cell."""

EMPTY_CELL = 1e-3
"""What an empty cell counts as, as in Stockfish's testing framework: small enough to move no result by a visible
digit, and the likelihood under any mean in (0, 1) stays finite.
"""


def regularised(counts: Sequence[float]) -> list[float]:
    """The counts with nothing empty."""
    return [max(float(count), EMPTY_CELL) for count in counts]


def mean_score(counts: Sequence[float]) -> float:
    """Mean share of the points; a half for no pairs."""
    total = sum(counts)
    return sum(count * cell for count, cell in zip(counts, CELL_SCORES, strict=True)) / total if total else 0.5


def profile(weights: Sequence[float], score: float) -> float:
    """Greatest log-likelihood of the weights under a mean ``score`` in (0, 1), less that under their own mean; <= 0."""
    from scipy.optimize import brentq

    odds, total = math.log(score / (1.0 - score)), sum(weights)
    # All that is not in the top cell has a mean of at least 0, all that is not in the lowest one of at most 1.
    low = math.log(weights[-1] / (total - weights[-1])) - odds
    high = math.log((total - weights[0]) / weights[0]) - odds
    return -shortfall(weights, brentq(lambda tilt: _odds(weights, tilt) - odds, low - 1.0, high + 1.0))


def bound(weights: Sequence[float], threshold: float, side: int) -> float:
    """The mean score below (``side`` = 1) or above (-1) the weights' own where the likelihood falls by a threshold."""
    from scipy.optimize import brentq

    reach = 1.0
    while shortfall(weights, side * reach) < threshold:
        reach *= 2.0
    tilt = side * brentq(lambda size: shortfall(weights, side * size) - threshold, 0.0, reach)
    return 1.0 / (1.0 + math.exp(-_odds(weights, tilt)))


def shortfall(weights: Sequence[float], tilt: float) -> float:
    """By how much the likelihood at a tilt falls short of the greatest: sum w_i log(d_i) + n log(sum w_i / (n d_i))."""
    total, power = sum(weights), math.exp(tilt)
    slack = [1.0 - cell + cell * power for cell in CELL_SCORES]
    falls = sum(weight * math.log(each) for weight, each in zip(weights, slack, strict=True))
    return falls + total * math.log(sum(weight / each for weight, each in zip(weights, slack, strict=True)) / total)


def _odds(weights: Sequence[float], tilt: float) -> float:
    """The logarithm of s / (1 - s) for the mean s at a tilt; it falls as the tilt grows."""
    power, won, lost = math.exp(tilt), 0.0, 0.0
    for weight, cell in zip(weights, CELL_SCORES, strict=True):
        chance = weight / (1.0 - cell + cell * power)
        won, lost = won + chance * cell, lost + chance * (1.0 - cell)
    return math.log(won / lost)
