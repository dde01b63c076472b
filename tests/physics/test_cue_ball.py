"""physics.cue_ball: its closed forms are what the simulation does (docs/physics.md, eq. 1-4 and 38-42)."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import physics
from physics.cue_ball import struck_ball

TABLES = {name: physics.Table.named(name).replace(cue_test=False) for name in ("olympiad", "nine_foot")}
STATE = physics.TableState.from_positions({0: (0.5, 1.0)})

offsets = st.floats(-19.0, 19.0)


@given(st.sampled_from(sorted(TABLES)), st.floats(0.2, 8.0), st.floats(0.0, 60.0), offsets, offsets)
def test_it_is_the_ball_that_the_simulation_starts_with(name, v, theta, a, b):
    """Miscues included: 19 mm to the side and up is beyond the tip's friction."""
    table = TABLES[name]
    result = physics.simulate(table, STATE, physics.Shot(v, 30.0, theta, a, b))
    first = result.at(0.0)
    found = struck_ball(table, [[v, 30.0, theta, a, b]])
    (vx, vy), (wx, wy, wz) = first.velocities[0], first.spins[0]
    azimuth = np.radians(30.0)
    assert np.hypot(vx, vy) == pytest.approx(found.speed[0], rel=1e-9, abs=1e-12)
    off = np.degrees(np.arctan2(vy, vx)) - 30.0
    assert (off + 180.0) % 360.0 - 180.0 == pytest.approx(found.squirt[0], abs=1e-7)
    radius = table.ball_radius
    assert radius * (wy * np.cos(azimuth) - wx * np.sin(azimuth)) == pytest.approx(found.follow[0], abs=1e-9)
    assert radius * (wx * np.cos(azimuth) + wy * np.sin(azimuth)) == pytest.approx(found.twist[0], abs=1e-9)
    assert radius * wz == pytest.approx(found.side[0], abs=1e-9)
    assert bool(result.facts.miscue) == found.slips[0]


def test_right_english_sends_the_ball_to_the_left():
    shot = physics.Shot(2.0, 90.0, 0.0, 10.0, 0.0)
    assert physics.squirt(TABLES["nine_foot"], shot) > 1.0
    assert physics.squirt(TABLES["olympiad"], shot) == 0.0


@pytest.mark.parametrize(
    ("shot", "words"), [((1.0, 2.0), "shot ="), (physics.Shot(2.0, 0.0, 0.0, 29.0, 0.0), "a, b = ")]
)
def test_what_is_no_stroke_is_refused(shot, words):
    with pytest.raises(physics.InvalidShot, match=words):
        physics.squirt(TABLES["nine_foot"], shot)
