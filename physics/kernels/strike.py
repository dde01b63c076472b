"""The cue strike ([I], section 5) and which strokes are possible.

With c = sqrt(R^2 - a^2 - b^2), C = cos theta, S = sin theta and offsets a, b in metres (docs/physics.md, eq. 1-4)::

    F = 2 m V / (1 + m/M + 5/(2R^2) [a^2 + (b C - c S)^2])
    v = (F C / m) d          w = (b C - c S) F/I l + a S F/I d + a C F/I k
"""

import math
from typing import NamedTuple

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, small_kernel, store, store_fact
from physics.kernels.detect.mouths import beside_long_nose, beside_short_nose
from physics.kernels.motion import on_table
from physics.kernels.resolve.flight import struck_off
from physics.kernels.squirt import struck
from physics.kernels.trigonometry import sine_cosine
from physics.kernels.workspace import by_table

MILLIMETRE = 1e-3
"""m: tip offsets of a shot come in millimetres."""


class CueStroke(NamedTuple):
    """A stroke as the physics takes it.

    Attributes:
        v: m/s. theta: deg. a, b: m, offsets of the tip to the right and up.
        dx, dy: the cue's direction d in plan, unit. cos_theta, sin_theta: of the elevation.
    """

    v: float
    theta: float
    a: float
    b: float
    dx: float
    dy: float
    cos_theta: float
    sin_theta: float


class CueAxis(NamedTuple):
    """The cue's axis, a segment from the tip r - c d - a l at height R + b along (-C d, S).

    Attributes:
        x, y: m, of the tip in plan. height, above: m, of the tip above the cloth, above the ball's centre.
        ux, uy, rise: unit direction from the tip to the butt. length: m.
    """

    x: float
    y: float
    height: float
    above: float
    ux: float
    uy: float
    rise: float
    length: float


@small_kernel
def stroke_of(v, phi, theta, a, b):
    """A stroke from v (m/s), phi and theta (deg), a and b (m)."""
    sin_phi, cos_phi = sine_cosine(phi)
    sin_theta, cos_theta = sine_cosine(theta)
    return CueStroke(v, theta, a, b, cos_phi, sin_phi, cos_theta, sin_theta)


@small_kernel
def read_stroke(shot):
    """The stroke of a shot in Olympiad units."""
    a, b = load(shot, at.S_A) * MILLIMETRE, load(shot, at.S_B) * MILLIMETRE
    return stroke_of(load(shot, at.S_V), load(shot, at.S_PHI), load(shot, at.S_THETA), a, b)


@small_kernel
def strike_rigidly(s, stroke):
    """Velocity (vx, vy) in m/s and spin (wx, wy, wz) in rad/s of the cue ball after the strike.

    The tip must be on the ball.
    """
    a, b = stroke.a, stroke.b
    radius = load(s.p, at.P_RADIUS)
    depth = math.sqrt(radius * radius - a * a - b * b)  # c: the tip meets the ball's surface
    lever = b * stroke.cos_theta - depth * stroke.sin_theta  # b C - c S: of the blow about the axis l
    bracket = (a * a + lever * lever) * load(s.p, at.P_BRACKET)
    # Elastic, along the cue: M V = M V' + F and V' + V = the tip's own speed along the cue, in which the ball's
    # spin adds [a^2 + lever^2] F/I to F/m, with I = 2/5 m R^2 (eq. 1).
    force = 2.0 * stroke.v / (1.0 + load(s.p, at.P_MASS_RATIO) + 2.5 / (radius * radius) * bracket)  # F / m
    turn = force / (load(s.p, at.P_INERTIA) * radius * radius)  # F / I
    along = a * stroke.sin_theta * turn
    across = lever * turn
    speed = force * stroke.cos_theta  # the cloth takes up the downward part F S (eq. 2)
    return (
        speed * stroke.dx,
        speed * stroke.dy,
        along * stroke.dx - across * stroke.dy,  # l = (-d_y, d_x)
        along * stroke.dy + across * stroke.dx,
        a * stroke.cos_theta * turn,
    )


@small_kernel
def strike_with_end(s, stroke):
    """The same by a cue whose end has mass: it squirts, and beyond the tip's friction it slips (squirt.py).

    Where balls leave the cloth it answers the blow down, and VZ of the cue ball is set.
    """
    radius = load(s.p, at.P_RADIUS)
    depth = math.sqrt(radius * radius - stroke.a * stroke.a - stroke.b * stroke.b)
    velocity, spin, slips = struck(
        radius,
        (stroke.dx, stroke.dy, stroke.cos_theta, stroke.sin_theta),
        depth,
        stroke.a,
        stroke.b,
        load(s.p, at.P_MASS_RATIO),
        load(s.p, at.P_END_RATIO),
        load(s.p, at.P_E_TIP),
        load(s.p, at.P_MU_TIP),
        stroke.v,
    )
    store_fact(s.facts, at.F_MISCUE, int(slips))
    if load(s.p, at.P_FLIGHT) != 0.0:
        velocity, spin = struck_off(s, velocity, spin)
        store(s.w, at.VZ + at.CUE_BALL, velocity[2])
    return velocity[0], velocity[1], spin[0], spin[1], spin[2]


strike = by_table(strike_rigidly, strike_with_end)
"""``strike(s, stroke)``: velocity and spin of the cue ball after the strike."""


@small_kernel
def cue_of(s, stroke, depth):
    """The cue as it lies at the stroke; ``depth``: c."""
    return CueAxis(
        load(s.w, at.X) - depth * stroke.dx + stroke.a * stroke.dy,
        load(s.w, at.Y) - depth * stroke.dy - stroke.a * stroke.dx,
        load(s.p, at.P_RADIUS) + stroke.b,
        stroke.b,
        -stroke.cos_theta * stroke.dx,
        -stroke.cos_theta * stroke.dy,
        stroke.sin_theta,
        load(s.p, at.P_CUE_LENGTH),
    )


@small_kernel
def blocked_by_ball(s, cue, ball):
    """Whether the cue's axis comes nearer to the centre of ``ball`` than R."""
    px, py, pz = load(s.w, at.X + ball) - cue.x, load(s.w, at.Y + ball) - cue.y, -cue.above
    along = px * cue.ux + py * cue.uy + pz * cue.rise  # the foot of the perpendicular, kept on the segment
    along = min(max(along, 0.0), cue.length)
    gx = px - along * cue.ux
    gy = py - along * cue.uy
    gz = pz - along * cue.rise
    radius = load(s.p, at.P_RADIUS)
    return gx * gx + gy * gy + gz * gz < radius * radius


@small_kernel
def below_nose(start, step, line, cue, nose):
    """Whether the cue crosses the vertical plane at ``line`` no higher than the nose of the cushion.

    ``start`` and ``step``: the tip's coordinate across the plane, and that of the cue's direction.
    """
    end = start + step * cue.length
    if (start < line) == (end < line) or step == 0.0:
        return False
    return cue.height + cue.rise * ((line - start) / step) <= nose


@small_kernel
def nose_under(s, cue):
    """The cushion whose nose the cue meets, in front of it or over a mouth; NOBODY if none."""
    half_x, half_y, nose = load(s.p, at.P_HALF_X), load(s.p, at.P_HALF_Y), load(s.p, at.P_NOSE)
    if below_nose(cue.x, cue.ux, -half_x, cue, nose):
        return at.BEHIND_CUSHION + at.WEST
    if below_nose(cue.x, cue.ux, half_x, cue, nose):
        return at.BEHIND_CUSHION + at.EAST
    if below_nose(cue.y, cue.uy, -half_y, cue, nose):
        return at.BEHIND_CUSHION + at.SOUTH
    if below_nose(cue.y, cue.uy, half_y, cue, nose):
        return at.BEHIND_CUSHION + at.NORTH
    return at.NOBODY


@small_kernel
def depth_of_mouth(s, mouth):
    """How far a kind of mouth reaches beyond its nose line: to the far edge of the hole, m."""
    return load(s.p, mouth + at.HOLE_RADIUS) - load(s.p, mouth + at.HOLE_U)


@small_kernel
def rail_under(s, cue):
    """The same on a table with jaws, where the tip may be beyond a nose line.

    Beside a nose it is then over the cushion, which must lie lower; in a mouth it is over the hole, and the cue must be
    above the rail where the hole ends.
    """
    found = nose_under(s, cue)
    if found != at.NOBODY:
        return found
    half_x, half_y, nose = load(s.p, at.P_HALF_X), load(s.p, at.P_HALF_Y), load(s.p, at.P_NOSE)
    east, north = 1.0 if cue.x > 0.0 else -1.0, 1.0 if cue.y > 0.0 else -1.0
    if abs(cue.x) > half_x:
        corner = half_y - abs(cue.y) < load(s.p, at.P_CORNER_JAW)
        line = half_x + depth_of_mouth(s, at.P_CORNER_JAW if corner else at.P_SIDE_JAW)
        over_cushion = beside_long_nose(s, cue.y) and cue.height <= nose
        if over_cushion or below_nose(cue.x, cue.ux, east * line, cue, nose):
            return at.BEHIND_CUSHION + (at.EAST if cue.x > 0.0 else at.WEST)
    if abs(cue.y) > half_y:
        line = half_y + depth_of_mouth(s, at.P_CORNER_JAW)
        over_cushion = beside_short_nose(s, cue.x) and cue.height <= nose
        if over_cushion or below_nose(cue.y, cue.uy, north * line, cue, nose):
            return at.BEHIND_CUSHION + (at.NORTH if cue.y > 0.0 else at.SOUTH)
    return at.NOBODY


cushion_under = by_table(nose_under, rail_under)
"""``cushion_under(s, cue)``: BEHIND_CUSHION + the cushion that the cue meets, or NOBODY."""


@kernel
def obstacle(s, stroke):
    """What blocks the cue: NOBODY, or the number of the first obstacle.

    Balls off the table lie far away and block nothing.
    """
    radius = load(s.p, at.P_RADIUS)
    depth = math.sqrt(radius * radius - stroke.a * stroke.a - stroke.b * stroke.b)
    if depth * stroke.cos_theta + stroke.b * stroke.sin_theta <= 0.0:
        return at.THROUGH_CUE_BALL
    cue = cue_of(s, stroke, depth)
    blocking = 0
    for ball in range(at.LANES):
        blocking |= int(blocked_by_ball(s, cue, ball)) << ball
    blocking &= ~(1 << at.CUE_BALL)
    if blocking != 0:
        return lowest_bit(blocking)
    return cushion_under(s, cue)


@kernel
def playable(s, stroke):
    """Status of a stroke before it is played: AT_REST if nothing is against it."""
    radius = load(s.p, at.P_RADIUS)
    in_range = 0.0 <= stroke.v <= load(s.p, at.P_V_MAX) and 0.0 <= stroke.theta <= load(s.p, at.P_THETA_MAX)
    if not in_range:
        return at.OUT_OF_RANGE
    if not on_table(load_integer(s.k, at.MOTION + at.CUE_BALL)):
        return at.NO_CUE_BALL
    if stroke.a * stroke.a + stroke.b * stroke.b > radius * radius:
        return at.TIP_OFF_BALL
    if load(s.p, at.P_CUE_TEST) != 0.0 and obstacle(s, stroke) != at.NOBODY:
        return at.CUE_OBSTRUCTED
    return at.AT_REST


@kernel
def is_free(s, phi, theta, a, b):
    """Whether nothing blocks the cue at elevation ``theta`` (deg)."""
    return obstacle(s, stroke_of(0.0, phi, theta, a, b)) == at.NOBODY


@kernel
def lowest_elevation(s, phi, a, b):
    """Smallest elevation in degrees at which nothing blocks the cue, NaN if none.

    The free elevations need not be one interval (a low tip passes under a ball's widest part), so they are looked
    for in steps of 1/8 deg and the edge of the first found is bisected to the last bit.
    """
    if is_free(s, phi, 0.0, a, b):
        return 0.0
    top = load(s.p, at.P_THETA_MAX)
    low = 0.0
    while low < top:
        high = min(low + 0.125, top)
        if is_free(s, phi, high, a, b):
            middle = 0.5 * (low + high)
            while low < middle < high:
                if is_free(s, phi, middle, a, b):
                    high = middle
                else:
                    low = middle
                middle = 0.5 * (low + high)
            return high
        low = high
    return math.nan
