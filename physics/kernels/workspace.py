"""The memory of one shot, handed from kernel to kernel as one value.

Compiled, its fields are addresses; interpreted, array views. ``s`` everywhere: ``load(s.p, at.P_RADIUS)``.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

from numba.extending import overload

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


class RealWorkspace(NamedTuple):
    """The same on a table with jaws: by its type kernels are compiled apart, see ``by_table``."""

    p: Any
    w: Any
    k: Any
    facts: Any
    trace: Any


def by_table(straight: Callable[..., Any], with_jaws: Callable[..., Any]) -> Callable[..., Any]:
    """A kernel that is ``straight`` on tables with straight mouths and ``with_jaws`` on tables with jaws.

    Which of the two is decided when it is compiled, by the type of the workspace, its first argument: neither table's
    code holds anything of the other's.
    """

    def chosen(s: Any, *rest: Any) -> Any:
        return (with_jaws if isinstance(s, RealWorkspace) else straight)(s, *rest)

    @overload(chosen, jit_options={"error_model": "numpy", "forceinline": True}, strict=False)
    def choose(s: Any, *_rest: Any) -> Any:
        kernel = with_jaws if s.instance_class is RealWorkspace else straight
        return lambda s, *_rest: kernel(s, *_rest)

    return chosen


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


@small_kernel
def real_workspace(p, memory, facts, trace):
    """``workspace`` of a table with jaws."""
    w = row(memory, 0)
    return RealWorkspace(row(p, 0), w, integers_behind(w, at.W_SIZE), facts, row(trace, 0))


@small_kernel
def bare_real_workspace(p, memory):
    """``bare_workspace`` of a table with jaws."""
    w = row(memory, 0)
    return RealWorkspace(row(p, 0), w, integers_behind(w, at.W_SIZE), plain(0), plain(0))


@small_kernel
def _with_facts(s, facts):
    return Workspace(s.p, s.w, integers_behind(s.w, at.W_SIZE), facts, s.trace)


@small_kernel
def _real_with_facts(s, facts):
    return RealWorkspace(s.p, s.w, integers_behind(s.w, at.W_SIZE), facts, s.trace)


with_facts = by_table(_with_facts, _real_with_facts)
"""``with_facts(s, facts)``: the same workspace for another row of facts. A kernel apart gets bare addresses: from here
on the compiler sees again that ``k`` lies behind ``w``."""
