"""Draws of the noise that are spread evenly: few of them tell more than as many independent ones.

Whether a pot falls depends on the direction above all, and the means of eight independent draws scatter. Here every
component falls into each of `n` equally likely intervals exactly once (Latin hypercube sampling: McKay, Beckman &
Conover, Technometrics 21, 1979), and the components together fill their space as an additive sequence does (Roberts,
"The unreasonable effectiveness of quasirandom sequences", 2018). A mean over them is unbiased: each draw by itself is
normal.
"""

from statistics import NormalDist

import numpy as np

from client.agents.search.shots import Floats

DIMENSIONS = 5
"""Of a stroke."""
STEPS = 1.1347241384015194 ** -np.arange(1.0, DIMENSIONS + 1.0)
"""Powers of 1 over the real root of x^6 = x + 1."""
_CELLS = 4096
_PROBABILITIES = (np.arange(_CELLS) + 0.5) / _CELLS
_QUANTILES = np.array([NormalDist().inv_cdf(each) for each in _PROBABILITIES.tolist()])


def spread_normals(chance: np.random.Generator, count: int) -> Floats:
    """(count, 5): standard normal draws, spread evenly together."""
    points = (chance.random(DIMENSIONS) + np.arange(count)[:, None] * STEPS) % 1.0
    ranks = points.argsort(axis=0).argsort(axis=0)
    return _normal((ranks + chance.random((count, DIMENSIONS))) / count)


def independent_normals(chance: np.random.Generator, count: int) -> Floats:
    """(count, 5): standard normal draws that know nothing of each other."""
    return chance.standard_normal((count, DIMENSIONS))


def _normal(probability: Floats) -> Floats:
    """Quantiles of the standard normal distribution."""
    found: Floats = np.interp(probability, _PROBABILITIES, _QUANTILES)
    return found
