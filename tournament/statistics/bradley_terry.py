"""Ratings of a whole table: the Bradley-Terry model on pairs of games, with a weak prior.

The expected score of i against j is 1 / (1 + exp(r_j - r_i)) (Bradley & Terry, Biometrika 39, 1952, 324-345), a draw
half a win: the equations then ask that everybody's expected points equal the points made, whatever the share of draws.
Draws and the ties between the two games of a pair make the variance of a pair's points other than binomial: by one
factor for the whole table, estimated from the residuals (quasi-likelihood: Wedderburn, Biometrika 61, 1974, 439-447).

The prior: everybody has also played one drawn game against an average player. It keeps 200-0 finite and joins tables
that fall apart.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tournament.results import GameResult
from tournament.statistics.normal import normal_cdf, student_quantile

ELO_PER_UNIT = 400.0 / math.log(10.0)
"""Elo points of one unit of r."""
PRIOR_GAMES = 1.0
"""Drawn games against an average player that everybody is given."""
PRIOR_VARIANCE = 2.0
"""Weight of the assumption that a pair's points vary like those of two independent games, in units of that variance: as
if four pairs of even games had shown exactly that.
"""

Floats = NDArray[np.float64]

_ROUNDS = 100


@dataclass(frozen=True, slots=True)
class Rating:
    """An entrant's rating, in Elo points above the mean of the table.

    Attributes:
        name: of the entrant; elo: rating; low, high: its interval of 95 % confidence; games: counted.
    """

    name: str
    elo: float
    low: float
    high: float
    games: int

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {name: getattr(self, name) for name in self.__slots__}


@dataclass(frozen=True)
class Ratings:
    """All ratings of a table.

    Attributes:
        table: by rating, the highest first.
        names: in the order of ``elo`` and ``covariance``.
        elo: (n,), mean 0. covariance: (n, n), Elo^2.
        dispersion: variance of a pair's points relative to two independent games.
    """

    table: tuple[Rating, ...]
    names: tuple[str, ...]
    elo: Floats
    covariance: Floats
    dispersion: float

    def superiority(self, one: str, other: str) -> float:
        """Likelihood that ``one`` is stronger than ``other``; ``ValueError`` for an unknown name."""
        i, j = self.names.index(one), self.names.index(other)
        if i == j:
            return 0.5
        variance = self.covariance[i, i] + self.covariance[j, j] - 2.0 * self.covariance[i, j]
        return normal_cdf(float(self.elo[i] - self.elo[j]) / math.sqrt(float(variance)))


@dataclass(frozen=True, slots=True)
class _Pairs:
    """Pairs as arrays: who met whom, games, points of the first."""

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
    pairs = _pairs(counted, everybody)
    strengths = _fit(pairs, len(everybody))
    return _ratings(everybody, counted, pairs, strengths)


def _pairs(games: Sequence[GameResult], names: Sequence[str]) -> _Pairs:
    place = {name: index for index, name in enumerate(names)}
    rows: dict[tuple[str, int, int], list[float]] = {}
    for game in games:
        one, other = sorted(place[name] for name in game.players)
        rows.setdefault((game.pair, one, other), []).append(game.points_of(names[one]))
    return _Pairs(
        np.array([one for _, one, _ in rows], dtype=np.intp),
        np.array([other for _, _, other in rows], dtype=np.intp),
        np.array([len(points) for points in rows.values()], dtype=np.float64),
        np.array([sum(points) for points in rows.values()], dtype=np.float64),
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


def _information(pairs: _Pairs, r: Floats) -> Floats:
    share = _expected(pairs, r)
    weight = pairs.games * share * (1.0 - share)
    mine = _logistic(r)
    matrix = np.diag(PRIOR_GAMES * mine * (1.0 - mine))
    np.add.at(matrix, (pairs.first, pairs.first), weight)
    np.add.at(matrix, (pairs.second, pairs.second), weight)
    np.add.at(matrix, (pairs.first, pairs.second), -weight)
    np.add.at(matrix, (pairs.second, pairs.first), -weight)
    return matrix


def _logistic(x: Floats) -> Floats:
    """1 / (1 + exp(-x)) without overflow."""
    value: Floats = np.exp(-np.logaddexp(0.0, -x))
    return value


def _dispersion(pairs: _Pairs, r: Floats) -> float:
    """How much more than binomial the points of pairs vary; 1 without evidence.

    Residuals are smaller than deviations by the parameters fitted to them: n - 1 of the pairs go for that.
    """
    share = _expected(pairs, r)
    variance = float((pairs.games * share * (1.0 - share)).sum())
    residual = float(((pairs.points - pairs.games * share) ** 2).sum())
    used = min(len(r) - 1, len(pairs.games) - 1)
    freed = len(pairs.games) / (len(pairs.games) - used) if used > 0 else 1.0
    return (PRIOR_VARIANCE + residual * freed) / (PRIOR_VARIANCE + variance)


def _ratings(names: tuple[str, ...], games: Sequence[GameResult], pairs: _Pairs, r: Floats) -> Ratings:
    n = len(names)
    dispersion = _dispersion(pairs, r)
    centre = np.eye(n) - 1.0 / n if n else np.eye(0)
    covariance = dispersion * ELO_PER_UNIT**2 * centre @ np.linalg.inv(_information(pairs, r)) @ centre
    elo = ELO_PER_UNIT * (r - r.mean()) if n else r
    t = student_quantile(0.975, max(1.0, len(pairs.games) - n + 1.0))
    played = dict.fromkeys(names, 0)
    for game in games:
        for name in game.players:
            played[name] += 1
    table = [
        Rating(name, float(elo[i]), float(elo[i] - t * spread), float(elo[i] + t * spread), played[name])
        for i, (name, spread) in enumerate(zip(names, np.sqrt(np.diag(covariance)).tolist(), strict=True))
    ]
    return Ratings(tuple(sorted(table, key=lambda one: -one.elo)), names, elo, covariance, dispersion)
