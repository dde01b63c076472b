"""``physics.contact_time``, the loop's own solver, against certified answers.

Required: no contact deeper than 1e-12 m missed or passed over, none invented where the exact gap stays above 1e-12 m,
every returned time within 1e-14 m of the distance. Classes of cases: ``support/contact/cases.py``.
"""

from collections import Counter

import numpy as np
import pytest
from support.contact.cases import CLASSES, DISTANCE, make_cases
from support.contact.certify import certainly_right
from support.contact.exact import judge
from support.contact.precise import agrees
from support.require import reference_quartics

import physics

N_CASES = 10_000


def answer(c, b, a, t_max):
    return physics.contact_time(c, b, a, t_max, DISTANCE)


@pytest.fixture(scope="module")
def answered():
    cases = make_cases(np.random.default_rng(20), N_CASES)
    answers = [answer(*row) for row in zip(cases.c, cases.b, cases.a, cases.t_max, strict=True)]
    return cases, np.array(answers)


@pytest.mark.parametrize("kind", CLASSES)
def test_every_answer_is_certified(answered, kind):
    cases, answers = answered[0], answered[1]
    cases, answers = cases[cases.kind == kind], answers[cases.kind == kind]
    doubtful = np.flatnonzero(~certainly_right(cases, answers))
    wrong = []
    for i in doubtful:
        case = (cases.c[i].tolist(), cases.b[i].tolist(), cases.a[i].tolist(), float(cases.t_max[i]))
        verdict = judge(*case, float(answers[i]), DISTANCE)
        if verdict != "ok":
            wrong.append((verdict, *case, float(answers[i])))
    assert not wrong, f"{len(wrong)} of {len(cases)}: {Counter(w[0] for w in wrong)}; first {wrong[0]}"


def test_a_sample_agrees_with_50_digits(answered):
    cases, answers = answered
    verdicts = Counter(
        agrees(cases.c[i], cases.b[i], cases.a[i], cases.t_max[i], answers[i]) for i in range(0, len(cases), 20)
    )
    assert verdicts[False] == 0, verdicts
    assert verdicts[True] > 0.7 * verdicts.total(), verdicts


def vectors(case):
    g = case["geom"]
    return [g["cx"], g["cy"]], [g["bx"], g["by"]], [g["ax"], g["ay"]]


def test_published_quartics():
    """3,000 harvested and constructed quartics; what is shallower than 1e-12 m their own rounding decides."""
    for case in reference_quartics():
        if case.get("geom") is None:
            continue
        c, b, a = vectors(case)
        t = answer(c, b, a, case["t_max"])
        assert judge(c, b, a, case["t_max"], t, DISTANCE) == "ok", (case, t)
        if abs(case["depth_m"]) > 1e-11 and not case["separating"]:
            assert (t == t) == (case["entry"] is not None), (case, t)
