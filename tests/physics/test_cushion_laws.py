"""Cushion laws that know spin and speed, as functions: the impact law, ``han`` and ``mathavan`` (FLIGHT 2, 5)."""

import itertools
import json
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.kernels import from_python
from support.require import reference_data

from physics.kernels.resolve import cushion_laws, fixed

han = from_python(cushion_laws.han)
mathavan = from_python(cushion_laws.mathavan)
impact = from_python(fixed.impact)

R = 0.028575
H = 0.03629025


def nose_normal(height: float = H, azimuth: float = 180.0) -> tuple[float, float, float]:
    """From a nose at ``height`` to the centre, with the plan part along ``azimuth`` (deg)."""
    sine = -(height - R) / R
    cosine = math.sqrt(1.0 - sine * sine)
    return cosine * math.cos(math.radians(azimuth)), cosine * math.sin(math.radians(azimuth)), sine


EAST = nose_normal()
SNOOKER = nose_normal(1.4 * R)


def by_han(v, w):
    return han(R, v, w, EAST, 0.85, 0.2)


def by_mathavan(v, w):
    return mathavan(R, v, w, EAST, 0.98, 0.14, 0.212)


def rolling(speed: float, degrees: float = 0.0, w_z: float = 0.0) -> tuple[Any, Any]:
    """Natural roll towards the east cushion, ``degrees`` off its normal."""
    v = speed * math.cos(math.radians(degrees)), speed * math.sin(math.radians(degrees))
    return v, (-v[1] / R, v[0] / R, w_z)


def out_angle(v: Any) -> float:
    return math.degrees(math.atan2(v[1], -v[0]))


def rolls_on(v, w):
    """Velocity once the ball rolls: v - 2/7 of its slip."""
    return v[0] - 2 / 7 * (v[0] - R * w[1]), v[1] - 2 / 7 * (v[1] + R * w[0])


def energy(v: Any, w: Any) -> float:
    return 0.5 * sum(x * x for x in v) + 0.2 * R * R * sum(x * x for x in w)


def differences(found, expected):
    return [abs(a - float(b)) for a, b in zip(found, expected, strict=True)]


@pytest.mark.parametrize("family", ["landing", "nose"])
def test_the_impact_law_agrees_with_fifty_digits(family):
    """``flight/laws.json``: speeds to 2e-15 m/s, spins times R likewise."""
    for case in json.loads(reference_data("flight/laws.json").read_text())[family]:
        normal = (0.0, 0.0, 1.0)
        if family == "nose":
            psi, beta = case["psi"], case["beta"]
            normal = math.cos(psi) * math.cos(beta), math.sin(psi) * math.cos(beta), math.sin(beta)
        v, w = impact(R, tuple(case["v"]), tuple(case["w"]), normal, case["e"], case["mu"])
        assert max(differences(v, case["v_after"])) < 2e-15
        assert R * max(differences(w, case["w_after"])) < 2e-15


def test_a_ball_that_does_not_approach_is_left():
    v, w = (-1.0, 2.0, 0.5), (3.0, 4.0, 5.0)
    assert impact(R, v, w, (-1.0, 0.0, 0.0), 0.85, 0.2) == (v, w)
    assert mathavan(R, (-1.0, 2.0), w, EAST, 0.98, 0.14, 0.2) == ((-1.0, 2.0), w)


# FLIGHT Part II, "Plausible figures", at the nose height of the WPA: Han 0.85 / 0.2 and Mathavan 0.98 / 0.14.
FIGURES = [(by_han, 0.736, 0.811, 0.548, 43.7, 59.6), (by_mathavan, 0.886, 0.958, 0.615, 38.3, 53.2)]


@pytest.mark.parametrize(("law", "slides", "rolls", "to_rolling", "immediately", "later"), FIGURES)
def test_published_rebounds(law, slides, rolls, to_rolling, immediately, later):
    assert -law((2.0, 0.0), (0.0, 0.0, 0.0))[0][0] / 2.0 == pytest.approx(slides, abs=6e-4)
    v, w = law(*rolling(2.0))
    assert -v[0] / 2.0 == pytest.approx(rolls, abs=6e-4)
    assert -rolls_on(v, w)[0] / 2.0 == pytest.approx(to_rolling, abs=1e-3)
    v, w = law(*rolling(2.0, 45.0))
    assert out_angle(v) == pytest.approx(immediately, abs=0.06)
    assert out_angle(rolls_on(v, w)) == pytest.approx(later, abs=0.06)


@pytest.mark.parametrize(("side", "degrees"), [(-1.5, 56.07), (0.0, 43.69), (1.5, 41.68)])
def test_english_turns_a_bank(side, degrees):
    """FLIGHT section 8: v 45 deg towards +x, +y, w_z = side v/R, natural roll, han 0.85 / 0.2."""
    v, _ = by_han(*rolling(2.0, 45.0, side * 2.0 / R))
    assert out_angle(v) == pytest.approx(degrees, abs=0.005)


def test_a_bank_of_45_degrees_by_the_literatures_model():
    """Mathavan 2010 at the nose height of the WPA: the bank ends at 37 degrees slid, at 53 rolled (FLIGHT, Part II)."""
    slid, rolled = by_mathavan(rolling(2.0, 45.0)[0], (0.0, 0.0, 0.0)), by_mathavan(*rolling(2.0, 45.0))
    assert out_angle(rolls_on(*slid)) == pytest.approx(37.0, abs=0.1)
    assert out_angle(rolls_on(*rolled)) == pytest.approx(53.2, abs=0.1)
    halfway = by_mathavan((2.0 * math.sqrt(0.5),) * 2, tuple(0.5 * w for w in rolling(2.0, 45.0)[1]))
    assert 37.0 < out_angle(rolls_on(*halfway)) < 53.2


@pytest.mark.parametrize(("law", "narrowest", "widest"), [(by_han, 41.6, 56.1), (by_mathavan, 36.3, 50.8)])
def test_english_opens_a_bank_one_way_and_closes_it_the_other(law, narrowest, widest):
    """Running english lengthens, reverse english shortens: from -1.5 v/R to 1.5 v/R the way out turns steadily."""
    outs = [out_angle(law(*rolling(2.0, 45.0, side * 2.0 / R))[0]) for side in np.linspace(-1.5, 1.5, 31)]
    assert all(more > less for more, less in itertools.pairwise(outs))
    assert outs[0] == pytest.approx(widest, abs=0.1)
    assert outs[-1] == pytest.approx(narrowest, abs=0.1)


def test_straight_in_with_side_leaves_to_the_side():
    """What the factors of the Olympiad's table do not know: 60 rad/s of side bend a straight rebound."""
    assert abs(out_angle(by_han((2.0, 0.0), (0.0, 0.0, 60.0))[0])) > 10.0


@pytest.mark.parametrize(("spin", "share"), [(0.0, 0.8373), (1.0, 0.9107)])
def test_mathavan_on_a_snooker_table(spin, share):
    """FLIGHT section 5: h = 7R/5, e 0.98, mu 0.14, cloth 0.212; the same at every speed. The step is worth 1.2e-4."""
    shares = [
        -mathavan(R, (speed, 0.0), (0.0, spin * speed / R, 0.0), SNOOKER, 0.98, 0.14, 0.212)[0][0] / speed
        for speed in (1e-3, 0.5, 2.0, 9.0)
    ]
    assert shares == pytest.approx([share] * 4, abs=1.5e-4)
    assert max(shares) - min(shares) < 1e-13


speeds = st.floats(-10.0, 10.0)
spins = st.floats(-400.0, 400.0)
azimuths = st.floats(0.0, 360.0)


@given(speeds, speeds, spins, spins, spins, azimuths, st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.01, 1.0))
def test_energy_never_rises(vx, vy, wx, wy, wz, azimuth, e, mu, bed):
    normal = nose_normal(H, azimuth)
    before = energy((vx, vy), (wx, wy, wz))
    for v, w in (
        han(R, (vx, vy), (wx, wy, wz), normal, e, mu),
        mathavan(R, (vx, vy), (wx, wy, wz), normal, e, mu, bed),
    ):
        assert energy(v, w) <= before * (1 + 1e-14)
        assert all(map(math.isfinite, (*v, *w)))


@given(
    speeds,
    speeds,
    st.floats(-10, 10),
    spins,
    spins,
    spins,
    azimuths,
    st.floats(-90, 90),
    st.floats(0, 1),
    st.floats(0, 1),
)
def test_an_impact_anywhere_loses_energy(vx, vy, vz, wx, wy, wz, azimuth, lean, e, mu):
    cosine = math.cos(math.radians(lean))
    normal = (
        cosine * math.cos(math.radians(azimuth)),
        cosine * math.sin(math.radians(azimuth)),
        math.sin(math.radians(lean)),
    )
    v, w = impact(R, (vx, vy, vz), (wx, wy, wz), normal, e, mu)
    assert energy(v, w) <= energy((vx, vy, vz), (wx, wy, wz)) * (1 + 1e-14)
    along = sum(a * b for a, b in zip(v, normal, strict=True))
    was = sum(a * b for a, b in zip((vx, vy, vz), normal, strict=True))
    assert along == pytest.approx(-e * was if was < 0 else was, abs=1e-13)


@given(st.floats(0.001, 10.0), speeds, spins, spins, spins, st.floats(0.01, 100.0))
def test_mathavan_is_homogeneous(vx, vy, wx, wy, wz, scale):
    """Twice the speeds and spins, twice the result: rebound over approach does not depend on speed."""
    v, w = by_mathavan((vx, vy), (wx, wy, wz))
    v2, w2 = by_mathavan((scale * vx, scale * vy), (scale * wx, scale * wy, scale * wz))
    size = math.sqrt(2.0 * energy((vx, vy), (wx, wy, wz)))
    assert max(abs(b / scale - a) for a, b in zip(v, v2, strict=True)) <= 1e-9 * size
    assert R * max(abs(b / scale - a) for a, b in zip(w, w2, strict=True)) <= 1e-9 * size


@given(speeds, speeds, spins, spins, spins, st.sampled_from([han, mathavan]), st.floats(0.0, 360.0))
def test_mirror_images_and_swapped_axes_have_the_same_bits(vx, vy, wx, wy, wz, law, azimuth):
    nx, ny, nz = nose_normal(H, azimuth)
    rest = (0.85, 0.2) if law is han else (0.98, 0.14, 0.2)
    (ax, ay), (px, py, pz) = law(R, (vx, vy), (wx, wy, wz), (nx, ny, nz), *rest)
    mirrored = law(R, (-vx, vy), (wx, -wy, -wz), (-nx, ny, nz), *rest)
    swapped = law(R, (vy, vx), (-wy, -wx, -wz), (ny, nx, nz), *rest)
    assert mirrored == ((-ax, ay), (px, -py, -pz))
    assert swapped == ((ay, ax), (-py, -px, -pz))
