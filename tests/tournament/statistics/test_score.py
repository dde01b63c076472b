"""Scores from pairs, against published figures, scipy and their own promises (docs/tournaments.md, "Scores")."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats
from support.events import play, spec_of

from tournament import Tournament
from tournament.statistics import (
    MOST_ELO,
    elo_of,
    expected_score,
    is_contradicted,
    score_interval,
    score_of,
    score_of_cells,
)
from tournament.statistics.few_pairs import MOST_PAIRS

cells = st.lists(st.integers(0, 300), min_size=5, max_size=5)

PUBLISHED = [
    ((214, 8992, 19871, 9102, 235), 0.69, 1.25, "https://github.com/Yoshie2000/PlentyChess/pull/334"),
    ((5, 942, 2469, 1050, 5), 4.20, 3.43, "https://github.com/Yoshie2000/PlentyChess/pull/334"),
    ((41, 6483, 15166, 6752, 51), 1.76, 1.39, "https://github.com/cosmobobak/viridithas/pull/396"),
    ((10, 60, 114, 59, 7), -4.86, 20.6, "https://github.com/official-stockfish/fishtest/pull/353"),
]
"""Pairs with 0 to 2 points, the Elo difference and the half width of its interval as reported there."""


@pytest.mark.parametrize(("counts", "elo", "width", "source"), PUBLISHED[:3])
def test_elo_and_interval_are_those_reported_for_pairs(counts, elo, width, source):
    score = score_of_cells(counts)
    assert score.elo == pytest.approx(elo, abs=0.006), source
    assert (score.elo_high - score.elo_low) / 2 == pytest.approx(width, abs=0.01), source


def test_pairs_tell_more_than_single_games_when_racks_matter():
    """fishtest's first pairs: -4.86 +- 20.6 from games, which the pairs make narrower."""
    counts, elo, width, _ = PUBLISHED[3]
    score = score_of_cells(counts)
    assert score.elo == pytest.approx(elo, abs=0.006)
    assert (score.elo_high - score.elo_low) / 2 < width


def test_superiority_is_the_one_sided_t_test_for_many_pairs():
    """With near-normal data the signed root is the t statistic."""
    counts = (100, 400, 1000, 450, 110)
    values = [cell / 4 for cell, count in enumerate(counts) for _ in range(count)]
    test = stats.ttest_1samp(values, 0.5, alternative="greater")
    assert score_of_cells(counts).superiority == pytest.approx(1 - test.pvalue, abs=2e-3)


@given(cells)
@settings(max_examples=40, deadline=None)
def test_nothing_is_ever_infinite_and_the_interval_holds_the_score(counts):
    score = score_of_cells(counts)
    assert all(math.isfinite(value) for value in score.to_dict().values() if isinstance(value, float))
    assert 0.0 <= score.low <= score.score <= score.high <= 1.0
    assert -MOST_ELO <= score.elo_low <= score.elo <= score.elo_high <= MOST_ELO
    assert 0.0 <= score.superiority <= 1.0


@given(cells)
@settings(max_examples=40, deadline=None)
def test_the_other_side_of_the_table_sees_the_mirror_image(counts):
    score, mirrored = score_of_cells(counts), score_of_cells(counts[::-1])
    assert mirrored.score == pytest.approx(1 - score.score, abs=1e-12)
    assert (mirrored.low, mirrored.high) == pytest.approx((1 - score.high, 1 - score.low), abs=1e-6)
    assert mirrored.superiority == pytest.approx(1 - score.superiority, abs=1e-6)


@given(cells.filter(lambda counts: sum(counts) > 1))
@settings(max_examples=40, deadline=None)
def test_superior_at_975_is_an_interval_above_a_half(counts):
    score = score_of_cells(counts)
    if abs(score.superiority - 0.975) > 1e-6:
        assert (score.superiority > 0.975) == (score.low > 0.5)


@given(cells.filter(lambda counts: sum(counts) > 1), st.floats(0.01, 0.99))
@settings(max_examples=40, deadline=None)
def test_what_is_contradicted_lies_outside_the_interval(counts, score):
    low, high = score_interval(counts)
    if min(abs(score - low), abs(score - high)) > 1e-6:
        assert is_contradicted(counts, score) == (not low <= score <= high)


few = st.lists(st.integers(0, 3), min_size=5, max_size=5).filter(lambda counts: 1 < sum(counts) <= MOST_PAIRS)


@given(few)
@settings(max_examples=30)
def test_few_pairs_have_an_interval_that_agrees_with_superiority_and_with_the_other_side(counts):
    score, mirrored = score_of_cells(counts), score_of_cells(counts[::-1])
    assert 0.0 <= score.low <= score.score <= score.high <= 1.0
    assert (score.superiority > 0.975) == (score.low > 0.5)
    assert (mirrored.low, mirrored.high) == pytest.approx((1 - score.high, 1 - score.low), abs=1e-6)
    assert mirrored.superiority == pytest.approx(1 - score.superiority, abs=1e-9)


@pytest.mark.parametrize(("pairs", "low"), [(3, 0.1 ** (1 / 3)), (4, 0.5)])
def test_few_pairs_all_won_are_judged_by_the_chance_of_that(pairs, low):
    """Below a half nothing speaks louder against s than winning all; half of s^n is 5 % at the bound.

    From a half on, losing all speaks as loudly or louder: four pairs all won leave a half in.
    """
    assert score_interval((0, 0, 0, 0, pairs)) == pytest.approx((low, 1.0), abs=3e-3)


def test_two_hundred_to_nothing_is_bounded_below():
    """A hundred pairs won: the likelihood s^100 falls to exp(-threshold) at the bound."""
    low, high = score_interval((0, 0, 0, 0, 100))
    t = stats.t.ppf(0.975, 99)
    assert low == pytest.approx(math.exp(-0.5 * math.log1p(t * t / 99)), abs=2e-4)  # empty cells count 0.001
    assert high == 1.0
    assert score_of_cells((0, 0, 0, 0, 100)).elo_low == pytest.approx(681, abs=1)


@pytest.mark.parametrize("counts", [(0, 0, 0, 0, 0), (0, 0, 0, 0, 1), (0, 0, 1, 0, 0)])
def test_fewer_than_two_pairs_exclude_nothing(counts):
    assert score_interval(counts) == (0.0, 1.0)
    assert score_of_cells(counts).superiority == 0.5


@pytest.mark.parametrize("counts", [(1, 2, 3), (0, 0, -1, 0, 0), (0, 0, True, 0, 0), (0, 0, 1.0, 0, 0)])
def test_counts_that_are_none_are_refused(counts):
    with pytest.raises(ValueError, match="counts = "):
        score_of_cells(counts)


def test_a_game_without_its_partner_is_left_out_and_told():
    event = play(Tournament(spec_of(2, pairs=3)), lambda due: due.pair.players.index("a"))
    score = score_of(event.results[:-1], "a")
    assert (score.cells, score.unpaired) == ((0, 0, 0, 0, 2), 1)


@given(st.floats(-MOST_ELO + 1, MOST_ELO - 1))
def test_elo_and_score_are_inverse(elo):
    assert elo_of(expected_score(elo)) == pytest.approx(elo, abs=1e-6)
