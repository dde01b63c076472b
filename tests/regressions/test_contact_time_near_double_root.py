"""Seen: ``contact_time`` returned a time 1.1e-14 m off for three of 1.7 million hard cases, straight paths that graze.

Expected: every returned time within 1e-14 m of the distance. Why it was not: close to a double root the closed form of
a straight path keeps half the digits of the time.
"""

import pytest
from support.contact.cases import DISTANCE
from support.contact.exact import judge

import physics

STRAIGHT = (0.0, 0.0)
CASES = [
    ((1.4109579755922572, -0.424493525475472), (-2.9764410923077187, 1.0229570844784286), 0.7625527835664084),
    ((-1.3752160328213368, -0.4921656702990626), (3.178011793313269, 1.1373546171254931), 0.7110265503350429),
]


@pytest.mark.parametrize(("c", "b", "t_max"), CASES)
def test_the_time_meets_the_distance(c, b, t_max):
    answer = physics.contact_time(c, b, STRAIGHT, t_max, DISTANCE)
    assert judge(c, b, STRAIGHT, t_max, answer, DISTANCE) == "ok"
