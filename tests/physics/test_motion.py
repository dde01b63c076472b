"""Motion between events and the transitions of [I] (PHYSICS "Motion between events")."""

import math

import pytest
from support.moving import Launch, after, first, let_go, rolling

import physics

R, G = 0.028575, 9.81
TABLE = physics.Table.olympiad()
HERE = (0.4, 0.7)


def test_a_ball_that_slides_without_spin_rolls_at_five_sevenths_of_its_speed():
    """Lasts 2 |u| / (7 mu_s g)."""
    result = let_go(TABLE, {1: Launch(HERE, (1.4, 0.0))})
    event = first(result, "sliding_rolling")
    t = 2 * 1.4 / (7 * 0.2 * G)
    assert event.time == pytest.approx(t, rel=1e-14)
    state = after(event, 1)
    assert state.velocity == pytest.approx((1.0, 0.0), rel=1e-14)
    assert state.position[0] == pytest.approx(HERE[0] + 1.4 * t - 0.1 * G * t * t, rel=1e-14)
    assert state.spin == pytest.approx((0.0, 1.0 / R, 0.0), rel=1e-14)
    assert state.motion is physics.Motion.ROLLING


def test_a_slide_curves_along_its_slip():
    """Mass\N{LATIN SMALL LETTER E WITH ACUTE}: the acceleration is -mu g times the unit slip, constant, not along v."""
    result = let_go(TABLE, {1: Launch(HERE, (0.5, 0.0), (30.0, 0.0, 0.0))})
    ux, uy = 0.5, R * 30.0
    t = 2 * math.hypot(ux, uy) / (7 * 0.2 * G)
    middle = result.at(t / 2)
    pull = 0.2 * G / math.hypot(ux, uy)
    where = [HERE[0] + 0.5 * t / 2 - pull * ux * t * t / 8, HERE[1] - pull * uy * t * t / 8]
    assert middle.positions[1] == pytest.approx(where, rel=1e-14)
    assert middle.velocities[1] == pytest.approx([0.5 - pull * ux * t / 2, -pull * uy * t / 2], rel=1e-13)


def test_rolling_is_straight_and_lasts_v_over_mu_g():
    result = let_go(TABLE, {1: rolling(HERE, (0.18, 0.24))})
    event = first(result, "rolling_stationary")
    assert event.time == pytest.approx(0.3 / (0.015 * G), rel=1e-14)
    way = 0.3**2 / (2 * 0.015 * G)
    assert after(event, 1).position == pytest.approx((HERE[0] + 0.6 * way, HERE[1] + 0.8 * way), rel=1e-14)
    assert after(event, 1).spin == (0.0, 0.0, 0.0)
    assert result.duration == event.time


def test_side_spin_decays_while_rolling_and_outlives_it():
    """w_z falls at 5 mu_sp g / 2R in every moving state; spinning lasts 2R |w_z| / (5 mu_sp g)."""
    rate = 5 * 0.044 * G / (2 * R)
    result = let_go(TABLE, {1: rolling(HERE, (0.1, 0.0), w_z=-60.0)})
    stop = first(result, "rolling_spinning")
    left = 60.0 - rate * stop.time
    assert after(stop, 1).spin == pytest.approx((0.0, 0.0, -left), rel=1e-13)
    assert result.duration == pytest.approx(60.0 / rate, rel=1e-14)
    assert first(result, "spinning_stationary").time == result.duration


def test_side_spin_that_ends_on_the_way_has_no_event():
    result = let_go(TABLE, {1: rolling(HERE, (0.3, 0.0), w_z=5.0)})
    assert [event.kind.value for event in result.events] == ["rolling_stationary"]
    assert result.at(1.0).spins[1][2] == 0.0


def test_a_slide_can_end_at_rest():
    """Backspin w R = 5v/2 takes the speed away exactly as the slip ends: sliding to stationary ..."""
    result = let_go(TABLE, {1: Launch(HERE, (1.0, 0.0), (0.0, -2.5 / R, 0.0))})
    event = result.events[0]
    assert event.kind.value == "sliding_stationary"
    assert event.time == pytest.approx(2 * 3.5 / (7 * 0.2 * G), rel=1e-14)
    assert result.duration == event.time


def test_a_slide_can_end_in_spinning():
    """... or to spinning, the tenth transition: the paper lacks it."""
    result = let_go(TABLE, {1: Launch(HERE, (1.0, 0.0), (0.0, -2.5 / R, 80.0))})
    assert [event.kind.value for event in result.events] == ["sliding_spinning", "spinning_stationary"]


def test_more_backspin_brings_the_ball_back():
    result = let_go(TABLE, {1: Launch(HERE, (1.0, 0.0), (0.0, -4.0 / R, 0.0))})
    assert after(first(result, "sliding_rolling"), 1).velocity[0] == pytest.approx(5 / 7 - 2 * 4 / 7, rel=1e-13)


def test_a_ball_at_rest_with_slip_slides_off():
    """v = 0 but u != 0: it slides (after a straight hit draw and follow must survive)."""
    result = let_go(TABLE, {1: Launch(HERE, (0.0, 0.0), (0.0, 20.0, 0.0))})
    assert after(first(result, "sliding_rolling"), 1).velocity == pytest.approx((2 / 7 * R * 20.0, 0.0), rel=1e-13)


def test_spinning_in_place():
    result = let_go(TABLE, {1: Launch(HERE, spin=(0.0, 0.0, 30.0))})
    assert result.duration == pytest.approx(2 * R * 30.0 / (5 * 0.044 * G), rel=1e-14)
    assert result.final.position(1) == pytest.approx(HERE, abs=1e-16)


def test_the_historical_side_spin_decays_at_a_quarter_while_sliding():
    """FastFiz, faults included."""
    rate = 5 * 0.044 * G / (2 * R)
    for table, share in ((TABLE, 1.0), (physics.Table.fastfiz(), 0.25)):
        event = first(let_go(table, {1: Launch(HERE, (1.4, 0.0), (0.0, 0.0, 100.0))}), "sliding_rolling")
        assert after(event, 1).spin[2] == pytest.approx(100.0 - share * rate * event.time, rel=1e-13)


@pytest.mark.parametrize(("mu", "value"), [("mu_slide", 0.4), ("mu_roll", 0.03), ("mu_spin", 0.088)])
def test_twice_the_friction_halves_the_time(mu, value):
    launch = {
        "mu_slide": Launch(HERE, (1.4, 0.0)),
        "mu_roll": rolling(HERE, (0.1, 0.0)),
        "mu_spin": Launch(HERE, spin=(0.0, 0.0, 30.0)),
    }[mu]
    usual, rough = (let_go(table, {1: launch}).events[0].time for table in (TABLE, TABLE.replace(**{mu: value})))
    assert rough == pytest.approx(usual / 2, rel=1e-14)
