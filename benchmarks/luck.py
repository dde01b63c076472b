"""Is the score without luck unbiased, and how much variance does it save? Whole games of unequal players at known odds.

The careful player of `benchmarks.straight_pots` against the careless one. Its true share of the points comes from many
games
without any correction; the games that luck is measured in are others. If the correction is unbiased, the mean luck is
zero and the corrected mean agrees with the true share, both within a few standard errors.
"""

import numpy as np

import client
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from benchmarks.straight_pots import Potter
from client.local_game import PlayedGame, points_of
from tournament.luck import VALUE, game_luck

SEED = 17
LEVELS = (1.0, 3.0)
GAMES, TRUTH = {True: 150, False: 5}, {True: 600, False: 10}
DRAWS = 40


def measure(full: bool) -> Tables:
    """A row for each noise level."""
    return {"correction": [study(level, GAMES[full], TRUTH[full]) for level in LEVELS]}


def study(level: float, games: int, truth: int) -> Row:
    """Points as played and without luck, at one level."""
    true = [points_of(play(level, 10_000 + number).outcome)[0] for number in range(truth)]
    found = [game_luck(list(play(level, number).record()), draws=DRAWS) for number in range(games)]
    played = np.array([each.points[0] for each in found])
    corrected = np.array([each.corrected(0) for each in found])
    strokes = np.array([one.luck for each in found for one in each.strokes])
    luck = played - corrected
    return {
        "noise": level,
        "games": games,
        "true_share": round(float(np.mean(true)), 4),
        "error_of_truth": error(np.array(true)),
        "as_played": round(float(played.mean()), 4),
        "its_error": error(played),
        "without_luck": round(float(corrected.mean()), 4),
        "error_without": error(corrected),
        "mean_luck": round(float(luck.mean()), 4),
        "error_of_luck": error(luck),
        "variance_saved": round(1.0 - float(corrected.var() / played.var()), 4),
        "mean_luck_of_a_stroke": round(float(strokes.mean()), 5),
        "error_of_a_stroke": error(strokes),
        "strokes": len(strokes),
        "value": VALUE.source,
    }


def play(level: float, number: int) -> PlayedGame:
    """One game, careful against careless."""
    seed = SEED * 1_000_000 + number
    (game,) = client.play(lambda: Potter(True, seed), lambda: Potter(False, seed + 1), seed=seed, noise=level).games
    return game


def error(values: np.ndarray) -> float:
    """Standard error of a mean."""
    return round(float(values.std(ddof=1) / np.sqrt(len(values))), 5)


if __name__ == "__main__":
    main("luck", measure)
