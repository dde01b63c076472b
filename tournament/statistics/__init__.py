"""Ratings, intervals, tests: what results say about strength, and how surely."""

from tournament.statistics.bradley_terry import rate
from tournament.statistics.elo import MOST_ELO, elo_of, expected_score
from tournament.statistics.ladder import Rung, ladder
from tournament.statistics.mean import Mean, mean_of
from tournament.statistics.ratings import Rating, Ratings
from tournament.statistics.score import Score, is_contradicted, score_interval, score_of, score_of_cells, superiority
from tournament.statistics.sprt import SprtDecision, SprtState, log_likelihood_ratio, sprt

__all__ = [
    "MOST_ELO",
    "Mean",
    "Rating",
    "Ratings",
    "Rung",
    "Score",
    "SprtDecision",
    "SprtState",
    "elo_of",
    "expected_score",
    "is_contradicted",
    "ladder",
    "log_likelihood_ratio",
    "mean_of",
    "rate",
    "score_interval",
    "score_of",
    "score_of_cells",
    "sprt",
    "superiority",
]
