"""``entries`` for tables with jaws, compiled when the first such table asks."""

from numba import types

from physics.kernels import layout as at
from physics.kernels import tasks
from physics.kernels.compiling import row
from physics.kernels.entry import COUNTERS, FACTS, FLOAT, INTEGER, NONE, POCKETS, READ, WRITTEN, entry
from physics.kernels.workspace import bare_real_workspace, real_workspace


@entry(NONE, READ, WRITTEN, READ, READ, WRITTEN, POCKETS, FACTS, WRITTEN, COUNTERS)
def simulate_rows(p, work, states, shots, final, pockets, facts, trace, counters):
    """See ``entries``."""
    rows = trace.shape[1] // at.TRACE_WIDTH
    for n in range(final.shape[0]):
        s = real_workspace(p, work, row(facts, n), trace)
        tasks.simulate_row(s, n, states, shots, final, pockets, facts, rows, counters)


@entry(NONE, READ, WRITTEN, READ, READ, FLOAT, WRITTEN)
def state_at(p, work, states, trace, time, out):
    """See ``entries``."""
    tasks.state_at(bare_real_workspace(p, work), states, trace, time, out)


@entry(types.UniTuple(INTEGER, 2), READ, WRITTEN, READ, READ)
def check_shot(p, work, positions, shot):
    """See ``entries``."""
    return tasks.check_shot(bare_real_workspace(p, work), positions, shot)


@entry(FLOAT, READ, WRITTEN, READ, FLOAT, FLOAT, FLOAT)
def elevation_needed(p, work, positions, phi, a, b):
    """See ``entries``."""
    return tasks.elevation_needed(bare_real_workspace(p, work), positions, phi, a, b)


@entry(types.UniTuple(INTEGER, 3), READ, WRITTEN, READ, FLOAT, FLOAT)
def first_bad_row(p, work, positions, least_squared, slack):
    """See ``entries``."""
    return tasks.first_bad_row(bare_real_workspace(p, work), positions, least_squared, slack)
