"""The event loop's contact solver, for those who want to test or use it."""

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
    path = [_numbers(name, vector, (2,)) for name, vector in (("c", c), ("b", b), ("a", a))]
    (until,), (meet,) = _numbers("t_max", t_max, ()), _numbers("distance", distance, ())
    if until < 0.0 or meet <= 0.0:
        raise PhysicsError("t_max, distance", (until, meet), "must not be negative, and the distance not 0")
    return float(kernels().time_of_contact(np.array([path]).reshape(1, -1), until, meet))


def _numbers(name: str, value: ArrayLike, shape: tuple[int, ...]) -> list[float]:
    try:
        array = np.asarray(value)
    except ValueError:  # ragged
        array = np.empty(0, object)
    if array.dtype.kind not in "iuf" or array.shape != shape or not np.isfinite(array).all():
        raise PhysicsError(name, value, "must be a finite number" if shape == () else "must be two finite numbers")
    return [float(number) for number in array.reshape(-1)]
