"""The memory of one shot, handed from kernel to kernel as one value.

Compiled, its fields are addresses; interpreted, array views. ``s`` everywhere: ``load(s.p, at.P_RADIUS)``.
"""

from typing import Any, NamedTuple

from physics.kernels import layout as at
from physics.kernels.compiling import integers_behind, plain, row, small_kernel


class Workspace(NamedTuple):
    """Where a shot is worked out. Places in each memory: ``physics.kernels.layout``.

    Attributes:
        p: parameters of the table, float64, only read.
        w: positions, velocities, times, float64. k: states, kinds, counters, int64.
        facts: what rules need to know, int32 and then float64.
        trace: rows of events, float64; room for ``at.TRACE_ROWS`` of them.
    """

    p: Any
    w: Any
    k: Any
    facts: Any
    trace: Any


@small_kernel
def workspace(p, memory, facts, trace):
    """The workspace of one shot from the arrays of an entry and the row of its facts."""
    w = row(memory, 0)
    return Workspace(row(p, 0), w, integers_behind(w, at.W_SIZE), facts, row(trace, 0))


@small_kernel
def bare_workspace(p, memory):
    """A workspace for what leaves neither facts nor a trace: nothing may be written there."""
    w = row(memory, 0)
    return Workspace(row(p, 0), w, integers_behind(w, at.W_SIZE), plain(0), plain(0))
