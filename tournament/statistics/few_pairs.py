"""The likelihood ratio of few pairs, judged by all that could have happened.

With many pairs the ratio of likelihoods is judged by its limiting distribution. With few, outcomes are counted. Under a
mean score s, that distribution over the cells under which the data are likeliest gives every outcome of n pairs a
chance, and s is contradicted when outcomes that speak against it at least as loudly as the one seen are rare: the
likelihood ratio with its parametric bootstrap (Beran, JASA 83, 1988; Lee & Young, Statistical Science 20, 2005),
computed exactly, for n pairs in five cells have (n + 4 choose 4) outcomes. The outcome seen counts half (mid-p:
Lancaster, JASA 56, 1961), or intervals would cover too much wherever there are few outcomes.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from tournament.statistics.likelihood import CELL_SCORES, EMPTY_CELL, mean_score

MOST_PAIRS = 12
"""1,820 outcomes; an interval takes some milliseconds. Beyond, the limiting distribution is as good."""

Floats = NDArray[np.float64]

_CELLS = np.array(CELL_SCORES)[:, None]
_STEPS = 100
"""Scores looked at before the bounds are refined: 1/100 to 99/100, a half among them."""
_HALVINGS = 8
"""A bound within 4e-5."""
_SAME = 1e-7
"""Ratios that differ by less are equal."""
_ROUNDS, _PRECISION = 100, 1e-2
"""Newton's last step squares the error in the tilt, and a shortfall, the greatest of all tilts', errs by its square."""


@dataclass(frozen=True)
class _Outcomes:
    """All that n pairs can come to.

    Attributes:
        counts: (5, m). log_ways: (m,), logarithm of the number of orders that lead to each.
        place: counts to their column.
        tilts, shortfalls: (99, m), of each under the mean scores 1/100 … 99/100 (``tournament.statistics.likelihood``).
    """

    counts: Floats
    log_ways: Floats
    place: dict[tuple[int, ...], int]
    tilts: Floats
    shortfalls: Floats

    def significance(self, counts: Sequence[int], tilts: Floats, shortfalls: Floats) -> float:
        """Chance of what speaks louder against a score than these counts, and half of that of what speaks as loudly.

        Args:
            counts: the outcome seen. tilts, shortfalls: (m,), of every outcome under the score.
        """
        place = self.place[tuple(counts)]
        nearest = np.maximum(self.counts[:, [place]], EMPTY_CELL) / (1.0 - _CELLS + _CELLS * math.exp(tilts[place]))
        chances = np.exp(self.log_ways + np.log(nearest / nearest.sum())[:, 0] @ self.counts)
        above = shortfalls - shortfalls[place]
        return float(chances[above > _SAME].sum() + 0.5 * chances[np.abs(above) <= _SAME].sum())


def bounds(counts: Sequence[int], confidence: float) -> tuple[float, float]:
    """The least and the greatest score that 2 to ``MOST_PAIRS`` pairs do not contradict."""
    mean, allowed = mean_score(counts), 1.0 - confidence
    fits = (1 + np.flatnonzero(_along(tuple(counts)) >= allowed)) / _STEPS
    low, high = min([mean, *fits.tolist()]), max([mean, *fits.tolist()])
    step = 1.0 / _STEPS
    return _refined(counts, allowed, low, max(0.0, low - step)), _refined(counts, allowed, high, min(1.0, high + step))


def superiority(counts: Sequence[int]) -> float:
    """Likelihood that the expected score is above a half, from the scores on its other side.

    Above 97.5 % exactly when no score up to a half is in the interval of 95 %.
    """
    mean, p = mean_score(counts), _along(tuple(counts))
    if mean == 0.5:
        return 0.5
    half = _STEPS // 2
    tail = 0.5 * float(p[:half].max() if mean > 0.5 else p[half - 1 :].max())
    return 1.0 - tail if mean > 0.5 else tail


def significance(counts: Sequence[int], score: float) -> float:
    """Chance of an outcome that speaks against the score in (0, 1) as loudly as this one, which counts half."""
    every = _outcomes(sum(counts))
    row = min(max(round(score * _STEPS), 1), _STEPS - 1) - 1
    tilts = _tilts(every.counts, score, every.tilts[row])
    return every.significance(counts, tilts, _shortfalls(every.counts, score, tilts))


def every_outcome(pairs: int, score: float) -> tuple[Floats, Floats, Floats]:
    """What so many pairs can come to: counts (m, 5), logarithms of their numbers of orders (m,), shortfalls (m,)."""
    every = _outcomes(pairs)
    return every.counts.T, every.log_ways, _shortfalls(every.counts, score, _tilts(every.counts, score))


@lru_cache(maxsize=4096)
def _along(counts: tuple[int, ...]) -> Floats:
    """The significance at 1/100 … 99/100."""
    every = _outcomes(sum(counts))
    rows = zip(every.tilts, every.shortfalls, strict=True)
    return np.array([every.significance(counts, *row) for row in rows])


def _refined(counts: Sequence[int], allowed: float, inside: float, outside: float) -> float:
    """Where between a score that fits and one that does not the significance falls below what is allowed."""
    if inside in (0.0, 1.0):
        return inside
    for _ in range(_HALVINGS):
        middle = 0.5 * (inside + outside)
        if significance(counts, middle) >= allowed:
            inside = middle
        else:
            outside = middle
    return inside


@lru_cache(maxsize=MOST_PAIRS)
def _outcomes(n: int) -> _Outcomes:
    """The outcomes of n pairs: where four bars can stand between n stars."""
    last = len(CELL_SCORES) - 1
    bars = [(-1, *places, n + last) for places in combinations(range(n + last), last)]
    counts = np.diff(np.array(bars), axis=1) - 1
    log_factorials = np.array([math.lgamma(k + 1.0) for k in range(n + 1)])
    log_ways = log_factorials[n] - log_factorials[counts].sum(axis=1)
    place = {tuple(row): index for index, row in enumerate(counts.tolist())}
    counts, tilts, shortfalls = counts.T.astype(np.float64), list[Floats](), list[Floats]()
    for step in range(1, _STEPS):  # each score's tilts are near those of the one before
        tilts.append(_tilts(counts, step / _STEPS, tilts[-1] if tilts else None))
        shortfalls.append(_shortfalls(counts, step / _STEPS, tilts[-1]))
    return _Outcomes(counts, log_ways, place, np.array(tilts), np.array(shortfalls))


def _shortfalls(counts: Floats, score: float, tilts: Floats) -> Floats:
    """(m,): by how much the likelihood of each outcome falls short: sum w_i log(d_i / (1 - s + s e^u))."""
    weights, power = np.maximum(counts, EMPTY_CELL), np.exp(tilts)
    slack = (1.0 - _CELLS + _CELLS * power) / (1.0 - score + score * power)
    found: Floats = (weights * np.log(slack)).sum(axis=0)
    return found


def _tilts(counts: Floats, score: float, start: Floats | None = None) -> Floats:
    """(m,): the tilt of each outcome under a score in (0, 1), by Newton's method within the bracket of ``profile``.

    All at once: a general root finder, asked 100,000 times, would take seconds.
    """
    weights, odds = np.maximum(counts, EMPTY_CELL), math.log(score / (1.0 - score))
    n, sides = weights.sum(axis=0), np.hstack([_CELLS, 1.0 - _CELLS]).T
    low, high = np.log(weights[-1] / (n - weights[-1])) - odds, np.log((n - weights[0]) / weights[0]) - odds
    x = 0.5 * (low + high) if start is None else np.clip(start, low, high)
    for _ in range(_ROUNDS):
        power = _CELLS * np.exp(x)
        slack = 1.0 - _CELLS + power
        chances = weights / slack
        (won, lost), (less_won, less_lost) = sides @ chances, sides @ (chances * power / slack)
        value, slope = np.log(won / lost) - odds, less_lost / lost - less_won / won
        low, high = np.where(value > 0.0, x, low), np.where(value > 0.0, high, x)
        following = x - value / slope
        following = np.where((low <= following) & (following <= high), following, 0.5 * (low + high))
        moved, x = np.abs(following - x).max(), following
        if moved < _PRECISION:
            break
    return x
