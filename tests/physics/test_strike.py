"""The cue strike ([I], section 5; PHYSICS "Strike"): velocity and spin it gives, and the exactness of the azimuth."""

import math
from typing import Any

import pytest
from support.moving import after, first

import physics

R, M = 0.028575, 0.16301
CUE = 0.160 / 0.302631579
OPEN = physics.Table.olympiad().replace(cue_test=False)
LONE = physics.TableState.from_positions({0: (0.5, 1.0)})


def struck(shot: physics.Shot, table: physics.Table = OPEN) -> physics.BallState:
    result = physics.simulate(table, LONE, shot)
    return after(first(result, "cue_strike"), 0)


def formula(shot: physics.Shot, bracket_factor: float = 1.0, inertia: float = 0.4 * M * R**2) -> tuple[Any, Any]:
    """F = 2 m V / (1 + m/M + 5/(2R^2) [a^2 + (bC - cS)^2]); v = (F C/m) d; w = ..."""
    a, b, theta, phi = shot.a / 1e3, shot.b / 1e3, math.radians(shot.theta), math.radians(shot.phi)
    c, co, si = math.sqrt(R * R - a * a - b * b), math.cos(theta), math.sin(theta)
    lever = b * co - c * si
    force = 2 * M * shot.v / (1 + M / CUE + bracket_factor * 5 / (2 * R * R) * (a * a + lever * lever))
    d, left = (math.cos(phi), math.sin(phi)), (-math.sin(phi), math.cos(phi))
    velocity = tuple(force * co / M * x for x in d)
    plane = tuple(force / inertia * (lever * y + a * si * x) for x, y in zip(d, left, strict=True))
    return velocity, (*plane, force / inertia * a * co)


SHOTS = [
    physics.Shot(2.0, 0.0),
    physics.Shot(10.0, 33.0, 5.0, 8.0, 12.0),
    physics.Shot(0.5, 211.0, 45.0, -6.0, -9.0),
    physics.Shot(6.0, -77.5, 70.0, 3.0, 20.0),
    physics.Shot(1.0, 1234.5, 20.0, 0.0, -15.0),
]


@pytest.mark.parametrize("shot", SHOTS, ids=str)
def test_velocity_and_spin_by_the_formula(shot):
    state, (velocity, spin) = struck(shot), formula(shot)
    assert state.velocity == pytest.approx(velocity, rel=1e-13, abs=1e-14)
    assert state.spin == pytest.approx(spin, rel=1e-13, abs=1e-12)


@pytest.mark.parametrize("shot", SHOTS, ids=str)
def test_the_historical_strike(shot):
    """FastFiz: the bracket times 0.999425 and I = 0.4 * 0.160 R^2 * 0.995473."""
    state = struck(shot, physics.Table.fastfiz())
    velocity, spin = formula(shot, 0.999425, 0.4 * 0.160 * R * R * 0.995473)
    assert state.velocity == pytest.approx(velocity, rel=1e-13, abs=1e-14)
    assert state.spin == pytest.approx(spin, rel=1e-13, abs=1e-12)


def test_a_central_level_hit_is_a_collision_of_two_bodies():
    """2 V / (1 + m/M), no spin."""
    state = struck(physics.Shot(3.0, 90.0))
    assert state.velocity == pytest.approx((0.0, 6.0 / (1 + M / CUE)), rel=1e-15)
    assert state.spin == (0.0, 0.0, 0.0)


def test_signs_of_english_and_follow():
    """a > 0 turns the ball counter-clockwise seen from above; b > 0 turns it forwards, b < 0 backwards."""
    assert struck(physics.Shot(2.0, 90.0, a=5.0)).spin[2] > 0 > struck(physics.Shot(2.0, 90.0, a=-5.0)).spin[2]
    follow, draw = struck(physics.Shot(2.0, 90.0, b=5.0)), struck(physics.Shot(2.0, 90.0, b=-5.0))
    assert follow.spin[0] < 0 < draw.spin[0]


def test_a_hit_at_two_fifths_of_the_radius_rolls_at_once():
    """b = 2R/5: w R = v, the height of natural roll."""
    height = 0.4 * R * 1e3
    state = struck(physics.Shot(2.0, 0.0, b=height))
    assert abs(state.velocity[0] - R * state.spin[1]) < 1e-12
    assert state.motion is physics.Motion.ROLLING
    assert struck(physics.Shot(2.0, 0.0, b=height - 1e-6)).motion is physics.Motion.SLIDING


def test_a_raised_cue_draws():
    """theta > 0 at b = 0 hits below the middle: lever -c sin theta."""
    assert struck(physics.Shot(2.0, 0.0, 10.0)).spin[1] < 0


@pytest.mark.parametrize("turn", [0.0, 360.0, -360.0, 3600.0, 360.0 * 2**30])
def test_multiples_of_90_degrees_are_exact(turn):
    """Sine and cosine exactly 0 and 1: a straight shot stays on its line."""
    for phi, exact in ((0.0, (1, 0)), (90.0, (0, 1)), (180.0, (-1, 0)), (270.0, (0, -1))):
        velocity = struck(physics.Shot(2.0, phi + turn)).velocity
        assert (velocity[0] == 0.0, velocity[1] == 0.0) == (exact[0] == 0, exact[1] == 0)
        assert (math.copysign(1, velocity[0]) == exact[0]) or exact[0] == 0


@pytest.mark.parametrize("phi", [45.0, 135.0, 225.0, 315.0])
def test_sine_and_cosine_are_equal_at_45_degrees(phi):
    vx, vy = struck(physics.Shot(2.0, phi)).velocity
    assert abs(vx) == abs(vy)


@pytest.mark.parametrize("phi", [0.1, 12.34375, 44.9, 45.1, 61.0, 89.999])
def test_the_azimuth_is_odd_even_and_periodic_exactly(phi):
    """phi is reduced exactly: these angles are sums without rounding only where they are binary fractions."""
    vx, vy = struck(physics.Shot(2.0, phi)).velocity
    assert struck(physics.Shot(2.0, -phi)).velocity == (vx, -vy)
    binary = round(phi * 2**20) / 2**20
    vx, vy = struck(physics.Shot(2.0, binary)).velocity
    assert struck(physics.Shot(2.0, 180.0 - binary)).velocity == (-vx, vy)
    assert struck(physics.Shot(2.0, 90.0 - binary)).velocity == (vy, vx)
    assert struck(physics.Shot(2.0, binary + 720.0)).velocity == (vx, vy)


def test_sine_and_cosine_to_one_unit_in_the_last_place():
    """Against the arbitrary-precision library, through the direction of a strike of known speed."""
    from mpmath import mp, mpf

    speed = struck(physics.Shot(2.0, 0.0)).velocity[0]
    with mp.workdps(40):
        for k in range(400):
            phi = k * 0.9173 - 180.0
            for value, true in zip(
                struck(physics.Shot(2.0, phi)).velocity,
                (mp.cospi(mpf(phi) / 180), mp.sinpi(mpf(phi) / 180)),
                strict=True,
            ):
                assert abs(value / speed - true) <= 2.5e-16
