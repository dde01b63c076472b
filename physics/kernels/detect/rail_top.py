"""Where the top of the rails is, seen from above: over a cushion, or the rail behind it; and where the holes are.

The whole top lies at the height of the nose. In a mouth the cushion ends at horn and facing.
"""

import math

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load, small_kernel
from physics.kernels.detect.jaws import from_facing
from physics.kernels.detect.mouths import (
    NO_MOUTH,
    beside_long_nose,
    beside_short_nose,
    corner_near,
    from_nose_lines,
    is_corner,
    jaw_at,
    side_near,
    signs_of,
)
from physics.kernels.path import Path


@small_kernel
def is_over_jaw(s, jaw, along, across):
    """Whether a place in jaw coordinates is over a jaw: behind nose and facing, and not in what the horn rounds off."""
    if not -load(s.p, at.P_CUSHION_WIDTH) <= across <= 0.0:
        return False
    gap, foot = from_facing(jaw, along, across)
    if gap > 0.0:
        return False
    horn_s, horn_d = along - jaw.nose_end, across + jaw.horn
    rounded_off = (along < jaw.nose_end) & (foot < 0.0)
    return not (rounded_off & (horn_s * horn_s + horn_d * horn_d > jaw.horn * jaw.horn))


@small_kernel
def from_hole(s, pocket, path):
    """A path in plan seen from the middle of a pocket's hole: by distances from the nose lines, or from the middle."""
    sign_x, sign_y = signs_of(pocket)
    if is_corner(pocket):
        here = from_nose_lines(s, path, sign_x, sign_y)
        mouth = at.P_CORNER_JAW
    else:
        here = Path(load(s.p, at.P_HALF_X) - sign_x * path.x, path.y, -sign_x * path.vx, path.vy, 0.0, 0.0)
        mouth = at.P_SIDE_JAW
    return Path(
        here.x - load(s.p, mouth + at.HOLE_U),
        here.y - load(s.p, mouth + at.HOLE_V),
        here.vx,
        here.vy,
        0.0,
        0.0,
    )


@small_kernel
def hole_radius(s, pocket):
    """Radius of a pocket's drop edge, m."""
    return load(s.p, (at.P_CORNER_JAW if is_corner(pocket) else at.P_SIDE_JAW) + at.HOLE_RADIUS)


@small_kernel
def is_over(s, pocket, x, y):
    """Whether a place is over a pocket's hole."""
    here = from_hole(s, pocket, Path(x, y, 0.0, 0.0, 0.0, 0.0))
    radius = hole_radius(s, pocket)
    return here.x * here.x + here.y * here.y < radius * radius


@kernel
def hole_under(s, x, y):
    """The pocket whose hole a place is over, or NO_MOUTH."""
    corner, side = corner_near(x, y), side_near(x)
    if is_over(s, corner, x, y):
        return corner
    return side if is_over(s, side, x, y) else NO_MOUTH


@kernel
def is_over_rail(s, x, y):
    """Whether a place in plan is over the top of a cushion or of the rail behind it."""
    u, v = load(s.p, at.P_HALF_X) - abs(x), load(s.p, at.P_HALF_Y) - abs(y)
    if (u > 0.0) & (v > 0.0):
        return False
    width = load(s.p, at.P_CUSHION_WIDTH)
    if (u < -width) | (v < -width):
        return hole_under(s, x, y) == NO_MOUTH
    if ((u <= 0.0) & beside_long_nose(s, y)) | ((v <= 0.0) & beside_short_nose(s, x)):
        return True
    corner = jaw_at(s, at.P_CORNER_JAW)
    if (u < corner.nose_end) & (v < corner.nose_end):
        return is_over_jaw(s, corner, u, v) | is_over_jaw(s, corner, v, u)
    return is_over_jaw(s, jaw_at(s, at.P_SIDE_JAW), abs(y), u)


@small_kernel
def rail_at(s, x, y):
    """The cushion whose rail a place beyond the nose lines is over; at a corner the one it is farther beyond."""
    if abs(x) - load(s.p, at.P_HALF_X) >= abs(y) - load(s.p, at.P_HALF_Y):
        return at.EAST if x > 0.0 else at.WEST
    return at.NORTH if y > 0.0 else at.SOUTH


@small_kernel
def falls_to(rise, height):
    """Time at which a flight falls to ``height``, infinity if it is always below; 0 if it is there and falls."""
    # z + vz t + hz t^2 = height, the later root; each branch adds numbers of one sign
    above = max(rise.z - height, 0.0) if rise.vz <= 0.0 else rise.z - height
    inside = rise.vz * rise.vz - 4.0 * rise.hz * above
    if (inside < 0.0) | ((rise.vz <= 0.0) & (rise.z < height)):
        return math.inf
    root = math.sqrt(inside)
    if rise.vz < 0.0:
        return 2.0 * above / (root - rise.vz)
    return (rise.vz + root) / (-2.0 * rise.hz)
