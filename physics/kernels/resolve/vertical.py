"""The vertical part of velocities in the contact rule: on old tables there is none, and nothing is compiled."""

from physics.kernels import layout as at
from physics.kernels.compiling import load, small_kernel, store
from physics.kernels.workspace import by_table


@small_kernel
def nothing(_s):
    """See ``clear_vertical_changes``."""


@small_kernel
def nothing_of(_s, _i, _scale):
    """See ``add_vertical_change``, ``scale_vertical``."""


@small_kernel
def none_of(_s, _i):
    """See ``vertical_change``, ``vertical_speed``."""
    return 0.0


@small_kernel
def clear_rows(s):
    """See ``clear_vertical_changes``."""
    for n in range(at.VZ_CHANGE, at.VZ_CHANGE + at.LANES):
        store(s.w, n, 0.0)


@small_kernel
def add_change(s, i, scale):
    """See ``add_vertical_change``."""
    store(s.w, at.VZ + i, load(s.w, at.VZ + i) + scale * load(s.w, at.VZ_CHANGE + i))


@small_kernel
def change_of(s, i):
    """See ``vertical_change``."""
    return load(s.w, at.VZ_CHANGE + i)


@small_kernel
def speed_of(s, i):
    """See ``vertical_speed``."""
    return load(s.w, at.VZ + i)


@small_kernel
def scale_speed(s, i, scale):
    """See ``scale_vertical``."""
    store(s.w, at.VZ + i, scale * load(s.w, at.VZ + i))


@small_kernel
def plane_alone(_s, squared, _z):
    """See ``plus_square``."""
    return squared


@small_kernel
def with_square(_s, squared, z):
    """See ``plus_square``."""
    return squared + z * z


plus_square = by_table(plane_alone, with_square)
"""``plus_square(s, squared, z)``: a square of a length with that of its vertical part."""

clear_vertical_changes = by_table(nothing, clear_rows)
"""``clear_vertical_changes(s)``: set those of a round to zero."""

add_vertical_change = by_table(nothing_of, add_change)
"""``add_vertical_change(s, i, scale)``: add that of a round, times ``scale``."""

vertical_change = by_table(none_of, change_of)
"""``vertical_change(s, i)``: that of a round, m/s."""

vertical_speed = by_table(none_of, speed_of)
"""``vertical_speed(s, i)``: m/s upwards."""

scale_vertical = by_table(nothing_of, scale_speed)
"""``scale_vertical(s, i, scale)``: multiply the vertical speed."""
