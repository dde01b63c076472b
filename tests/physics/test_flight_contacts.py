"""Contact times of flying balls against exact answers (shared data, FLIGHT 8): 0 missed, 0 invented, 0 late.

The answers are by rational arithmetic and Sturm sequences, to 32 digits, of the doubles taken as exact.
"""

import json
import math
from collections import Counter
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf
from support.kernels import from_python
from support.require import reference_data
from support.truth.roots import falls

import physics
from physics.kernels.detect import edges_in_air
from physics.kernels.path import Rise

meets_edge = from_python(edges_in_air.meets_edge)

GAP = 1e-15
"""m. How far from the distance asked for a contact may be taken."""


def cases(*families: str) -> list[dict[str, Any]]:
    known = json.loads(reference_data("flight/contacts.json").read_text())["cases"]
    return [case for case in known if case["family"] in families]


def answer(case: dict[str, Any]) -> float:
    if case["family"] == "horn_flying":
        return physics.ring_contact_time(
            *(case["p"], case["z"], case["v"], case["vz"], case["ring"], case["radius"], case["t_max"], case["g"])
        )
    return physics.contact_time(case["c"], case["b"], case["a"], case["t_max"], case["distance"])


def gap(case: dict[str, Any], time: float) -> mpf:
    """How far from contact the path is at a time."""
    t = mpf(time)
    if case["family"] == "horn_flying":
        x, y = (mpf(p) + t * mpf(v) for p, v in zip(case["p"], case["v"], strict=True))
        z = mpf(case["z"]) + t * mpf(case["vz"]) - t * t * mpf(case["g"]) / 2
        return mp.sqrt((mp.sqrt(x * x + y * y) - mpf(case["ring"])) ** 2 + z * z) - mpf(case["radius"])
    place = [mpf(c) + t * (mpf(b) + t * mpf(a)) for c, b, a in zip(case["c"], case["b"], case["a"], strict=True)]
    return mp.sqrt(sum(x * x for x in place)) - mpf(case["distance"])


def is_tangency(case: dict[str, Any], time: float) -> bool:
    """Exact tangencies accept either answer, at the time at which they graze."""
    grazes = case.get("grazes_at")
    return grazes is not None and (math.isnan(time) or abs(time - float(grazes)) < 1e-6)


@pytest.mark.parametrize(
    "family", ["flying_cloth", "flying_flying", "nose_flying", "horn_flying", "horn_cloth", "drop_edge"]
)
def test_every_contact_is_found_and_none_invented(family):
    wrong: list[tuple[str, float, object]] = []
    counted: Counter[bool] = Counter()
    for case in cases(family):
        found = answer(case)
        counted[case["time"] is not None] += 1
        with mp.workdps(50):
            if is_tangency(case, found):
                continue
            missed = case["time"] is None or math.isnan(found)
            right = (
                case["time"] is None and math.isnan(found)
                if missed
                else abs(gap(case, found)) <= GAP and abs(found - float(case["time"])) < 1e-3
            )
        if not right:
            wrong.append((case["id"], found, case["time"]))
    assert not wrong
    assert counted[True] >= 10
    assert counted[False] >= 3


def drawn(rng: np.random.Generator) -> dict[str, Any]:
    """A ball near a horn: passing, falling past it, grazing it."""
    ring, radius = float(rng.uniform(0.001, 0.03)), 0.028575
    angle, far = rng.uniform(0, 2 * math.pi), rng.uniform(ring, 0.15)
    p = far * math.cos(angle), far * math.sin(angle)
    aim = angle + math.pi + rng.normal(0, 0.3)
    speed = float(rng.choice([0.01, 0.3, 2.0, 8.0]))
    return {
        "family": "horn_flying",
        "p": [float(x) for x in p],
        "v": [speed * math.cos(aim), speed * math.sin(aim)],
        "z": float(rng.uniform(-0.0077, 0.07)),
        "vz": float(rng.normal(0, 0.7)),
        "ring": ring,
        "radius": radius,
        "g": 9.81,
        "t_max": float(rng.uniform(0.02, 0.5)),
    }


def octic_answer(case: dict[str, Any]) -> mpf | None:
    """By root isolation of the octic; only what is outside the disc, and only if it does not begin inside."""
    x, y = (mpf(value) for value in case["p"])
    vx, vy = (mpf(value) for value in case["v"])
    z = [mpf(case["z"]), mpf(case["vz"]), -mpf(case["g"]) / 2]
    ring, radius = mpf(case["ring"]), mpf(case["radius"])
    q2 = [x * x + y * y, 2 * (x * vx + y * vy), vx * vx + vy * vy]
    z2 = [sum(z[i] * z[n - i] for i in range(3) if 0 <= n - i < 3) for n in range(5)]
    a = [z2[n] + (q2[n] if n < 3 else 0) for n in range(5)]
    a[0] += ring * ring - radius * radius
    p = [sum(a[i] * a[n - i] for i in range(5) if 0 <= n - i < 5) for n in range(9)]
    for n in range(3):
        p[n] -= 4 * ring * ring * q2[n]

    def at(q: list[mpf], t: mpf) -> mpf:
        return sum(c * t**k for k, c in enumerate(q))

    return next(
        (t for t in falls(p, mpf(case["t_max"])) if at(a, t) >= 0 and at(q2, t) >= ring * ring),
        None,
    )


def test_drawn_horns_agree_with_root_isolation_of_the_octic():
    """1,000 flights past horns of 1 to 30 mm, at 40 digits."""
    rng, found, none = np.random.default_rng(4), 0, 0
    for _ in range(1_000):
        case = drawn(rng)
        with mp.workdps(40):
            if gap(case, 0.0) < 0:
                continue
            truth, time = octic_answer(case), answer(case)
            if truth is None:
                assert math.isnan(time), case
                none += 1
            else:
                assert abs(gap(case, time)) <= GAP, case
                assert abs(time - float(truth)) < 1e-6, case
                found += 1
    assert found > 200
    assert none > 200


def test_a_ball_beside_the_noses_end_comes_to_the_nose_later():
    """The first fall within R, at 5.9 ms, is 28 mm before the nose's end; the hit is at 170.6 ms, 21 mm along it.

    FLIGHT Part II, 2.6: a solver that takes the first root and then looks where its foot is loses the hit.
    """
    rise = Rise(-0.00771525, 1.0, -4.905)
    time = meets_edge(0.028575, (0.0288, -0.05), (-0.030, 0.3), (0.0, 1.0), rise, 0.3, 0.3)
    assert abs(time - 0.170582) < 1e-6
    across, above = 0.0288 - 0.05 * time, rise.z + time * (rise.vz + time * rise.hz)
    assert abs(math.hypot(across, above) - 0.028575) < 1e-15
