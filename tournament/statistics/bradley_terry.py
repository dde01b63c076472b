"""Ratings of a whole table: the Bradley-Terry model on pairs of games, with a weak prior.

The expected score of i against j is 1 / (1 + exp(r_j - r_i)) (Bradley & Terry, Biometrika 39, 1952, 324-345), a draw
half a win: the equations then ask that everybody's expected points equal the points made, whatever the share of draws.
Draws and the ties between the two games of a pair make the variance of a pair's points other than binomial: by one
factor for the whole table, estimated from the residuals (quasi-likelihood: Wedderburn, Biometrika 61, 1974, 439-447).

The prior: everybody has also played one drawn game against an average player. It keeps 200-0 finite and joins tables
that fall apart.

Intervals are Student's. A marginal one holds its own true rating with 95 % confidence; of many, some miss. The
simultaneous ones hold all true ratings at once with 95 % confidence, and so do the intervals of ranks, which follow
from the differences between all ratings (Mogstad, Romano, Shaikh & Wilhelm, Review of Economic Studies 91, 2024,
476-518). Both quantiles are Sidak's (JASA 62, 1967, 626-633): valid however the estimates depend on each other.
"""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tournament.results import GameResult
from tournament.statistics.ratings import Floats, Rating, Ratings, gaps
from tournament.statistics.student import sidak_quantile

CONFIDENCE = 0.95
ELO_PER_UNIT = 400.0 / math.log(10.0)
"""Elo points of one unit of r."""
PRIOR_GAMES = 1.0
"""Drawn games against an average player that everybody is given."""
PRIOR_VARIANCE = 2.0
"""Weight of the assumption that a pair's points vary like those of two independent games, in units of that variance: as
if four pairs of even games had shown exactly that.
"""

_ROUNDS = 100


@dataclass(frozen=True, slots=True)
class _Pairs:
    """Pairs of games as arrays, in the order of their ids: who met whom, games, points of the first."""

    first: NDArray[np.intp]
    second: NDArray[np.intp]
    games: Floats
    points: Floats


def rate(games: Iterable[GameResult], names: Sequence[str] = ()) -> Ratings:
    """Rate everybody in these games; ``names`` may add players without any.

    Games whose partner has no result count by themselves.
    """
    counted = [game for game in games if game.counts]
    everybody = tuple(dict.fromkeys([*names, *(name for game in counted for name in game.players)]))
    pairs = _pairs_of(counted, everybody)
    strengths = _fit(pairs, len(everybody))
    return _ratings(everybody, counted, pairs, strengths)


def _pairs_of(games: Sequence[GameResult], names: Sequence[str]) -> _Pairs:
    """The pairs of these games, all of which count, among players with these names."""
    place = {name: index for index, name in enumerate(names)}
    points_of: dict[tuple[str, int, int], list[float]] = {}
    for game in games:
        one, other = sorted(place[name] for name in game.players)
        points_of.setdefault((game.pair, one, other), []).append(game.points_of(names[one]))
    rows = sorted(points_of.items())
    return _Pairs(
        np.array([one for (_, one, _), _ in rows], dtype=np.intp),
        np.array([other for (_, _, other), _ in rows], dtype=np.intp),
        np.array([len(points) for _, points in rows], dtype=np.float64),
        np.array([sum(points) for _, points in rows], dtype=np.float64),
    )


def _fit(pairs: _Pairs, n: int) -> Floats:
    """The strengths of greatest likelihood times prior: Newton's method on a concave function, halved when too far."""
    r = np.zeros(n)
    best = _objective(pairs, r)
    for _ in range(_ROUNDS):
        step = np.linalg.solve(_information(pairs, r), _slope(pairs, r)) if n else r
        while (value := _objective(pairs, r + step)) < best and np.abs(step).max() > 1e-12:
            step = step / 2.0
        if n == 0 or np.abs(step).max() < 1e-10:
            break
        r, best = r + step, value
    return r


def _expected(pairs: _Pairs, r: Floats) -> Floats:
    """Expected score of the first of each pair."""
    return _logistic(r[pairs.first] - r[pairs.second])


def _objective(pairs: _Pairs, r: Floats) -> float:
    gap = r[pairs.first] - r[pairs.second]
    likelihood = pairs.points @ -np.logaddexp(0.0, -gap) + (pairs.games - pairs.points) @ -np.logaddexp(0.0, gap)
    prior = -0.5 * PRIOR_GAMES * (np.logaddexp(0.0, r) + np.logaddexp(0.0, -r)).sum()
    return float(likelihood + prior)


def _slope(pairs: _Pairs, r: Floats) -> Floats:
    excess = pairs.points - pairs.games * _expected(pairs, r)
    slope = PRIOR_GAMES * (0.5 - _logistic(r))
    np.add.at(slope, pairs.first, excess)
    np.add.at(slope, pairs.second, -excess)
    return slope


def _information(pairs: _Pairs, r: Floats, prior: float = PRIOR_GAMES) -> Floats:
    """(n, n): the negative curvature of the log-likelihood and of the prior."""
    share, mine = _expected(pairs, r), _logistic(r)
    return _laplacian(pairs, pairs.games * share * (1.0 - share), len(r)) + np.diag(prior * mine * (1.0 - mine))


def _laplacian(pairs: _Pairs, weights: Floats, n: int) -> Floats:
    """(n, n): sum over the pairs of weight x x', where x is 1 for the first player and -1 for the second."""
    matrix = np.zeros((n, n))
    np.add.at(matrix, (pairs.first, pairs.first), weights)
    np.add.at(matrix, (pairs.second, pairs.second), weights)
    np.add.at(matrix, (pairs.first, pairs.second), -weights)
    np.add.at(matrix, (pairs.second, pairs.first), -weights)
    return matrix


def _logistic(x: Floats) -> Floats:
    """1 / (1 + exp(-x)) without overflow."""
    value: Floats = np.exp(-np.logaddexp(0.0, -x))
    return value


def _freed(pairs: _Pairs, n: int) -> float:
    """By what squared residuals grow, since n - 1 fitted ratings have made them smaller than deviations."""
    used = min(n, len(pairs.games)) - 1
    return len(pairs.games) / (len(pairs.games) - used) if used > 0 else 1.0


def _dispersion(pairs: _Pairs, r: Floats) -> float:
    """How much more than binomial the points of pairs vary; 1 without evidence."""
    share = _expected(pairs, r)
    variance = float((pairs.games * share * (1.0 - share)).sum())
    residual = float(((pairs.points - pairs.games * share) ** 2).sum())
    return (PRIOR_VARIANCE + residual * _freed(pairs, len(r))) / (PRIOR_VARIANCE + variance)


def _bootstrap_dispersion(pairs: _Pairs, r: Floats) -> float | None:
    """How far ratings scatter when pairs are drawn again from those played, against two independent games a pair.

    The limit of infinitely many replications, to first order (the infinitesimal jackknife: Efron, Biometrika 68, 1981,
    589-599): each pair moves the ratings by its residual times the inverse of the information. Where pairs of some
    players vary more than those of others, one factor for all is wrong, and this one differs from it.
    """
    n = len(r)
    if len(pairs.games) < max(2, n):
        return None
    centre = np.eye(n) - 1.0 / n
    moved = centre @ np.linalg.inv(_information(pairs, r))
    residual = pairs.points - pairs.games * _expected(pairs, r)
    seen = moved @ _laplacian(pairs, residual**2, n) @ moved.T
    independent = moved @ _information(pairs, r, prior=0.0) @ moved.T
    return float(np.trace(seen) / np.trace(independent)) * _freed(pairs, n)


def _ratings(names: tuple[str, ...], games: Sequence[GameResult], pairs: _Pairs, r: Floats) -> Ratings:
    n = len(names)
    dispersion, again = _dispersion(pairs, r), _bootstrap_dispersion(pairs, r)
    dof = max(1.0, len(pairs.games) - n + 1.0)
    centre = np.eye(n) - 1.0 / n if n else np.eye(0)
    covariance = dispersion * ELO_PER_UNIT**2 * centre @ np.linalg.inv(_information(pairs, r)) @ centre
    elo = ELO_PER_UNIT * (r - r.mean()) if n else r
    apart = gaps(elo, covariance) > sidak_quantile(CONFIDENCE, n * (n - 1) // 2, dof)
    played = Counter(name for game in games for name in game.players)
    spread = np.sqrt(np.diag(covariance))
    columns = np.array(
        [elo + times * sidak_quantile(CONFIDENCE, among, dof) * spread for among in (1, n) for times in (-1.0, 1.0)]
    ).T.tolist()
    ranks = zip((1 + apart.sum(axis=0)).tolist(), (n - apart.sum(axis=1)).tolist(), strict=True)
    table = [
        Rating(name, float(elo[i]), low, high, played[name], all_low, all_high, best, worst)
        for i, (name, (low, high, all_low, all_high), (best, worst)) in enumerate(
            zip(names, columns, ranks, strict=True)
        )
    ]
    return Ratings(tuple(sorted(table, key=lambda one: -one.elo)), names, elo, covariance, dispersion, again, dof)
