"""Two balls in space, and friction that falls with the slip (FLIGHT 2.4, "Alciatore friction")."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import exp, mp, mpf
from support.kernels import from_python
from support.require import reference_data

from physics.kernels.resolve import pair_laws

collide_in_space = from_python(pair_laws.collide_in_space)
fading = from_python(pair_laws.fading)
friction = from_python(pair_laws.friction)

R = 0.028575
V = tuple[float, float, float]


def energy(v: V, w: V) -> float:
    return 0.5 * sum(x * x for x in v) + 0.2 * R * R * sum(x * x for x in w)


def test_the_law_in_space_agrees_with_fifty_digits():
    """``flight/laws.json``: speeds to 2e-15 m/s, spins times R likewise."""
    for case in json.loads(reference_data("flight/laws.json").read_text())["ball_ball"]:
        size = math.sqrt(sum(x * x for x in case["direction"]))
        normal = tuple(x / size for x in case["direction"])
        one, two = (tuple(case["v1"]), tuple(case["w1"])), (tuple(case["v2"]), tuple(case["w2"]))
        after = collide_in_space(R, normal, one, two, case["e"], case["mu"])
        for (v, w), name in zip(after, "12", strict=True):
            assert v == pytest.approx([float(x) for x in case[f"v{name}_after"]], abs=2e-15)
            assert [R * x for x in w] == pytest.approx([R * float(x) for x in case[f"w{name}_after"]], abs=2e-15)


def test_the_exponential_is_within_two_ulp():
    """exp(-x) by its fixed sequence, against 40 digits."""
    with mp.workdps(40):
        for x in [0.0, 1e-300, *(0.0137 * i for i in range(1, 3000)), 1.088 * 13.7, 42.99]:
            true = exp(-mpf(x))
            assert abs(mpf(fading(x)) - true) <= 2 * mpf(2) ** -52 * true, x
    assert fading(43.0) == fading(1e300) == fading(math.inf) == 0.0


def test_friction_is_alciatores():
    """TP A-14: 9.951e-3 + 0.108 exp(-1.088 s); slow balls stick out at 0.118, fast ones at 0.01."""
    assert friction(0.0) == pytest.approx(0.117951, rel=1e-14)
    assert friction(1.0) == pytest.approx(9.951e-3 + 0.108 * math.exp(-1.088), rel=1e-14)
    assert friction(100.0) == 9.951e-3


def throw(speed: float, cut: float, spin: V = (0.0, 0.0, 0.0)) -> float:
    """Degrees by which the object ball leaves the line of centres, the cue ball sliding without spin unless given."""
    v = speed * math.cos(math.radians(cut)), speed * math.sin(math.radians(cut)), 0.0
    rest = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    tangential = math.sqrt((v[1] + R * spin[2]) ** 2 + (R * spin[1]) ** 2)
    _, (after, _) = collide_in_space(R, (1.0, 0.0, 0.0), (v, spin), rest, 1.0, friction(tangential))
    return math.degrees(math.atan2(after[1], after[0]))


@pytest.mark.parametrize("cut", [5.0, 15.0, 30.0, 45.0, 60.0, 75.0])
@pytest.mark.parametrize("speed", [0.447, 1.341, 3.129])
@pytest.mark.parametrize("side", [-0.6, 0.0, 0.4])
def test_throw_is_that_of_the_technical_proof(cut, speed, side):
    """TP A-14: tan(throw) = min(mu v cos f / |s|, 1/7) (v sin f - R w_z) / (v cos f), e = 1, with w_z the
    other way round in its figure. Speeds are its 1, 3 and 7 mph."""
    w_z = side * speed / R
    sine, cosine = math.sin(math.radians(cut)), math.cos(math.radians(cut))
    slip = speed * sine + R * w_z
    share = min((9.951e-3 + 0.108 * math.exp(-1.088 * abs(slip))) * speed * cosine / abs(slip), 1 / 7)
    expected = math.degrees(math.atan(share * slip / (speed * cosine)))
    assert throw(speed, cut, (0.0, 0.0, w_z)) == pytest.approx(expected, abs=1e-11)


def test_throw_falls_with_speed():
    """A half-ball stun shot: about 5 degrees slow, 2 fast (Alciatore, "Throw": maximum 5 to 6 deg)."""
    slow, medium, fast = (throw(speed, 30.0) for speed in (0.447, 1.341, 3.129))
    assert 4.0 < slow < 6.0
    assert slow > medium > fast > 1.0


vectors = st.tuples(*[st.floats(-10.0, 10.0)] * 3)
spins = st.tuples(*[st.floats(-400.0, 400.0)] * 3)


@given(vectors, spins, vectors, spins, st.floats(0, 360), st.floats(-90, 90), st.floats(0.8, 1.0), st.floats(0.0, 1.0))
def test_energy_never_rises_and_momentum_stays(v1, w1, v2, w2, azimuth, lean, e, mu):
    cosine = math.cos(math.radians(lean))
    normal = (
        cosine * math.cos(math.radians(azimuth)),
        cosine * math.sin(math.radians(azimuth)),
        math.sin(math.radians(lean)),
    )
    (a, p), (b, q) = collide_in_space(R, normal, (v1, w1), (v2, w2), e, mu)
    assert energy(a, p) + energy(b, q) <= (energy(v1, w1) + energy(v2, w2)) * (1 + 1e-14) + 1e-28
    for axis in range(3):
        assert a[axis] + b[axis] == pytest.approx(v1[axis] + v2[axis], abs=1e-14)


@given(vectors, spins, vectors, spins, st.floats(0, 360), st.floats(0.0, 0.2))
def test_which_ball_is_called_first_does_not_matter(v1, w1, v2, w2, azimuth, mu):
    """Bit for bit."""
    normal = math.cos(math.radians(azimuth)), math.sin(math.radians(azimuth)), 0.0
    back = tuple(-x for x in normal)
    one, two = collide_in_space(R, normal, (v1, w1), (v2, w2), 0.95, mu)
    assert collide_in_space(R, back, (v2, w2), (v1, w1), 0.95, mu) == (two, one)
