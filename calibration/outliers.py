"""Samples that no ball can have made: apart from what comes before and from what comes after."""

import numpy as np
from numpy.typing import NDArray

from calibration.observed import ObservedShot

FAR = 8.0
"""Standard deviations of a prediction from two samples: more is an outlier."""
PREDICTION_SPREAD = 6.0
"""Variance of x_i - 2 x_(i-1) + x_(i-2), in variances of a sample."""
ACCELERATION = 5.0
"""m/s^2: more than any cloth gives."""


def outliers(shot: ObservedShot, sigma: float) -> NDArray[np.bool_]:
    """Which samples neither go on from the two before, nor lead to the two after, nor lie between their neighbours.

    A sample beside a collision does one of these; a false detection none. Nor does a sample between two collisions in
    a row, but that is seldom alone: a run of such samples is a ball that meets much, and stays.
    """
    found = np.zeros(len(shot.times), bool)
    for ball in shot.numbers:
        rows = shot.of_ball(ball)
        if len(rows) >= 5:
            found[rows] = _of_path(shot.times[rows], shot.places[rows], sigma)
    return found


def _of_path(times: NDArray[np.float64], places: NDArray[np.float64], sigma: float) -> NDArray[np.bool_]:
    n = len(times)
    off = np.full((3, n), np.inf)
    for kind, (first, second) in enumerate(((-2, -1), (1, 2), (-1, 1))):
        here = np.arange(max(0, -first), n - max(0, second))
        t0, t1, x0, x1 = times[here + first], times[here + second], places[here + first], places[here + second]
        part = ((times[here] - t0) / (t1 - t0))[:, None]
        span = np.maximum(np.abs(times[here] - t0), np.abs(times[here] - t1))
        allowed = FAR * sigma * np.sqrt(PREDICTION_SPREAD) * np.maximum(1.0, np.abs(part[:, 0]) - 1.0)
        aside = np.hypot(*(places[here] - x0 - part * (x1 - x0)).T)
        off[kind, here] = aside / (allowed + ACCELERATION * span * span)
    least = off.min(axis=0)
    strange = np.pad(np.isfinite(least) & (least > 1.0), 1)
    found: NDArray[np.bool_] = strange[1:-1] & ~strange[:-2] & ~strange[2:]
    return found
