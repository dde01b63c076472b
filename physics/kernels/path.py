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


class Rise(NamedTuple):
    """The vertical part of a path: z + vz t + hz t^2.

    Attributes:
        z: m. vz: m/s. hz: m/s^2.
    """

    z: float
    vz: float
    hz: float


class SpacePath(NamedTuple):
    """A parabola in space: a ``Path`` and its ``Rise``."""

    x: float
    y: float
    z: float
    vx: float
    vy: float
    vz: float
    hx: float
    hy: float
    hz: float


class RingPath(NamedTuple):
    """The path of a flying ball by a horizontal ring, seen from its middle: straight in plan.

    Attributes:
        x, y, z: m. vx, vy, vz: m/s. hz: m/s^2. ring: m, its radius.
    """

    x: float
    y: float
    z: float
    vx: float
    vy: float
    vz: float
    hz: float
    ring: float


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
def rise_of(s, i, now):
    """The vertical part of the path of ball ``i`` from ``now`` on: 0 on the cloth."""
    dt = now - load(s.w, at.SINCE + i)
    vz, hz = load(s.w, at.VZ + i), load(s.w, at.HZ + i)
    gain = dt * hz
    return Rise(load(s.w, at.Z + i) + dt * (vz + gain), vz + (gain + gain), hz)


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


@small_kernel
def in_space(path, here, there):
    """A relative ``path`` with its relative rise: ``there`` seen from ``here``."""
    return SpacePath(
        path.x,
        path.y,
        there.z - here.z,
        path.vx,
        path.vy,
        there.vz - here.vz,
        path.hx,
        path.hy,
        there.hz - here.hz,
    )


@small_kernel
def later(path, rise, time):
    """A ``Path`` and its ``Rise`` from ``time`` on."""
    return (
        Path(
            along(path.x, path.vx, path.hx, time),
            along(path.y, path.vy, path.hy, time),
            path.vx + 2.0 * path.hx * time,
            path.vy + 2.0 * path.hy * time,
            path.hx,
            path.hy,
        ),
        Rise(along(rise.z, rise.vz, rise.hz, time), rise.vz + 2.0 * rise.hz * time, rise.hz),
    )
