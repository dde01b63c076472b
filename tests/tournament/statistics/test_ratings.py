"""Ratings of a table against scipy's optimum, and what they promise (docs/tournaments.md, "Ratings")."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import optimize, stats
from support.events import by_lot, play, spec_of

from referee.game import EndReason
from tournament import GameResult, Tournament
from tournament.statistics import ladder, rate
from tournament.statistics.bradley_terry import ELO_PER_UNIT, PRIOR_GAMES


def games_of(rows):
    """Games from rows (first, second, winner's seat or None), two a pair."""
    return [
        GameResult(f"p{number // 2}", number % 2, (one, other), number % 2, winner, EndReason.EIGHT_MADE)
        for number, (one, other, winner) in enumerate(rows)
    ]


def minus_log_posterior(r, names, games):
    total = 0.0
    for game in games:
        gap = r[names.index(game.players[0])] - r[names.index(game.players[1])]
        total += game.points[0] * np.logaddexp(0, -gap) + game.points[1] * np.logaddexp(0, gap)
    return total + sum(0.5 * PRIOR_GAMES * (np.logaddexp(0, x) + np.logaddexp(0, -x)) for x in r)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_ratings_are_scipys_optimum(seed):
    event = play(Tournament(spec_of(5, pairs=3)), by_lot(seed))
    ratings = rate(event.results)
    names = list(ratings.names)
    found = optimize.minimize(minus_log_posterior, np.zeros(5), (names, event.results), tol=1e-12)
    expected = ELO_PER_UNIT * (found.x - found.x.mean())
    assert np.allclose(ratings.elo, expected, atol=0.01)


def test_two_hundred_to_nothing_by_hand():
    """Each has a = half the gap: 200 / (1 + exp(2a)) = (logistic(a) - 1/2)."""
    ratings = rate(games_of([("a", "b", 0)] * 200))
    half = optimize.brentq(lambda a: 200 / (1 + math.exp(2 * a)) - (1 / (1 + math.exp(-a)) - 0.5), 0, 20)
    first, last = ratings.table
    assert (first.name, last.name) == ("a", "b")
    assert first.elo - last.elo == pytest.approx(2 * half * ELO_PER_UNIT, abs=1e-3)
    assert 400 < 2 * first.low < 2 * first.high < 2500


tables = st.lists(
    st.tuples(st.sampled_from("abcd"), st.sampled_from("efgh"), st.sampled_from([0, 1, None])), min_size=0, max_size=60
)


@given(tables)
@settings(deadline=None)
def test_nothing_is_ever_infinite(rows):
    ratings = rate(games_of(rows), names=["nobody"])
    for rating in ratings.table:
        assert all(math.isfinite(value) for value in (rating.elo, rating.low, rating.high))
        assert rating.low < rating.elo < rating.high or len(ratings.table) == 1
    assert math.isfinite(ratings.dispersion)
    assert ratings.dispersion > 0


@given(tables)
@settings(deadline=None, max_examples=50)
def test_intervals_of_all_hold_those_of_each_and_ranks_hold_the_order(rows):
    """Simultaneous intervals are wider; whoever is told apart from nobody may have any rank."""
    ratings = rate(games_of(rows), names=["nobody"])
    n = len(ratings.table)
    for place, rating in enumerate(ratings.table, start=1):
        assert rating.simultaneous_low <= rating.low <= rating.high <= rating.simultaneous_high
        assert 1 <= rating.best_rank <= place <= rating.worst_rank <= n
    # Each entrant surely stronger makes one worse rank impossible for another: both sides count the same pairs.
    assert sum(one.best_rank - 1 for one in ratings.table) == sum(n - one.worst_rank for one in ratings.table)


def test_a_clear_order_has_clear_ranks():
    """300 games each way of three: the differences are some eight standard errors, the ranks certain."""
    rows = [("a", "b", 0), ("b", "c", 0), ("a", "c", 0), ("a", "b", 0), ("b", "c", 0), ("a", "c", 1)] * 50
    ranks = {one.name: (one.best_rank, one.worst_rank) for one in rate(games_of(rows)).table}
    assert ranks == {"a": (1, 1), "b": (2, 2), "c": (3, 3)}


def test_the_simultaneous_quantile_is_sidaks():
    """Ten pairs, nine degrees of freedom: both intervals by scipy's quantiles."""
    rows = [("a", "b", 0), ("a", "b", 1), ("a", "b", 0), ("a", "b", 0)] * 5
    ratings = rate(games_of(rows))
    first = ratings.table[0]
    alone, together = (stats.t.ppf(0.5 + 0.5 * 0.95 ** (1 / among), 10 - 1) for among in (1, 2))
    assert ratings.dof == 9
    assert (first.simultaneous_high - first.elo) / (first.high - first.elo) == pytest.approx(together / alone)


@given(tables)
@settings(deadline=None, max_examples=30)
def test_superiorities_are_those_of_two_sides(rows):
    ratings = rate(games_of(rows), names=["x", "y"])
    matrix = ratings.superiorities()
    assert np.allclose(matrix + matrix.T, 1.0)
    assert np.allclose(np.diag(matrix), 0.5)
    first, last = ratings.table[0].name, ratings.table[-1].name
    assert ratings.superiority(first, last) >= 0.5
    assert matrix[ratings.names.index(first), ratings.names.index(last)] == ratings.superiority(first, last)


def drawn_again(games, names, chance):
    """The ratings of as many pairs, drawn with replacement from those played."""
    pairs: dict[str, list[GameResult]] = {}
    for game in games:
        pairs.setdefault(game.pair, []).append(game)
    drawn = chance.choice(len(pairs), size=len(pairs))
    fresh = [replace(game, pair=f"{place}") for place, at in enumerate(drawn) for game in list(pairs.values())[at]]
    return rate(fresh, names).elo


def test_the_bootstrap_of_the_dispersion_is_what_drawing_pairs_again_gives():
    """Efron's bootstrap by lot, 150 replications: its scatter over that of the model is the factor."""
    event = play(Tournament(spec_of(3, pairs=40)), by_lot(4))
    ratings = rate(event.results)
    chance = np.random.default_rng(5)
    scatter = np.var([drawn_again(event.results, ratings.names, chance) for _ in range(150)], axis=0, ddof=1).sum()
    found = scatter / np.trace(ratings.covariance) * ratings.dispersion
    assert ratings.bootstrap_dispersion == pytest.approx(found, rel=0.25)


def test_the_bootstrap_tells_when_one_factor_does_not_do_for_all():
    """Drawn pairs that never vary between a and b, pairs that go all one way between c and d."""
    calm = [("a", "b", 0), ("a", "b", 1)] * 60
    wild = [("c", "d", winner) for winner in (0, 0, 1, 1) * 8] + [("a", "c", winner) for winner in (0, 0, 1, 1)]
    ratings = rate(games_of(calm + wild))
    assert ratings.bootstrap_dispersion > 1.3 * ratings.dispersion


def test_the_order_of_results_changes_nothing():
    """On one worker or many: not even the last bit of a report."""
    event = play(Tournament(spec_of(4, pairs=5)), by_lot(8))
    forth, back = (rate(results, "abcd") for results in (event.results, event.results[::-1]))
    assert (forth.table, forth.bootstrap_dispersion) == (back.table, back.bootstrap_dispersion)


@given(tables, st.permutations("abcdefgh"))
@settings(deadline=None)
def test_names_mean_nothing(rows, order):
    names = dict(zip("abcdefgh", order, strict=True))
    renamed = [(names[one], names[other], winner) for one, other, winner in rows]
    before = {names[one.name]: one.elo for one in rate(games_of(rows)).table}
    after = {one.name: one.elo for one in rate(games_of(renamed)).table}
    assert after == pytest.approx(before, abs=1e-6)


def test_swapping_winners_swaps_ratings():
    rows = [("a", "b", 0), ("a", "c", None), ("b", "c", 1), ("c", "a", 0)]
    turned = [(one, other, None if winner is None else 1 - winner) for one, other, winner in rows]
    before = {one.name: one.elo for one in rate(games_of(rows)).table}
    after = {one.name: -one.elo for one in rate(games_of(turned)).table}
    assert after == pytest.approx(before, abs=1e-6)


def test_tables_that_never_met_are_rated_together():
    ratings = rate(games_of([("a", "b", 0)] * 10 + [("c", "d", 1)] * 10))
    assert {one.name for one in ratings.table[:2]} == {"a", "d"}
    assert ratings.superiority("a", "b") > 0.95
    assert ratings.superiority("a", "d") == pytest.approx(0.5)


def test_games_that_do_not_count_are_passed_over():
    games = games_of([("a", "b", 0)] * 4)
    aborted = GameResult("x", 0, ("b", "a"), 0, None, EndReason.ABORTED)
    assert [one.to_dict() for one in rate([*games, aborted]).table] == [one.to_dict() for one in rate(games).table]
    assert ladder([*games, aborted]) == ladder(games)


def test_the_ladder_is_openskills():
    """One win from the start: openskill 6.2, PlackettLuce defaults, rate([[a], [b]], ranks=[0, 1])."""
    first, last = ladder(games_of([("b", "a", 1)]))
    assert (first.name, first.games) == ("a", 1)
    assert (first.mu, first.sigma) == pytest.approx((27.635389493140497, 8.06590141354368))
    assert (last.mu, last.sigma) == pytest.approx((22.364610506859503, 8.06590141354368))


@given(tables)
@settings(deadline=None, max_examples=30)
def test_the_ladder_stays_finite(rows):
    for rung in ladder(games_of(rows)):
        assert math.isfinite(rung.ordinal)
        assert rung.sigma > 0
