"""Contacts with the pieces of a mouth: certified against exact arithmetic, and against an oracle without any filter."""

import json
import math
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf
from support.contact.cases import DISTANCE, make_cases
from support.contact.exact import falls_deep, first_fall, gap_polynomial, squared_distance
from support.kernels import from_python
from support.require import reference_data
from support.truth.jaws import JawTruth, first_contact

import physics
from physics.kernels.detect import jaws
from physics.kernels.detect.jaws import JawOutline
from physics.kernels.path import Path
from physics.kernels.tolerances import DEEPER

drops = from_python(jaws.drops)
falling = from_python(jaws.falling)
falling_from_touch = from_python(jaws.falling_from_touch)
meets_facing = from_python(jaws.meets_facing)
meets_horn = from_python(jaws.meets_horn)

NINE = physics.RealTable.of_size("nine_foot").replace(flight=False)
RHO = NINE.contact_distance
SHAPES = {"corner": NINE.corner_shape, "side": NINE.side_shape}


def constants(mouth):
    """``jaw`` as the kernels take it."""
    return JawOutline(
        *(mouth.nose_end, mouth.horn_radius, *mouth.facing_start, *mouth.facing_normal, mouth.facing_length)
    )


def gap(c: Any, b: Any, a: Any, t: Any, distance: Any) -> float:
    """Exact gap at a time, m."""
    t = Fraction(t)
    squared = sum((Fraction(x) + t * (Fraction(y) + t * Fraction(z))) ** 2 for x, y, z in zip(c, b, a, strict=True))
    with mp.workdps(40):
        return float(mp.sqrt(mpf(squared.numerator) / squared.denominator) - mpf(distance))


@pytest.mark.parametrize("family", ["horn_cloth", "drop_edge"])
def test_the_reference_contacts(family):
    """``flight/contacts.json``: none missed, none invented, gap and time times closing speed at most 1e-15 m.

    So a later root would not do. The two families have no exact tangency; grazes are as fine as 1e-12 m.
    """
    cases = [
        c for c in json.loads(reference_data("flight/contacts.json").read_text())["cases"] if c["family"] == family
    ]
    assert len(cases) > 30
    for case in cases:
        c, b, a, t_max, distance = case["c"], case["b"], case["a"], case["t_max"], case["distance"]
        t = answer(family, c, b, a, t_max, distance)
        assert (t != t) == (case["time"] is None), case["id"]
        if t == t:
            assert abs(gap(c, b, a, t, distance)) <= 1e-15, case["id"]
            with mp.workdps(40):
                assert abs(mpf(t) - mpf(case["time"])) * case["closing_speed"] <= 1e-15, case["id"]


def answer(family: str, c: Any, b: Any, a: Any, t_max: float, distance: float) -> float:
    """What the kernels say of a path past a horn or a drop edge."""
    if family == "drop_edge":
        return drops(Path(*c, *b, *a), distance, t_max, t_max)
    horn = JawOutline(0.0, distance - RHO, 0.0, 0.0, 0.0, 1.0, 0.0)
    return meets_horn(horn, RHO, Path(c[0], c[1] - (distance - RHO), *b, *a), t_max, t_max)


UNSEEN = (
    *("random", "aimed", "graze", "nearly touching", "no acceleration", "parallel paths", "stopping short"),
    "ending close",
)
"""Classes of ``support/contact/cases.py`` whose starts are clear and whose grazes are no finer than 1e-12 m."""


@pytest.mark.parametrize(
    ("family", "distance"), [("horn_cloth", SHAPES["side"].horn_radius + RHO), ("drop_edge", 0.0635)]
)
def test_hard_contacts_that_no_file_has(family, distance):
    """The classes of the ball-ball contact at these distances, against Sturm sequences over the integers."""
    cases = make_cases(np.random.default_rng(len(family)), 480, UNSEEN)
    scale, met = distance / DISTANCE, 0
    for i in range(len(cases)):
        c, b, a = ([float(x) * scale for x in part[i]] for part in (cases.c, cases.b, cases.a))
        squared, t_max = squared_distance(c, b, a), float(cases.t_max[i])
        true = first_fall(gap_polynomial(squared, Fraction(distance)), Fraction(t_max))
        t = answer(family, c, b, a, t_max, distance)
        assert (t != t) == (true is None), (cases.kind[i], c, b, a, t_max)
        if t == t:
            met += 1
            assert abs(gap(c, b, a, t, distance)) <= 1e-15, (cases.kind[i], c, b, a, t_max)
            assert not falls_deep(squared, Fraction(distance), Fraction(t)), (cases.kind[i], c, b, a, t_max)
    assert met > 100


def paths(rng: np.random.Generator, shape: Any, n: int) -> Iterator[tuple[float, ...]]:
    """Starts in and before a mouth, clear of its pieces, on curves of sliding and rolling balls."""
    made = 0
    while made < n:
        s, d = rng.uniform(-0.06, 0.16), rng.uniform(-0.05, 0.1)
        place = (d, NINE.length / 2 + s) if not shape.in_corner else (s, d)
        if not NINE.contains(*place):
            continue
        heading, speed = rng.uniform(0, 2 * math.pi), 10.0 ** rng.uniform(-2.0, 0.9)
        pull, turn = rng.choice([0.05, 0.98]), heading + rng.choice([math.pi, rng.uniform(0, 2 * math.pi)])
        yield (
            *(float(s), float(d), speed * math.cos(heading), speed * math.sin(heading)),
            *(pull * math.cos(turn), pull * math.sin(turn), float(rng.uniform(0.01, 1.0))),
        )
        made += 1


@pytest.mark.parametrize("kind", ["corner", "side"])
def test_every_piece_agrees_with_thirty_digits(kind):
    """Horn and facing of one jaw, each by itself, found or not; times to a gap of 1e-15 m."""
    shape, rng = SHAPES[kind], np.random.default_rng(len(kind))
    truth = JawTruth.of(shape, RHO)
    met = 0
    for s, d, vs, vd, hs, hd, lasts in paths(rng, shape, 400):
        with mp.workdps(30):
            horn, facing = first_contact(truth, (s, d), (vs, vd), (hs, hd), lasts)
        t = meets_horn(constants(shape), RHO, Path(s, d, vs, vd, hs, hd), lasts, lasts)
        agree(t, horn, abs(vs) + abs(vd))
        t = meets_facing(constants(shape), RHO, Path(s, d, vs, vd, hs, hd), lasts)
        agree(math.nan if t == math.inf else t, facing, abs(vs) + abs(vd))
        met += (horn is not None) + (facing is not None)
    assert met > 50


def agree(found: float, true: Any, speed: float) -> None:
    assert (found != found) == (true is None), (found, true)
    if true is not None:
        assert abs(found - float(true)) <= 1e-13 + 1e-14 / max(speed, 1e-3), (found, true)


@pytest.mark.parametrize(
    ("gap_now", "speed", "half", "expected"),
    [
        (1.0, 1.0, 0.0, 1.0),
        (-1.0, 1.0, 1.0, math.inf),  # behind, going on
        (-1.0, -1.0, 0.0, math.inf),  # behind, coming out for good
        (-1.0, -3.0, 1.0, (3.0 + math.sqrt(5.0)) / 2.0),  # out, and back at the later root
        (-1.0, -1.0, 1.0, math.inf),  # turns before it is out
        (-1.0, 1.0, -1.0, math.inf),
    ],
)
def test_falling_through_a_line_from_either_side(gap_now, speed, half, expected):
    assert falling(gap_now, speed, half) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize(
    ("gap_now", "speed", "half", "expected"),
    [
        (0.0, 1e-3, 0.0, 0.0),
        (-1e-13, 1e-3, 0.0, 0.0),
        (1e-13, 1e-3, 0.0, 1e-10),
        (0.0, -1e-3, 0.0, math.inf),
        (0.0, -1e-3, 1e-3, 1.0),
        (-5e-13, -1e-3, 1e-3, 1.0),  # where it overlaps as much again
        (0.0, 0.0, 0.0, math.inf),
        (0.0, 0.0, 1.0, math.sqrt(DEEPER)),
        (0.0, 1e-10, 0.0, DEEPER / 1e-10),
        (0.0, -1e-10, 1e-10, 1.0),
        (0.0, 1e-10, -1.0, math.inf),
    ],
)
def test_a_line_that_is_touched_is_never_met_at_time_zero_again(gap_now, speed, half, expected):
    assert falling_from_touch(gap_now, speed, half, 10.0) == pytest.approx(expected, rel=1e-12)


def test_a_path_that_leaves_a_strip_at_its_end_meets_the_disc():
    """Aimed at the seam of facing and horn, and of nose and horn, at 1,000 angles: some piece is always met."""
    shape = SHAPES["corner"]
    jaw = constants(shape)
    (start_s, start_d), (ns, nd) = shape.facing_start, shape.facing_normal
    for seam_s, seam_d in ((start_s + RHO * ns, start_d + RHO * nd), (shape.nose_end, RHO)):
        for angle in np.linspace(0.0, 2 * math.pi, 1000):
            s, d = seam_s + 0.02 * math.cos(angle), seam_d + 0.02 * math.sin(angle)
            gap_facing = (s - start_s) * ns + (d - start_d) * nd - RHO
            clear = math.dist((s, d), shape.horn_centre) > shape.horn_radius + RHO + 1e-9
            if not clear or (gap_facing < 1e-9 and s < shape.nose_end) or (d < RHO + 1e-9 and s >= shape.nose_end):
                continue
            vs, vd = -math.cos(angle), -math.sin(angle)
            # Beyond the seam lies the jaw: within 20.001 mm something must be met, unless the path only grazes it.
            t = min(
                meets_facing(jaw, RHO, Path(s, d, vs, vd, 0.0, 0.0), 0.03),
                falling(d - RHO, -vd, 0.0) if s + 0.02 * vs >= shape.nose_end else math.inf,
                *(x for x in [meets_horn(jaw, RHO, Path(s, d, vs, vd, 0.0, 0.0), 0.03, 0.03)] if x == x),
            )
            grazes = abs(vs * ns + vd * nd) < 1e-3 or abs(vd) < 1e-3
            assert t <= 0.02 + 1e-9 or grazes, (angle, t)


def test_the_drop_edge_is_met_from_outside_alone():
    assert drops(Path(0.0634, 0.0, 0.5, 0.0, 0.0, 0.0), 0.0635, 1.0, 1.0) == 0.0
    assert drops(Path(0.0635 + 1e-12, 0.0, -1e-3, 0.0, 0.0, 0.0), 0.0635, 1.0, 1.0) == pytest.approx(1e-9, rel=1e-3)
    assert drops(Path(0.0635 + 1e-12, 0.0, 0.0, 0.0, 0.0, 0.0), 0.0635, 1.0, 1.0) != 0.0
    outside = drops(Path(0.07, -1.0, 0.0, 1.0, 0.0, 0.0), 0.0635, 2.0, 2.0)
    assert outside != outside
