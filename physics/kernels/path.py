"""The path of a ball's centre between two of its events: r(t) = r + v t + h t^2 (docs/physics.md, eq. 5-9)."""

from typing import NamedTuple

from physics.kernels import layout as at
from physics.kernels.compiling import load, small_kernel


class Path(NamedTuple):
    """A parabola in the plane, its time counting from now; of one ball, or of one ball seen from another.

    Attributes:
        x, y: m. vx, vy: m/s. hx, hy: m/s^2, half the acceleration.
    """

    x: float
    y: float
    vx: float
    vy: float
    hx: float
    hy: float


@small_kernel
def along(start, speed, half, dt):
    """Coordinate after ``dt``: start + speed dt + half dt^2."""
    return start + dt * (speed + dt * half)


@small_kernel
def path_of(s, i, now):
    """Path of ball ``i`` from ``now`` on: with dt = now - SINCE it begins at X + V dt + H dt^2, with V + 2 H dt."""
    dt = now - load(s.w, at.SINCE + i)
    vx, vy, hx, hy = load(s.w, at.VX + i), load(s.w, at.VY + i), load(s.w, at.HX + i), load(s.w, at.HY + i)
    gain_x, gain_y = dt * hx, dt * hy
    return Path(
        load(s.w, at.X + i) + dt * (vx + gain_x),
        load(s.w, at.Y + i) + dt * (vy + gain_y),
        vx + (gain_x + gain_x),
        vy + (gain_y + gain_y),
        hx,
        hy,
    )


@small_kernel
def seen_from(here, there):
    """The path ``there`` seen from a ball on the path ``here``."""
    return Path(
        there.x - here.x,
        there.y - here.y,
        there.vx - here.vx,
        there.vy - here.vy,
        there.hx - here.hx,
        there.hy - here.hy,
    )
