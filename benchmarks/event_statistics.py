"""Do the statistics of events keep their promises? Simulated events with known truth.

Coverage of the 95 % interval of a score, by true score, number of pairs and share of draws: for few pairs exactly, over
all that can happen, for many by simulation (a share of 2,000 events around 95 % has a standard deviation of 0.5 %);
error rates of the sequential test; coverage of the ratings of whole tables, each by itself, all at once, and of their
ranks; the dispersion factor and its bootstrap; coverage of scores without luck; the time of an interval.
"""

import math
import time
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from benchmarks.command import main
from benchmarks.pairs_by_lot import KINSHIP, cell_chances, draw_cells
from benchmarks.recording import Row, Tables
from tournament import GameResult, SprtTerms
from tournament.statistics import (
    Ratings,
    SprtDecision,
    SprtState,
    expected_score,
    is_contradicted,
    mean_of,
    rate,
    score_interval,
    sprt,
)
from tournament.statistics.bradley_terry import ELO_PER_UNIT
from tournament.statistics.few_pairs import MOST_PAIRS, every_outcome

SEED = 3
EVENTS, TESTED = {True: 2000, False: 200}, {True: 5000, False: 200}
SCORES, DRAWS = (0.5, 0.6, 0.75, 0.9), (0.0, 0.1, 0.4)
FEW, MANY = {True: (3, 5, 6, 8, 10, 12), False: (3,)}, (20, 50, 100, 200)
LUCKY = (3, 5, 10, 20, 50)
PROMISE = 0.95
TESTS = ((0.0, 100.0), (-25.0, 75.0), (0.0, 200.0))
TABLES = (
    (2, 20, 0.5), (2, 100, 1.0), (4, 5, 0.7), (4, 20, 0.7), (8, 2, 0.7), (8, 5, 0.0), (8, 5, 1.5), (12, 1, 1.0),
    (20, 2, 1.0),
)  # fmt: skip
"""Players, pairs of each meeting, half the spread of the true strengths."""
LONGEST = 2000
EXPLAINED = 1.6
"""How much of the noise the value function knows, in standard deviations of what it does not: half of the variance of
the points of equal players is luck then, as in real games (docs/benchmarks.md, "Luck").
"""


def measure(full: bool) -> Tables:
    """All studies."""
    events = EVENTS[full]
    return {
        "interval_time": [interval_time(pairs) for pairs in (100, 3, 6, 9, MOST_PAIRS)],  # first: nothing is kept yet
        "few_pairs": [exact_coverage(score, pairs) for pairs in FEW[full] for score in SCORES],
        "coverage": [coverage(score, pairs, events) for pairs in MANY for score in SCORES],
        "sprt": [errors(test, draws, TESTED[full]) for test in TESTS for draws in (0.0, 0.4)],
        "ratings": [rating_coverage(*table, draws, events // 10) for table in TABLES for draws in (0.0, 0.4)],
        "without_luck": [luck_coverage(score, pairs, events) for pairs in LUCKY for score in SCORES],
    }


def exact_coverage(score: float, pairs: int) -> Row:
    """Chances that the interval holds the true score, lies below or above it; the attainable one nearest to 95 %."""
    row: Row = {"pairs": pairs, "true_score": score}
    outcomes, log_ways, shortfalls = every_outcome(pairs, score)
    low, high = intervals(pairs).T
    for draws in DRAWS:
        chances = np.exp(log_ways + outcomes @ np.log(np.maximum(cell_chances(score, draws), 1e-300)))
        row[f"covered_draws_{round(100 * draws)}"] = round(float(chances[(low <= score) & (score <= high)].sum()), 4)
        row[f"below_draws_{round(100 * draws)}"] = round(float(chances[high < score].sum()), 4)
        row[f"above_draws_{round(100 * draws)}"] = round(float(chances[low > score].sum()), 4)
        row[f"nearest_draws_{round(100 * draws)}"] = round(nearest(chances, shortfalls), 4)
        row[f"width_draws_{round(100 * draws)}"] = round(float(chances @ (high - low)), 3)
    return row


@lru_cache(maxsize=8)
def intervals(pairs: int) -> NDArray[np.float64]:
    """The interval of every outcome, (m, 2); that of the other side of the table is the mirror image."""
    found: dict[tuple[int, ...], tuple[float, float]] = {}
    outcomes = [tuple(counts) for counts in every_outcome(pairs, 0.5)[0].astype(int).tolist()]
    for counts in outcomes:
        if counts not in found:
            low, high = found[counts] = score_interval(counts)
            found.setdefault(counts[::-1], (1.0 - high, 1.0 - low))
    return np.array([found[counts] for counts in outcomes])


def nearest(chances: NDArray[np.float64], shortfalls: NDArray[np.float64]) -> float:
    """Of the coverages that leaving out the unlikeliest outcomes can have, the one nearest to what is promised.

    Who knew the true distribution could choose among these; between them lies nothing.
    """
    order = np.argsort(shortfalls)
    last = np.append(np.diff(shortfalls[order]) > 1e-7, True)  # equally unlikely ones are left out together
    attainable = np.cumsum(chances[order])[last]
    return float(attainable[np.argmin(np.abs(attainable - PROMISE))])


def coverage(score: float, pairs: int, events: int) -> Row:
    """Share of events whose interval holds the true score, one column a share of draws."""
    row: Row = {"pairs": pairs, "true_score": score}
    for draws in DRAWS:
        chance = np.random.default_rng((SEED, pairs, round(1000 * score), round(100 * draws)))
        cells = draw_cells(score, draws, (events, pairs), chance)
        counts = [np.bincount(one, minlength=5).tolist() for one in cells]
        held = 1.0 - np.mean([is_contradicted(one, score) for one in counts])
        widths = [high - low for low, high in map(score_interval, counts[: events // 20])]
        row[f"covered_draws_{round(100 * draws)}"] = round(float(held), 4)
        row[f"width_draws_{round(100 * draws)}"] = round(float(np.mean(widths)), 3)
    return row


def errors(test: tuple[float, float], draws: float, events: int) -> Row:
    """Error rates of a sequential test with 5 % allowed for each, and how many pairs it took."""
    terms = SprtTerms(*test)
    at0, at1 = (states(terms, elo, draws, events) for elo in test)
    verdicts0, verdicts1 = ([state.verdict for state in at] for at in (at0, at1))
    return {
        "elo0": test[0],
        "elo1": test[1],
        "draws": draws,
        **share("false_elo1", verdicts0.count(SprtDecision.ELO1), events),
        **share("false_elo0", verdicts1.count(SprtDecision.ELO0), events),
        "allowed": terms.alpha,
        "undecided": verdicts0.count(SprtDecision.OPEN) + verdicts1.count(SprtDecision.OPEN),
        "pairs_at_elo0": round(float(np.mean([state.pairs for state in at0])), 1),
        "pairs_at_elo1": round(float(np.mean([state.pairs for state in at1])), 1),
        "events": events,
    }


def share(name: str, count: int, events: int) -> Row:
    """A share with its 95 % interval (Wilson, JASA 22, 1927)."""
    found, z = count / events, 1.96
    centre = (count + z * z / 2.0) / (events + z * z)
    half = z * math.sqrt(events * found * (1.0 - found) + z * z / 4.0) / (events + z * z)
    return {name: round(found, 4), f"{name}_from": round(centre - half, 4), f"{name}_to": round(centre + half, 4)}


def states(terms: SprtTerms, elo: float, draws: float, events: int) -> list[SprtState]:
    """Tests run to their decision."""
    chance = np.random.default_rng((SEED, round(elo) + 10_000, round(100 * draws)))
    score = expected_score(elo)
    return [sprt(terms, draw_cells(score, draws, (LONGEST,), chance).tolist()) for _ in range(events)]


def rating_coverage(players: int, pairs: int, half: float, draws: float, events: int) -> Row:
    """Shares of ratings whose interval holds the true one, and of events where all hold at once."""
    chance = np.random.default_rng((SEED, players, pairs))
    truth = np.linspace(-half, half, players)
    tables = [rate(table_by_lot(truth, pairs, draws, chance)) for _ in range(events)]
    alone, together, ranked = np.array([held(table, truth) for table in tables]).T
    checked = [one for one in tables if one.bootstrap_dispersion is not None]
    factors = np.array([(one.dispersion, one.bootstrap_dispersion) for one in checked], dtype=np.float64)
    return {
        "players": players,
        "pairs_a_meeting": pairs,
        "elo_from_first_to_last": round(2.0 * half * ELO_PER_UNIT),
        "draws": draws,
        "covered": round(float(alone.mean()), 4),
        "all_by_chance": round(float((alone == 1.0).mean()), 4),
        "simultaneous": round(float(together.mean()), 4),
        "ranks": round(float(ranked.mean()), 4),
        "dispersion": round(float(factors[:, 0].mean()), 3),
        "bootstrap": round(float(factors[:, 1].mean()), 3),
        "apart": round(float(np.quantile(np.abs(factors[:, 1] / factors[:, 0] - 1.0), 0.95)), 3),
        "ratings": players * events,
    }


def held(table: Ratings, truth: NDArray[np.float64]) -> tuple[float, bool, bool]:
    """Share of the marginal intervals that hold the truth; whether all simultaneous ones do; whether all ranks do."""
    at = [ELO_PER_UNIT * float(truth[int(one.name)]) for one in table.table]
    ranks = [1 + sum(other > mine for other in at) for mine in at]
    alone = [one.low <= elo <= one.high for one, elo in zip(table.table, at, strict=True)]
    together = [one.simultaneous_low <= elo <= one.simultaneous_high for one, elo in zip(table.table, at, strict=True)]
    ranked = [one.best_rank <= rank <= one.worst_rank for one, rank in zip(table.table, ranks, strict=True)]
    return sum(alone) / len(alone), all(together), all(ranked)


def luck_coverage(score: float, pairs: int, events: int) -> Row:
    """How often the interval of the score without luck holds the true score, and its width next to that of the points.

    A game is won with the probability that its noise leaves; part of the noise is known to a value function that takes
    the players for equal, as the one of the luck report does. The second game of a pair repeats the first one's noise
    with probability ``KINSHIP``.
    """
    from scipy.special import ndtr, ndtri

    chance = np.random.default_rng((SEED, pairs, round(1000 * score), 7))
    lots = chance.uniform(size=(2, events, pairs, 2))
    lots[..., 1] = np.where(chance.uniform(size=(events, pairs)) < KINSHIP, lots[..., 0], lots[..., 1])
    known = EXPLAINED * ndtri(lots[0])
    points = (lots[1] < ndtr(ndtri(score) * math.hypot(1.0, EXPLAINED) + known)).astype(np.float64)
    corrected = points - (ndtr(known) - 0.5)
    of_pair = np.repeat(np.arange(pairs), 2).tolist()
    intervals = [mean_of(games, of_pair) for games in corrected.reshape(events, -1).tolist()]
    played = [mean_of(games, of_pair) for games in points.reshape(events, -1).tolist()]
    sure = [(one.low, one.high) for one in intervals if one.low is not None and one.high is not None]
    plain = [one.high - one.low for one in played if one.low is not None and one.high is not None]
    return {
        "pairs": pairs,
        "true_score": score,
        "mean": round(float(corrected.mean()), 4),
        "covered": round(float(np.mean([low <= score <= high for low, high in sure])), 4),
        "width": round(float(np.mean([high - low for low, high in sure])), 3),
        "width_as_played": round(float(np.mean(plain)), 3),
        "events": events,
    }


def interval_time(pairs: int) -> Row:
    """Processor time of an interval: the first one for this number of pairs, and the median of others."""
    chance = np.random.default_rng((SEED, pairs))
    seconds = []
    for cells in chance.integers(0, 5, size=(11, pairs)):
        before = time.process_time()
        score_interval(np.bincount(cells, minlength=5).tolist())
        seconds.append(time.process_time() - before)
    return {
        "pairs": pairs,
        "first_ms": round(1e3 * seconds[0], 1),
        "median_ms": round(1e3 * float(np.median(seconds[1:])), 2),
    }


def table_by_lot(truth: np.ndarray, pairs: int, draws: float, chance: np.random.Generator) -> list[GameResult]:
    """A round robin of players of known strengths."""
    games = []
    for one in range(len(truth)):
        for other in range(one + 1, len(truth)):
            score = 1.0 / (1.0 + np.exp(truth[other] - truth[one]))
            for index, cell in enumerate(draw_cells(score, draws, (pairs,), chance).tolist()):
                games += pair_of(one, other, index, cell)
    return games


def pair_of(one: int, other: int, index: int, cell: int) -> list[GameResult]:
    """Two games with so many half points for the first player."""
    winners = ((1, 1), (None, 1), (0, 1), (0, None), (0, 0))[cell]
    players = (str(one), str(other))
    reasons = ["eight_made" if winner is not None else "stalemate" for winner in winners]
    return [
        GameResult(f"{one}-{other}-{index}", leg, players, leg, winners[leg], reasons[leg])  # type: ignore[arg-type]
        for leg in (0, 1)
    ]


if __name__ == "__main__":
    main("event_statistics", measure)
