"""The squared distance that a path keeps, with its derivatives: what the contact solver steps along.

By the kind of path: |c + b t + a t^2|^2 in the plane and in space, and (q - r)^2 + z^2, q = |p + v t|, by a ring of
radius r. The plane's expressions are those of every earlier release: their bits stand.
"""

import math
from collections.abc import Callable
from typing import Any

from numba.extending import overload

from physics.kernels.compiling import small_kernel
from physics.kernels.path import Path, RingPath, SpacePath


def by_path(plane: Callable[..., Any], space: Callable[..., Any], ring: Callable[..., Any]) -> Callable[..., Any]:
    """A kernel that is another for each kind of path, its first argument; decided when it is compiled."""
    kernels = {Path: plane, SpacePath: space, RingPath: ring}

    def chosen(path: Any, *rest: Any) -> Any:
        return kernels[type(path)](path, *rest)

    @overload(chosen, jit_options={"error_model": "numpy", "forceinline": True}, strict=False)
    def choose(path: Any, *_rest: Any) -> Any:
        kernel = kernels[path.instance_class]
        return lambda path, *_rest: kernel(path, *_rest)

    return chosen


@small_kernel
def least_of_parabola(c0, c1, c2, start, end):
    """Least value of c0 + c1 t + c2 t^2 on [start, end], for c2 >= 0."""
    if c1 + 2.0 * c2 * start >= 0.0:  # rising from the start on
        return c0 + start * (c1 + start * c2)
    if c1 + 2.0 * c2 * end <= 0.0:  # falling to the end
        return c0 + end * (c1 + end * c2)
    return c0 - 0.25 * c1 * c1 / c2  # the vertex, t = -c1 / 2 c2


@small_kernel
def start_in_plane(path):
    """See ``start_of``."""
    return path.x * path.x + path.y * path.y, path.x * path.vx + path.y * path.vy


@small_kernel
def start_in_space(path):
    """See ``start_of``."""
    cx, cy, cz, bx, by, bz, _, _, _ = path
    return (cx * cx + cy * cy) + cz * cz, (cx * bx + cy * by) + cz * bz


@small_kernel
def start_by_ring(path):
    """See ``start_of``."""
    q = math.sqrt(path.x * path.x + path.y * path.y)
    out = q - path.ring
    return out * out + path.z * path.z, out * ((path.x * path.vx + path.y * path.vy) / q) + path.z * path.vz


start_of = by_path(start_in_plane, start_in_space, start_by_ring)
"""``start_of(path)``: (distance^2, half its derivative) at time 0."""


@small_kernel
def reach_in_plane(path, t):
    """See ``reach_at``."""
    cx, cy, bx, by, ax, ay = path
    dx = cx + t * (bx + t * ax)
    dy = cy + t * (by + t * ay)
    return dx * dx + dy * dy, 2.0 * (dx * (bx + 2.0 * ax * t) + dy * (by + 2.0 * ay * t))


@small_kernel
def reach_in_space(path, t):
    """See ``reach_at``."""
    cx, cy, cz, bx, by, bz, ax, ay, az = path
    dx = cx + t * (bx + t * ax)
    dy = cy + t * (by + t * ay)
    dz = cz + t * (bz + t * az)
    along = dx * (bx + 2.0 * ax * t) + dy * (by + 2.0 * ay * t)
    return (dx * dx + dy * dy) + dz * dz, 2.0 * (along + dz * (bz + 2.0 * az * t))


@small_kernel
def reach_by_ring(path, t):
    """See ``reach_at``."""
    px, py = path.x + t * path.vx, path.y + t * path.vy
    dz = path.z + t * (path.vz + t * path.hz)
    q = math.sqrt(px * px + py * py)
    out = q - path.ring
    speed = (px * path.vx + py * path.vy) / q
    return out * out + dz * dz, 2.0 * (out * speed + dz * (path.vz + 2.0 * path.hz * t))


reach_at = by_path(reach_in_plane, reach_in_space, reach_by_ring)
"""``reach_at(path, t)``: (distance^2, its derivative)."""


@small_kernel
def curvature_in_plane(path):
    """See ``curvature_of``."""
    cx, cy, bx, by, ax, ay = path
    c0 = 2.0 * (bx * bx + by * by) + 4.0 * (ax * cx + ay * cy)
    c1 = 12.0 * (ax * bx + ay * by)
    c2 = 12.0 * (ax * ax + ay * ay)
    return c0, c1, c2


@small_kernel
def curvature_in_space(path):
    """See ``curvature_of``."""
    cx, cy, cz, bx, by, bz, ax, ay, az = path
    c0 = 2.0 * ((bx * bx + by * by) + bz * bz) + 4.0 * ((ax * cx + ay * cy) + az * cz)
    c1 = 12.0 * ((ax * bx + ay * by) + az * bz)
    c2 = 12.0 * ((ax * ax + ay * ay) + az * az)
    return c0, c1, c2


@small_kernel
def curvature_by_ring(path):
    """Of q^2 + z^2, see ``curvature_of``; the rest of (q - r)^2, -2 r q, is bounded in ``least_by_ring``."""
    vx, vy, z, vz, hz = path.vx, path.vy, path.z, path.vz, path.hz
    return 2.0 * ((vx * vx + vy * vy) + vz * vz) + 4.0 * hz * z, 12.0 * hz * vz, 12.0 * hz * hz


curvature_of = by_path(curvature_in_plane, curvature_in_space, curvature_by_ring)
"""``curvature_of(path)``: (c0, c1, c2) of f'' = c0 + c1 t + c2 t^2 for the squared distance f: f' = 2 d.d' and
f'' = 2 d'.d' + 2 d.d'' with d' = b + 2 a t, d'' = 2 a, so f'' = 2 b.b + 4 a.c + 12 (a.b) t + 12 (a.a) t^2 (eq. 23)."""


@small_kernel
def least_alone(_path, curvature, start, end):
    """See ``least_curvature``: f'' is the parabola itself."""
    return least_of_parabola(curvature[0], curvature[1], curvature[2], start, end)


@small_kernel
def least_by_ring(path, curvature, start, end):
    """See ``least_curvature``: q'' = L^2 / q^3 with L = p x v, so f'' >= (...)_least - 2 r L^2 / q_least^3 (eq. 49).

    Holds where q >= r.
    """
    x, y, vx, vy, ring = path.x, path.y, path.vx, path.vy, path.ring
    turn = x * vy - y * vx
    speed_squared, towards = vx * vx + vy * vy, -(x * vx + y * vy)  # nearest at towards / speed_squared
    nearest = start
    if towards >= end * speed_squared:
        nearest = end
    elif towards > start * speed_squared:
        nearest = towards / speed_squared
    px, py = x + nearest * vx, y + nearest * vy
    q = max(math.sqrt(px * px + py * py), ring)
    least = least_of_parabola(curvature[0], curvature[1], curvature[2], start, end)
    return least - 2.0 * ring * (turn * turn) / (q * q * q)


least_curvature = by_path(least_alone, least_alone, least_by_ring)
"""``least_curvature(path, curvature, start, end)``: a lower bound of f'' on [start, end]; exact but by a ring."""
