"""A ball at the cushions and jaws of a table with jaws: what it touches, and the laws and holds at any direction.

Numbers: cushions WEST EAST SOUTH NORTH = 0..3, then jaws, FIRST_JAW + 0..11. Each function does what ``cushion`` does
for straight mouths; a horn is curved, so a ball that moves along it parts from it.
"""

import math
from typing import NamedTuple

from physics.kernels import layout as at
from physics.kernels.apart import apart
from physics.kernels.compiling import kernel, load, load_integer, plain, small_kernel, store
from physics.kernels.detect.jaws import from_facing
from physics.kernels.detect.mouths import end_jaw, is_corner, jaw_at, rail_touched, signs_of, upper_jaw
from physics.kernels.motion import on_table
from physics.kernels.path import path_of
from physics.kernels.recording import record
from physics.kernels.resolve.cushion_laws import han, mathavan
from physics.kernels.resolve.fixed import impact
from physics.kernels.resolve.flight import pressed_up
from physics.kernels.resolve.rails_in_air import (
    edge_of,
    hold_in_air,
    open_at,
    opening_in_air,
    rebound_in_air,
    returns_in_air,
    touched_in_air,
)
from physics.kernels.tolerances import DEEPER, ROUNDING_ACROSS, TOUCH
from physics.kernels.workspace import RealWorkspace


class Wall(NamedTuple):
    """A cushion or jaw where a ball touches it.

    Attributes:
        nx, ny: unit normal in plan, from it to the ball's centre. distance: m, of the centre from nose line, facing or
            horn. bend: 1/m, curvature of the line the centre would follow along it, 0 on a straight piece.
    """

    nx: float
    ny: float
    distance: float
    bend: float


@small_kernel
def touched(s, i):
    """Cushion or jaw that ball ``i`` touches, or NO_CUSHION. At most one: jaws are farther apart than a ball is."""
    motion = load_integer(s.k, at.MOTION + i)
    if not on_table(motion):
        return at.NO_CUSHION
    if motion == at.FLYING:
        return touched_in_air(s, i)
    return rail_touched(s, load(s.w, at.X + i), load(s.w, at.Y + i))


@small_kernel
def wall_of_jaw(s, jaw, place_s, place_d):
    """The facing, or the horn, beside a place in jaw coordinates, its normal in them."""
    distance, foot = from_facing(jaw, place_s, place_d)
    if foot >= 0.0:
        return Wall(jaw.normal_s, jaw.normal_d, distance, 0.0)
    from_s, from_d = place_s - jaw.nose_end, place_d + jaw.horn
    far = math.sqrt(from_s * from_s + from_d * from_d)
    return Wall(from_s / far, from_d / far, far - jaw.horn, 1.0 / (jaw.horn + load(s.p, at.P_RHO)))


@kernel
def wall_at(s, number, i):
    """Cushion or jaw ``number`` where ball ``i`` touches it."""
    x, y = load(s.w, at.X + i), load(s.w, at.Y + i)
    if number == at.WEST:
        return Wall(1.0, 0.0, load(s.p, at.P_HALF_X) + x, 0.0)
    if number == at.EAST:
        return Wall(-1.0, 0.0, load(s.p, at.P_HALF_X) - x, 0.0)
    if number == at.SOUTH:
        return Wall(0.0, 1.0, load(s.p, at.P_HALF_Y) + y, 0.0)
    if number == at.NORTH:
        return Wall(0.0, -1.0, load(s.p, at.P_HALF_Y) - y, 0.0)
    jaw = number - at.FIRST_JAW
    pocket = jaw >> 1
    sign_x, sign_y = signs_of(pocket)
    u = load(s.p, at.P_HALF_X) - sign_x * x
    if is_corner(pocket):
        v = load(s.p, at.P_HALF_Y) - sign_y * y
        shape = jaw_at(s, at.P_CORNER_JAW)
        if jaw == end_jaw(pocket):
            wall = wall_of_jaw(s, shape, u, v)
            return Wall(-sign_x * wall.nx, -sign_y * wall.ny, wall.distance, wall.bend)
        wall = wall_of_jaw(s, shape, v, u)
        return Wall(-sign_x * wall.ny, -sign_y * wall.nx, wall.distance, wall.bend)
    side = 1.0 if jaw == upper_jaw(pocket) else -1.0
    wall = wall_of_jaw(s, jaw_at(s, at.P_SIDE_JAW), side * y, u)
    return Wall(-sign_x * wall.ny, side * wall.nx, wall.distance, wall.bend)


@small_kernel
def is_slanted(wall):
    """Whether a wall lies along neither axis: then a component across it is rounded."""
    return (wall.nx != 0.0) & (wall.ny != 0.0)


@small_kernel
def across(wall, x, y):
    """Component of a velocity away from a wall, m/s; of a slanted one 0 where it may be rounding of one along it."""
    speed = x * wall.nx + y * wall.ny
    return 0.0 if is_slanted(wall) & (abs(speed) <= ROUNDING_ACROSS) else speed


@small_kernel
def opening(s, wall, i):
    """Speed of ball ``i`` away from a wall, m/s."""
    return across(wall, load(s.w, at.VX + i), load(s.w, at.VY + i))


@kernel
def half_away(s, wall, i):
    """Half the acceleration at which ball ``i`` parts from a wall, m/s^2; along a horn |v|^2 / 2(r + rho) parts it too.

    The cloth's friction opposes slip or velocity: where that has nothing across a slanted wall, friction has nothing.
    """
    vx, vy = load(s.w, at.VX + i), load(s.w, at.VY + i)
    ux, uy = vx, vy
    if load_integer(s.k, at.MOTION + i) == at.SLIDING:
        radius = load(s.p, at.P_RADIUS)
        ux, uy = vx - radius * load(s.w, at.WY + i), vy + radius * load(s.w, at.WX + i)
    along = vy * wall.nx - vx * wall.ny
    curved = 0.5 * wall.bend * along * along
    if is_slanted(wall) & (across(wall, ux, uy) == 0.0):
        return curved
    return load(s.w, at.HX + i) * wall.nx + load(s.w, at.HY + i) * wall.ny + curved


@small_kernel
def flies(s, i):
    """Whether ball ``i`` is in the air."""
    return load_integer(s.k, at.FLYING_BALLS) >> i & 1 != 0


@kernel
def speed_towards(s, i, number):
    """Speed of ball ``i`` towards a cushion or jaw that it touches, m/s."""
    wall = wall_at(s, number, i)
    if flies(s, i):
        return -opening_in_air(s, edge_of(s, wall, i), i)
    return -opening(s, wall, i)


@kernel
def touches_ball(s, i):
    """Whether ball ``i`` touches another ball."""
    near = 2.0 * load(s.p, at.P_RADIUS) + TOUCH
    x, y = load(s.w, at.X + i), load(s.w, at.Y + i)
    for j in range(at.LANES):
        if j != i and on_table(load_integer(s.k, at.MOTION + j)):
            here = path_of(s, j, load(s.w, at.SINCE + i))
            dx, dy = here.x - x, here.y - y
            if dx * dx + dy * dy <= near * near:
                return True
    return False


@small_kernel
def put_at(s, wall, i):
    """Put a ball that touches a wall exactly at its contact distance.

    A ball may start deep in a jaw by the tolerance of a placement. While it touches another ball it is put right by
    DEEPER at most, which is what it comes nearer between two contacts: all at once it would overlap that ball.
    """
    if wall.nx == 0.0:
        store(s.w, at.Y + i, -wall.ny * load(s.p, at.P_LINE_Y))
    elif wall.ny == 0.0:
        store(s.w, at.X + i, -wall.nx * load(s.p, at.P_LINE_X))
    else:
        missing = load(s.p, at.P_RHO) - wall.distance
        if missing > DEEPER and touches_ball(s, i):
            missing = DEEPER
        store(s.w, at.X + i, load(s.w, at.X + i) + missing * wall.nx)
        store(s.w, at.Y + i, load(s.w, at.Y + i) + missing * wall.ny)


@small_kernel
def factors(s, wall, v, w):
    """The Olympiad's law (eq. 20-21) at a wall of any direction."""
    back = -load(s.p, at.P_PERPENDICULAR) * (v[0] * wall.nx + v[1] * wall.ny)
    along = load(s.p, at.P_PARALLEL) * (v[1] * wall.nx - v[0] * wall.ny)
    keep = load(s.p, at.P_KEEP_SPIN)
    return (
        (back * wall.nx - along * wall.ny, back * wall.ny + along * wall.nx),
        (keep * w[0], keep * w[1], keep * w[2]),
    )


@small_kernel
def nose_normal(s, wall):
    """From the nose of a wall to the centre of a ball on the cloth, unit: it points down."""
    cosine = load(s.p, at.P_NOSE_COSINE)
    return cosine * wall.nx, cosine * wall.ny, load(s.p, at.P_NOSE_SINE)


@kernel
def by_law(s, wall, v, w):
    """Velocity and spin after a collision with a wall, by the table's cushion law."""
    law = load(s.p, at.P_CUSHION_LAW)
    if law == at.FACTORS:
        return factors(s, wall, v, w)
    radius, e, mu = load(s.p, at.P_RADIUS), load(s.p, at.P_E_CUSHION), load(s.p, at.P_MU_CUSHION)
    normal = nose_normal(s, wall)
    if law == at.HAN:
        return han(radius, v, w, normal, e, mu)
    return mathavan(radius, v, w, normal, e, mu, load(s.p, at.P_MU_SLIDE))


@small_kernel
def thrown(s, wall, v, w):
    """Vertical speed that ``han`` leaves a ball on the cloth: pressed down it comes up by ``e_pressed``."""
    radius, e, mu = load(s.p, at.P_RADIUS), load(s.p, at.P_E_CUSHION), load(s.p, at.P_MU_CUSHION)
    (_, _, vz), _ = impact(radius, (v[0], v[1], 0.0), w, nose_normal(s, wall), e, mu)
    return pressed_up(s, -vz) if vz < 0.0 else vz


@apart(None, RealWorkspace, int, int)
@kernel
def rebound(s, i, number):
    """A collision with a cushion or jaw, by the table's law; in the air by the impact law."""
    wall = wall_at(s, number, i)
    if flies(s, i):
        rebound_in_air(s, edge_of(s, wall, i), i)
        return
    put_at(s, wall, i)
    v = load(s.w, at.VX + i), load(s.w, at.VY + i)
    w = load(s.w, at.WX + i), load(s.w, at.WY + i), load(s.w, at.WZ + i)
    if load(s.p, at.P_FLIGHT) != 0.0 and load(s.p, at.P_CUSHION_LAW) == at.HAN:
        store(s.w, at.VZ + i, thrown(s, wall, v, w))
    v, w = by_law(s, wall, v, w)
    store(s.w, at.VX + i, v[0])
    store(s.w, at.VY + i, v[1])
    store(s.w, at.WX + i, w[0])
    store(s.w, at.WY + i, w[1])
    store(s.w, at.WZ + i, w[2])


@small_kernel
def take_across(s, x_row, i, nx, ny):
    """Take the component along (nx, ny) from a vector of ball ``i``: exactly, along an axis."""
    if ny == 0.0:
        store(s.w, x_row + i, 0.0)
    elif nx == 0.0:
        store(s.w, x_row + at.LANES + i, 0.0)
    else:
        x, y = load(s.w, x_row + i), load(s.w, x_row + at.LANES + i)
        taken = x * nx + y * ny
        store(s.w, x_row + i, x - taken * nx)
        store(s.w, x_row + at.LANES + i, y - taken * ny)


@kernel
def stop(s, i, number):
    """An approach that is rounding: no velocity across the wall; the spin is kept, for it may carry the ball off."""
    wall = wall_at(s, number, i)
    if flies(s, i):
        open_at(s, edge_of(s, wall, i), i, 0.0)
        return
    put_at(s, wall, i)
    take_across(s, at.VX, i, wall.nx, wall.ny)


@kernel
def hold(s, i, number):
    """A soft touch: no velocity across the wall, no spin about its direction; nothing else changes."""
    wall = wall_at(s, number, i)
    if flies(s, i):
        hold_in_air(s, edge_of(s, wall, i), wall, i)
        return
    put_at(s, wall, i)
    take_across(s, at.VX, i, wall.nx, wall.ny)
    take_across(s, at.WX, i, -wall.ny, wall.nx)


@kernel
def returns(s, i, number):
    """Whether ball ``i``'s own acceleration brings it back to a cushion or jaw it touches within the rest time."""
    wall = wall_at(s, number, i)
    if flies(s, i):
        return returns_in_air(s, edge_of(s, wall, i), wall, i)
    half = -half_away(s, wall, i)
    return half > 0.0 and opening(s, wall, i) < half * load(s.p, at.P_REST_TIME)


@small_kernel
def cushion_of(number):
    """The cushion that a jaw ends, or the cushion itself."""
    if number < at.FIRST_JAW:
        return number
    jaw = number - at.FIRST_JAW
    sign_x, sign_y = signs_of(jaw >> 1)
    if is_corner(jaw >> 1) and jaw == end_jaw(jaw >> 1):
        return at.NORTH if sign_y > 0.0 else at.SOUTH
    return at.EAST if sign_x > 0.0 else at.WEST


@small_kernel
def is_same(_s, one, other):
    """Whether two cushions or jaws are of one cushion."""
    return cushion_of(one) == cushion_of(other)


@kernel
def leaves(s, i, number):
    """Whether a ball that has touched the cushion of ``number`` ever since is leaving it, or touches it no more."""
    here = touched(s, i)
    if here == at.NO_CUSHION or cushion_of(here) != cushion_of(number):
        return True
    wall = wall_at(s, here, i)
    if flies(s, i):
        return opening_in_air(s, edge_of(s, wall, i), i) > 0.0
    speed = opening(s, wall, i)
    return speed > 0.0 or (speed == 0.0 and half_away(s, wall, i) > 0.0)


@small_kernel
def report(s, i, number, time):
    """Record a collision with a cushion or a jaw; its ordinal."""
    if number < at.FIRST_JAW:
        return record(s, time, plain(at.RAIL_COLLISION), i, number)
    return record(s, time, plain(at.JAW_COLLISION), i, number - at.FIRST_JAW)
