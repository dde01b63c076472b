"""The sequential probability ratio test on pairs of games.

Pairs are independent of each other, the two games of a pair are not (same racks, same level), so the test sees pairs:
five cells, points 0, 1/2, 1, 3/2, 2. It is the generalised test of Van den Bergh, "A practical introduction to the
GSPRT" (2019), used by Stockfish's testing framework: the likelihood of the data, greatest under the expected score of
elo1, against the greatest under that of elo0. Its bounds are Wald's.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum

from tournament.sprt_terms import SprtTerms
from tournament.statistics.elo import expected_score

CELL_SCORES = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Share of the points of a pair in each of the five cells."""

EMPTY_CELL = 1e-3
"""What an empty cell counts as: the likelihood would be degenerate, and with 5 of them no decision shifts by a pair."""


class Verdict(StrEnum):
    """What a test says."""

    OPEN = "open"
    ELO0 = "elo0"
    ELO1 = "elo1"


@dataclass(frozen=True, slots=True)
class SprtState:
    """A test after some pairs.

    Attributes:
        verdict: open, or which hypothesis is accepted.
        llr: logarithm of the likelihood ratio, elo1 over elo0; bounds: at which it decides.
        pairs: how many it has seen; after a decision it looks at no more.
    """

    verdict: Verdict
    llr: float
    bounds: tuple[float, float]
    pairs: int


def sprt(terms: SprtTerms, cells: Iterable[int]) -> SprtState:
    """Test pairs in their order, stopping at the first decision.

    Args:
        terms: of the test.
        cells: for each pair, in the order of pairs (not of completion), the points of the first entrant times two: 0 to
            4.
    """
    lower, upper = terms.bounds
    counts = [0] * len(CELL_SCORES)
    seen, ratio = 0, 0.0
    for seen, cell in enumerate(cells, start=1):
        counts[cell] += 1
        ratio = log_likelihood_ratio(counts, expected_score(terms.elo0), expected_score(terms.elo1))
        if not lower < ratio < upper:
            return SprtState(Verdict.ELO1 if ratio >= upper else Verdict.ELO0, ratio, (lower, upper), seen)
    return SprtState(Verdict.OPEN, ratio, (lower, upper), seen)


def log_likelihood_ratio(counts: Sequence[int], score0: float, score1: float) -> float:
    """Logarithm of the greatest likelihood under mean score ``score1`` over that under ``score0``.

    Args:
        counts: pairs in each of the five cells.
        score0, score1: expected scores in (0, 1).
    """
    total = float(sum(counts))
    if total == 0.0:
        return 0.0
    weights = [max(float(count), EMPTY_CELL) for count in counts]
    return _profile(weights, score1) - _profile(weights, score0)


def _profile(weights: Sequence[float], score: float) -> float:
    """Greatest log-likelihood of the weights under mean ``score``, up to a constant.

    With Lagrange multipliers (Van den Bergh, section 4): q_i = p_i / (1 + x (a_i - s)), where x solves
    sum_i p_i (a_i - s) / (1 + x (a_i - s)) = 0. Then the log-likelihood is - sum_i w_i log(1 + x (a_i - s)).
    """
    away = [cell - score for cell in CELL_SCORES]
    x = _multiplier(weights, away)
    return -sum(weight * math.log1p(x * far) for weight, far in zip(weights, away, strict=True))


def _multiplier(weights: Sequence[float], away: Sequence[float]) -> float:
    """The x that makes the tilted mean zero: the sum falls with x between its two poles, so halving finds it."""
    low, high = -1.0 / away[-1], -1.0 / away[0]
    for _ in range(200):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        tilted = sum(weight * far / (1.0 + middle * far) for weight, far in zip(weights, away, strict=True))
        low, high = (middle, high) if tilted > 0.0 else (low, middle)
    return 0.5 * (low + high)
