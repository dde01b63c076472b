"""One shot: ``simulate``, ``resume`` and their result."""

import math
from collections.abc import Iterator
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from physics.constants import N_BALLS
from physics.engine import kernels
from physics.errors import InvalidShot, InvalidState
from physics.facts import FACTS_DTYPE, Facts
from physics.parameters import parameters
from physics.shot import Shot
from physics.state import TableState
from physics.status import Status
from physics.table import Table
from physics.trajectory import Events, Snapshot, resting_states

TRACE_ROWS = 192
"""Events a trace has room for at first; a shot with more is simulated again with room for all."""

TRACE_WIDTH = 20


class Result:
    """What a shot did. Made by ``simulate`` and ``resume``.

    Attributes:
        table: the table it was played on.
        n_events: number of events, the cue strike included.
    """

    __slots__ = ("__dict__", "_facts", "_final", "_start", "_trace", "n_events", "table")

    def __init__(
        self,
        table: Table,
        start: NDArray[np.float64],
        final: NDArray[np.float64],
        facts: NDArray[np.void],
        trace: NDArray[np.float64] | None,
        n_events: int,
    ) -> None:
        self.table = table
        self.n_events = n_events
        self._start = start
        self._final = final
        self._facts = facts
        self._trace = trace

    @cached_property
    def final(self) -> TableState:
        """Where the balls lie afterwards: a legal start for the next shot."""
        return TableState.trusted(self._final.reshape(N_BALLS, 2))

    @property
    def duration(self) -> float:
        """Time until the last ball came to rest, s."""
        return float(self._facts["duration"][0])

    @property
    def status(self) -> Status:
        """How the shot ended."""
        return Status(int(self._facts["status"][0]))

    @cached_property
    def facts(self) -> Facts:
        """What rules need to know."""
        return Facts.from_record(self._facts[0])

    @cached_property
    def events(self) -> Events:
        """The events in order.

        Raises:
            ValueError: the shot was simulated with ``trace=False``.
        """
        return Events(self.table, self._rows())

    def at(self, t: float) -> Snapshot:
        """All balls at time ``t`` (s) in [0, duration]; at the time of an event, after it.

        Raises:
            ValueError: ``t`` is outside [0, duration], or there is no trace.
        """
        if not 0.0 <= t <= self.duration:
            raise ValueError(f"t = {t!r}: must be in [0, {self.duration}] s, the duration of the shot")
        rows = self._rows()
        out = np.empty((1, N_BALLS * 8))
        start = resting_states(self._start.reshape(N_BALLS, 2)) if self._start.size == 2 * N_BALLS else self._start
        kernels().state_at(parameters(self.table), start, rows.reshape(1, -1), len(rows), float(t), out)
        return Snapshot.from_states(self.table, t, out.reshape(N_BALLS, 8))

    def sample(self, dt: float) -> Iterator[Snapshot]:
        """Snapshots every ``dt`` seconds, the first at 0 and the last at the end.

        Raises:
            ValueError: ``dt`` is not a positive number.
        """
        if not (dt > 0.0 and math.isfinite(dt)):
            raise ValueError(f"dt = {dt!r}: must be a positive number of seconds")
        for n in range(int(self.duration / dt) + 1):
            yield self.at(min(n * dt, self.duration))
        if int(self.duration / dt) * dt < self.duration:
            yield self.at(self.duration)

    def _rows(self) -> NDArray[np.float64]:
        if self._trace is None:
            raise ValueError("there is no trace: the shot was simulated with trace=False")
        return self._trace

    def __repr__(self) -> str:
        return f"Result({self.status.name}, {self.n_events} events, {self.duration:.3f} s)"


def simulate(table: Table, state: TableState, shot: Shot, trace: bool = True) -> Result:
    """Play one shot and follow every ball until all are at rest.

    The event-based method of Leckie & Greenspan (2005): from one event to the next along closed forms. The same bits
    on every machine, with and without ``trace``, alone or in a batch. A shot that cannot be played is a result
    too: its ``status`` says why, and nothing has moved.

    Args:
        table: the table; state: the balls at rest on it; shot: the stroke.
        trace: whether to keep the events; without them there are no ``events`` and no ``at(t)``.

    Raises:
        InvalidState: a ball lies outside the cushion lines or in a mouth of this table.
        InvalidShot: ``shot`` is not a ``Shot``.
    """
    if not isinstance(shot, Shot):
        raise InvalidShot("shot", shot, "must be a physics.Shot")
    positions = checked_positions(table, state)
    stroke = np.array([[shot.v, shot.phi, shot.theta, shot.a, shot.b]])
    final = np.empty((1, 2 * N_BALLS))
    facts = np.empty(1, FACTS_DTYPE)
    views = facts.view(np.int32).reshape(1, -1), facts.view(np.float64).reshape(1, -1)
    entry, row = kernels().simulate_one, parameters(table)
    rows = TRACE_ROWS if trace else 0
    events = np.empty((1, rows * TRACE_WIDTH))
    n_events = entry(row, positions, stroke, final, *views, events, rows)
    if trace and n_events > rows:
        events = np.empty((1, n_events * TRACE_WIDTH))
        entry(row, positions, stroke, final, *views, events, n_events)
    return Result(table, positions, final, facts, _cut(events, n_events) if trace else None, n_events)


def resume(table: Table, snapshot: Snapshot, trace: bool = True) -> Result:
    """Go on from a snapshot, its time counting as 0. There is no cue strike; positions are those of the snapshot.

    Raises:
        InvalidState: the snapshot holds something that is not finite.
    """
    states = snapshot.to_states()
    if not np.isfinite(states).all():
        raise InvalidState("snapshot", "not finite", "positions, velocities and spins must be finite numbers")
    final = np.empty((1, 2 * N_BALLS))
    facts = np.empty(1, FACTS_DTYPE)
    views = facts.view(np.int32).reshape(1, -1), facts.view(np.float64).reshape(1, -1)
    entry, row = kernels().resume_one, parameters(table)
    rows = TRACE_ROWS if trace else 0
    events = np.empty((1, rows * TRACE_WIDTH))
    n_events = entry(row, states, final, *views, events, rows)
    if trace and n_events > rows:
        events = np.empty((1, n_events * TRACE_WIDTH))
        entry(row, states, final, *views, events, n_events)
    return Result(table, states, final, facts, _cut(events, n_events) if trace else None, n_events)


def checked_positions(table: Table, state: TableState) -> NDArray[np.float64]:
    """(1, 32) positions of a state whose balls all lie inside this table's cushion lines and outside its mouths."""
    if not isinstance(state, TableState):
        raise InvalidState("state", state, "must be a physics.TableState")
    return state.valid_on(table).positions.reshape(1, -1)


def _cut(events: NDArray[np.float64], n_events: int) -> NDArray[np.float64]:
    return events.reshape(-1, TRACE_WIDTH)[:n_events]
