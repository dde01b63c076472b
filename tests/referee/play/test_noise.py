"""Execution noise: issue "The main job", point 4; docs/protocol.md, Noise."""

import math
import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from physics.errors import FieldError
from physics.generator import SeededStream
from physics.shot import FIELDS, Shot
from physics.table import Table
from referee.play import NoiseModel
from referee.play.noise import Sigmas
from referee.play.noise_file import read_sigmas, write_sigmas

SEED = bytes(range(32))
SHOT = Shot(v=4.0, phi=120.0, theta=20.0, a=1.0, b=-2.0)
finite = st.floats(allow_nan=False, allow_infinity=False)
shots = st.builds(Shot, v=st.floats(0, 10), phi=finite, theta=st.floats(0, 70), a=finite, b=finite)


def bits(shot):
    return struct.pack("<5d", *(getattr(shot, name) for name in FIELDS))


def test_golden_value():
    """Bits another implementation must reproduce."""
    assert NoiseModel(1.0).perturb(SHOT, SEED, 5).to_dict() == {
        "v": 3.9241405233380413,
        "phi": 120.34729670332435,
        "theta": 20.099557940073286,
        "a": 1.448971979631173,
        "b": -2.6275140865862157,
    }


@given(shots)
def test_level_zero_leaves_every_bit(shot):
    assert bits(NoiseModel(0.0).perturb(shot, SEED, 0)) == bits(shot)


def test_order_and_sigmas_are_the_olympiads():
    """a 0.5 mm, b 0.5 mm, theta 0.1 deg, phi 0.125 deg, v 0.075 m/s, drawn in this order."""
    stream = SeededStream(SEED, "pooliad/1 stroke 9")
    z = [stream.gaussian() for _ in range(5)]
    noisy = NoiseModel(2.0).perturb(SHOT, SEED, 9)
    assert noisy.a == SHOT.a + 2.0 * 0.5 * z[0]
    assert noisy.b == SHOT.b + 2.0 * 0.5 * z[1]
    assert noisy.theta == SHOT.theta + 2.0 * 0.1 * z[2]
    assert noisy.phi == SHOT.phi + 2.0 * 0.125 * z[3]
    assert noisy.v == SHOT.v + 2.0 * 0.075 * z[4]


@pytest.mark.parametrize(("name", "sigma"), [("a", 0.5), ("b", 0.5), ("theta", 0.1), ("phi", 0.125), ("v", 0.075)])
def test_noise_is_gaussian_and_independent_between_strokes(name, sigma):
    noisy = [NoiseModel(1.0).perturb(SHOT, SEED, stroke) for stroke in range(2_000)]
    errors = np.array([getattr(shot, name) - getattr(SHOT, name) for shot in noisy]) / sigma
    assert stats.kstest(errors, "norm").pvalue > 0.001
    assert abs(np.corrcoef(errors[:-1], errors[1:])[0, 1]) < 4 / math.sqrt(len(errors))


def test_noise_depends_on_seed_and_index_alone():
    """The same stroke asked for twice is the same stroke: nobody gets a second draw."""
    noise = NoiseModel(1.0)
    assert noise.perturb(SHOT, SEED, 3) == noise.perturb(SHOT, SEED, 3)
    assert noise.perturb(SHOT, SEED, 3) != noise.perturb(SHOT, SEED, 4)
    assert noise.perturb(SHOT, SEED, 3) != noise.perturb(SHOT, bytes(32), 3)
    other = SHOT.replace(v=5.0)
    shift = noise.perturb(other, SEED, 3).a - other.a
    assert shift == noise.perturb(SHOT, SEED, 3).a - SHOT.a


@given(shots, st.floats(0.01, 5), st.integers(0, 400))
def test_noisy_shots_are_in_range(shot, level, stroke):
    noisy = NoiseModel(level).perturb(shot, SEED, stroke)
    assert 0.0 <= noisy.phi < 360.0
    assert 0.0 <= noisy.theta <= 70.0
    assert 0.0 <= noisy.v <= 10.0


def test_the_table_bounds_the_noise():
    """A table with a greater speed and elevation lets noise go there; one with less does not."""
    nine, slow = Table.nine_foot(), Table.nine_foot().replace(v_max=4.0, theta_max=20.0)
    hard = Shot(11.99, 0.0, 84.9)
    played = [NoiseModel(1.0).perturb(hard, SEED, stroke, nine) for stroke in range(60)]
    assert {shot.v == 12.0 for shot in played} == {True, False}
    assert {shot.theta == 85.0 for shot in played} == {True, False}
    assert max(NoiseModel(1.0).perturb(SHOT, SEED, stroke, slow).v for stroke in range(60)) == 4.0
    draws = np.random.default_rng(1).normal(size=(60, 5))
    rows = NoiseModel(1.0).perturb_rows(np.tile([11.99, 0.0, 84.9, 0.0, 0.0], (60, 1)), draws, nine)
    assert (rows[:, 0].max(), rows[:, 2].max()) == (12.0, 85.0)


def test_v_and_theta_are_clamped_and_phi_wraps():
    strokes = range(60)
    low = [NoiseModel(1.0).perturb(Shot(0.0, 0.0), SEED, stroke) for stroke in strokes]
    high = [NoiseModel(1.0).perturb(Shot(10.0, 359.99, 70.0), SEED, stroke) for stroke in strokes]
    assert {shot.v == 0.0 for shot in low} == {True, False}
    assert {shot.theta == 0.0 for shot in low} == {True, False}
    assert {shot.phi > 180.0 for shot in low} == {True, False}
    assert {shot.v == 10.0 for shot in high} == {True, False}
    assert {shot.theta == 70.0 for shot in high} == {True, False}
    assert {shot.phi < 180.0 for shot in high} == {True, False}


@pytest.mark.parametrize("turns", [2**20, 2**44, -(2**44)])
def test_a_huge_angle_does_not_swallow_the_noise(turns):
    """Attack: at 360 * 2^44 deg a double's spacing is 1 deg, eight sigmas of phi."""
    aimed = SHOT.replace(phi=360.0 * turns)
    plain = SHOT.replace(phi=0.0)
    for stroke in range(20):
        assert NoiseModel(1.0).perturb(aimed, SEED, stroke) == NoiseModel(1.0).perturb(plain, SEED, stroke)


def test_an_angle_that_rounds_up_to_a_full_turn_is_zero():
    """-1e-311 + 360 is 360.0 in doubles, which is outside [0, 360)."""
    noisy = [NoiseModel(1e-310).perturb(Shot(1.0, 0.0), SEED, stroke).phi for stroke in range(20)]
    assert {phi > 0.0 for phi in noisy} == {True, False}
    assert max(noisy) < 1e-300


def test_a_tip_off_the_ball_is_a_possible_result():
    """R39: noise may push the tip off the ball; that is a miscue later, not an error here."""
    edge = Shot(3.0, 0.0, 10.0, a=28.5)
    noisy = [NoiseModel(5.0).perturb(edge, SEED, stroke) for stroke in range(20)]
    assert any(shot.a**2 + shot.b**2 > 28.575**2 for shot in noisy)


@pytest.mark.parametrize("level", [-0.1, 5.1, math.nan, math.inf])
def test_levels_outside_zero_to_five_are_refused(level):
    with pytest.raises(ValueError, match=r"must be in \[0, 5.0\]"):
        NoiseModel(level)


@pytest.mark.parametrize("level", ["x", True, None, [1.0], 1j, float("nan"), -0.1, 5.1])
def test_a_level_that_is_none_is_named(level):
    with pytest.raises(ValueError, match="level = "):
        NoiseModel(level)


@pytest.mark.parametrize("told", [None, 1, "no"])
def test_told_is_yes_or_no(told):
    with pytest.raises(ValueError, match="told = "):
        NoiseModel(1.0, told)


OWN = Sigmas(v=0.02, phi=0.5, theta=0.3, a=2.0, b=0.0)


def test_standard_deviations_of_ones_own_take_the_place_of_the_olympiads():
    """Issue "Calibration": the diagonal of an error model is a noise. The same draws, other factors."""
    stream = SeededStream(SEED, "pooliad/1 stroke 9")
    z = [stream.gaussian() for _ in range(5)]
    noisy = NoiseModel(2.0, sigmas=OWN).perturb(SHOT, SEED, 9)
    assert (noisy.a, noisy.b) == (SHOT.a + 2.0 * 2.0 * z[0], SHOT.b)
    assert noisy.v == SHOT.v + 2.0 * 0.02 * z[4]
    draws = np.array([[z[4], z[3], z[2], z[0], z[1]]])
    row = np.array([[SHOT.v, SHOT.phi, SHOT.theta, SHOT.a, SHOT.b]])
    assert NoiseModel(2.0, sigmas=OWN).perturb_rows(row, draws).tolist() == [
        [noisy.v, noisy.phi, noisy.theta, noisy.a, noisy.b]
    ]


def test_only_other_standard_deviations_are_written_down():
    """What records and commitments of the Olympiad's noise hold stays byte for byte."""
    assert NoiseModel(1.0, sigmas=Sigmas(v=0.075)).to_dict() == {"level": 1.0, "told": True}
    written = NoiseModel(1.0, False, OWN).to_dict()
    assert written == {"level": 1.0, "told": False, "sigmas": OWN.to_dict()}
    assert NoiseModel.from_dict(written) == NoiseModel(1.0, False, OWN)


@pytest.mark.parametrize(
    ("values", "field"),
    [({"v": 1.01}, "v"), ({"phi": -0.1}, "phi"), ({"a": math.nan}, "a"), ({"b": "1"}, "b"), ({"c": 1}, "c"), (3, "")],
)
def test_standard_deviations_that_cannot_be_are_named(values, field):
    with pytest.raises(FieldError) as error:
        Sigmas.from_dict(values)
    assert error.value.field == field


def test_standard_deviations_in_a_file(tmp_path):
    file = tmp_path / "noise.toml"
    write_sigmas(file, OWN, ("of somebody",))
    assert read_sigmas(file) == OWN
    file.write_text("v = ")
    with pytest.raises(FieldError, match="must be a TOML file"):
        read_sigmas(file)
