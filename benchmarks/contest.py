"""Which contest tells players apart? By table and noise: break-and-run, won breaks, Elo of ten times the thinking.

Where a break is often run out, the opponent cannot answer, and the better player shows in few pairs. A contest is the
better, the rarer that is and the less the score of a pair varies beside the difference it is to show: `pairs_to_tell`
is how many pairs bring the mean two and a half standard errors away from a half, ten times the thinking against one.
"""

from collections import Counter

import numpy as np
from scipy.stats import binomtest

from benchmarks.command import main
from benchmarks.lockstep import MatchUp, Played, play
from benchmarks.recording import Row, Tables
from benchmarks.search import score_row

TABLES, LEVELS = ("olympiad", "nine_foot"), (0.5, 1.0, 2.0, 5.0)
STRONG, WEAK, GREEDY = "search:shots=3000", "search:shots=300", "greedy"
PAIRS, GREEDY_PAIRS = {True: 20, False: 2}, {True: 8, False: 1}
SEED, ERRORS = 303, 2.5


def measure(full: bool) -> Tables:
    """A row for each table and level of noise."""
    scenes = [(table, noise) for table in TABLES for noise in LEVELS] if full else [("olympiad", 1.0)]
    return {"contest": [row(table, noise, PAIRS[full], GREEDY_PAIRS[full]) for table, noise in scenes]}


def row(table: str, noise: float, pairs: int, greedy_pairs: int) -> Row:
    """One contest: the player against itself with a tenth of the thinking, and `greedy` against that."""
    games = play(MatchUp((STRONG, WEAK), noise, table, seed=SEED, pairs=pairs))
    others = play(MatchUp((GREEDY, WEAK), noise, table, seed=SEED, pairs=greedy_pairs))
    cells = points(games)
    of_pairs = np.repeat(np.arange(5) / 4.0, [cells[cell] for cell in range(5)])
    variance, gain = float(of_pairs.var(ddof=1)), float(of_pairs.mean()) - 0.5
    return {
        "table": table,
        "noise": noise,
        **score_row(cells),
        "pair_variance": round(variance, 4),
        "pairs_to_tell": round(ERRORS**2 * variance / gain**2) if gain > 0.0 else None,
        "breaks_kept": round(float(np.mean([game.kept for game in games])), 3),
        "breaks_won": round(float(np.mean([game.winner == game.breaker for game in games])), 3),
        **runs(games, 0, "break_and_run"),
        **runs(games, 1, "of_a_tenth"),
        **runs(others, 0, "of_greedy"),
    }


def points(games: list[Played]) -> Counter[int]:
    """Pairs by twice the first player's points."""
    found: Counter[int] = Counter()
    for game in games:
        found[game.pair] += 1 if game.winner is None else 2 * (game.winner == 0)
    return Counter(found.values())


def runs(games: list[Played], player: int, name: str) -> Row:
    """The share of a player's breaks that it ran out, with its interval."""
    broke = [game.run_out for game in games if game.breaker == player]
    interval = binomtest(sum(broke), len(broke)).proportion_ci(0.95)
    return {
        name: round(float(np.mean(broke)), 3),
        f"{name}_low_95": round(float(interval.low), 3),
        f"{name}_high_95": round(float(interval.high), 3),
    }


if __name__ == "__main__":
    main("contest", measure)
