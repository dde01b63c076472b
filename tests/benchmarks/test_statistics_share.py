"""A bounded share of `pooliad bench event_statistics` and `luck` (issue "tournaments worth believing")."""

import numpy as np
import pytest

from benchmarks import event_statistics, luck
from benchmarks.pairs_by_lot import cell_chances

ALLOWED = 0.05


@pytest.mark.parametrize("score", [0.05, 0.3, 0.5, 0.75, 0.9])
@pytest.mark.parametrize("draws", [0.0, 0.4, 1.0])
def test_pairs_by_lot_have_the_score_they_claim(score, draws):
    cells = cell_chances(score, draws)
    assert cells.sum() == pytest.approx(1.0)
    assert cells.min() >= -1e-15
    assert cells @ np.arange(5) / 4 == pytest.approx(score)


def test_intervals_of_few_pairs_cover_what_can_be_covered():
    """All 35 outcomes of three pairs; the full study has more."""
    for score in (0.6, 0.75, 0.9):
        row = event_statistics.exact_coverage(score, 3)
        for draws in (0, 10, 40):
            assert 0.94 <= row[f"covered_draws_{draws}"] <= 0.99
            assert abs(row[f"nearest_draws_{draws}"] - 0.95) <= abs(row[f"covered_draws_{draws}"] - 0.95) + 1e-9


def test_intervals_cover_95_percent_of_200_events():
    """Three standard deviations of a share of 200."""
    row = event_statistics.coverage(0.6, 50, 200)
    for draws in (0, 10, 40):
        assert row[f"covered_draws_{draws}"] == pytest.approx(0.95, abs=0.047)


def test_the_sequential_test_errs_as_seldom_as_it_says():
    row = event_statistics.errors((0.0, 200.0), 0.0, 150)
    assert row["undecided"] == 0
    assert max(row["false_elo0"], row["false_elo1"]) <= ALLOWED + 3 * np.sqrt(ALLOWED * 0.95 / 150)


def test_ratings_cover_95_percent():
    row = event_statistics.rating_coverage(4, 5, 0.7, 0.0, 50)
    assert row["ratings"] == 200
    assert row["covered"] == pytest.approx(0.95, abs=0.05)


def test_luck_is_told_for_games_of_simple_players():
    row = luck.study(1.0, 2, 2)
    assert row["games"] == 2
    assert row["strokes"] > 10
    assert abs(row["mean_luck_of_a_stroke"]) < 0.2
    assert row["mean_luck"] == pytest.approx(row["as_played"] - row["without_luck"], abs=2e-4)


@pytest.mark.long
@pytest.mark.parametrize("pairs", [50, 100, 200])
@pytest.mark.parametrize("score", [0.5, 0.6, 0.75])
def test_coverage_of_2000_events_is_94_to_96_percent(pairs, score):
    """Up to three standard deviations of the study itself."""
    row = event_statistics.coverage(score, pairs, 2000)
    for draws in (0, 10, 40):
        assert 0.94 - 0.005 <= row[f"covered_draws_{draws}"] <= 0.96 + 0.005


@pytest.mark.long
@pytest.mark.parametrize("terms", event_statistics.TESTS)
def test_error_rates_of_2000_tests_are_within_their_bounds(terms):
    row = event_statistics.errors(terms, 0.4, 2000)
    assert max(row["false_elo0_from"], row["false_elo1_from"]) <= ALLOWED
