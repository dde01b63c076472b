"""client.geometry: identities of plane geometry, symmetry, and agreement with the simulation."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import physics
from client import geometry
from referee import Action, CueBallArea, EightBall, Game, Phase

TABLE = physics.Table.olympiad()
RADIUS = TABLE.ball_radius

points = st.tuples(st.floats(0.1, 1.0), st.floats(0.1, 2.1))


@given(points, points)
def test_the_ghost_ball_touches_the_ball_on_the_far_side_of_its_target(ball, target):
    assume(geometry.distance(ball, target) > 1e-3)
    ghost = geometry.ghost_ball(ball, target, RADIUS)
    assert geometry.distance(ghost, ball) == pytest.approx(2 * RADIUS, abs=1e-12)
    assert geometry.distance(ghost, target) == pytest.approx(geometry.distance(ball, target) + 2 * RADIUS, abs=1e-12)


@given(points, points)
def test_azimuth_points_from_start_to_end(start, end):
    assume(geometry.distance(start, end) > 1e-6)
    phi = math.radians(geometry.azimuth(start, end))
    reach = geometry.distance(start, end)
    assert start[0] + reach * math.cos(phi) == pytest.approx(end[0], abs=1e-9)
    assert start[1] + reach * math.sin(phi) == pytest.approx(end[1], abs=1e-9)


@pytest.mark.parametrize(
    ("cue_ball", "cut"), [((0.5, 0.5), 0.0), ((0.5 - 0.5, 1.0 - 2 * RADIUS), 90.0), ((0.5, 1.6), 180.0)]
)
def test_cut_angle_of_straight_square_and_impossible(cue_ball, cut):
    assert geometry.cut_angle(cue_ball, (0.5, 1.0), (0.5, 2.0), RADIUS) == pytest.approx(cut, abs=1e-9)


def test_no_direction_between_equal_points():
    with pytest.raises(ValueError, match=r"\(0.5, 0.5\)"):
        geometry.azimuth((0.5, 0.5), (0.5, 0.5))
    with pytest.raises(ValueError, match="already there"):
        geometry.ghost_ball((0.5, 0.5), (0.5, 0.5), RADIUS)


def test_blockers_are_the_balls_within_two_radii_of_the_path():
    state = physics.TableState.from_positions(
        {
            0: (0.5, 0.5),
            1: (0.5, 1.5),
            2: (0.5 + 1.9 * RADIUS, 1.0),
            3: (0.5 - 2.1 * RADIUS, 1.0),
            4: (0.5, 0.2),
        }
    )
    path = (0.5, 0.5), (0.5, 1.46)
    assert geometry.blockers(state, *path, RADIUS, ignore=(0, 1)) == (2,)
    assert geometry.blockers(state, *path, RADIUS, ignore=(0,)) == (1, 2)
    assert not geometry.is_clear(state, *path, RADIUS, ignore=(0, 1))


def test_a_path_of_no_length_is_blocked_only_where_it_stands():
    state = physics.TableState.from_positions({0: (0.5, 0.5), 1: (0.6, 0.5)})
    assert geometry.blockers(state, (0.5, 0.5), (0.5, 0.5), RADIUS) == (0,)


@pytest.mark.parametrize("pocket", range(6))
def test_an_open_pot_is_made_by_the_simulation(pocket):
    """A direct check against the physics: aim as `pot` says, and the ball drops where it says."""
    mouth = TABLE.mouths[pocket]
    middle = 0.5 * TABLE.width, 0.5 * TABLE.length + 0.2
    ball = tuple((mouth + 0.5 * (middle - mouth)).tolist())
    state = physics.TableState.from_positions({0: middle, 5: ball})
    found = geometry.pot(TABLE, state, 5, pocket)
    assert found.is_open
    assert found.cut == pytest.approx(0.0, abs=1e-6)
    theta = physics.min_elevation(TABLE, state, found.phi)
    result = physics.simulate(TABLE, state, physics.Shot(2.0, found.phi, theta))
    assert (5, pocket) in [(ball, into) for ball, into, _ in result.facts.pocketed_in_order]


def test_mirror_images_are_equally_hard():
    state = physics.TableState.from_positions({0: (0.4, 1.6), 5: (0.3, 0.6)})
    mirrored = physics.TableState.from_positions({0: (TABLE.width - 0.4, 1.6), 5: (TABLE.width - 0.3, 0.6)})
    for pocket, twin in ((0, 5), (1, 4), (2, 3)):
        here, there = geometry.pot(TABLE, state, 5, pocket), geometry.pot(TABLE, mirrored, 5, twin)
        assert here.tolerance == pytest.approx(there.tolerance, abs=1e-9)
        assert here.cut == pytest.approx(there.cut, abs=1e-9)


def test_pots_lists_open_pots_from_the_easiest_on():
    state = physics.TableState.from_positions({0: (0.5, 1.2), 3: (0.2, 0.3), 9: (0.9, 0.9), 4: (0.15, 0.2)})
    listed = geometry.pots(TABLE, state, (3, 9))
    assert [pot.tolerance for pot in listed] == sorted((pot.tolerance for pot in listed), reverse=True)
    assert all(pot.is_open and pot.ball in (3, 9) for pot in listed)
    blocked = geometry.pot(TABLE, state, 3, 0)
    assert blocked.blockers == (4,)
    assert not blocked.is_open


def test_further_away_is_harder():
    near = physics.TableState.from_positions({0: (0.5, 0.7), 3: (0.3, 0.4)})
    far = physics.TableState.from_positions({0: (0.8, 1.15), 3: (0.3, 0.4)})
    assert geometry.pot(TABLE, near, 3, 0).tolerance > geometry.pot(TABLE, far, 3, 0).tolerance


def test_a_pocket_may_be_named():
    state = physics.TableState.from_positions({0: (0.5, 0.7), 3: (0.3, 0.4)})
    assert geometry.pot(TABLE, state, 3, "SW") == geometry.pot(TABLE, state, 3, 0)
    assert geometry.pots(TABLE, state, [3], ["SW", "W"]) == geometry.pots(TABLE, state, [3], [0, 1]) != []
    assert geometry.bank(TABLE, state, 3, "NW", 3) == geometry.bank(TABLE, state, 3, 2, 3)
    assert geometry.kick(TABLE, state, 3, "SW", 1) == geometry.kick(TABLE, state, 3, 0, 1)
    with pytest.raises(ValueError, match="pocket = 'south': must be 0 to 5, or SW"):
        geometry.bank(TABLE, state, 3, "south", 3)


def test_bad_input_is_named():
    state = physics.TableState.from_positions({0: (0.5, 0.7), 3: (0.3, 0.4)})
    with pytest.raises(ValueError, match="ball 7 is not on the table"):
        geometry.pot(TABLE, state, 7, 0)
    with pytest.raises(ValueError, match="pocket = 6: must be 0 to 5, or SW, W, NW, NE, E, SE"):
        geometry.pot(TABLE, state, 3, 6)
    with pytest.raises(ValueError, match="cue ball"):
        geometry.pot(TABLE, state, 0, 1)


@pytest.mark.parametrize(
    ("place", "free", "in_kitchen"),
    [
        ((0.5, 1.9), True, True),
        ((0.5, TABLE.head_string), True, False),
        ((0.5, 0.5), True, False),
        ((0.3, 1.9), False, False),
        ((0.3 + 2 * RADIUS, 1.9), False, False),
        ((RADIUS, 0.8), True, False),
        ((RADIUS, 0.5 * TABLE.length), False, False),
        ((0.01, 1.9), False, False),
        ((math.nan, 1.9), False, False),
    ],
    ids=[
        "clear",
        "on-the-string",
        "outside-the-kitchen",
        "on-a-ball",
        "touching",
        "frozen",
        "mouth",
        "rail",
        "nan",
    ],
)
def test_free_places_are_those_the_referee_accepts(place, free, in_kitchen):
    """R6, R37, R40: on the string is not behind it, touching counts as overlap, mouth lines are no place."""
    state = physics.TableState.from_positions({3: (0.3, 1.9), 8: (0.9, 0.3)})
    assert geometry.is_free(TABLE, state, place) is free
    assert geometry.is_free(TABLE, state, place, kitchen=True) is in_kitchen
    for area, ours in ((CueBallArea.ANYWHERE, free), (CueBallArea.KITCHEN, in_kitchen)):
        game = Game(state, Phase.PLAY, 0, 0, cue_ball_in_hand=area)
        action = Action(shot=physics.Shot(2.0, 200.0, 60.0), call="safety", cue_ball=place)
        refused = {refusal.field for refusal in EightBall(TABLE).check(game, action)}
        assert ("cue_ball" not in refused) is ours


def test_a_lattice_has_free_places_only():
    state = physics.rack(TABLE, "eight_ball", seed=3)
    everywhere = geometry.lattice(TABLE, state, 9, 17)
    kitchen = geometry.lattice(TABLE, state, 9, 5, kitchen=True)
    assert len(everywhere) > 100
    assert all(geometry.is_free(TABLE, state, place) for place in everywhere)
    assert all(place[1] > TABLE.head_string for place in kitchen)
