"""The laws of real tables have the same bits interpreted as compiled."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
from support.kernels import from_python

from physics.kernels import squirt
from physics.kernels.compiling import INTERPRETED
from physics.kernels.detect import jaws
from physics.kernels.path import Path as BallPath
from physics.kernels.resolve import cushion_laws, fixed, pair_laws

R, RHO = 0.028575, 0.02751373370586951
NOSE = -0.9628602347719864, 0.0, -0.27
JAW = jaws.JawOutline(0.083, 0.00635, 0.0791, -0.00135, -0.6156614753256583, 0.788010753606722, 0.0803)


drops, meets_facing, meets_horn = map(from_python, (jaws.drops, jaws.meets_facing, jaws.meets_horn))
han, mathavan, impact = map(from_python, (cushion_laws.han, cushion_laws.mathavan, fixed.impact))
collide_in_space, friction = map(from_python, (pair_laws.collide_in_space, pair_laws.friction))
struck = from_python(squirt.struck)


def bits() -> str:
    """SHA-256 over what every law gives for 60 drawn inputs."""
    rng, text = np.random.default_rng(5), hashlib.sha256()
    for _ in range(60):
        v, w, v2, w2 = (tuple(map(float, scale * rng.normal(size=3))) for scale in (3.0, 90.0, 3.0, 90.0))
        angle = float(rng.uniform(0, 6.28))
        normal = float(np.cos(angle)), float(np.sin(angle)), 0.0
        s, d = (float(x) for x in rng.uniform(-0.02, 0.12, 2))
        path = BallPath(s, d, v[0], v[1], 0.1 * v[2], 0.1 * v2[0])
        results = (
            impact(R, v, w, NOSE, 0.85, 0.2),
            han(R, v[:2], w, NOSE, 0.85, 0.2),
            mathavan(R, v[:2], w, NOSE, 0.98, 0.14, 0.2),
            collide_in_space(R, normal, (v, w), (v2, w2), 0.95, friction(abs(v[0]))),
            struck(R, (*normal[:2], 0.8, 0.6), 0.025, 0.01, -0.004, 0.3, 1 / 30, 1.0, 0.6, abs(v[0])),
            meets_facing(JAW, RHO, path, 1.0),
            meets_horn(JAW, RHO, path, 1.0, 1.0),
            drops(path, 0.0635, 1.0, 1.0),
        )
        text.update(repr(results).encode())
    return text.hexdigest()


def test_interpreted_laws_have_the_bits_of_compiled_ones():
    assert not INTERPRETED
    tests = str(Path(__file__).parents[1])
    code = f"import sys; sys.path[:0] = [{str(Path(__file__).parent)!r}, {tests!r}]; "
    code += "from test_laws_interpreted import bits; print(bits())"
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1"}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == bits()
