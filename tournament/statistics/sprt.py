"""The sequential probability ratio test on pairs of games.

The generalised test of Stockfish's testing framework (LLRcalc.py): the likelihood of the five cells, greatest under
the expected score of elo1, against the greatest under that of elo0. The bounds are Wald's (Annals of Mathematical
Statistics 16, 1945, 117-186).
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import lru_cache
from typing import Any

from tournament.sprt_terms import SprtTerms
from tournament.statistics.elo import expected_score
from tournament.statistics.likelihood import CELL_SCORES, profile, regularised


class SprtDecision(StrEnum):
    """What a test says."""

    OPEN = "open"
    ELO0 = "elo0"
    """The difference is not more than elo0."""
    ELO1 = "elo1"
    """It is at least elo1."""


@dataclass(frozen=True, slots=True)
class SprtState:
    """A test after some pairs.

    Attributes:
        verdict: open, or which hypothesis is accepted.
        llr: logarithm of the likelihood ratio, elo1 over elo0; bounds: at which it decides.
        pairs: how many it has seen; after a decision it looks at no more.
    """

    verdict: SprtDecision
    llr: float
    bounds: tuple[float, float]
    pairs: int

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {"verdict": self.verdict.value, "llr": self.llr, "bounds": list(self.bounds), "pairs": self.pairs}


def sprt(terms: SprtTerms, cells: Iterable[int]) -> SprtState:
    """Test pairs in their order, stopping at the first decision.

    Args:
        terms: of the test.
        cells: for each pair, in the order of pairs (not of completion), the points of the first entrant times two:
            0 to 4.
    """
    lower, upper = terms.bounds
    counts = [0] * len(CELL_SCORES)
    seen, ratio = 0, 0.0
    for seen, cell in enumerate(cells, start=1):
        counts[cell] += 1
        ratio = log_likelihood_ratio(counts, terms.elo0, terms.elo1)
        if not lower < ratio < upper:
            return SprtState(SprtDecision.ELO1 if ratio >= upper else SprtDecision.ELO0, ratio, (lower, upper), seen)
    return SprtState(SprtDecision.OPEN, ratio, (lower, upper), seen)


def log_likelihood_ratio(counts: Sequence[int], elo0: float, elo1: float) -> float:
    """Logarithm of the likelihood of five cells under ``elo1`` over that under ``elo0``; 0 for no pairs."""
    return _ratio(tuple(counts), elo0, elo1)


@lru_cache(maxsize=1 << 16)
def _ratio(counts: tuple[int, ...], elo0: float, elo1: float) -> float:
    """Kept: a test looks at the same counts again after every game."""
    if not sum(counts):
        return 0.0
    weights = regularised(counts)
    return profile(weights, expected_score(elo1)) - profile(weights, expected_score(elo0))
