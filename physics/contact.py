"""The event loop's contact solvers, for those who want to test or use them."""

import math

import numpy as np
from numpy.typing import ArrayLike

from physics.constants import BALL_RADIUS, GRAVITY
from physics.engine import kernels
from physics.errors import PhysicsError


def contact_time(c: ArrayLike, b: ArrayLike, a: ArrayLike, t_max: float, distance: float = 2.0 * BALL_RADIUS) -> float:
    """Earliest t in [0, t_max] at which |c + b t + a t^2| falls through ``distance``; NaN if none.

    Args:
        c: (2,) or (3,) m, b: m/s, a: m/s^2, alike: the relative path, in the plane or in space; ``a`` is half the
            relative acceleration.
        t_max: s, finite and not negative. distance: m, positive.

    Raises:
        PhysicsError: a value of another kind.
    """
    size = 3 if np.shape(c) == (3,) else 2
    path = [_numbers(name, vector, (size,)) for name, vector in (("c", c), ("b", b), ("a", a))]
    until, meet = _time_and_distance(t_max, "distance", distance)
    row = np.array([path]).reshape(1, -1)
    if size == 3:
        return float(kernels(True).time_of_contact_in_space(row, until, meet))
    return float(kernels().time_of_contact(row, until, meet))


def ring_contact_time(
    p: ArrayLike,
    z: float,
    v: ArrayLike,
    vz: float,
    ring: float,
    radius: float,
    t_max: float,
    g: float = GRAVITY,
) -> float:
    """Earliest t in [0, t_max] at which a flying ball comes within ``radius`` of a level ring; NaN if none.

    The ball and the rounded horn of a cushion. Over the ring's disc nothing counts: there the rail's top is met first.

    Args:
        p: (2,) m, where the ball is in plan from the ring's axis; z: m above the ring.
        v: (2,) m/s in plan, straight; vz: m/s, upwards, falling with g, m/s^2, positive.
        ring, radius: m, positive. t_max: s, finite and not negative.

    Raises:
        PhysicsError: a value of another kind.
    """
    (x, y), (vx, vy) = _numbers("p", p, (2,)), _numbers("v", v, (2,))
    (height,), (rising,), (fall,) = _numbers("z", z, ()), _numbers("vz", vz, ()), _numbers("g", g, ())
    until, meet = _time_and_distance(t_max, "radius", radius)
    (wide,) = _numbers("ring", ring, ())
    if wide <= 0.0 or fall <= 0.0:
        raise PhysicsError("ring, g", (wide, fall), "must be positive")
    path = np.array([[x, y, height, vx, vy, rising, -0.5 * fall, wide]])
    time = float(kernels(True).time_of_ring_contact(path, until, meet))
    return time if math.isfinite(time) else math.nan


def _time_and_distance(t_max: float, name: str, distance: float) -> tuple[float, float]:
    (until,), (meet,) = _numbers("t_max", t_max, ()), _numbers(name, distance, ())
    if until < 0.0 or meet <= 0.0:
        raise PhysicsError(f"t_max, {name}", (until, meet), f"must not be negative, and the {name} not 0")
    return until, meet


def _numbers(name: str, value: ArrayLike, shape: tuple[int, ...]) -> list[float]:
    try:
        array = np.asarray(value)
    except ValueError:  # ragged
        array = np.empty(0, object)
    if array.dtype.kind not in "iuf" or array.shape != shape or not np.isfinite(array).all():
        words = {(): "a finite number", (2,): "two finite numbers", (3,): "three finite numbers"}
        raise PhysicsError(name, value, f"must be {words[shape]}")
    return [float(number) for number in array.reshape(-1)]
