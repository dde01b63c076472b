"""Elo differences and expected scores: the logistic curve of Elo's system, and its slope.

A. Elo, The Rating of Chessplayers, Past and Present (1978), section 8.4: an advantage of d points gives the expected
score 1 / (1 + 10^(-d / 400)).
"""

import math

MOST_ELO = 1500.0
"""Elo differences are cut off here: a score within 2e-4 of 0 or 1, which no event tells from 0 or 1."""

_SCALE = 400.0


def expected_score(elo: float) -> float:
    """The expected score in [0, 1] of who is ``elo`` points stronger."""
    return 1.0 / (1.0 + math.pow(10.0, -elo / _SCALE))


def elo_of(score: float) -> float:
    """The Elo difference at which ``score`` is expected, within +-``MOST_ELO``."""
    if not 0.0 < score < 1.0:
        return math.copysign(MOST_ELO, score - 0.5)
    return max(-MOST_ELO, min(MOST_ELO, _SCALE * (math.log10(score) - math.log10(1.0 - score))))
