"""One shot: ``simulate``, ``resume`` and their result."""

import math
from collections.abc import Iterator
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from physics import archive, notebook
from physics.constants import EVENT_LIMIT, N_BALLS, PLACEMENT_TOLERANCE
from physics.engine import kernels, workspace
from physics.errors import InvalidShot, InvalidState
from physics.events import OUT_OF_PLAY
from physics.facts import FACTS_WORDS, Facts
from physics.kernels import layout as at
from physics.kernels.layout import F_EVENTS, N_COUNTERS, SHOT_WIDTH
from physics.parameters import parameters
from physics.shot import Shot
from physics.state import TableState
from physics.status import Status
from physics.table import Table
from physics.trajectory import PLACE, Events, Snapshot, resting_states, state_width

TRACE_ROWS = 192
"""Events a trace has room for at first; a shot with more is simulated again with room for all."""

Floats = NDArray[np.float64]

NO_SHOT: Floats = np.zeros((1, SHOT_WIDTH))
NO_TRACE: Floats = np.zeros((1, 0))
NO_COUNTERS: NDArray[np.int64] = np.zeros((0, N_COUNTERS), np.int64)


class Result:
    """What a shot did. Made by ``simulate`` and ``resume``.

    Attributes:
        table: the table it was played on.
        n_events: number of events, the cue strike included.
    """

    __slots__ = ("__dict__", "_facts", "_final", "_read", "_start", "_state", "_trace", "n_events", "table")

    def __init__(
        self,
        table: Table,
        start: Floats,
        final: Floats,
        facts: NDArray[np.int32],
        trace: Floats | None,
        n_events: int,
    ) -> None:
        self.table = table
        self.n_events = n_events
        self._start = start
        self._final = final
        self._facts = facts
        self._trace = trace
        self._state: TableState | None = None
        self._read: Facts | None = None

    @cached_property
    def start(self) -> Snapshot:
        """All balls before the first event: at rest, or as the snapshot that was resumed had them."""
        return Snapshot.from_states(0.0, self._start_states().reshape(N_BALLS, -1))

    @property
    def final(self) -> TableState:
        """Where the balls lie afterwards: a legal start for the next shot."""
        if self._state is None:
            self._state = TableState.trusted(self._final.reshape(N_BALLS, 2))
        return self._state

    @property
    def duration(self) -> float:
        """Time until the last ball came to rest, s."""
        return self.facts.duration

    @property
    def status(self) -> Status:
        """How the shot ended."""
        return Status(self.facts.status)

    @property
    def facts(self) -> Facts:
        """What rules need to know."""
        if self._read is None:
            self._read = Facts.from_words(self._facts[0])
        return self._read

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
        states = self._states(np.array([[t]], dtype=np.float64)).reshape(N_BALLS, -1)
        states[:, PLACE] += (0.5 * self.table.width, 0.5 * self.table.length)
        return Snapshot.from_states(t, states)

    def paths(self, times: ArrayLike) -> tuple[Floats, Floats]:
        """Where all balls are at n times (s), in any order: positions (n, 16, 2) m and heights (n, 16) m.

        NaN for a ball that is not on the table then. The numbers of ``at``, many at once.

        Raises:
            ValueError: a time is outside [0, duration], ``times`` is not one row of numbers, or there is no trace.
        """
        wanted = np.asarray(times)
        if wanted.ndim != 1 or wanted.dtype.kind not in "iuf":
            raise ValueError(f"times = {times!r}: must be numbers, (n,)")
        wanted = wanted.astype(np.float64)
        if not ((wanted >= 0.0) & (wanted <= self.duration)).all():
            raise ValueError(f"times = {times!r}: must be in [0, {self.duration}] s, the duration of the shot")
        order = np.argsort(wanted, kind="stable")
        states = np.empty((len(wanted), N_BALLS, state_width(self.table)))
        states[order] = self._states(wanted[order].reshape(1, -1)).reshape(states.shape)
        positions = states[:, :, PLACE] + (0.5 * self.table.width, 0.5 * self.table.length)
        heights = states[:, :, at.A_Z].copy() if self.table.has_jaws else np.zeros(states.shape[:2])
        motion = states[:, :, at.A_MOTION]
        pocketed, absent, driven_off = OUT_OF_PLAY  # three comparisons: np.isin takes five times as long
        away = (motion == pocketed) | (motion == absent) | (motion == driven_off)
        positions[away], heights[away] = np.nan, np.nan
        return positions, heights

    def _states(self, times: Floats) -> Floats:
        """The kernels' states at ascending ``times`` (1, n), one row each."""
        rows, start = self._rows(), self._start_states()
        out = np.empty((times.shape[1], N_BALLS * state_width(self.table)))
        find = kernels(self.table.has_jaws).states_at
        find(parameters(self.table), workspace(), start, rows.reshape(1, -1), times, out)
        return out

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

    def to_dict(self) -> dict[str, Any]:
        """Plain values, for JSON: table, status, duration, final positions, and the events if they were kept."""
        events = {} if self._trace is None else {"events": [event.to_dict() for event in self.events]}
        return {
            "table": self.table.to_dict(),
            "status": self.status.name.lower(),
            "duration": self.duration,
            "n_events": self.n_events,
            "final": self.final.to_dict(),
        } | events

    def save(self, file: archive.File) -> None:
        """Write all of it, bit for bit, as a NumPy archive (``.npz``) that ``load`` reads.

        Raises:
            OSError: the file cannot be written.
        """
        arrays: archive.Arrays = {"start": self._start, "final": self._final, "facts": self._facts}
        archive.write(file, self.table, arrays if self._trace is None else arrays | {"trace": self._trace})

    @classmethod
    def load(cls, file: archive.File) -> Self:
        """Read what ``save`` wrote.

        Raises:
            OSError: the file cannot be read.
            ValueError: it is not a saved result.
        """
        table, arrays = archive.read(file)
        trace, n_events = arrays.get("trace"), int(arrays["facts"][0, F_EVENTS])
        return cls(table, arrays["start"], arrays["final"], arrays["facts"], trace, n_events)

    def _start_states(self) -> Floats:
        """(1, n): the balls before the first event, in the table's frame."""
        if self._start.size == 2 * N_BALLS:
            return resting_states(self.table, self._start.reshape(N_BALLS, 2))
        return self._start

    def _rows(self) -> Floats:
        if self._trace is None:
            raise ValueError("there is no trace: the shot was simulated with trace=False")
        return self._trace

    def _repr_svg_(self) -> str | None:
        return None if self._trace is None else notebook.picture(self)

    def __repr__(self) -> str:
        return f"Result({self.status.name}, {self.n_events} events, {self.duration:.3f} s)"


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
