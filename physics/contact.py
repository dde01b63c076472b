"""The event loop's contact solver, for those who want to test or use it."""

import math

import numpy as np
from numpy.typing import ArrayLike

from physics.constants import BALL_RADIUS
from physics.engine import kernels
from physics.errors import PhysicsError


def contact_time(c: ArrayLike, b: ArrayLike, a: ArrayLike, t_max: float, distance: float = 2.0 * BALL_RADIUS) -> float:
    """Earliest t in [0, t_max] at which |c + b t + a t^2| falls through ``distance``; NaN if none.

    Args:
        c: (2,) m, b: (2,) m/s, a: (2,) m/s^2: the relative path; ``a`` is half the relative acceleration.
        t_max: s, finite and not negative. distance: m, positive.

    Raises:
        PhysicsError: a value of another kind.
    """
    numbers = []
    for name, vector in (("c", c), ("b", b), ("a", a)):
        pair = np.asarray(vector, dtype=np.float64)
        if pair.shape != (2,) or not np.isfinite(pair).all():
            raise PhysicsError(name, vector, "must be two finite numbers")
        numbers += pair.tolist()
    for name, value in (("t_max", t_max), ("distance", distance)):
        if not (math.isfinite(value) and value >= 0.0) or (name == "distance" and value == 0.0):
            raise PhysicsError(name, value, "must be a finite positive number")
    return float(kernels().time_of_contact(*numbers, float(t_max), float(distance)))
