"""What touches what at an instant: the geometry the contact rule works on."""

from physics.kernels import layout as at
from physics.kernels.advance import advance
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, small_kernel, store, store_integer
from physics.kernels.path import along
from physics.kernels.recording import note_crossing
from physics.kernels.resolve.ball_ball import Touch, touch_of
from physics.kernels.resolve.vertical import plus_square
from physics.kernels.tolerances import TOUCH
from physics.kernels.workspace import by_table


@small_kernel
def above_cloth(_s, _i, _dt):
    """See ``height_after``."""
    return 0.0


@small_kernel
def above_anything(s, i, dt):
    """See ``height_after``."""
    return along(load(s.w, at.Z + i), load(s.w, at.VZ + i), load(s.w, at.HZ + i), dt)


height_after = by_table(above_cloth, above_anything)
"""``height_after(s, i, dt)``: height of ball ``i`` after ``dt``, m; 0 on the cloth: it adds nothing to a distance."""


@kernel
def neighbours(s, i, time):
    """Bit set of the balls that touch ball ``i``, which is anchored at ``time``."""
    near = 2.0 * load(s.p, at.P_RADIUS) + TOUCH
    limit = near * near
    x = load(s.w, at.X + i)
    y = load(s.w, at.Y + i)
    z = height_after(s, i, 0.0)
    found = 0
    for j in range(at.LANES):
        dt = time - load(s.w, at.SINCE + j)
        dx = along(load(s.w, at.X + j), load(s.w, at.VX + j), load(s.w, at.HX + j), dt) - x
        dy = along(load(s.w, at.Y + j), load(s.w, at.VY + j), load(s.w, at.HY + j), dt) - y
        dz = height_after(s, j, dt) - z
        found |= int(plus_square(s, dx * dx + dy * dy, dz) <= limit) << j
    return found & ~(1 << i)


@kernel
def neighbours_of_two(s, i, j, time):
    """``neighbours`` of two balls anchored at ``time``, in one pass: (of i, of j)."""
    near = 2.0 * load(s.p, at.P_RADIUS) + TOUCH
    limit = near * near
    x_i, y_i, x_j, y_j = load(s.w, at.X + i), load(s.w, at.Y + i), load(s.w, at.X + j), load(s.w, at.Y + j)
    z_i, z_j = height_after(s, i, 0.0), height_after(s, j, 0.0)
    found = 0
    for n in range(at.LANES):
        dt = time - load(s.w, at.SINCE + n)
        x = along(load(s.w, at.X + n), load(s.w, at.VX + n), load(s.w, at.HX + n), dt)
        y = along(load(s.w, at.Y + n), load(s.w, at.VY + n), load(s.w, at.HY + n), dt)
        z = height_after(s, n, dt)
        at_i = plus_square(s, (x - x_i) * (x - x_i) + (y - y_i) * (y - y_i), z - z_i) <= limit
        at_j = plus_square(s, (x - x_j) * (x - x_j) + (y - y_j) * (y - y_j), z - z_j) <= limit
        found |= int(at_i) << n | int(at_j) << (n + at.LANES)
    return found & 0xFFFF & ~(1 << i), found >> at.LANES & ~(1 << j)


@small_kernel
def bring(s, i, time):
    """Advance ball ``i`` to ``time``, noting on the way whether the cue ball crosses the head string."""
    if i == at.CUE_BALL:
        note_crossing(s, time)
    advance(s, i, time)


@kernel
def gather(s, seeds, time):
    """Bit set of the cluster of balls linked by touching to ``seeds``, all brought to ``time``.

    Lists its touching pairs, lower ball first, in ascending order.
    """
    members = seeds
    waiting = seeds
    links = 0
    while waiting != 0:
        rest = waiting
        while rest != 0:
            i = lowest_bit(rest)
            rest &= rest - 1
            waiting &= ~(1 << i)
            bring(s, i, time)
            found = neighbours(s, i, time)
            links |= found
            waiting |= found & ~members
            members |= found
    store_integer(s.k, at.N_PAIRS, 0)
    if links != 0:
        list_pairs(s, members, time)
    return members


@small_kernel
def no_rise(_s, _n, _rise):
    """See ``store_rise``."""


@small_kernel
def keep_rise(s, n, rise):
    """See ``store_rise``."""
    store(s.w, at.NORMAL_Z + n, rise)


@small_kernel
def level(_s, _n):
    """See ``listed_rise``."""
    return 0.0


@small_kernel
def kept_rise(s, n):
    """See ``listed_rise``."""
    return load(s.w, at.NORMAL_Z + n)


store_rise = by_table(no_rise, keep_rise)
"""``store_rise(s, n, rise)``: note the vertical component of the normal of the touching pair ``n``."""

listed_rise = by_table(level, kept_rise)
"""``listed_rise(s, n)``: that component."""


@kernel
def list_pairs(s, members, time):
    """List the touching pairs among ``members`` with their normals: where balls are does not change at an instant."""
    count = 0
    rest = members
    while rest != 0:
        i = lowest_bit(rest)
        rest &= rest - 1
        found = neighbours(s, i, time)
        for j in range(i + 1, at.LANES):
            if found >> j & 1:
                store_integer(s.k, at.PAIRS + count, i * at.LANES + j)
                touch = touch_of(s, i, j)
                store(s.w, at.NORMAL_X + count, touch.nx)
                store(s.w, at.NORMAL_Y + count, touch.ny)
                store_rise(s, count, touch.nz)
                count += 1
    store_integer(s.k, at.N_PAIRS, count)


@small_kernel
def pair(s, n):
    """Balls (i, j) of the touching pair ``n``."""
    both = load_integer(s.k, at.PAIRS + n)
    return both >> 4, both & 15


@small_kernel
def listed(s, n):
    """The touching pair ``n``."""
    i, j = pair(s, n)
    return Touch(i, j, load(s.w, at.NORMAL_X + n), load(s.w, at.NORMAL_Y + n), listed_rise(s, n))
