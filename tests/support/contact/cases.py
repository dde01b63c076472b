"""Hard and random instances of the contact problem, by class, as arrays.

The problem: the earliest t in [0, t_max] at which |c + b t + a t^2| falls through the distance. Classes follow the ways
two balls meet on a table: any two motions, grazes of a chosen depth, balls that touch already, motions whose leading
coefficients vanish, contacts at the very end of a motion.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

DISTANCE = 2 * 0.028575
"""Two ball radii, m."""

DIAGONAL = 2.4
"""m; the longest way on the table."""

G = 9.81
MU_SLIDE, MU_ROLL = 0.2, 0.015
FLOATS = NDArray[np.float64]


@dataclass(frozen=True)
class Cases:
    """``n`` problems: c m, b m/s, a m/s^2 (n, 2); t_max s (n,); the class name of each (n,)."""

    c: FLOATS
    b: FLOATS
    a: FLOATS
    t_max: FLOATS
    kind: NDArray[np.str_]

    def __len__(self) -> int:
        return len(self.t_max)

    def __getitem__(self, rows: slice | NDArray[np.bool_ | np.int_]) -> "Cases":
        return Cases(self.c[rows], self.b[rows], self.a[rows], self.t_max[rows], self.kind[rows])


def directions(rng: np.random.Generator, n: int) -> FLOATS:
    angle = rng.uniform(0, 2 * np.pi, n)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def turned(v: FLOATS) -> FLOATS:
    return np.stack([-v[:, 1], v[:, 0]], axis=1)


def column(x: FLOATS) -> FLOATS:
    return x[:, None]


def motions(rng: np.random.Generator, n: int) -> tuple[FLOATS, FLOATS, FLOATS]:
    """Velocity, half acceleration and lifetime of n balls: sliding, rolling, resting."""
    state = rng.integers(0, 3, n)
    speed = np.exp(rng.uniform(np.log(1e-3), np.log(8.0), n))
    heading, slip = directions(rng, n), np.exp(rng.uniform(np.log(1e-3), np.log(10.0), n))
    sliding, rolling = column(state == 0), column(state == 1)
    velocity = np.where(column(state == 2), 0.0, heading * column(speed))
    pull = np.where(sliding, directions(rng, n) * MU_SLIDE, np.where(rolling, heading * MU_ROLL, 0.0))
    lifetime = np.select([state == 0, state == 1], [2 * slip / (7 * MU_SLIDE * G), speed / (MU_ROLL * G)], np.inf)
    return velocity, -0.5 * G * pull, lifetime


def relative_motions(rng: np.random.Generator, n: int) -> tuple[FLOATS, FLOATS, FLOATS]:
    """b, a and t_max of n pairs of which at least one moves; no way is longer than the table's diagonal."""
    v1, a1, t1 = motions(rng, n)
    v2, a2, t2 = motions(rng, n)
    t_max = np.minimum(np.minimum(t1, t2), rng.uniform(0.5, 4.0, n))
    return v2 - v1, a2 - a1, np.minimum(t_max, 0.5 * DIAGONAL / np.linalg.norm(v2 - v1, axis=1).clip(0.1))


def random_pairs(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    b, a, t_max = relative_motions(rng, n)
    c = np.stack([rng.uniform(-1.05, 1.05, n), rng.uniform(-2.15, 2.15, n)], axis=1)
    near = np.linalg.norm(c, axis=1) < DISTANCE * 1.001
    c[near] = [0.3, 0.4]
    return c, b, a, t_max


def placed(at: FLOATS, t: FLOATS, b: FLOATS, a: FLOATS) -> FLOATS:
    """c such that the path is ``at`` at time t."""
    return at - b * column(t) - a * column(t * t)


def started_clear(c: FLOATS, b: FLOATS, a: FLOATS, t_max: FLOATS) -> tuple[FLOATS, ...]:
    """Starts inside the other ball replaced by starts far away."""
    inside = np.linalg.norm(c, axis=1) < DISTANCE
    c = np.where(column(inside), [2.0, 1.0], c)
    return c, b, a, t_max


def aimed(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    """Paths that meet the other ball's disc somewhere within the lifetime."""
    b, a, t_max = relative_motions(rng, n)
    at = directions(rng, n) * column(DISTANCE * rng.uniform(0, 1.05, n))
    return started_clear(placed(at, t_max * rng.uniform(0, 1, n), b, a), b, a, t_max)


def depths(rng: np.random.Generator, n: int, k_min: int = 2, k_max: int = 12) -> FLOATS:
    """Gaps +-10^-k m."""
    return rng.choice([-1.0, 1.0], n) * 10.0 ** -rng.integers(k_min, k_max + 1, n)


def grazes(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    """Closest approach inside the lifetime, at a gap of +-10^-2 to +-10^-12 m."""
    b, a, t_max = relative_motions(rng, n)
    t = t_max * rng.uniform(0.01, 0.99, n)
    velocity = b + 2 * a * column(t)
    across = turned(velocity / column(np.maximum(np.linalg.norm(velocity, axis=1), 1e-300)))
    return started_clear(placed(across * column(DISTANCE + depths(rng, n)), t, b, a), b, a, t_max)


def touching(rng: np.random.Generator, n: int) -> tuple[FLOATS, FLOATS, FLOATS, FLOATS, FLOATS]:
    """A start at exactly the distance (to rounding), a random pair of motions, and the unit normal."""
    b, a, t_max = relative_motions(rng, n)
    normal = directions(rng, n)
    axis = rng.random(n) < 0.25
    normal[axis] = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])[rng.integers(0, 4, axis.sum())]
    return normal * DISTANCE, b, a, t_max, normal


def with_normal_speed(b: FLOATS, normal: FLOATS, speed: FLOATS) -> FLOATS:
    return b - normal * column(np.sum(b * normal, axis=1)) + normal * column(speed)


def touching_approaching(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    c, b, a, t_max, normal = touching(rng, n)
    return c, with_normal_speed(b, normal, -(10.0 ** rng.uniform(-7, 0.7, n))), a, t_max


def touching_opening(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    """Balls that part, some to be brought back by their accelerations."""
    c, b, a, t_max, normal = touching(rng, n)
    return c, with_normal_speed(b, normal, 10.0 ** rng.uniform(-7, 0.7, n)), a, t_max


def touching_resting(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    """No normal speed (exactly, on the axes): pressed together, parted or kept by the acceleration alone."""
    c, b, a, t_max, normal = touching(rng, n)
    still = rng.random(n) < 0.5
    return c, np.where(still[:, None], 0.0, with_normal_speed(b, normal, np.zeros(n))), a, t_max


def nearly_touching(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    """Gaps of 10^-11 to 10^-6 m at the start."""
    c, b, a, t_max, normal = touching(rng, n)
    return c + normal * column(10.0 ** rng.uniform(-11, -6, n)), b, a, t_max


def double_roots(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    """Passing at exactly the distance: a tangency the doubles represent exactly."""
    t = rng.integers(1, 64, n) / 64.0
    speed = rng.integers(1, 64, n) / 16.0 * rng.choice([-1.0, 1.0], n)
    pull = np.where(rng.random(n) < 0.5, 0.0, rng.integers(-32, 33, n) / 64.0)
    c = np.stack([-(speed + pull * t) * t, np.full(n, DISTANCE)], axis=1)
    b, a = np.stack([speed, np.zeros(n)], axis=1), np.stack([pull, np.zeros(n)], axis=1)
    swap = rng.random(n) < 0.5
    c[swap], b[swap], a[swap] = c[swap][:, ::-1], b[swap][:, ::-1], a[swap][:, ::-1]
    return started_clear(c, b, a, t * rng.uniform(1.0, 2.0, n))


def no_acceleration(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    """Two balls rolling the same way: equal decelerations, leading coefficients exactly 0 or a rounding error."""
    c, b, a, t_max = grazes(rng, n) if rng.random() < 0.5 else aimed(rng, n)
    scale = rng.choice([0.0, 1e-17, 1e-16, 1e-15, 1e-12, 1e-9, 1e-6], n)
    return c, b, a * column(scale), t_max


def parallel_paths(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    """Relative velocity and acceleration along one line, at a chosen distance beside it; half along an axis."""
    heading = directions(rng, n)
    heading[rng.random(n) < 0.5] = [1.0, 0.0]
    speed, pull = rng.uniform(0.01, 5.0, n), rng.choice([0.0, MU_ROLL, MU_SLIDE, -MU_ROLL], n) * G / 2
    beside = np.where(rng.random(n) < 0.3, 0.0, DISTANCE + depths(rng, n))
    ahead = rng.uniform(0.06, 1.5, n)
    c = heading * column(ahead) + turned(heading) * column(beside)
    t_max = np.minimum(rng.uniform(0.1, 4.0, n), DIAGONAL / speed)
    return started_clear(c, -heading * column(speed), heading * column(pull), t_max)


def stopping_short(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    """A rolling ball that comes to rest +-10^-k m before (or inside) a resting one; t_max is its stop."""
    heading = directions(rng, n)
    heading[rng.random(n) < 0.3] = [0.0, 1.0]
    speed, pull = rng.uniform(0.01, 0.7, n), MU_ROLL * G
    stop = speed / pull
    way = speed * stop - 0.5 * pull * stop * stop
    c = heading * column(DISTANCE + depths(rng, n) + way)
    return started_clear(c, -heading * column(speed), heading * column(np.full(n, 0.5 * pull)), stop)


def ending_close(rng: np.random.Generator, n: int) -> tuple[FLOATS, ...]:
    """Still approaching at t_max, at a gap of +-10^-k m there."""
    b, a, t_max = relative_motions(rng, n)
    velocity = b + 2 * a * column(t_max)
    heading = velocity / column(np.maximum(np.linalg.norm(velocity, axis=1), 1e-300))
    lean = rng.uniform(-1.5, 1.5, n)
    at = -(heading * column(np.cos(lean)) + turned(heading) * column(np.sin(lean)))
    return started_clear(placed(at * column(DISTANCE + depths(rng, n)), t_max, b, a), b, a, t_max)


CLASSES: dict[str, Callable[[np.random.Generator, int], tuple[FLOATS, ...]]] = {
    "random": random_pairs,
    "aimed": aimed,
    "graze": grazes,
    "touching, approaching": touching_approaching,
    "touching, opening": touching_opening,
    "touching, resting": touching_resting,
    "nearly touching": nearly_touching,
    "double root": double_roots,
    "no acceleration": no_acceleration,
    "parallel paths": parallel_paths,
    "stopping short": stopping_short,
    "ending close": ending_close,
}


def make_cases(rng: np.random.Generator, n: int, kinds: tuple[str, ...] = tuple(CLASSES)) -> Cases:
    """About n cases, the same number of each class."""
    each = -(-n // len(kinds))
    parts = [CLASSES[kind](rng, each) for kind in kinds]
    c, b, a, t_max = (np.ascontiguousarray(np.concatenate(arrays)) for arrays in zip(*parts, strict=True))
    return Cases(c, b, a, t_max, np.repeat(np.array(kinds), each))
