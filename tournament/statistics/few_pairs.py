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
"""1,820 outcomes; an interval takes some hundredths of a second. Beyond, the limiting distribution is as good."""

Floats = NDArray[np.float64]

_STEPS = 100
"""Scores looked at before the bounds are refined: 1/100 to 99/100, a half among them."""
_HALVINGS = 8
"""A bound within 4e-5."""
_SAME = 1e-7
"""Ratios that differ by less are equal."""
_ROUNDS, _PRECISION = 100, 1e-12


@dataclass(frozen=True)
class _Outcomes:
    """All that n pairs can come to.

    Attributes:
        counts: (m, 5). log_ways: (m,), logarithm of the number of orders that lead to each.
        shortfalls: (99, m), by how much the likelihood of each falls short of its greatest at 1/100 … 99/100.
    """

    counts: Floats
    log_ways: Floats
    shortfalls: Floats


def bounds(counts: Sequence[int], confidence: float) -> tuple[float, float]:
    """The least and the greatest score that 2 to ``MOST_PAIRS`` pairs do not contradict."""
    mean, allowed = mean_score(counts), 1.0 - confidence
    fits = [score for score, p in zip(_grid().tolist(), _along(counts).tolist(), strict=True) if p >= allowed]
    low, high = min([mean, *fits]), max([mean, *fits])
    step = 1.0 / _STEPS
    return _refined(counts, allowed, low, max(0.0, low - step)), _refined(counts, allowed, high, min(1.0, high + step))


def superiority(counts: Sequence[int]) -> float:
    """Likelihood that the expected score is above a half, from the scores on its other side.

    Above 97.5 % exactly when no score up to a half is in the interval of 95 %.
    """
    mean, p = mean_score(counts), _along(counts)
    if mean == 0.5:
        return 0.5
    half = _STEPS // 2
    tail = 0.5 * float(p[:half].max() if mean > 0.5 else p[half - 1 :].max())
    return 1.0 - tail if mean > 0.5 else tail


def significance(counts: Sequence[int], score: float) -> float:
    """Chance of an outcome that speaks against the score in (0, 1) as loudly as this one, which counts half."""
    every = _outcomes(sum(counts))
    return float(_significance(every, counts, np.array([score]), _shortfalls(every.counts, np.array([score])))[0])


def every_outcome(pairs: int, score: float) -> tuple[Floats, Floats, Floats]:
    """What so many pairs can come to: counts (m, 5), logarithms of their numbers of orders (m,), shortfalls (m,)."""
    every = _outcomes(pairs)
    return every.counts, every.log_ways, _shortfalls(every.counts, np.array([score]))[0]


@lru_cache(maxsize=4096)
def _kept(counts: tuple[int, ...]) -> Floats:
    every = _outcomes(sum(counts))
    return _significance(every, counts, _grid(), every.shortfalls)


def _along(counts: Sequence[int]) -> Floats:
    """The significance at 1/100 … 99/100."""
    return _kept(tuple(counts))


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


def _significance(every: _Outcomes, counts: Sequence[int], scores: Floats, shortfalls: Floats) -> Floats:
    """For each score: the chance of what speaks louder, and half of that of what speaks as loudly.

    Args:
        scores: (k,). shortfalls: (k, m), of every outcome at each of them.
    """
    weights = np.maximum(np.array(counts, dtype=np.float64), EMPTY_CELL)
    away = np.array(CELL_SCORES) - scores[:, None]
    slack = 1.0 + _multipliers(weights, scores)[:, None] * away
    mine = (weights * np.log(slack)).sum(axis=1)[:, None]
    nearest = weights / slack
    nearest /= nearest.sum(axis=1, keepdims=True)
    chances = np.exp(every.log_ways + np.log(nearest) @ every.counts.T)
    louder = (chances * (shortfalls > mine + _SAME)).sum(axis=1)
    equal = (chances * (np.abs(shortfalls - mine) <= _SAME)).sum(axis=1)
    found: Floats = louder + 0.5 * equal
    return found


@lru_cache(maxsize=MOST_PAIRS)
def _outcomes(n: int) -> _Outcomes:
    """The outcomes of n pairs: where four bars can stand between n stars."""
    last = len(CELL_SCORES) - 1
    bars = [(-1, *places, n + last) for places in combinations(range(n + last), last)]
    counts = np.diff(np.array(bars, dtype=np.float64), axis=1) - 1.0
    log_factorials = np.array([math.lgamma(k + 1.0) for k in range(n + 1)])
    log_ways = log_factorials[n] - log_factorials[counts.astype(np.intp)].sum(axis=1)
    return _Outcomes(counts, log_ways, _shortfalls(counts, _grid()))


def _grid() -> Floats:
    return np.arange(1, _STEPS) / _STEPS


def _shortfalls(counts: Floats, scores: Floats) -> Floats:
    """(k, m): how far the likelihood of each of m outcomes falls short at each of k scores."""
    weights = np.maximum(counts, EMPTY_CELL)
    away = (np.array(CELL_SCORES) - scores[:, None])[:, None, :]
    slack = 1.0 + _multipliers(weights, scores[:, None])[..., None] * away
    found: Floats = (weights * np.log(slack)).sum(axis=-1)
    return found


def _multipliers(weights: Floats, scores: Floats) -> Floats:
    """The Lagrange multipliers of ``tournament.statistics.likelihood``, for many weights and scores at once."""
    away = np.array(CELL_SCORES) - scores[..., None]
    low, high = np.broadcast_arrays(-1.0 / away[..., -1], -1.0 / away[..., 0])
    x = np.zeros(np.broadcast_shapes(weights.shape[:-1], scores.shape))
    low, high = np.broadcast_to(low, x.shape), np.broadcast_to(high, x.shape)
    for _ in range(_ROUNDS):
        shares = away / (1.0 + x[..., None] * away)
        value, slope = (weights * shares).sum(axis=-1), (weights * shares * shares).sum(axis=-1)
        low, high = np.where(value > 0.0, x, low), np.where(value > 0.0, high, x)
        following = x + value / slope
        following = np.where((low < following) & (following < high), following, 0.5 * (low + high))
        moved, x = np.abs(following - x) > _PRECISION * (high - low), following
        if not moved.any():
            break
    return x
