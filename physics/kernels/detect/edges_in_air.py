"""When a flying ball meets an edge: a straight one, of a nose or a facing, or the round one of a horn.

A cushion is a plate at the height of its nose whose edge in plan is nose line, horn and facing; a ball touches it when
its centre is R from the edge (docs/physics.md, eq. 47-49). In plan a flight is straight. Heights are ``Rise``s above
the nose. Every function returns the first contact in [0, ``lasts``], or infinity if it does not come before ``limit``.
"""

import math

from physics.kernels.compiling import kernel, small_kernel
from physics.kernels.detect.contact import contact
from physics.kernels.path import Path, RingPath, along
from physics.kernels.tolerances import TOUCH


@small_kernel
def within(place, speed, low, high, start, end):
    """The part of [start, end] in which place + speed t is in [low, high]; empty if its start is after its end."""
    if speed == 0.0:
        return start, end if low <= place <= high else -math.inf
    one, other = (low - place) / speed, (high - place) / speed
    return max(start, min(one, other)), min(end, max(one, other))


@small_kernel
def reach_of_edge(path, start, end, limit, radius):
    """Time from now of a contact after ``start``, ``path`` counting from there; one begun inside was met before."""
    least = radius - 2.0 * TOUCH
    squared = path.x * path.x + path.y * path.y
    if squared < least * least:
        return math.inf
    found = contact(path, end - start, limit - start, radius).time
    return start + found if found == found else math.inf


@kernel
def meets_edge(radius, gap, foot, length, rise, lasts, limit):
    """A straight edge. ``gap``, ``foot``: (m, m/s) off its line and along it; it is where the foot is in ``length``."""
    start, end = within(foot[0], foot[1], length[0], length[1], 0.0, lasts)
    start, end = within(gap[0], gap[1], 0.0, math.inf, start, end)
    if not start <= min(end, limit):
        return math.inf
    across = max(gap[0] + start * gap[1], 0.0)
    path = Path(across, along(rise.z, rise.vz, rise.hz, start), gap[1], rise.vz + 2.0 * rise.hz * start, 0.0, rise.hz)
    return reach_of_edge(path, start, end, limit, radius)


@kernel
def meets_ring_from(radius, path, start, end, limit):
    """A ring, from ``start`` on until ``end``, outside of it in plan."""
    if not start <= min(end, limit):
        return math.inf
    x, y = path.x + start * path.vx, path.y + start * path.vy
    z, vz = along(path.z, path.vz, path.hz, start), path.vz + 2.0 * path.hz * start
    out = math.sqrt(x * x + y * y) - path.ring
    least = radius - 2.0 * TOUCH
    if out * out + z * z < least * least:
        return math.inf
    there = RingPath(x, y, z, path.vx, path.vy, vz, path.hz, path.ring)
    found = contact(there, end - start, limit - start, radius).time
    return start + found if found == found else math.inf


@kernel
def meets_ring(radius, path, lasts, limit):
    """A horn's ring, whose middle is the origin of ``path``.

    Over the disc itself there is the rail top; so only what of the path is outside counts, up to two stretches. The
    second is void where it begins too near: the ball has met the rail top, or is under it.
    """
    vx, vy = path.vx, path.vy
    speed_squared = vx * vx + vy * vy
    out = path.x * vx + path.y * vy
    beyond = path.x * path.x + path.y * path.y - path.ring * path.ring
    inside = out * out - speed_squared * beyond  # of the root in |p + v t|^2 = r^2
    enters, leaves = math.inf, math.inf
    if speed_squared > 0.0 and inside > 0.0:
        root = math.sqrt(inside)
        if beyond < 0.0:
            enters, leaves = 0.0, (root - out) / speed_squared if out <= 0.0 else -beyond / (out + root)
        elif out < 0.0:
            enters, leaves = beyond / (root - out), (root - out) / speed_squared
    if beyond >= 0.0:
        found = meets_ring_from(radius, path, 0.0, min(lasts, enters), limit)
        if found < math.inf:
            return found
    elif speed_squared == 0.0:
        return math.inf
    if not leaves <= lasts or abs(along(path.z, path.vz, path.hz, leaves)) < radius:
        return math.inf
    return meets_ring_from(radius, path, leaves, lasts, limit)
