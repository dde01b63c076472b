"""The contact solver against a certified reference: 10^7 pairs with --full, 10^5 without.

Every answer of ``physics.contact_time`` is judged: first by double-precision intervals, which prove most of them right
(``tests/support/contact/certify.py``), the rest in exact rational arithmetic (``exact.py``); and one in a hundred (10^5
of the full run) independently at 50 digits (``precise.py``). Wrong is: a contact deeper than 1e-12 m missed or passed
over, one invented, a time that is further than 1e-14 m from the distance.
"""

import sys
from collections import Counter

import numpy as np

import physics
from benchmarks.command import main
from benchmarks.recording import ROOT, Row, Tables

sys.path.insert(0, str(ROOT / "tests"))

from support.contact.cases import CLASSES, DISTANCE, FLOATS, Cases, make_cases
from support.contact.certify import certainly_right
from support.contact.exact import judge
from support.contact.precise import agrees

BATCH = 120_000
PRECISE_EVERY = 100
"""One case in this many is decided at 50 digits as well."""

SEED = 2005


def measure(full: bool) -> Tables:
    """Verdicts by class, the agreement with 50 digits, and every failure."""
    total = 10_000_000 if full else 100_000
    verdicts: Counter[tuple[str, str]] = Counter()
    precise: Counter[bool | None] = Counter()
    failures: list[Row] = []
    for batch in range(-(-total // BATCH)):
        cases = make_cases(np.random.default_rng([SEED, batch]), min(BATCH, total))
        found = answers(cases)
        failures += judged(cases, found, verdicts)
        for i in range(batch % PRECISE_EVERY, len(cases), PRECISE_EVERY):
            precise[agrees(cases.c[i], cases.b[i], cases.a[i], cases.t_max[i], found[i])] += 1
        print(f"{verdicts_total(verdicts):,} of {total:,}, {len(failures)} wrong", flush=True)
    return {"contact_reference": rows(verdicts), "at 50 digits": [agreement(precise)], "failures": failures}


def answers(cases: Cases) -> FLOATS:
    """The solver's answer to each case."""
    paths = zip(cases.c, cases.b, cases.a, cases.t_max.tolist(), strict=True)
    return np.array([physics.contact_time(c, b, a, t_max, DISTANCE) for c, b, a, t_max in paths])


def judged(cases: Cases, found: FLOATS, verdicts: Counter[tuple[str, str]]) -> list[Row]:
    """Count how each case was decided; the wrong ones."""
    certain = certainly_right(cases, found)
    for kind, contact, sure in zip(cases.kind, ~np.isnan(found), certain, strict=True):
        verdicts[kind, "cases"] += 1
        verdicts[kind, "contacts"] += bool(contact)
        verdicts[kind, "by intervals" if sure else "exactly"] += 1
    wrong = []
    for i in np.flatnonzero(~certain):
        verdict = judge(cases.c[i], cases.b[i], cases.a[i], cases.t_max[i], float(found[i]), DISTANCE)
        if verdict != "ok":
            verdicts[cases.kind[i], "wrong"] += 1
            wrong.append(failure(cases, int(i), float(found[i]), verdict))
    return wrong


def failure(cases: Cases, i: int, answer: float, verdict: str) -> Row:
    """A wrong answer with all that is needed to repeat it."""
    path = {name: getattr(cases, name)[i].tolist() for name in ("c", "b", "a", "t_max")}
    return {"class": str(cases.kind[i]), "verdict": verdict, "answer": answer, **path}


def verdicts_total(verdicts: Counter[tuple[str, str]]) -> int:
    """Cases judged so far."""
    return sum(verdicts[kind, "cases"] for kind in CLASSES)


def rows(verdicts: Counter[tuple[str, str]]) -> list[Row]:
    """One row a class."""
    columns = ("cases", "contacts", "by intervals", "exactly", "wrong")
    return [{"class": kind, **{name: verdicts[kind, name] for name in columns}} for kind in CLASSES]


def agreement(precise: Counter[bool | None]) -> Row:
    """One row."""
    return {
        "cases": precise.total(),
        "agree": precise[True],
        "shallower than 1e-12 m": precise[None],
        "disagree": precise[False],
    }


if __name__ == "__main__":
    main("contact_reference", measure)
