"""The score of one entrant against another, its Elo difference, and how sure both are."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from tournament.results import GameResult
from tournament.statistics import few_pairs
from tournament.statistics.elo import elo_of
from tournament.statistics.likelihood import CELL_SCORES, bound, mean_score, profile, regularised
from tournament.statistics.student import sidak_quantile, student_cdf

CONFIDENCE = 0.95


@dataclass(frozen=True, slots=True)
class Score:
    """What pairs of games say about a player against one other, or against several.

    Attributes:
        cells: pairs with 0, 1/2, 1, 3/2, 2 points.
        score: mean share of the points, in [0, 1]; a half for no pairs.
        low, high: its interval of 95 % confidence, in [0, 1].
        elo, elo_low, elo_high: the same as Elo differences, cut off at +-1500.
        superiority: likelihood of being the better one, in [0, 1].
        unpaired: games left out because the other game of their pair has no result.
    """

    cells: tuple[int, int, int, int, int]
    score: float
    low: float
    high: float
    elo: float
    elo_low: float
    elo_high: float
    superiority: float
    unpaired: int = 0

    @property
    def pairs(self) -> int:
        """Pairs counted."""
        return sum(self.cells)

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        data = {name: getattr(self, name) for name in self.__slots__}
        return data | {"cells": list(self.cells), "pairs": self.pairs}


def score_of(games: Iterable[GameResult], player: str) -> Score:
    """The score of ``player`` in these games; those of others, and those that do not count, are passed over."""
    pairs: dict[tuple[str, str], dict[int, float]] = {}
    for game in games:
        if game.counts and player in game.players:
            opponent = game.players[1 - game.seat(player)]
            pairs.setdefault((game.pair, opponent), {})[game.leg] = game.points_of(player)
    whole = [round(2.0 * sum(legs.values())) for legs in pairs.values() if len(legs) == 2]
    return score_of_cells([whole.count(cell) for cell in range(len(CELL_SCORES))], unpaired=len(pairs) - len(whole))


def score_of_cells(counts: Sequence[int], confidence: float = CONFIDENCE, unpaired: int = 0) -> Score:
    """The score behind five counts of pairs.

    Args:
        counts: pairs with 0, 1/2, 1, 3/2, 2 points.
        confidence: of the interval, in (0, 1).
        unpaired: handed through.

    Raises:
        ValueError: not five integers >= 0.
    """
    if len(counts) != len(CELL_SCORES) or any(isinstance(one, bool) or not isinstance(one, int) for one in counts):
        raise ValueError(f"counts = {counts!r}: must be five integers")
    if min(counts) < 0:
        raise ValueError(f"counts = {counts!r}: must be >= 0")
    score = mean_score(counts)
    low, high = score_interval(counts, confidence)
    return Score(
        cells=(counts[0], counts[1], counts[2], counts[3], counts[4]),
        score=score,
        low=low,
        high=high,
        elo=elo_of(score),
        elo_low=elo_of(low),
        elo_high=elo_of(high),
        superiority=superiority(counts),
        unpaired=unpaired,
    )


def score_interval(counts: Sequence[int], confidence: float = CONFIDENCE) -> tuple[float, float]:
    """The interval of mean scores that the pairs do not contradict.

    Few pairs (``few_pairs.MOST_PAIRS``) are judged by all that could have happened. For more, all s whose likelihood
    ratio 2 (l(best) - l(s)) is at most n log(1 + t^2 / (n - 1)), where t is Student's quantile with n - 1 degrees of
    freedom: for normal data that is exactly the t interval, and it is the usual chi-square one for many pairs. Near 0
    and 1 it bends as the likelihood does. Its coverage is measured (docs/benchmarks.md). Fewer than two pairs
    contradict nothing.
    """
    n = sum(counts)
    if n < 2:
        return 0.0, 1.0
    if n <= few_pairs.MOST_PAIRS:
        return few_pairs.bounds(counts, confidence)
    threshold, weights, mean = _threshold(n, confidence), regularised(counts), mean_score(counts)
    if mean in (0.0, 1.0):
        return (mean, bound(weights, threshold, -1)) if mean == 0.0 else (bound(weights, threshold, 1), mean)
    return min(mean, bound(weights, threshold, 1)), max(mean, bound(weights, threshold, -1))


def is_contradicted(counts: Sequence[int], score: float, confidence: float = CONFIDENCE) -> bool:
    """Whether a mean score in (0, 1) lies outside the interval; quicker than the interval itself for many pairs."""
    n = sum(counts)
    if n <= few_pairs.MOST_PAIRS:
        low, high = score_interval(counts, confidence)
        return not low <= score <= high
    return -profile(regularised(counts), score) > _threshold(n, confidence)


@lru_cache(maxsize=1024)
def _threshold(n: int, confidence: float) -> float:
    """How far the log-likelihood may fall."""
    t = sidak_quantile(confidence, 1, n - 1)
    return 0.5 * n * math.log1p(t * t / (n - 1))


def superiority(counts: Sequence[int]) -> float:
    """Likelihood that the expected score is above a half.

    The signed root of the likelihood ratio at 1/2, on the same scale as the interval: above 97.5 % exactly when the
    interval of 95 % lies above a half. A half for fewer than two pairs.
    """
    n = sum(counts)
    if n < 2:
        return 0.5
    if n <= few_pairs.MOST_PAIRS:
        return few_pairs.superiority(counts)
    ratio = max(0.0, -2.0 * profile(regularised(counts), 0.5))
    t = math.sqrt((n - 1) * math.expm1(min(ratio / n, _LARGEST_EXPONENT)))
    return float(student_cdf(math.copysign(t, mean_score(counts) - 0.5), n - 1))


_LARGEST_EXPONENT = 700.0
