"""Several contacts at once, resting and frozen balls (PHYSICS "Contacts")."""

import math

import pytest
from support.audit import audit
from support.moving import Launch, after, first, let_go, rolling
from support.play import OPEN
from support.scenes import RADIUS as R

import physics

SMOOTH = OPEN.replace(mu_ball=0.0)
PARTING = 0.2 * 9.81 * 1e-3
"""m/s; the fastest opening the rule gives: sliding friction on both balls, A tau / 2 = mu_slide g tau."""


def triangle(rows: int = 5, apex: tuple[float, float] = (0.558, 0.559)) -> dict[int, tuple[float, float]]:
    """Exactly touching, apex towards +y."""
    step = 2 * R
    balls: dict[int, tuple[float, float]] = {}
    for row in range(rows):
        for place in range(row + 1):
            balls[len(balls) + 1] = (apex[0] + (place - row / 2) * step, apex[1] - row * step * math.sqrt(0.75))
    return balls


def played(positions, shot, table=OPEN):
    state = physics.TableState.from_positions(positions)
    result = physics.simulate(table, state, shot)
    worst = audit(table, state, result)
    assert worst.rise <= 1e-12
    assert worst.overlap <= 1e-12
    return result


def test_two_balls_struck_at_once_leave_alike():
    """First round: one lambda for all linked pairs; the struck balls mirror each other."""
    side = math.sqrt(3) * R
    balls = {0: (0.5, 1.2), 1: (0.5 - R, 1.2 - side - 0.1), 2: (0.5 + R, 1.2 - side - 0.1)}
    result = played(balls, physics.Shot(3.0, 270.0), SMOOTH)
    hits = [e for e in result.events if e.kind.value == "ball_collision"][:2]
    assert {(e.ball, e.other) for e in hits} == {(0, 1), (0, 2)}
    assert hits[0].time == hits[1].time
    left, right = after(hits[1], 1) if hits[1].other == 1 else after(hits[0], 1), after(hits[1], 2)
    assert abs(left.velocity[0] + right.velocity[0]) < 1e-12
    assert abs(left.velocity[1] - right.velocity[1]) < 1e-12
    assert result.facts.struck_first == (1, 2)


def test_one_ball_against_two_by_the_formula():
    """D = sum of plastic changes, lambda = -(v.D)/(D.D) times 2 at e = 1: v' = -v/5 and two at 2 sqrt3/5 v."""
    side = math.sqrt(3) * R
    launches = {
        0: Launch((0.5, 1.0 + 1e-9), (0.0, -1.0)),
        1: Launch((0.5 - R, 1.0 - side)),
        2: Launch((0.5 + R, 1.0 - side)),
    }
    result = let_go(SMOOTH, launches)
    states = {s.ball: s for e in result.events if e.kind.value == "ball_collision" for s in e.states}
    speed = 1.0
    assert states[0].velocity[1] == pytest.approx(speed / 5, abs=1e-8)
    for ball in (1, 2):
        assert math.hypot(*states[ball].velocity) == pytest.approx(2 * math.sqrt(3) / 5 * speed, abs=1e-8)


def test_a_straight_break_of_the_touching_rack_stays_symmetric():
    """Neither back corner is preferred: mirror images to 1e-9 m after some hundred events."""
    result = played({0: (0.558, 1.7), **triangle()}, physics.Shot(8.0, 270.0))
    for left, right in {2: 3, 4: 6, 7: 10, 8: 9, 11: 15, 12: 14}.items():
        p, q = result.final.position(left), result.final.position(right)
        assert (p is None) == (q is None)
        if p and q:
            assert math.dist(p, (1.116 - q[0], q[1])) < 1e-9


@pytest.mark.parametrize("n", [1, 2, 3, 5])
def test_newtons_cradle(n):
    """One ball goes out; the others keep no more than the parting speed of the rule."""
    row = {i: (0.5, 1.2 - 2 * R * i) for i in range(1, n + 2)}
    result = played({0: (0.5, 1.5), **row}, physics.Shot(2.0, 270.0), SMOOTH)
    first_hit = first(result, "ball_collision")
    incoming = -result.at(math.nextafter(first_hit.time, 0.0)).velocities[0][1]
    speeds = [math.hypot(*v) for v in result.at(first_hit.time).velocities[: n + 2]]
    assert speeds[-1] == pytest.approx(incoming, abs=2 * PARTING)
    assert max(speeds[:-1]) <= 2 * PARTING


def test_a_frozen_pair_at_rest_stays_at_rest():
    """A third ball far away is played: the pair has no event."""
    result = played({0: (0.3, 1.8), 1: (0.6, 0.5), 2: (0.6 + 2 * R, 0.5)}, physics.Shot(0.3, 90.0))
    assert {event.ball for event in result.events} == {0}
    assert result.final.position(1) == (0.6, 0.5)


def test_playing_away_from_a_frozen_ball_does_not_touch_it():
    result = played({0: (0.5, 1.0), 1: (0.5 + 2 * R, 1.0)}, physics.Shot(0.2, 180.0))
    assert not [event for event in result.events if event.kind.value == "ball_collision"]
    assert result.final.position(1) == (0.5 + 2 * R, 1.0)
    assert result.facts.frozen_to_cue_ball[1] == 1


def test_playing_into_a_frozen_ball_moves_it_at_time_zero():
    result = played({0: (0.5, 1.0), 1: (0.5 + 2 * R, 1.0)}, physics.Shot(1.0, 0.0))
    hit = first(result, "ball_collision")
    assert hit.time == 0.0
    assert result.facts.struck_first == (1,)


def test_a_ball_between_the_cue_ball_and_its_cushion():
    """Hit into the cushion it is frozen to: it comes back through the cushion's law at once."""
    result = played({0: (0.3, 0.8), 1: (R, 0.8)}, physics.Shot(1.0, 180.0), SMOOTH)
    at_hit = [e for e in result.events if e.time == first(result, "ball_collision").time]
    assert {e.kind.value for e in at_hit} >= {"ball_collision", "rail_collision"}
    assert result.final.position(1) is not None


def test_two_balls_rolling_in_contact_have_no_endless_events():
    """Pressed by unequal decelerations, the case that loops for ever without a rule."""
    follower = Launch((0.5, 0.9), (0.0, 0.5), (-0.5 / R, 0.0, 0.0))
    leader = Launch((0.5, 0.9 + 2 * R), (0.0, 0.5), (0.0, 0.0, 0.0))
    result = let_go(OPEN, {1: follower, 2: leader})
    assert result.status is physics.Status.AT_REST
    assert result.n_events < 2000


def test_balls_rolling_alike_side_by_side_never_meet():
    """Equal decelerations: leading coefficients exactly 0; the touch neither presses nor opens."""
    pair = {1: rolling((0.5, 0.6), (0.0, 0.4)), 2: rolling((0.5 + 2 * R, 0.6), (0.0, 0.4))}
    result = let_go(OPEN, pair)
    assert [e.kind.value for e in result.events] == ["rolling_stationary"] * 2


def test_a_cluster_in_the_corner_survives_full_speed():
    balls = {1: (R, 0.12), 2: (R + 2 * R, 0.12), 3: (R, 0.12 + 2 * R), 4: (3 * R, 0.12 + 2 * R)}
    result = played({0: (0.5, 0.5), **balls}, physics.Shot(10.0, 215.0, 0.0, 5.0, 5.0))
    assert result.status is physics.Status.AT_REST
