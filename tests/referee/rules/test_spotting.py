"""R31: the exact place of a spotted ball."""

from fractions import Fraction
from math import hypot, inf, nextafter, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from physics.state import TableState
from physics.table import Table
from referee.rules import SPOT_GAP, spot

TABLE = Table.olympiad()
R = TABLE.ball_radius
X, FOOT = TABLE.foot_spot


def spotted(balls: dict[int, tuple[float, float]]) -> tuple[float, float]:
    position = spot(TABLE, TableState.from_positions(balls)).position(8)
    assert position is not None
    return position


def overlaps(place: tuple[float, float], ball: tuple[float, float], keep: float) -> bool:
    """In exact arithmetic."""
    dx, dy = (Fraction(one) - Fraction(other) for one, other in zip(place, ball, strict=True))
    return dx * dx + dy * dy < Fraction(keep) ** 2


def keep(ball: int) -> float:
    return 2 * R + SPOT_GAP if ball == 0 else 2 * R


def test_free_foot_spot_is_taken():
    assert spotted({0: (0.3, 1.8), 3: (X, FOOT + 2.1 * R)}) == (X, FOOT)


def test_exactly_touching_the_foot_spot_is_no_overlap():
    assert spotted({3: (X + 2 * R, 1.0), 5: (X, FOOT + 2 * R)})[1] == FOOT


def test_taken_foot_spot_means_touching_behind_it():
    x, y = spotted({3: (X, FOOT)})
    assert x == X
    assert y == pytest.approx(FOOT - 2 * R, abs=1e-15)
    assert not overlaps((x, y), (X, FOOT), 2 * R)
    assert overlaps((x, nextafter(y, inf)), (X, FOOT), 2 * R)


def test_ball_beside_the_string_pushes_the_place_only_as_far_as_need_be():
    other = (X + 0.03, FOOT - 0.01)
    assert spotted({3: other})[1] == pytest.approx(other[1] - sqrt(4 * R * R - 0.03**2), abs=1e-15)


def test_a_gap_too_narrow_for_a_ball_is_passed_over():
    second = FOOT - 2.6 * R
    assert spotted({3: (X, FOOT), 5: (X, second)})[1] == pytest.approx(second - 2 * R, abs=1e-15)


def test_full_string_behind_goes_in_front_of_the_spot():
    wall = {ball: (X, FOOT - row * 2.001 * R) for row, ball in enumerate((1, 2, 3, 4, 5, 6, 7, 9, 10, 11))}
    wall = {ball: place for ball, place in wall.items() if place[1] >= R}
    assert min(y for _, y in wall.values()) < 3 * R
    assert spotted(wall)[1] == pytest.approx(FOOT + 2 * R, abs=1e-15)


def test_cue_ball_on_the_spot_keeps_the_stated_gap():
    y = spotted({0: (X, FOOT)})[1]
    assert FOOT - y == pytest.approx(2 * R + SPOT_GAP, abs=1e-15)
    assert FOOT - y >= 2 * R + SPOT_GAP


def test_place_may_be_frozen_to_the_foot_cushion():
    wall = {ball: (X, R + (row + 1) * 2 * R * 1.0001) for row, ball in enumerate((1, 2, 3, 4, 5, 6, 7, 9, 10))}
    assert spotted(wall)[1] == pytest.approx(wall[1][1] - 2 * R, abs=1e-15)
    assert spotted(wall)[1] >= R


def test_a_failed_respot_cannot_happen():
    """Known error of the historical referee: with the long string crowded its re-spot threw.

    Fourteen object balls and the cue ball, spread so that each blocks as much of the string as it can.
    """
    numbers = (0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 15)
    step = 3.99 * R
    crowd = {ball: (X, FOOT - 7 * R + row * step) for row, ball in enumerate(numbers)}
    crowd = {ball: place for ball, place in crowd.items() if R <= place[1] <= TABLE.length - R}
    place = spotted(crowd)
    assert R <= place[1] <= TABLE.length - R
    assert not any(overlaps(place, other, keep(ball)) for ball, other in crowd.items())


@st.composite
def near_the_string(draw: st.DrawFn) -> dict[int, tuple[float, float]]:
    """Balls crowded round the long string, none overlapping; drawn one after the other, misfits left out."""
    balls: dict[int, tuple[float, float]] = {}
    for ball in draw(st.permutations([0, 1, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 13, 14, 15])):
        x = X + draw(st.floats(-2 * R, 2 * R))
        y = draw(st.floats(R, 1.2))
        if all(hypot(x - other_x, y - other_y) > 2 * R for other_x, other_y in balls.values()):
            balls[ball] = (x, y)
    return balls


@given(near_the_string())
def test_nearest_place_without_overlap(balls):
    """Free itself; the next double towards the spot is not; and nothing in between is.

    Each ball blocks an interval, so the edges of single balls are the only candidates.
    """
    x, y = spotted(balls)
    assert x == X
    blocked = lambda place: any(overlaps((X, place), other, keep(ball)) for ball, other in balls.items())  # noqa: E731
    assert not blocked(y)
    if y == FOOT:
        return
    assert blocked(nextafter(y, FOOT))
    candidates = [
        other_y + side * sqrt(max(keep(ball) ** 2 - (other_x - X) ** 2, 0.0)) + side * 1e-12
        for ball, (other_x, other_y) in balls.items()
        for side in (-1, 1)
        if abs(other_x - X) < keep(ball)
    ]
    nearer = [one for one in candidates if min(FOOT, y) + 1e-9 < one <= max(FOOT, y) - 1e-9]
    assert all(blocked(one) for one in nearer)
    if y > FOOT:
        assert all(blocked(one) for one in candidates if R <= one <= FOOT)
