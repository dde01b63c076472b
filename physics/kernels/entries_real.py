"""``entries`` for tables with jaws, compiled when the first such table asks."""

from numba import types

from physics.kernels import layout as at
from physics.kernels import tasks
from physics.kernels.apart import load_apart
from physics.kernels.compiling import plain
from physics.kernels.detect.contact import contact_time
from physics.kernels.detect.edges_in_air import meets_ring
from physics.kernels.entry import COUNTERS, FACTS, FLOAT, INTEGER, NONE, POCKETS, READ, WRITTEN, entry
from physics.kernels.path import RingPath, SpacePath
from physics.kernels.workspace import RealWorkspace, bare_real_workspace, real_workspace

load_apart(RealWorkspace)


@entry(NONE, READ, WRITTEN, READ, READ, WRITTEN, POCKETS, FACTS, WRITTEN, COUNTERS)
def simulate_rows(p, work, states, shots, final, pockets, facts, trace, counters):
    """See ``entries``."""
    s = real_workspace(p, work, plain(0), trace)
    tasks.simulate_rows(s, states, shots, final, pockets, facts, trace.shape[1] // at.REAL_TRACE_WIDTH, counters)


@entry(NONE, READ, WRITTEN, READ, READ, READ, WRITTEN)
def states_at(p, work, states, trace, times, out):
    """See ``entries``."""
    tasks.states_at(bare_real_workspace(p, work), states, trace, times, out)


@entry(types.UniTuple(INTEGER, 2), READ, WRITTEN, READ, READ)
def check_shot(p, work, positions, shot):
    """See ``entries``."""
    return tasks.check_shot(bare_real_workspace(p, work), positions, shot)


@entry(FLOAT, READ, WRITTEN, READ, FLOAT, FLOAT, FLOAT)
def elevation_needed(p, work, positions, phi, a, b):
    """See ``entries``."""
    return tasks.elevation_needed(bare_real_workspace(p, work), positions, phi, a, b)


@entry(FLOAT, READ, FLOAT, FLOAT)
def time_of_contact_in_space(path, t_max, distance):
    """``entries.time_of_contact`` on a relative path (1, 9) of x y z vx vy vz hx hy hz."""
    x, y, z, vx, vy, vz = path[0, 0], path[0, 1], path[0, 2], path[0, 3], path[0, 4], path[0, 5]
    return contact_time(SpacePath(x, y, z, vx, vy, vz, path[0, 6], path[0, 7], path[0, 8]), t_max, distance)


@entry(FLOAT, READ, FLOAT, FLOAT)
def time_of_ring_contact(path, t_max, radius):
    """Earliest contact in [0, t_max] with a ring, infinity if none; (1, 8) of x y z vx vy vz hz and its radius."""
    x, y, z, vx, vy, vz = path[0, 0], path[0, 1], path[0, 2], path[0, 3], path[0, 4], path[0, 5]
    return meets_ring(radius, RingPath(x, y, z, vx, vy, vz, path[0, 6], path[0, 7]), t_max, t_max)


@entry(types.UniTuple(INTEGER, 3), READ, WRITTEN, READ, FLOAT, FLOAT)
def first_bad_row(p, work, positions, least_squared, slack):
    """See ``entries``."""
    return tasks.first_bad_row(bare_real_workspace(p, work), positions, least_squared, slack)
