"""Which strokes are possible (PHYSICS "Obstruction"): the cue against balls and cushions, tips off the ball."""

import math

import numpy as np
import pytest

import physics

TABLE = physics.Table.olympiad()
R, NOSE, CUE = 0.028575, 0.040005, 1.45
BEHIND = 0.20


def behind(phi: float, distance: float = BEHIND, side: float = 0.0) -> physics.TableState:
    """A ball straight behind the cue ball for a stroke in direction phi, moved ``side`` to its left."""
    angle = math.radians(phi)
    d, left = (math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))
    ball = (0.558 - distance * d[0] + side * left[0], 1.118 - distance * d[1] + side * left[1])
    return physics.TableState.from_positions({0: (0.558, 1.118), 5: ball})


@pytest.mark.parametrize("phi", [0.0, 17.0, 90.0, 133.3, 270.0, 359.0])
def test_a_ball_20_cm_behind_needs_9_5955_degrees(phi):
    """Whatever phi is: 9.59 is refused, 9.60 allowed."""
    assert physics.min_elevation(TABLE, behind(phi), phi) == pytest.approx(9.5955, abs=1e-4)
    blocked = physics.check(TABLE, behind(phi), physics.Shot(2.0, phi, 9.59))
    assert blocked is not None
    assert blocked.status is physics.Status.CUE_OBSTRUCTED
    assert "ball 5" in str(blocked)
    assert physics.check(TABLE, behind(phi), physics.Shot(2.0, phi, 9.60)) is None


def test_the_9_5955_degrees_by_geometry():
    """The cue's line from the tip (R behind, height R + b) passes at distance R from the other centre."""

    def clearance(degrees):
        theta = math.radians(degrees)
        return (BEHIND - R) * math.sin(theta) - 0.0 * math.cos(theta)

    low, high = 0.0, 45.0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if clearance(middle) < R else (low, middle)
    assert physics.min_elevation(TABLE, behind(0.0), 0.0) == pytest.approx(low, abs=1e-9)


@pytest.mark.parametrize("side", [0.0, 0.01, 0.02, -0.025])
@pytest.mark.parametrize("distance", [0.08, 0.3, 1.0])
@pytest.mark.parametrize("b", [-10.0, 0.0, 10.0])
def test_min_elevation_is_the_edge_of_check(side, distance, b):
    """Just above it the shot can be played, just below it cannot; nearer to no other centre than R."""
    phi = 90.0
    state = behind(phi, distance, side)
    needed = physics.min_elevation(TABLE, state, phi, 0.0, b)
    if math.isnan(needed):
        assert physics.check(TABLE, state, physics.Shot(1.0, phi, 70.0, 0.0, b)) is not None
        return
    assert physics.check(TABLE, state, physics.Shot(1.0, phi, min(70.0, needed + 1e-6), 0.0, b)) is None
    if needed > 1e-6:
        assert physics.check(TABLE, state, physics.Shot(1.0, phi, needed - 1e-6, 0.0, b)) is not None


def test_min_elevation_keeps_the_cue_a_radius_away():
    """Distance of the other centre from the cue's segment, by sampling the segment."""
    state = behind(90.0, 0.3, 0.015)
    theta = math.radians(physics.min_elevation(TABLE, state, 90.0, 2.0, 3.0))
    c = math.sqrt(R**2 - 0.002**2 - 0.003**2)
    tip = np.array([0.558 + 0.002, 1.118 - c, R + 0.003])
    way = np.array([0.0, -math.cos(theta), math.sin(theta)])
    centre = np.array([*state.position(5), R])
    along = np.clip((centre - tip) @ way, 0.0, CUE)
    assert np.linalg.norm(tip + along * way - centre) == pytest.approx(R, abs=1e-9)


@pytest.mark.parametrize("distance", [R + 0.005, 0.1, 0.5])
def test_the_cushion_behind_the_cue_ball(distance):
    """The cue crosses x = 0 above the nose's 40.005 mm: tan theta = (nose - R) / (distance - R)."""
    state = physics.TableState.from_positions({0: (distance, 0.7)})
    needed = math.degrees(math.atan((NOSE - R) / (distance - R)))
    found = physics.min_elevation(TABLE, state, 0.0)
    assert found == pytest.approx(needed, abs=1e-9)
    assert physics.check(TABLE, state, physics.Shot(1.0, 0.0, needed - 1e-6)) is not None
    assert physics.check(TABLE, state, physics.Shot(1.0, 0.0, needed + 1e-6)) is None


def test_no_elevation_is_enough_against_a_touching_ball_behind():
    state = physics.TableState.from_positions({0: (0.558, 1.118), 5: (0.558 - 2 * R, 1.118)})
    assert (
        math.isnan(physics.min_elevation(TABLE, state, 0.0, 0.0, 0.0))
        or physics.min_elevation(TABLE, state, 0.0) > 60.0
    )


def test_the_middle_of_the_table_needs_no_elevation():
    """Nothing within the cue's 1.45 m but a cushion: a long table's middle, played across its width, has one."""
    state = physics.TableState.from_positions({0: (0.558, 2.0)})
    assert physics.min_elevation(TABLE, state, 90.0) == 0.0


def test_a_tip_off_the_ball():
    state = physics.TableState.from_positions({0: (0.558, 1.118)})
    off = physics.check(TABLE, state, physics.Shot(1.0, 90.0, 10.0, 25.0, 20.0))
    assert off is not None
    assert off.status is physics.Status.TIP_OFF_BALL


def test_a_cue_through_the_cue_ball():
    """c cos theta + b sin theta <= 0: steep and far below the middle."""
    state = physics.TableState.from_positions({0: (0.558, 1.118)})
    assert physics.check(TABLE, state, physics.Shot(1.0, 90.0, 70.0, 0.0, -28.0)) is not None


def test_no_cue_ball():
    state = physics.TableState.from_positions({3: (0.558, 1.118)})
    missing = physics.check(TABLE, state, physics.Shot(1.0, 90.0))
    assert missing is not None
    assert missing.status is physics.Status.NO_CUE_BALL
    result = physics.simulate(TABLE, state, physics.Shot(1.0, 90.0))
    assert (result.status, result.n_events, result.duration) == (physics.Status.NO_CUE_BALL, 0, 0.0)
    assert result.final == state


def test_a_shot_that_cannot_be_played_moves_nothing():
    state = behind(0.0)
    result = physics.simulate(TABLE, state, physics.Shot(5.0, 0.0, 0.0))
    assert result.status is physics.Status.CUE_OBSTRUCTED
    assert result.final == state
    assert len(result.events) == 0
    assert result.facts.n_events == 0


def test_the_historical_table_does_not_test_the_cue():
    assert physics.check(physics.Table.fastfiz(), behind(0.0), physics.Shot(5.0, 0.0)) is None
    assert physics.min_elevation(physics.Table.fastfiz(), behind(0.0), 0.0) == 0.0


def test_bad_offsets_for_min_elevation_raise():
    with pytest.raises(physics.InvalidShot, match=r"a\^2"):
        physics.min_elevation(TABLE, behind(0.0), 0.0, 30.0, 0.0)
