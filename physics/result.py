"""What a shot did: events, facts, where the balls lie, and where each was at any time."""

import math
from collections.abc import Iterator
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from physics import archive, notebook
from physics.constants import N_BALLS
from physics.engine import kernels, workspace
from physics.events import OUT_OF_PLAY
from physics.facts import Facts
from physics.kernels import layout as at
from physics.kernels.layout import F_EVENTS
from physics.parameters import parameters
from physics.state import TableState
from physics.status import Status
from physics.table import Table
from physics.trajectory import PLACE, Events, Snapshot, resting_states, state_width

Floats = NDArray[np.float64]


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
