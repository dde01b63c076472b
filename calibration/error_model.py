"""How a player's strokes differ from what was intended: standard deviations and correlations.

Each estimated stroke has an error of its own, from the noise of the places. So the differences are not counted but
modelled: stroke errors are normal with one mean and covariance, samples are normal about them, and both together are
estimated by maximum likelihood (expectation and maximisation, Dempster, Laird & Rubin 1977). What the samples do not
tell of a stroke then adds nothing.
"""

import dataclasses
from collections.abc import Sequence

import numpy as np

from calibration.errors import InvalidFit
from calibration.observed import Floats, ObservedShot
from calibration.result import ExplainedShot
from calibration.shot_model import INTENDED, SCALES, STROKE

LEAST_STROKES = 8
STEPS, SETTLED = 400, 1e-5
REPEATS = 60
TOLD = 0.7
"""Part of a parameter's variance that samples must explain, on average, for its standard deviation to be told."""


@dataclasses.dataclass(frozen=True, eq=False)
class ErrorModel:
    """The errors of a player's strokes.

    Attributes:
        strokes: how many there were.
        sigmas: standard deviations by name: v m/s, phi and theta deg, a and b mm. intervals: 95 %, by the bootstrap.
        means: what the player does off his intention on average, in the same units.
        correlations: (5, 5), in the order v, phi, theta, a, b.
        told: by name, whether the samples tell this one; elevation and height of the tip often look alike.
    """

    strokes: int
    sigmas: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    means: dict[str, float]
    correlations: Floats
    told: dict[str, bool]

    def level(self, standard: dict[str, float]) -> float:
        """The factor on standard deviations by name that comes nearest, over those that are told."""
        ratios = [self.sigmas[name] / standard[name] for name in STROKE if self.told[name]]
        return float(np.sqrt(np.mean(np.square(ratios)))) if ratios else float("nan")

    def to_dict(self) -> dict[str, object]:
        """Plain values, for JSON."""
        return dataclasses.asdict(self) | {"correlations": self.correlations.tolist()}


def error_model(observed: Sequence[ObservedShot], shots: Sequence[ExplainedShot], seed: int = 0) -> ErrorModel:
    """From the shots whose intended stroke is known and which the model explains.

    Raises:
        InvalidFit: there are fewer than ``LEAST_STROKES`` of them.
    """
    used = [
        (meant.stroke, shot)
        for meant, shot in zip(observed, shots, strict=True)
        if meant.stroke.is_whole and shot.is_explained
    ]
    if len(used) < LEAST_STROKES:
        raise InvalidFit("strokes", len(used), f"must be at least {LEAST_STROKES} with all five parameters intended")
    scales = np.array([SCALES[name] for name in STROKE])
    differences = np.array([[getattr(shot.stroke, n) - getattr(meant, n) for n in STROKE] for meant, shot in used])
    differences[:, 1] = (differences[:, 1] + 180.0) % 360.0 - 180.0
    information = np.array([shot.information for _, shot in used])
    pulls = np.einsum("nij,nj->ni", information, differences / scales) - np.array([shot.pull for _, shot in used])
    mean, covariance, shares = _most_likely(information, pulls)
    rng = np.random.default_rng(seed)
    draws = []
    for _ in range(REPEATS):
        rows = rng.integers(0, len(used), len(used))
        draws.append(np.sqrt(np.diag(_most_likely(information[rows], pulls[rows])[1])))
    sigmas = np.sqrt(np.diag(covariance))
    bounds = scales * np.percentile(draws, [2.5, 97.5], axis=0)
    return ErrorModel(
        len(used),
        dict(zip(STROKE, (scales * sigmas).tolist(), strict=True)),
        {name: (low, high) for name, low, high in zip(STROKE, *bounds.tolist(), strict=True)},
        dict(zip(STROKE, (scales * mean).tolist(), strict=True)),
        covariance / np.outer(sigmas, sigmas),
        dict(zip(STROKE, (shares > TOLD).tolist(), strict=True)),
    )


def _most_likely(information: Floats, pulls: Floats) -> tuple[Floats, Floats, Floats]:
    """Mean (5,), covariance (5, 5), and which part of each variance the samples explain (5,), in natural sizes.

    Args:
        information: (n, 5, 5) of each stroke's error; pulls: (n, 5), that times the error that fits the samples best.
    """
    n, k = pulls.shape
    mean: Floats = np.zeros(k)
    covariance: Floats = np.diag([(0.5 * INTENDED[name] / SCALES[name]) ** 2 for name in STROKE])
    posterior = np.zeros_like(information)
    for _ in range(STEPS):
        prior = np.linalg.inv(covariance)
        posterior = np.linalg.inv(information + prior)
        means = np.einsum("nij,nj->ni", posterior, pulls + prior @ mean)
        mean = means.mean(axis=0)
        off = means - mean
        next_one = (posterior.mean(axis=0) + off.T @ off / (n - 1)) + 1e-8 * np.eye(k)
        change = float(np.abs(next_one - covariance).max() / np.diag(covariance).max())
        covariance = next_one
        if change < SETTLED:
            break
    shares = 1.0 - np.diagonal(posterior, axis1=1, axis2=2).mean(axis=0) / np.diag(covariance)
    return mean, covariance, shares
