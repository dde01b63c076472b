"""The certified reference itself: it agrees with the published answers, and it can say no."""

from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp, mpf
from support.contact.cases import CLASSES, DISTANCE, make_cases
from support.contact.certify import certainly_right
from support.contact.exact import first_fall, integral, judge, refined
from support.contact.precise import entry
from support.require import reference_quartics
from support.truth import roots


def test_sturm_finds_the_published_entry_of_every_quartic():
    for case in reference_quartics():
        p = integral([Fraction(x) for x in case["coeffs"]])
        found = first_fall(p, Fraction(case["t_max"]))
        assert (found is None) == (case["entry"] is None), case
        if found is not None:
            low, high = refined(p, found, Fraction(1, 10**18))
            assert float(low) - 1e-15 <= case["entry"] <= float(high) + 1e-15, case


def test_root_isolation_at_50_digits_finds_the_same_entries():
    decided = [case for case in reference_quartics() if case["mult"] != 2]
    with mp.workdps(50):
        for case in decided:
            p = [mpf(x) for x in case["coeffs"]]
            touching_inside = p[0] <= 0 and p[1] < 0
            found = mpf(0) if touching_inside else roots.first_fall(p, mpf(case["t_max"]))
            assert (found is None) == (case["entry"] is None), case
            assert found is None or abs(float(found) - case["entry"]) <= 1e-15, case


@pytest.fixture(scope="module")
def answered():
    """600 cases with their answers at 50 digits."""
    cases = make_cases(np.random.default_rng(2), 600)
    answers = [entry(cases.c[i], cases.b[i], cases.a[i], cases.t_max[i]) for i in range(len(cases))]
    return cases, np.array([np.nan if x is None else float(x) for x in answers])


def verdicts(cases, answers):
    return [
        judge(cases.c[i], cases.b[i], cases.a[i], cases.t_max[i], float(answers[i]), DISTANCE)
        for i in range(len(cases))
    ]


def test_true_answers_are_accepted_in_every_class(answered):
    cases, answers = answered
    assert set(verdicts(cases, answers)) == {"ok"}
    assert set(cases.kind) == set(CLASSES)


def test_the_interval_verdict_is_never_more_lenient_than_the_exact_one(answered):
    cases, answers = answered
    for wrong in (answers, answers + 1e-9, answers * 0.5, np.full(len(cases), np.nan), cases.t_max):
        sure = certainly_right(cases, wrong)
        assert {v for v, s in zip(verdicts(cases, wrong), sure, strict=True) if s} <= {"ok"}


def test_wrong_answers_are_named():
    head_on = ([1.0, 0.0], [-1.0, 0.0], [0.0, 0.0], 2.0)
    hit = 1.0 - DISTANCE
    assert judge(*head_on, hit, DISTANCE) == "ok"
    assert judge(*head_on, float("nan"), DISTANCE) == "missed"
    assert judge(*head_on, 1.0 + DISTANCE, DISTANCE) == "late"
    assert judge(*head_on, hit - 1e-9, DISTANCE) == "residual"
    assert judge(*head_on, 2.5, DISTANCE) == "outside"
    assert judge([DISTANCE, 0.0], [1.0, 0.0], [0.0, 0.0], 2.0, 0.0, DISTANCE) == "opening"
    assert judge([DISTANCE, 0.0], [1.0, 0.0], [0.0, 0.0], 2.0, float("nan"), DISTANCE) == "ok"
