"""Two balls alone (docs/physics.md, eq. 12-19): the consistent law and the historical one."""

import math

from physics.kernels.compiling import kernel, load, small_kernel, store
from physics.kernels.layout import P_E_BALL, P_MU_BALL, P_PER_RADIUS, P_RADIUS, VX, VY, WX, WY, WZ, X, Y

HISTORICAL_FRICTION = 0.01
"""The historical engine's factor k |B| / v_n."""

HISTORICAL_RADIUS = 1.000575
"""The historical engine's factor on R in the spin it transfers."""


@small_kernel
def add(memory, index, value):
    """Add ``value`` to a float64 number."""
    store(memory, index, load(memory, index) + value)


@small_kernel
def normal(w, i, j):
    """Unit vector from ball i to ball j, and their distance in m."""
    dx = load(w, X + j) - load(w, X + i)
    dy = load(w, Y + j) - load(w, Y + i)
    distance = math.sqrt(dx * dx + dy * dy)
    return dx / distance, dy / distance, distance


@small_kernel
def approach(w, i, j, nx, ny):
    """Normal speed at which j and i near each other, m/s; (nx, ny) is the unit vector from i to j."""
    return (load(w, VX + i) - load(w, VX + j)) * nx + (load(w, VY + i) - load(w, VY + j)) * ny


@small_kernel
def rub(p, w, i, j, nx, ny, normal_change, share, shift):
    """Friction of one contact whose normal impulse changes each ball's velocity by ``normal_change`` (m/s).

    Impulse against the slip v1 - v2 - R n x (w1 + w2), of size min(mu J_n, m |slip| / (7 share)) over m; both
    spins change in the same sense, the vertical velocity is absorbed (eq. 15-17). Changes are added to the rows
    ``shift`` behind the velocities and spins: 0 for these themselves.
    """
    radius = load(p, P_RADIUS)
    spin_x = load(w, WX + i) + load(w, WX + j)
    spin_y = load(w, WY + i) + load(w, WY + j)
    spin_z = load(w, WZ + i) + load(w, WZ + j)
    # along t = k x n = (-ny, nx), and vertical; n x w = (ny wz, -nx wz, nx wy - ny wx)
    slip_t = (load(w, VY + i) - load(w, VY + j)) * nx - (load(w, VX + i) - load(w, VX + j)) * ny
    slip_t = slip_t + radius * spin_z
    slip_z = radius * (ny * spin_x - nx * spin_y)
    slip = math.sqrt(slip_t * slip_t + slip_z * slip_z)
    if slip == 0.0:
        return
    size = min(load(p, P_MU_BALL) * normal_change, slip / (7.0 * share))
    part_of_slip = size / slip
    push_t = part_of_slip * slip_t
    push_z = part_of_slip * slip_z
    add(w, shift + VX + i, push_t * ny)
    add(w, shift + VY + i, -push_t * nx)
    add(w, shift + VX + j, -push_t * ny)
    add(w, shift + VY + j, push_t * nx)
    # the same turn for both: -5/(2R) n x s with s = push_t t + push_z k
    turn = -2.5 * load(p, P_PER_RADIUS)
    for ball in (i, j):
        add(w, shift + WX + ball, turn * push_z * ny)
        add(w, shift + WY + ball, -turn * push_z * nx)
        add(w, shift + WZ + ball, turn * push_t)


@small_kernel
def part(w, i, j, nx, ny, change, shift):
    """Push i and j apart along the normal, each by ``change`` (m/s)."""
    add(w, shift + VX + i, -change * nx)
    add(w, shift + VY + i, -change * ny)
    add(w, shift + VX + j, change * nx)
    add(w, shift + VY + j, change * ny)


@small_kernel
def collide(p, w, i, j, nx, ny, closing):
    """Two balls of equal mass approaching at ``closing`` (m/s): normal impulse (1 + e)/2 m v_n, then friction."""
    change = 0.5 * (1.0 + load(p, P_E_BALL)) * closing
    part(w, i, j, nx, ny, change, 0)
    rub(p, w, i, j, nx, ny, change, 1.0, 0)


@kernel
def collide_historically(p, w, i, j, nx, ny, j_rests):
    """The law of FastFiz 0.2, faults included; ball i moves. Eq. 18-19.

    ``j_rests`` (0 or 1): ball j stays where it is, whether or not it spins there; then spin is transferred with
    opposite signs, else both are set to natural roll.
    """
    radius = load(p, P_RADIUS)
    tx, ty = -ny, nx
    v1x, v1y, v2x, v2y = load(w, VX + i), load(w, VY + i), load(w, VX + j), load(w, VY + j)
    spin_x = load(w, WX + i) + load(w, WX + j)
    spin_y = load(w, WY + i) + load(w, WY + j)
    spin_z = load(w, WZ + i) + load(w, WZ + j)
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
    store(w, VX + i, v2n * nx + v1t * tx)
    store(w, VY + i, v2n * ny + v1t * ty)
    store(w, VX + j, v1n * nx + v2t * tx)
    store(w, VY + j, v1n * ny + v2t * ty)
    if j_rests != 0:
        turn = -2.5 * k / (HISTORICAL_RADIUS * radius)
        turn_x = turn * ny * bz
        turn_y = -turn * nx * bz
        turn_z = turn * (nx * by - ny * bx)
        store(w, WX + j, load(w, WX + j) + turn_x)
        store(w, WY + j, load(w, WY + j) + turn_y)
        store(w, WZ + j, load(w, WZ + j) + turn_z)
        store(w, WX + i, load(w, WX + i) - turn_x)
        store(w, WY + i, load(w, WY + i) - turn_y)
        store(w, WZ + i, load(w, WZ + i) - turn_z)
    else:
        for ball in (i, j):
            store(w, WX + ball, -load(w, VY + ball) / radius)
            store(w, WY + ball, load(w, VX + ball) / radius)
