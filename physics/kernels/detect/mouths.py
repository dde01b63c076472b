"""When a ball reaches the boundary of a table with jaws: nose lines, and the five pieces of a mouth.

Inside the rectangle of the nose lines moved inward by rho there is no part of a jaw or a hole, so the four lines are
the broad phase, and an exact one: a path meets each at most once from inside. Where it does, it meets the cushion if
the foot is on the nose, else it comes into that mouth; then, unless it meets a cushion before, the mouth's two horns,
two facings and drop edge are looked for over the whole path. So they are for a ball that is in a mouth now
(docs/physics.md, "Jaws").

Everything is met in jaw coordinates, signs flipped, both jaws of a corner alike: mirror images have the same bits.
"""

import math

from physics.kernels import layout as at
from physics.kernels.apart import apart
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, small_kernel, store_integer
from physics.kernels.detect.boundary import Coming, lines_in_reach
from physics.kernels.detect.jaws import JawOutline, drops, falling, from_facing, meets_facing, meets_horn
from physics.kernels.detect.line import crossing
from physics.kernels.path import Path, along
from physics.kernels.tolerances import TOUCH, UNFELT
from physics.kernels.workspace import RealWorkspace

NO_MOUTH = -1


@small_kernel
def jaw_at(s, mouth):
    """The jaw of a kind of mouth: P_CORNER_JAW or P_SIDE_JAW."""
    return JawOutline(
        load(s.p, mouth + at.JAW_NOSE_END),
        load(s.p, mouth + at.JAW_HORN),
        load(s.p, mouth + at.JAW_START_S),
        load(s.p, mouth + at.JAW_START_D),
        load(s.p, mouth + at.JAW_NORMAL_S),
        load(s.p, mouth + at.JAW_NORMAL_D),
        load(s.p, mouth + at.JAW_LENGTH),
    )


@small_kernel
def is_corner(pocket):
    """Whether a pocket is a corner pocket."""
    return (pocket != at.POCKET_W) & (pocket != at.POCKET_E)


@small_kernel
def signs_of(pocket):
    """Where a pocket lies: (-1 west or 1 east, -1 south, 0 middle or 1 north)."""
    east = 1.0 if pocket >= at.POCKET_NE else -1.0
    if not is_corner(pocket):
        return east, 0.0
    return east, 1.0 if (pocket == at.POCKET_NW) | (pocket == at.POCKET_NE) else -1.0


@small_kernel
def corner_near(x, y):
    """The corner pocket of a quarter of the table."""
    if x > 0.0:
        return at.POCKET_NE if y > 0.0 else at.POCKET_SE
    return at.POCKET_NW if y > 0.0 else at.POCKET_SW


@small_kernel
def side_near(x):
    """The side pocket of a half of the table."""
    return at.POCKET_E if x > 0.0 else at.POCKET_W


@small_kernel
def beside_long_nose(s, y):
    """Whether the foot of a place on a long nose line lies on the nose: both its ends belong to it."""
    from_corner, from_middle = load(s.p, at.P_HALF_Y) - abs(y), abs(y)
    return (from_corner >= load(s.p, at.P_CORNER_JAW)) & (from_middle >= load(s.p, at.P_SIDE_JAW))


@small_kernel
def beside_short_nose(s, x):
    """The same on a short nose line."""
    return load(s.p, at.P_HALF_X) - abs(x) >= load(s.p, at.P_CORNER_JAW)


@small_kernel
def mouth_on_long_line(s, x, y):
    """The mouth in a long nose line at a place beside which there is no nose."""
    if load(s.p, at.P_HALF_Y) - abs(y) < load(s.p, at.P_CORNER_JAW):
        return corner_near(x, y)
    return side_near(x)


@small_kernel
def mouth_of(s, x, y):
    """The mouth that a place outside the rectangle is in, or NO_MOUTH."""
    if abs(x) > load(s.p, at.P_LINE_X):
        return NO_MOUTH if beside_long_nose(s, y) else mouth_on_long_line(s, x, y)
    if abs(y) > load(s.p, at.P_LINE_Y):
        return NO_MOUTH if beside_short_nose(s, x) else corner_near(x, y)
    return NO_MOUTH


@small_kernel
def reached(gap, speed, half, on_nose):
    """When a path falls through a nose line; ``on_nose``: its foot lies on the nose, so what overlaps is rounding."""
    if (speed <= 0.0) & (half <= UNFELT):
        return math.inf
    return crossing(max(gap, 0.0), speed, half) if on_nose else falling(gap, speed, half)


@small_kernel
def through_line(s, path, line):
    """(when a path falls through a nose line; where along it; whether that is beside the nose)."""
    sign = 1.0 if line & 1 else -1.0
    if line <= at.EAST:
        gap = load(s.p, at.P_LINE_X) - sign * path.x
        t = reached(gap, sign * path.vx, sign * path.hx, beside_long_nose(s, path.y))
        y = along(path.y, path.vy, path.hy, t) if t < math.inf else 0.0
        return t, y, beside_long_nose(s, y)
    gap = load(s.p, at.P_LINE_Y) - sign * path.y
    t = reached(gap, sign * path.vy, sign * path.hy, beside_short_nose(s, path.x))
    x = along(path.x, path.vx, path.hx, t) if t < math.inf else 0.0
    return t, x, beside_short_nose(s, x)


@kernel
def mouths_entered(s, path, lines, until):
    """Bit set of the mouths into which a path falls through one of ``lines``, none of them beside a nose."""
    mouths = 0
    while lines != 0:
        line = lowest_bit(lines)
        lines &= lines - 1
        sign = 1.0 if line & 1 else -1.0
        t, place, _ = through_line(s, path, line)
        if t <= until:
            mouths |= 1 << (mouth_on_long_line(s, sign, place) if line <= at.EAST else corner_near(place, sign))
    return mouths


@small_kernel
def meet_noses(s, path, best):
    """(the cushion the path meets before ``best``, bit set of the mouths that it comes into until then)."""
    openings = 0
    rest = lines_in_reach(s, path, best.time)
    while rest != 0:
        line = lowest_bit(rest)
        rest &= rest - 1
        t, _, on_nose = through_line(s, path, line)
        if not on_nose:
            openings |= int(t <= best.time) << line
        elif t < best.time:
            best = Coming(t, at.MEET_CUSHION, line)
    return best, mouths_entered(s, path, openings, best.time) if openings != 0 else 0


@small_kernel
def meet_jaw(s, jaw, number, path, lasts, best):
    """Jaw ``number``, before ``best``; ``path`` in its coordinates."""
    rho = load(s.p, at.P_RHO)
    t = meets_facing(jaw, rho, path, lasts)
    if t < best.time:
        best = Coming(t, at.MEET_JAW, at.FIRST_JAW + number)
    t = meets_horn(jaw, rho, path, lasts, best.time)
    if t < best.time:
        best = Coming(t, at.MEET_JAW, at.FIRST_JAW + number)
    return best


@small_kernel
def meet_hole(s, mouth, pocket, path, lasts, best):
    """The drop edge of a pocket, before ``best``; ``path`` by distances from the nose lines, or from the middle."""
    from_hole = Path(
        path.x - load(s.p, mouth + at.HOLE_U), path.y - load(s.p, mouth + at.HOLE_V), path.vx, path.vy, path.hx, path.hy
    )
    t = drops(from_hole, load(s.p, mouth + at.HOLE_RADIUS), lasts, best.time)
    return Coming(t, at.MEET_POCKET, pocket) if t < best.time else best


@small_kernel
def swapped(path):
    """The path with its coordinates exchanged."""
    return Path(path.y, path.x, path.vy, path.vx, path.hy, path.hx)


@small_kernel
def from_nose_lines(s, path, sign_x, sign_y):
    """A path as distances (U, V) from the nose lines of a corner."""
    return Path(
        load(s.p, at.P_HALF_X) - sign_x * path.x,
        load(s.p, at.P_HALF_Y) - sign_y * path.y,
        -sign_x * path.vx,
        -sign_y * path.vy,
        -sign_x * path.hx,
        -sign_y * path.hy,
    )


@small_kernel
def end_jaw(corner):
    """Number of the jaw that ends the short cushion at a corner pocket; the pocket's other one ends the long."""
    return 2 * corner + int((corner == at.POCKET_NW) | (corner == at.POCKET_SE))


@small_kernel
def upper_jaw(side):
    """Number of a side pocket's jaw on the half y > 0; the other is the pocket's other one."""
    return 2 * side + int(side == at.POCKET_W)


@apart(Coming, RealWorkspace, int, Path, float, Coming)
@kernel
def meet_mouth(s, pocket, path, lasts, best):
    """The first piece of a mouth that the path meets before ``best``."""
    sign_x, sign_y = signs_of(pocket)
    if is_corner(pocket):
        jaw, first = jaw_at(s, at.P_CORNER_JAW), end_jaw(pocket)
        here = from_nose_lines(s, path, sign_x, sign_y)
        best = meet_jaw(s, jaw, first, here, lasts, best)
        best = meet_jaw(s, jaw, first ^ 1, swapped(here), lasts, best)
        return meet_hole(s, at.P_CORNER_JAW, pocket, here, lasts, best)
    jaw, first = jaw_at(s, at.P_SIDE_JAW), upper_jaw(pocket)
    out = load(s.p, at.P_HALF_X) - sign_x * path.x
    upper = Path(path.y, out, path.vy, -sign_x * path.vx, path.hy, -sign_x * path.hx)
    lower = Path(-path.y, out, -path.vy, -sign_x * path.vx, -path.hy, -sign_x * path.hx)
    best = meet_jaw(s, jaw, first, upper, lasts, best)
    best = meet_jaw(s, jaw, first ^ 1, lower, lasts, best)
    return meet_hole(s, at.P_SIDE_JAW, pocket, swapped(upper), lasts, best)


@small_kernel
def meet_rails(s, path, lasts):
    """First cushion, jaw or drop edge a moving ball reaches within ``lasts``, counting from now; NOTHING if none."""
    store_integer(s.k, at.CUSHION_LOOKS, load_integer(s.k, at.CUSHION_LOOKS) + 1)
    best, mouths = meet_noses(s, path, Coming(lasts, at.NOTHING, 0))
    here = mouth_of(s, path.x, path.y)
    if here != NO_MOUTH:
        mouths |= 1 << here
    while mouths != 0:
        pocket = lowest_bit(mouths)
        mouths &= mouths - 1
        best = meet_mouth(s, pocket, path, lasts, best)
    return best


@small_kernel
def may_stand(s, x, y, slack):
    """Whether a centre may rest at (x, y), from the table's centre: clear of noses, jaws and holes.

    ``slack`` (m) in a cushion counts as at it.
    """
    near = load(s.p, at.P_RHO) - slack
    u, v = load(s.p, at.P_HALF_X) - abs(x), load(s.p, at.P_HALF_Y) - abs(y)
    if (u >= near) & (v >= near):
        return True
    corner, side = jaw_at(s, at.P_CORNER_JAW), jaw_at(s, at.P_SIDE_JAW)
    if (u < corner.nose_end) & (v < corner.nose_end):
        clear = is_clear_of(corner, near, u, v) & is_clear_of(corner, near, v, u)
        return clear & is_off_hole(s, at.P_CORNER_JAW, u, v)
    if (abs(y) < side.nose_end) & (v >= near):
        return is_clear_of(side, near, abs(y), u) & is_off_hole(s, at.P_SIDE_JAW, u, abs(y))
    return False


@small_kernel
def is_clear_of(jaw, near, s, d):
    """Whether a centre in jaw coordinates is ``near`` or more from the jaw, and not beyond its facing's end."""
    gap, foot = from_facing(jaw, s, d)
    horn_s, horn_d, reach = s - jaw.nose_end, d + jaw.horn, jaw.horn + near
    off_facing = (foot < 0.0) | ((gap >= near) & (foot <= jaw.length))
    off_nose = (s < jaw.nose_end) | (d >= near)
    return off_nose & off_facing & (horn_s * horn_s + horn_d * horn_d >= reach * reach)


@small_kernel
def is_off_hole(s, mouth, u, v):
    """Whether a centre is outside the drop edge."""
    at_u, at_v, radius = (
        u - load(s.p, mouth + at.HOLE_U),
        v - load(s.p, mouth + at.HOLE_V),
        load(s.p, mouth + at.HOLE_RADIUS),
    )
    return at_u * at_u + at_v * at_v > radius * radius


@small_kernel
def touches_jaw(jaw, near, s, d):
    """Whether a centre in jaw coordinates is within ``near`` of the facing, beside it, or of the horn, round it."""
    gap, foot = from_facing(jaw, s, d)
    if foot >= 0.0:
        return (gap <= near) & (foot <= jaw.length)
    horn_s, horn_d, reach = s - jaw.nose_end, d + jaw.horn, jaw.horn + near
    return (s < jaw.nose_end) & (horn_s * horn_s + horn_d * horn_d <= reach * reach)


@kernel
def rail_touched(s, x, y):
    """Number of the cushion or jaw (FIRST_JAW + its number) that a centre touches, or NO_CUSHION. At most one."""
    u, v = load(s.p, at.P_HALF_X) - abs(x), load(s.p, at.P_HALF_Y) - abs(y)
    near = load(s.p, at.P_RHO) + TOUCH
    if (u > near) & (v > near):
        return at.NO_CUSHION
    if (u <= near) & beside_long_nose(s, y):
        return at.EAST if x > 0.0 else at.WEST
    if (v <= near) & beside_short_nose(s, x):
        return at.NORTH if y > 0.0 else at.SOUTH
    corner = jaw_at(s, at.P_CORNER_JAW)
    if (u < corner.nose_end) & (v < corner.nose_end):
        pocket = corner_near(x, y)
        if touches_jaw(corner, near, u, v):
            return at.FIRST_JAW + end_jaw(pocket)
        return at.FIRST_JAW + (end_jaw(pocket) ^ 1) if touches_jaw(corner, near, v, u) else at.NO_CUSHION
    pocket = side_near(x)
    if touches_jaw(jaw_at(s, at.P_SIDE_JAW), near, abs(y), u):
        return at.FIRST_JAW + (upper_jaw(pocket) if y > 0.0 else upper_jaw(pocket) ^ 1)
    return at.NO_CUSHION
