"""The mean of what games are worth, and how sure it is: games of one pair go together.

For numbers that no likelihood of cells fits, such as points less luck. The variance of the mean is that of pairs, not
of games (the cluster-robust variance: Liang & Zeger, Biometrika 73, 1986, 13-22); when all pairs are whole, the
interval is Student's t interval of the means of pairs.
"""

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass

from tournament.statistics.student import sidak_quantile

CONFIDENCE = 0.95

_NOTHING = 1e-20
"""A squared deviation that is rounding."""


@dataclass(frozen=True, slots=True)
class Mean:
    """A mean over games.

    Attributes:
        value: the mean. pairs: how many pairs, or single games whose partner is missing, it comes from.
        low, high: its interval of 95 % confidence; None for fewer than two pairs, or if all pairs are worth the same:
            they say nothing about how much others would differ.
    """

    value: float
    low: float | None
    high: float | None
    pairs: int


def mean_of(values: Sequence[float], pairs: Sequence[Hashable], confidence: float = CONFIDENCE) -> Mean:
    """The mean of at least one game.

    Args:
        values: of the games. pairs: of each game, what it shares with its partner and with no other game.
        confidence: of the interval, in (0, 1).
    """
    mean = sum(values) / len(values)
    sums: dict[Hashable, float] = {}
    for value, pair in zip(values, pairs, strict=True):
        sums[pair] = sums.get(pair, 0.0) + value - mean
    squares, count = sum(one * one for one in sums.values()), len(sums)
    if count < 2 or squares <= _NOTHING * len(values):
        return Mean(mean, None, None, count)
    error = math.sqrt(squares * count / (count - 1)) / len(values)
    half = sidak_quantile(confidence, 1, count - 1) * error
    return Mean(mean, mean - half, mean + half, count)
