"""The sequential test against published and independent values (docs/tournaments.md, "Stopping early")."""

import math
import random

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import optimize
from support.events import result_of, spec_of

from tournament import InvalidSpec, SprtTerms, Tournament
from tournament.statistics import SprtDecision, expected_score, log_likelihood_ratio, sprt

PUBLISHED = [
    ((17, 253, 1042, 337, 39), (-0.5, 1.5), 2.96, 2971),
    ((11, 407, 3238, 513, 11), (0.25, 1.75), 2.93, 2971),
    ((59, 754, 2467, 865, 75), (-0.5, 1.5), 2.95, 2951),
    ((33, 1185, 8378, 1302, 50), (0.25, 1.75), 2.95, 2951),
    ((253, 4282, 17604, 4431, 286), (-0.25, 1.25), 2.94, 3209),
    ((58, 3302, 33130, 3518, 84), (0.25, 1.25), 2.97, 3209),
]
"""Pairs, elo0 and elo1, log-likelihood ratio: https://github.com/official-stockfish/Stockfish/pull/NUMBER."""


@pytest.mark.parametrize(("counts", "elos", "llr", "number"), PUBLISHED)
def test_the_ratio_is_that_of_stockfishs_testing_framework(counts, elos, llr, number):
    assert log_likelihood_ratio(counts, *elos) == pytest.approx(llr, abs=0.0051)


def greatest_likelihood(counts, score):
    """The same maximum by scipy's general minimiser over the five probabilities."""
    cells = np.arange(5) / 4
    weights = np.maximum(counts, 1e-3)
    start = np.interp(cells, [0, 1], [1 - score, score])
    found = optimize.minimize(
        lambda q: -weights @ np.log(q),
        start / start.sum(),
        jac=lambda q: -weights / q,
        method="SLSQP",
        bounds=[(1e-12, 1)] * 5,
        constraints=[{"type": "eq", "fun": lambda q: q.sum() - 1}, {"type": "eq", "fun": lambda q: q @ cells - score}],
        options={"maxiter": 500, "ftol": 1e-13},
    )
    return -found.fun


@pytest.mark.parametrize("counts", [(3, 5, 11, 7, 4), (1, 0, 5, 2, 9), (20, 3, 4, 1, 2)])
def test_the_ratio_is_a_ratio_of_maxima(counts):
    expected = greatest_likelihood(counts, expected_score(60)) - greatest_likelihood(counts, expected_score(-10))
    assert log_likelihood_ratio(counts, -10, 60) == pytest.approx(expected, abs=1e-3)


@given(st.lists(st.integers(0, 10_000), min_size=5, max_size=5), st.floats(-1000, 900), st.floats(0.1, 100))
def test_the_ratio_is_finite_and_antisymmetric(counts, elo0, more):
    ratio = log_likelihood_ratio(counts, elo0, elo0 + more)
    assert math.isfinite(ratio)
    assert log_likelihood_ratio(counts, elo0 + more, elo0) == -ratio
    assert log_likelihood_ratio(counts[::-1], -elo0 - more, -elo0) == pytest.approx(-ratio, rel=1e-6, abs=1e-6)


def test_the_bounds_are_walds():
    """Fishtest's 2.94 for error rates of 5 %."""
    assert SprtTerms().bounds == pytest.approx((-2.944, 2.944), abs=5e-4)


def test_it_stops_at_the_first_decision_and_looks_no_further():
    won = sprt(SprtTerms(0, 50), [4] * 1000)
    assert won.verdict is SprtDecision.ELO1
    assert won.pairs < 100
    assert sprt(SprtTerms(0, 50), [4] * won.pairs + [0] * 900) == won
    assert sprt(SprtTerms(0, 50), [0] * 1000).verdict is SprtDecision.ELO0
    assert sprt(SprtTerms(0, 50), []).verdict is SprtDecision.OPEN


@given(st.integers(0, 2**32))
@settings(max_examples=20, deadline=None)
def test_an_event_is_tested_in_the_order_of_pairs_whatever_the_order_of_completion(seed):
    """Results come in any order, some games after the decision: the same pairs count, the same standings follow."""
    chance = random.Random(seed)
    event = Tournament(spec_of(2, pairs=60, sprt=SprtTerms(0, 200)))
    results = [result_of(due, due.pair.players.index("a") if chance.random() < 0.8 else None) for due in event.due]
    whole = event.with_results(*results)
    chance.shuffle(results)
    partly = event
    for result in results:
        before, partly = partly, partly.with_results(result)
        if before.stopped:
            assert partly.counted == before.counted
            assert partly.due == ()
    assert partly.test == whole.test
    assert partly.counted == whole.counted
    assert len(whole.counted) == 2 * whole.test.pairs


def test_a_gap_in_the_order_of_pairs_waits():
    event = Tournament(spec_of(2, pairs=30, sprt=SprtTerms(0, 100)))
    later = [result_of(due, due.pair.players.index("a")) for due in event.due if due.pair.number > 0]
    event = event.with_results(*later)
    assert event.test.verdict is SprtDecision.OPEN
    assert event.test.pairs == 0
    assert {due.pair.number for due in event.due} == {0}


@pytest.mark.parametrize(
    ("terms", "words"),
    [
        ({"elo0": 5.0, "elo1": 5.0}, "sprt.elo1 = 5.0: must be more than elo0 = 5"),
        ({"alpha": 0.0}, "sprt.alpha = 0.0: must be a number from 1e-06 to 0.4"),
        ({"beta": math.nan}, "sprt.beta = nan: must be a number from 1e-06 to 0.4"),
        ({"elo1": "20"}, "sprt.elo1 = '20': must be a number from -1000 to 1000"),
    ],
)
def test_terms_that_cannot_be_are_named(terms, words):
    with pytest.raises(InvalidSpec, match=words):
        SprtTerms(**terms)


def test_it_is_for_two():
    with pytest.raises(InvalidSpec, match="two entrants"):
        spec_of(3, sprt=SprtTerms())
