"""Two balls alone: the consistent law and the historical one (PHYSICS "Collisions")."""

import math

import numpy as np
import pytest
from mpmath import mpc, mpf
from support.moving import Launch, after, first, let_go, rolling
from support.truth.laws import historical_collision
from support.truth.model import Ball, World

import physics

R = 0.028575
TABLE = physics.Table.olympiad()
SMOOTH = TABLE.replace(mu_ball=0.0)


Spin = tuple[float, float, float]


def meeting(
    lean: float, speed: float = 2.0, spin: Spin = (0.0, 0.0, 0.0), gap: float = 1e-9
) -> tuple[dict[int, Launch], tuple[float, float]]:
    """Ball 1 at rest; ball 0 about to hit it, coming along +x, its centre line leaning by ``lean`` degrees."""
    angle = math.radians(lean)
    n = (math.cos(angle), math.sin(angle))
    hit = (0.6 - 2 * R * n[0], 1.0 - 2 * R * n[1])
    return {0: Launch((hit[0] - gap, hit[1]), (speed, 0.0), spin), 1: Launch((0.6, 1.0))}, n


def collision(table, launches):
    """Both balls' states just before and after the first collision."""
    result = let_go(table, launches)
    event = first(result, "ball_collision")
    snapshot = result.at(math.nextafter(event.time, 0.0))
    before = {ball: (snapshot.velocities[ball], snapshot.spins[ball]) for ball in launches}
    now = {s.ball: (np.array(s.velocity), np.array(s.spin)) for s in event.states}
    places = {s.ball: np.array(s.position) for s in event.states}
    low, high = sorted(launches)
    normal = (places[high] - places[low]) / np.linalg.norm(places[high] - places[low])
    return before, now, normal


def in_space(v):
    return np.array([v[0], v[1], 0.0])


@pytest.mark.parametrize("lean", [0.0, 1.0, 30.0, -45.0, 60.0, 80.0])
@pytest.mark.parametrize("e", [0.8, 0.95, 1.0])
def test_restitution_and_momentum(lean, e):
    """Normal impulse (1 + e)/2 m v_n with the relative normal speed; momentum kept; nothing else without friction."""
    launches, _ = meeting(lean)
    before, now, n = collision(SMOOTH.replace(e_ball=e), launches)
    closing = (before[0][0] - before[1][0]) @ n
    assert (now[1][0] - now[0][0]) @ n == pytest.approx(e * closing, rel=1e-12, abs=1e-14)
    assert now[0][0] + now[1][0] == pytest.approx(before[0][0] + before[1][0], rel=1e-13, abs=1e-14)
    assert now[1][0] == pytest.approx((1 + e) / 2 * closing * n, rel=1e-12, abs=1e-14)
    assert now[0][1] == pytest.approx(before[0][1], abs=1e-10)


@pytest.mark.parametrize("lean", [0.0, 20.0, 50.0, -70.0])
@pytest.mark.parametrize("mu", [0.01, 0.06, 1.0])
@pytest.mark.parametrize("spin", [(0.0, 0.0, 0.0), (0.0, 70.0, 0.0), (40.0, -20.0, 120.0)])
def test_friction_opposes_the_contact_slip(lean, mu, spin):
    """Size min(mu J_n, m |slip| / 7) against v1 - v2 - R n x (w1 + w2); the same change of both spins; the vertical
    velocity absorbed by the cloth."""
    launches, _ = meeting(lean, spin=spin)
    before, now, n = collision(TABLE.replace(mu_ball=mu), launches)
    n3 = np.append(n, 0.0)
    slip = in_space(before[0][0] - before[1][0]) - R * np.cross(n3, before[0][1] + before[1][1])
    slip -= (slip @ n3) * n3
    normal_impulse = (before[0][0] - before[1][0]) @ n
    size = min(mu * normal_impulse, np.linalg.norm(slip) / 7)
    impulse = -size * slip / np.linalg.norm(slip) if size else np.zeros(3)
    gained = in_space(now[0][0] - before[0][0]) + normal_impulse * n3
    assert gained[:2] == pytest.approx(impulse[:2], rel=1e-9, abs=1e-12)
    turn = 2.5 / R * np.cross(n3, impulse)
    for ball in (0, 1):
        assert now[ball][1] - before[ball][1] == pytest.approx(turn, rel=1e-8, abs=1e-9)
    assert now[0][0] + now[1][0] == pytest.approx(before[0][0] + before[1][0], rel=1e-12, abs=1e-13)


@pytest.mark.parametrize("mu", [0.0, 0.1, 1.0])
@pytest.mark.parametrize("e", [0.8, 1.0])
def test_energy_never_rises(mu, e):
    rng = np.random.default_rng(1)
    for _ in range(20):
        launches, _ = meeting(rng.uniform(-80, 80), rng.uniform(0.1, 5), tuple(rng.normal(0, 60, 3)))
        launches[1] = Launch((0.6, 1.0), spin=(0.0, 0.0, float(rng.normal(0, 60))))
        before, now, _ = collision(TABLE.replace(mu_ball=mu, e_ball=e), launches)
        kinetic = [sum(v @ v / 2 + 0.2 * R * R * (w @ w) for v, w in state.values()) for state in (before, now)]
        assert kinetic[1] <= kinetic[0] * (1 + 1e-13)


@pytest.mark.parametrize("lean", [0.0, 33.0, -60.0])
def test_which_ball_is_called_first_does_not_matter(lean):
    """Bit for bit."""
    launches, _ = meeting(lean, spin=(10.0, 20.0, 30.0))
    one = first(let_go(TABLE, launches), "ball_collision")
    two = first(let_go(TABLE, {9: launches[0], 4: launches[1]}), "ball_collision")
    for ball, name in ((0, 9), (1, 4)):
        p, q = after(one, ball), after(two, name)
        assert (p.position, p.velocity, p.spin, p.motion) == (q.position, q.velocity, q.spin, q.motion)


def test_a_straight_rolling_hit_keeps_its_follow():
    """The cue ball stops dead and then follows with 2/7 of its speed."""
    result = let_go(SMOOTH, {0: rolling((0.5, 0.8), (0.0, 1.0)), 1: Launch((0.5, 0.9))})
    hit = first(result, "ball_collision")
    speed = after(hit, 1).velocity[1]
    assert after(hit, 0).velocity == (0.0, 0.0)
    assert after(hit, 0).motion is physics.Motion.SLIDING
    own = next(e for e in result.events if e.kind.value == "sliding_rolling" and e.ball == 0)
    assert after(own, 0).velocity == pytest.approx((0.0, 2 / 7 * speed), rel=1e-12, abs=1e-16)


def test_a_straight_hit_with_backspin_draws():
    result = let_go(SMOOTH, {0: Launch((0.5, 0.84), (0.0, 2.0), (60.0, 0.0, 0.0)), 1: Launch((0.5, 0.9))})
    own = next(e for e in result.events if e.kind.value == "sliding_rolling" and e.ball == 0)
    assert after(own, 0).velocity[1] < -0.3


def test_elastic_balls_part_at_a_right_angle():
    """Equal masses, e = 1, no friction: after a glancing hit on a resting ball."""
    before, now, _ = collision(SMOOTH, meeting(40.0)[0])
    assert abs(now[0][0] @ now[1][0]) < 1e-14
    assert now[0][0] @ now[0][0] + now[1][0] @ now[1][0] == pytest.approx(before[0][0] @ before[0][0], rel=1e-13)


def test_the_historical_law_gains_energy():
    """Friction k = 0.01 v1n / |B| and spins by opposite signs: faults the consistent law does not have."""
    launches, _ = meeting(30.0, spin=(0.0, 2.0 / R, 0.0))
    gains = []
    for table in (TABLE, physics.Table.fastfiz()):
        before, now, _ = collision(table, launches)
        kinetic = [sum(v @ v / 2 + 0.2 * R * R * (w @ w) for v, w in state.values()) for state in (before, now)]
        gains.append(kinetic[1] / kinetic[0] - 1)
    assert gains[0] <= 0 < gains[1] < 0.015


def test_the_historical_law_rolls_two_moving_balls():
    """If both move: w_xy = k x v / R for both, w_z unchanged."""
    launches = {0: Launch((0.5, 1.0), (2.0, 0.0), (0.0, 0.0, 30.0)), 1: Launch((0.56, 1.003), (-1.0, 0.1))}
    event = first(let_go(physics.Table.fastfiz(), launches), "ball_collision")
    for state in event.states:
        assert state.motion is physics.Motion.ROLLING
        assert state.spin[:2] == pytest.approx((-state.velocity[1] / R, state.velocity[0] / R), rel=1e-12)
    assert after(event, 0).spin[2] == pytest.approx(30.0, abs=0.3)


SPINNING_IN_PLACE = Launch((0.6, 1.0), spin=(0.0, 0.0, -35.0))


@pytest.mark.parametrize(("mover", "spinner"), [(0, 1), (1, 0)])
@pytest.mark.parametrize("lean", [0.0, 25.0, -50.0])
def test_the_historical_law_spares_a_ball_that_spins_in_place(mover, spinner, lean):
    """Only two balls that both change their place are set to natural roll (FastFiz 0.2), whatever their numbers.

    Judged by the arbitrary-precision law of ``support/truth``, which tells by the velocity, not by a motion state.
    """
    launches, _ = meeting(lean, spin=(12.0, -20.0, 30.0))
    launches = {mover: launches[0], spinner: SPINNING_IN_PLACE}
    table = physics.Table.fastfiz()
    result = let_go(table, launches)
    event = first(result, "ball_collision")
    before = result.at(math.nextafter(event.time, 0.0))
    balls = {
        i: Ball(
            i,
            *(mpc(*(float(x) for x in xy)) for xy in (before.positions[i], before.velocities[i], before.spins[i, :2])),
        )
        for i in (0, 1)
    }
    for i, ball in balls.items():
        ball.w_z = mpf(float(before.spins[i, 2]))
    historical_collision(World(historical=True), balls[0], balls[1])
    for i, ball in balls.items():
        state = after(event, i)
        assert complex(*state.velocity) == pytest.approx(complex(ball.velocity), rel=1e-9, abs=1e-9)
        assert complex(*state.spin[:2]) == pytest.approx(complex(ball.w_xy), rel=1e-7, abs=1e-6)
        assert state.spin[2] == pytest.approx(float(ball.w_z), rel=1e-7, abs=1e-6)
        assert state.motion is physics.Motion.SLIDING
