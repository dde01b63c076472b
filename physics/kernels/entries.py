"""Entry points: what the Python layer calls. Arrays in, arrays out; compiled once and cached.

Every array is C-contiguous and two-dimensional, one shot a row: ``p`` (1, P_SIZE) float64; ``positions`` (n, 32) or
(1, 32) for all; ``states`` the same or (n, 128); ``shots`` (n, SHOT_WIDTH); ``facts`` (n, FACTS_WIDTH) int32, a view of
the structured array; ``trace`` (1, rows * TRACE_WIDTH).

``work`` (1, W_SIZE + K_SIZE) float64 is the memory a shot is worked out in. The caller holds it: an array made in here
would be released after its last use by name, while kernels still address it.
"""

from numba import types

from physics.kernels import layout as at
from physics.kernels import tasks
from physics.kernels.apart import load_apart
from physics.kernels.compiling import plain
from physics.kernels.detect.contact import contact_time
from physics.kernels.entry import COUNTERS, FACTS, FLOAT, INTEGER, NONE, POCKETS, READ, WRITTEN, entry
from physics.kernels.path import Path
from physics.kernels.workspace import Workspace, bare_workspace, workspace

load_apart(Workspace)


@entry(NONE, READ, WRITTEN, READ, READ, WRITTEN, POCKETS, FACTS, WRITTEN, COUNTERS)
def simulate_rows(p, work, states, shots, final, pockets, facts, trace, counters):
    """Simulate n shots.

    ``states``: positions at rest, of width 32, each struck by its shot; or balls in motion, of width 128, which go on
    (``shots`` is not read then). One row is for all. ``final`` (n, 32), ``pockets`` (n, 16) and ``facts`` are filled;
    ``trace``: events of one shot, as many as it has room for. ``counters``: (n, N_COUNTERS) int64, filled with the work
    done (predictions, pairs past the filter, contacts solved, boundary looks), or of no rows.
    """
    s = workspace(p, work, plain(0), trace)
    tasks.simulate_rows(s, states, shots, final, pockets, facts, trace.shape[1] // at.TRACE_WIDTH, counters)


@entry(NONE, READ, WRITTEN, READ, READ, READ, WRITTEN)
def states_at(p, work, states, trace, times, out):
    """States of all balls at ascending ``times`` (1, n), from the start's and the trace; (n, 128), from the centre."""
    tasks.states_at(bare_workspace(p, work), states, trace, times, out)


@entry(types.UniTuple(INTEGER, 2), READ, WRITTEN, READ, READ)
def check_shot(p, work, positions, shot):
    """(status, obstacle) of a shot: AT_REST and NOBODY when it can be played."""
    return tasks.check_shot(bare_workspace(p, work), positions, shot)


@entry(FLOAT, READ, WRITTEN, READ, FLOAT, FLOAT, FLOAT)
def elevation_needed(p, work, positions, phi, a, b):
    """Smallest free elevation in deg, NaN if none; a and b in mm, on the ball."""
    return tasks.elevation_needed(bare_workspace(p, work), positions, phi, a, b)


@entry(FLOAT, READ, FLOAT, FLOAT)
def time_of_contact(path, t_max, distance):
    """Earliest contact in [0, t_max] on a relative path (1, 6) of x y vx vy hx hy, NaN if none: the loop's solver."""
    relative = Path(path[0, 0], path[0, 1], path[0, 2], path[0, 3], path[0, 4], path[0, 5])
    return contact_time(relative, t_max, distance)


@entry(types.UniTuple(INTEGER, 3), READ, WRITTEN, READ, FLOAT, FLOAT)
def first_bad_row(p, work, positions, least_squared, slack):
    """(row, ball, other) of the first state with a bad place or an overlap (then ``other`` >= 0); (-1, -1, -1)."""
    return tasks.first_bad_row(bare_workspace(p, work), positions, least_squared, slack)
