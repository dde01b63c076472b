"""Two balls alone (docs/physics.md, eq. 12-19, 37): the consistent law, on cloth and in the air; the historical."""

import math
from typing import NamedTuple

from physics.kernels import layout as at
from physics.kernels.compiling import kernel, load, load_integer, plain, small_kernel, store
from physics.kernels.motion import moves
from physics.kernels.resolve.flight import spin_of, velocity_of
from physics.kernels.resolve.pair_laws import friction, length, rubbed, slip_in_space
from physics.kernels.workspace import by_table

HISTORICAL_FRICTION = 0.01
"""The historical engine's factor k |B| / v_n."""

HISTORICAL_RADIUS = 1.000575
"""The historical engine's factor on R in the spin it transfers."""


class Touch(NamedTuple):
    """Two touching balls.

    Attributes:
        i, j: their numbers. nx, ny, nz: unit normal n from i to j; nz is 0 between balls on the cloth.
    """

    i: int
    j: int
    nx: float
    ny: float
    nz: float


@small_kernel
def add(memory, index, value):
    """Add ``value`` to a float64 number."""
    store(memory, index, load(memory, index) + value)


@small_kernel
def touch_on_cloth(s, i, j):
    """See ``touch_of``."""
    dx = load(s.w, at.X + j) - load(s.w, at.X + i)
    dy = load(s.w, at.Y + j) - load(s.w, at.Y + i)
    distance = math.sqrt(dx * dx + dy * dy)
    return Touch(i, j, dx / distance, dy / distance, 0.0)


@small_kernel
def touch_in_space(s, i, j):
    """See ``touch_of``; on the cloth with the same bits."""
    dx = load(s.w, at.X + j) - load(s.w, at.X + i)
    dy = load(s.w, at.Y + j) - load(s.w, at.Y + i)
    dz = load(s.w, at.Z + j) - load(s.w, at.Z + i)
    distance = math.sqrt((dx * dx + dy * dy) + dz * dz)
    return Touch(i, j, dx / distance, dy / distance, dz / distance)


touch_of = by_table(touch_on_cloth, touch_in_space)
"""``touch_of(s, i, j)``: two balls that touch, where they are."""


@small_kernel
def turned(touch):
    """The same two balls, the other one first."""
    return Touch(touch.j, touch.i, -touch.nx, -touch.ny, -touch.nz)


@small_kernel
def approach_on_cloth(s, touch):
    """See ``approach``."""
    i, j, nx, ny, _ = touch
    along_x = (load(s.w, at.VX + i) - load(s.w, at.VX + j)) * nx
    return along_x + (load(s.w, at.VY + i) - load(s.w, at.VY + j)) * ny


@small_kernel
def approach_in_space(s, touch):
    """See ``approach``."""
    upward = (load(s.w, at.VZ + touch.i) - load(s.w, at.VZ + touch.j)) * touch.nz
    return approach_on_cloth(s, touch) + upward


approach = by_table(approach_on_cloth, approach_in_space)
"""``approach(s, touch)``: normal speed at which two balls near each other, m/s: (v_i - v_j).n."""


@small_kernel
def part_on_cloth(s, touch, change, shift):
    """See ``part``."""
    i, j, nx, ny, _ = touch
    add(s.w, shift + at.VX + i, -change * nx)
    add(s.w, shift + at.VY + i, -change * ny)
    add(s.w, shift + at.VX + j, change * nx)
    add(s.w, shift + at.VY + j, change * ny)


@small_kernel
def part_in_space(s, touch, change, shift):
    """See ``part``."""
    part_on_cloth(s, touch, change, shift)
    if touch.nz != 0.0:
        add(s.w, shift + at.VZ + touch.i, -change * touch.nz)
        add(s.w, shift + at.VZ + touch.j, change * touch.nz)


part = by_table(part_on_cloth, part_in_space)
"""``part(s, touch, change, shift)``: push two balls apart along the normal, each by ``change`` (m/s): v_i -= change n,
v_j += change n (eq. 13). Added to the rows ``shift`` behind the velocities and spins: 0 for these themselves."""


@small_kernel
def constant_friction(s, _slip):
    """Coefficient of friction between balls, the table's."""
    return load(s.p, at.P_MU_BALL)


@small_kernel
def friction_by_law(s, slip):
    """Coefficient of friction between balls that slip at ``slip`` m/s, by the table's law."""
    return friction(slip) if load(s.p, at.P_BALL_LAW) == at.ALCIATORE else load(s.p, at.P_MU_BALL)


ball_friction = by_table(constant_friction, friction_by_law)


@small_kernel
def rub_on_cloth(s, touch, normal_change, share, shift):
    """Friction of one contact whose normal impulse changes each ball's velocity by ``normal_change`` (m/s).

    Impulse against the slip v1 - v2 - R n x (w1 + w2), of size min(mu J_n, m |slip| / (7 share)) over m; both
    spins change in the same sense, the vertical velocity is absorbed (eq. 14-17). Changes go to the rows ``shift``
    behind the velocities and spins.
    """
    i, j, nx, ny, _ = touch
    radius = load(s.p, at.P_RADIUS)
    spin_x = load(s.w, at.WX + i) + load(s.w, at.WX + j)
    spin_y = load(s.w, at.WY + i) + load(s.w, at.WY + j)
    spin_z = load(s.w, at.WZ + i) + load(s.w, at.WZ + j)
    # along t = k x n = (-ny, nx), and vertical; n x w = (ny wz, -nx wz, nx wy - ny wx)
    slip_t = (load(s.w, at.VY + i) - load(s.w, at.VY + j)) * nx - (load(s.w, at.VX + i) - load(s.w, at.VX + j)) * ny
    slip_t = slip_t + radius * spin_z
    slip_z = radius * (ny * spin_x - nx * spin_y)
    slip = math.sqrt(slip_t * slip_t + slip_z * slip_z)
    if slip == 0.0:
        return
    # An impulse J_t changes the slip by J_t / m for each ball's speed and by R (R J_t) / I = 5 J_t / 2m for each
    # ball's spin, 7 J_t / m together: m |slip| / 7 ends it.
    size = min(ball_friction(s, slip) * normal_change, slip / (7.0 * share))
    part_of_slip = size / slip
    push_t = part_of_slip * slip_t
    push_z = part_of_slip * slip_z
    add(s.w, shift + at.VX + i, push_t * ny)
    add(s.w, shift + at.VY + i, -push_t * nx)
    add(s.w, shift + at.VX + j, -push_t * ny)
    add(s.w, shift + at.VY + j, push_t * nx)
    # the same turn for both: -5/(2R) n x s with s = push_t t + push_z k, n x t = k, n x k = (ny, -nx)
    turn = -2.5 * load(s.p, at.P_PER_RADIUS)
    for ball in (i, j):
        add(s.w, shift + at.WX + ball, turn * push_z * ny)
        add(s.w, shift + at.WY + ball, -turn * push_z * nx)
        add(s.w, shift + at.WZ + ball, turn * push_t)


@kernel
def rub_in_air(s, touch, normal_change, share, shift):
    """The same where one of the balls is off the cloth: the vertical velocity is kept (eq. 37)."""
    i, j, nx, ny, nz = touch
    one = velocity_of(s, i), spin_of(s, i)
    two = velocity_of(s, j), spin_of(s, j)
    radius = load(s.p, at.P_RADIUS)
    slip = slip_in_space(radius, (nx, ny, nz), one, two)
    size = length(slip)
    mu = ball_friction(s, size)
    push, turn = rubbed(radius, (nx, ny, nz), slip, size, mu * normal_change, share)
    add(s.w, shift + at.VX + i, push[0])
    add(s.w, shift + at.VY + i, push[1])
    add(s.w, shift + at.VZ + i, push[2])
    add(s.w, shift + at.VX + j, -push[0])
    add(s.w, shift + at.VY + j, -push[1])
    add(s.w, shift + at.VZ + j, -push[2])
    for ball in (i, j):
        add(s.w, shift + at.WX + ball, turn[0])
        add(s.w, shift + at.WY + ball, turn[1])
        add(s.w, shift + at.WZ + ball, turn[2])


@small_kernel
def is_in_air(s, touch):
    """Whether one of two touching balls is off the cloth."""
    return (load(s.w, at.Z + touch.i) > 0.0) | (load(s.w, at.Z + touch.j) > 0.0)


@kernel
def rub_anywhere(s, touch, normal_change, share, shift):
    """See ``rub``."""
    if is_in_air(s, touch):
        rub_in_air(s, touch, normal_change, share, shift)
    else:
        rub_on_cloth(s, touch, normal_change, share, shift)


rub = by_table(rub_on_cloth, rub_anywhere)
"""``rub(s, touch, normal_change, share, shift)``: friction of one contact. See ``rub_on_cloth``."""


@small_kernel
def collide(s, touch, closing):
    """Two balls of equal mass approaching at ``closing`` (m/s): J_n = (1 + e)/2 m v_n (eq. 12), then friction."""
    change = 0.5 * (1.0 + load(s.p, at.P_E_BALL)) * closing
    part(s, touch, change, 0)
    rub(s, touch, change, 1.0, 0)


@kernel
def collide_historically(s, touch, j_rests):
    """The law of FastFiz 0.2, faults included; ball i moves. Eq. 18-19.

    ``j_rests`` (0 or 1): ball j stays where it is, whether or not it spins there; then spin is transferred with
    opposite signs, else both are set to natural roll.
    """
    i, j, nx, ny, _ = touch
    radius = load(s.p, at.P_RADIUS)
    tx, ty = -ny, nx
    v1x, v1y, v2x, v2y = load(s.w, at.VX + i), load(s.w, at.VY + i), load(s.w, at.VX + j), load(s.w, at.VY + j)
    spin_x = load(s.w, at.WX + i) + load(s.w, at.WX + j)
    spin_y = load(s.w, at.WY + i) + load(s.w, at.WY + j)
    spin_z = load(s.w, at.WZ + i) + load(s.w, at.WZ + j)
    # B = v1 - v2 - R n x (w1 + w2), its normal part included
    bx = v1x - v2x - radius * ny * spin_z
    by = v1y - v2y + radius * nx * spin_z
    bz = -radius * (nx * spin_y - ny * spin_x)
    size = math.sqrt(bx * bx + by * by + bz * bz)
    v1n = v1x * nx + v1y * ny
    v2n = v2x * nx + v2y * ny
    k = HISTORICAL_FRICTION * v1n / size if size > 0.0 else 0.0
    b_t = bx * tx + by * ty
    v1t = v1x * tx + v1y * ty - k * b_t
    v2t = v2x * tx + v2y * ty + k * b_t
    store(s.w, at.VX + i, v2n * nx + v1t * tx)
    store(s.w, at.VY + i, v2n * ny + v1t * ty)
    store(s.w, at.VX + j, v1n * nx + v2t * tx)
    store(s.w, at.VY + j, v1n * ny + v2t * ty)
    if j_rests != 0:
        # D = -(2.5 k / (1.000575 R)) n x B
        turn = -2.5 * k / (HISTORICAL_RADIUS * radius)
        turn_x = turn * ny * bz
        turn_y = -turn * nx * bz
        turn_z = turn * (nx * by - ny * bx)
        store(s.w, at.WX + j, load(s.w, at.WX + j) + turn_x)
        store(s.w, at.WY + j, load(s.w, at.WY + j) + turn_y)
        store(s.w, at.WZ + j, load(s.w, at.WZ + j) + turn_z)
        store(s.w, at.WX + i, load(s.w, at.WX + i) - turn_x)
        store(s.w, at.WY + i, load(s.w, at.WY + i) - turn_y)
        store(s.w, at.WZ + i, load(s.w, at.WZ + i) - turn_z)
    else:
        for ball in (i, j):
            store(s.w, at.WX + ball, -load(s.w, at.VY + ball) / radius)
            store(s.w, at.WY + ball, load(s.w, at.VX + ball) / radius)


@small_kernel
def is_historical(s, _touch):
    """Whether two balls collide by the historical law."""
    return load(s.p, at.P_HISTORICAL) != 0.0


@small_kernel
def is_fastfiz(s, touch):
    """The same on a table with jaws; in the air there is no such law."""
    return load(s.p, at.P_BALL_LAW) == at.FASTFIZ and not is_in_air(s, touch)


collides_historically = by_table(is_historical, is_fastfiz)


@small_kernel
def push_alone(s, touch, closing):
    """The collision of two balls that share it with no other, by the table's law."""
    if not collides_historically(s, touch):
        collide(s, touch, closing)
    elif moves(load_integer(s.k, at.MOTION + touch.i)):
        collide_historically(s, touch, int(not moves(load_integer(s.k, at.MOTION + touch.j))))
    else:
        collide_historically(s, turned(touch), plain(1))
