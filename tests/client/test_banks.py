"""client.geometry.banks: mirror geometry, and what the simulation makes of it."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import physics
from client import geometry

TABLE = physics.Table.olympiad()
RADIUS = TABLE.ball_radius
LINES = (RADIUS, TABLE.width - RADIUS, RADIUS, TABLE.length - RADIUS)

points = st.tuples(st.floats(0.15, 0.95), st.floats(0.15, 2.05))


def two_balls(cue_ball, ball):
    assume(geometry.distance(cue_ball, ball) > 4 * RADIUS)
    return physics.TableState.from_positions({0: cue_ball, 3: ball})


@given(points, points, st.integers(0, 5), st.integers(0, 3))
def test_the_way_in_and_the_way_out_make_equal_angles(cue_ball, ball, pocket, cushion):
    bank = geometry.bank(TABLE, two_balls(cue_ball, ball), 3, pocket, cushion)
    assume(bank is not None)
    axis = 0 if cushion < 2 else 1
    target = TABLE.mouths[pocket].tolist()
    assert bank.bounce[axis] == LINES[cushion]
    slopes = [(bank.bounce[1 - axis] - end[1 - axis]) / abs(bank.bounce[axis] - end[axis]) for end in (ball, target)]
    assert slopes[0] == pytest.approx(-slopes[1], abs=1e-9)
    assert geometry.distance(bank.ghost, ball) == pytest.approx(2 * RADIUS)


@given(points, points, st.integers(0, 5), st.integers(0, 3))
def test_a_kick_reaches_the_ghost_ball_of_the_straight_pot(cue_ball, ball, pocket, cushion):
    state = two_balls(cue_ball, ball)
    kick = geometry.kick(TABLE, state, 3, pocket, cushion)
    assume(kick is not None)
    assert kick.ghost == geometry.pot(TABLE, state, 3, pocket).ghost
    assert kick.phi == pytest.approx(geometry.azimuth(cue_ball, kick.bounce))
    assert kick.length >= geometry.distance(cue_ball, kick.ghost)


def test_open_banks_come_shortest_first_and_blocked_ones_not_at_all():
    state = physics.TableState.from_positions({0: (0.5, 1.7), 3: (0.4, 0.6), 8: (0.9, 0.4)})
    found = geometry.banks(TABLE, state, (3, 8))
    assert found == sorted(found, key=lambda each: each.length)
    assert found
    assert all(not each.blockers and each.cut <= 85.0 for each in found)
    walled = physics.TableState.from_positions({0: (0.5, 1.7), 3: (0.4, 0.6), 8: (0.4, 0.6 + 2 * RADIUS + 1e-6)})
    assert all(each.bounce for each in geometry.banks(TABLE, walled, (3,)))


def test_the_mirror_is_a_good_first_guess():
    """A softly struck bank, searched a few degrees around the mirror's direction, goes in."""
    state = physics.TableState.from_positions({0: (0.65, 1.1), 3: (0.75, 0.75)})
    bank = next(each for each in geometry.banks(TABLE, state, (3,)) if not each.kick)
    made = []
    for offset in [step / 50.0 for step in range(-200, 201)]:
        phi = bank.phi + offset
        theta = physics.min_elevation(TABLE, state, phi) + 0.1
        if math.isnan(theta):
            continue
        result = physics.simulate(TABLE, state, physics.Shot(3.0, phi, theta), trace=False)
        made.append(result.facts.pocket[3] == bank.pocket)
    assert any(made)


@pytest.mark.parametrize(
    "call", [lambda s: geometry.bank(TABLE, s, 3, 0, 4), lambda s: geometry.kick(TABLE, s, 3, 0, -1)]
)
def test_a_cushion_that_is_none_is_named(call):
    with pytest.raises(ValueError, match="W, E, S, N"):
        call(physics.TableState.from_positions({0: (0.5, 1.7), 3: (0.4, 0.6)}))


def test_a_ball_on_the_cushion_is_not_banked_off_it():
    state = physics.TableState.from_positions({0: (0.5, 1.7), 3: (RADIUS, 0.6)})
    assert geometry.bank(TABLE, state, 3, 3, 0) is None
