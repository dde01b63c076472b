"""Means over games in pairs against scipy and by hand (docs/tournaments.md, "Luck")."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from tournament.statistics import mean_of


@given(st.lists(st.tuples(st.floats(-1, 2), st.floats(-1, 2)), min_size=2, max_size=30))
def test_whole_pairs_have_scipys_t_interval_of_their_means(pairs):
    values, of_pair = [value for pair in pairs for value in pair], [at for at in range(len(pairs)) for _ in range(2)]
    means = np.mean(pairs, axis=1)
    found = mean_of(values, of_pair)
    assert found.value == pytest.approx(np.mean(values))
    assert found.pairs == len(pairs)
    if found.low is None:
        assert means.std() < 1e-9
        return
    expected = stats.t.interval(0.95, len(pairs) - 1, np.mean(means), stats.sem(means))
    assert (found.low, found.high) == pytest.approx(expected, abs=1e-9)


def test_games_of_a_pair_are_not_two_pieces_of_evidence():
    """The same number twice in every pair: as sure as half as many games."""
    once = mean_of([0.1, 0.7, 0.4], "abc")
    twice = mean_of([0.1, 0.1, 0.7, 0.7, 0.4, 0.4], "aabbcc")
    assert (twice.low, twice.high) == pytest.approx((once.low, once.high))


def test_a_game_without_its_partner_counts_by_itself():
    """By hand: deviations of pairs 0.2 - 0.2 + 0.2 and -0.4, over three games of mean 0.6."""
    found = mean_of([0.8, 0.8, 0.2], "aab")
    error = math.sqrt((0.4**2 + 0.4**2) * 2 / 1) / 3
    assert found.high - found.value == pytest.approx(stats.t.ppf(0.975, 1) * error)


@pytest.mark.parametrize(("values", "pairs"), [([1.0], "a"), ([0.3, 0.4], "aa"), ([1.0, 1.0, 1.0], "abc")])
def test_no_spread_no_interval(values, pairs):
    assert (mean_of(values, pairs).low, mean_of(values, pairs).high) == (None, None)
