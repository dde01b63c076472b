"""One shot: ``simulate`` and ``resume``."""

import numpy as np
from numpy.typing import NDArray

from physics.constants import EVENT_LIMIT, N_BALLS, PLACEMENT_TOLERANCE
from physics.engine import kernels, workspace
from physics.errors import InvalidShot, InvalidState
from physics.facts import FACTS_WORDS
from physics.kernels import layout as at
from physics.kernels.layout import F_EVENTS, N_COUNTERS, SHOT_WIDTH
from physics.parameters import parameters
from physics.result import Floats, Result
from physics.shot import Shot
from physics.state import TableState
from physics.table import Table
from physics.trajectory import Snapshot

TRACE_ROWS = 192
"""Events a trace has room for at first; a shot with more is simulated again with room for all."""

NO_SHOT: Floats = np.zeros((1, SHOT_WIDTH))
NO_TRACE: Floats = np.zeros((1, 0))
NO_COUNTERS: NDArray[np.int64] = np.zeros((0, N_COUNTERS), np.int64)


def simulate(table: Table, state: TableState, shot: Shot, trace: bool = True, event_limit: int = EVENT_LIMIT) -> Result:
    """Play one shot and follow every ball until all are at rest.

    The event-based method of Leckie & Greenspan (2005): from one event to the next along closed forms. The same bits
    on every machine, with and without ``trace``, alone or in a batch. A shot that cannot be played is a result
    too: its ``status`` says why, and nothing has moved.

    Args:
        table: the table; state: the balls at rest on it; shot: the stroke.
        trace: whether to keep the events; without them there are no ``events`` and no ``at(t)``.
        event_limit: at the first instant by which there are so many events, from 1 to ``EVENT_LIMIT``, every ball is
            stopped where it is: ``Status.EVENT_LIMIT``. The events of that instant are all told.

    Raises:
        InvalidState: a ball lies outside the cushion lines or in a mouth of this table.
        InvalidShot: ``shot`` is not a ``Shot``, or its speed or elevation is out of the table's range.
        ValueError: ``event_limit`` is out of range.
    """
    if not isinstance(shot, Shot):
        raise InvalidShot("shot", shot, "must be a physics.Shot")
    shot.refuse_beyond(table)
    stroke = np.array((shot.v, shot.phi, shot.theta, shot.a, shot.b)).reshape(1, SHOT_WIDTH)
    return _run(table, checked_positions(table, state), stroke, trace, event_limit)


def resume(table: Table, snapshot: Snapshot, trace: bool = True, event_limit: int = EVENT_LIMIT) -> Result:
    """Go on from a snapshot, its time counting as 0. There is no cue strike, and ``facts`` count from here.

    ``event_limit`` is as for ``simulate``.

    Raises:
        InvalidState: the snapshot holds what cannot be: see ``Snapshot.refuse_impossible``.
        ValueError: ``event_limit`` is out of range.
    """
    if not isinstance(snapshot, Snapshot):
        raise InvalidState("snapshot", snapshot, "must be a physics.Snapshot")
    snapshot.refuse_impossible(table)
    return _run(table, snapshot.to_states(table), NO_SHOT, trace, event_limit)


def _run(table: Table, states: Floats, stroke: Floats, trace: bool, event_limit: int) -> Result:
    """One row through the kernel; a trace that turns out too short is written again, with room for all."""
    final, facts = np.empty((1, 2 * N_BALLS)), np.empty((1, FACTS_WORDS), np.int32)
    outputs = final, np.empty((1, N_BALLS), np.int8), facts
    entry, row, work = kernels(table.has_jaws).simulate_rows, parameters(table, event_limit), workspace()
    width = at.REAL_TRACE_WIDTH if table.has_jaws else at.TRACE_WIDTH
    rows = TRACE_ROWS if trace else 0
    events = np.empty((1, rows * width)) if trace else NO_TRACE
    entry(row, work, states, stroke, *outputs, events, NO_COUNTERS)
    n_events = int(facts[0, F_EVENTS])
    if trace and n_events > rows:
        events = np.empty((1, n_events * width))
        entry(row, work, states, stroke, *outputs, events, NO_COUNTERS)
    if trace:  # cut where it lies: a copy would cost more than the call
        events.resize((n_events, width), refcheck=False)
    return Result(table, states, final, facts, events if trace else None, n_events)


def checked_positions(table: Table, state: TableState) -> Floats:
    """(1, 32) positions of a state whose balls all lie inside this table's cushion lines and outside its mouths."""
    if not isinstance(state, TableState):
        raise InvalidState("state", state, "must be a physics.TableState")
    flat = state.positions.reshape(1, -1)
    if not state.is_known_on(table):
        bad = (
            kernels(table.has_jaws).first_bad_row(parameters(table), workspace(), flat, 0.0, PLACEMENT_TOLERANCE)[0]
            >= 0
        )
        state.valid_on(table, known=not bad)  # which has the words
    return flat
