"""The paths of many shots at once: ``simulate_paths``."""

import dataclasses
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from physics.batch import checked_shots, checked_states, refuse_bad_rows
from physics.constants import N_BALLS
from physics.engine import kernels, workspace
from physics.events import OUT_OF_PLAY
from physics.facts import FACTS_DTYPE, FACTS_WORDS
from physics.kernels import layout as at
from physics.parameters import parameters
from physics.shot import Shot
from physics.simulation import NO_COUNTERS, TRACE_ROWS
from physics.state import TableState
from physics.table import Table
from physics.trajectory import PLACE

Floats = NDArray[np.float64]


@dataclasses.dataclass(frozen=True, eq=False)
class Paths:
    """Where b balls were in n shots at m times each.

    Attributes:
        positions: (n, m, b, 2) m; NaN for a ball that is not on the table then.
        heights: (n, m, b) m, of the centres above where they rest on the cloth; NaN likewise.
        left: (n, b, 2) m, where a ball was when it left the table; NaN for one that did not.
        status: (n,) int8 of ``Status``. duration: (n,) s.
    """

    positions: Floats
    heights: Floats
    left: Floats
    status: NDArray[np.int8]
    duration: Floats


def simulate_paths(
    tables: Table | Sequence[Table],
    states: TableState | Floats,
    shots: ArrayLike | Sequence[Shot],
    times: Floats,
    balls: Sequence[int] = range(N_BALLS),
) -> Paths:
    """Simulate n shots and say where balls are at given times. The numbers are those of ``Result.paths``, bit for bit.

    For many shots at once it takes a fraction of the time of ``simulate`` and ``Result.paths``: what fits shots to
    observed paths needs.

    Args:
        tables: one for all shots, or one for each; all with jaws, or all without.
        states: one ``TableState`` for all shots, or positions (n, 16, 2) in metres with NaN for absent balls; that
            these do not overlap is not checked.
        shots: (n, 5) float64, columns v, phi, theta, a, b in Olympiad units; or a list of ``Shot``.
        times: (n, m) s, or (m,) for all; ascending. Beyond a shot's end balls lie where it left them, before 0 where it
            began.
        balls: the b balls that are asked about.

    Raises:
        InvalidShot: wrong shape, or a value that is not finite; names the first bad row.
        InvalidState: wrong shape, not finite, or off the table; names the first bad row.
        ValueError: ``tables``, ``times`` or ``balls`` are not as said.
    """
    strokes = checked_shots(shots)
    n = len(strokes)
    each = (tables,) * n if isinstance(tables, Table) else tuple(tables)
    if len(each) != n or len({table.has_jaws for table in each}) > 1:
        raise ValueError(f"tables = {len(each)} tables: must be one, or {n}, all with jaws or all without")
    given = checked_states(each[0], states, n) if n else np.empty((0, 2 * N_BALLS))
    given = np.repeat(given, n, axis=0) if isinstance(states, TableState) else given
    wanted = _checked_times(times, n)
    seen = _Seen(given, wanted.shape[1], each[0].has_jaws if n else False)
    for number, table in enumerate(each):
        seen.fill(number, table, strokes[number : number + 1], wanted[number : number + 1])
    return seen.paths(each, _checked_balls(balls))


class _Seen:
    """What the kernels fill, shot by shot; begun with positions (n, 32)."""

    def __init__(self, starts: Floats, m: int, has_jaws: bool) -> None:
        n = len(starts)
        self._starts = starts
        self._has_jaws = has_jaws
        self._stride = at.REAL_TRACE_WIDTH if has_jaws else at.TRACE_WIDTH
        self._width = at.REAL_STATE_WIDTH if has_jaws else at.STATE_WIDTH
        self._final, self._pocket = np.empty((1, 2 * N_BALLS)), np.empty((1, N_BALLS), np.int8)
        self._facts = np.zeros(n, FACTS_DTYPE)
        self._words = self._facts.view(np.int32).reshape(n, FACTS_WORDS)
        self._trace = np.empty((1, TRACE_ROWS * self._stride))
        self._states = np.empty((n, m, N_BALLS * self._width))
        self._left = np.full((n, N_BALLS, 2), np.nan)
        places = starts.reshape(n, N_BALLS, 2)
        absent = np.isnan(places[:, :, 0])
        resting = np.zeros((n, N_BALLS, self._width))
        resting[:, :, PLACE] = np.where(absent[:, :, None], 0.0, places)
        resting[:, :, at.A_MOTION] = np.where(absent, at.ABSENT, at.STATIONARY)
        self._resting = resting.reshape(n, N_BALLS * self._width)

    def fill(self, number: int, table: Table, stroke: Floats, times: Floats) -> None:
        """Simulate one shot, (1, 5), and read its states at (1, m) times."""
        one = slice(number, number + 1)
        start, words = self._starts[one], self._words[one]
        entries, row, work = kernels(self._has_jaws), parameters(table), workspace()
        refuse_bad_rows(table, start, number, nearest=0.0)
        entries.simulate_rows(row, work, start, stroke, self._final, self._pocket, words, self._trace, NO_COUNTERS)
        size = int(words[0, at.F_EVENTS]) * self._stride
        if size > self._trace.shape[1]:
            self._trace = np.empty((1, size))
            entries.simulate_rows(row, work, start, stroke, self._final, self._pocket, words, self._trace, NO_COUNTERS)
        events = self._trace[:, :size]
        within = np.minimum(np.maximum(times, 0.0), self._facts["duration"][number])
        entries.states_at(row, work, self._resting[one], events, within, self._states[number])
        gone = words[0, at.F_OFF_TABLE : at.F_OFF_TABLE + N_BALLS]
        if self._pocket.max() >= 0 or gone.max() >= 0:
            self._note_leaving(number, table, events.reshape(-1, self._stride))

    def _note_leaving(self, number: int, table: Table, events: Floats) -> None:
        kinds = events[:, at.T_KIND]
        for event in events[(kinds == at.POCKET_COLLISION) | (kinds == at.OFF_TABLE)].tolist():
            x, y = event[at.T_FIRST : at.T_FIRST + 2]
            self._left[number, int(event[at.T_BALL])] = x + 0.5 * table.width, y + 0.5 * table.length

    def paths(self, tables: Sequence[Table], balls: list[int]) -> Paths:
        """Of these balls."""
        seen = self._states.reshape(*self._states.shape[:2], N_BALLS, self._width)[:, :, balls]
        middles = np.array([(0.5 * table.width, 0.5 * table.length) for table in tables]).reshape(len(seen), 1, 1, 2)
        positions = seen[..., PLACE] + middles
        heights = seen[..., at.A_Z].copy() if self._has_jaws else np.zeros(seen.shape[:3])
        motion = seen[..., at.A_MOTION]
        pocketed, absent, driven_off = OUT_OF_PLAY
        away = (motion == pocketed) | (motion == absent) | (motion == driven_off)
        if away.any():
            positions[away], heights[away] = np.nan, np.nan
        facts = self._facts
        return Paths(
            positions, heights, self._left[:, balls], facts["status"].astype(np.int8), facts["duration"].copy()
        )


def _checked_balls(balls: Sequence[int]) -> list[int]:
    """Numbers of balls."""
    for ball in balls:
        if isinstance(ball, bool) or not isinstance(ball, int | np.integer) or not 0 <= ball < N_BALLS:
            raise ValueError(f"balls = {ball!r}: must be numbers from 0 to {N_BALLS - 1}")
    return [int(ball) for ball in balls]


def _checked_times(times: Floats, n: int) -> Floats:
    """(n, m) ascending times."""
    given = np.asarray(times)
    rows = np.repeat(given[None], n, axis=0) if given.ndim == 1 else given
    if given.dtype != np.float64 or rows.ndim != 2 or len(rows) != n:
        raise ValueError(f"times = {given.dtype.name} {given.shape}: must be float64 of shape (m,) or ({n}, m)")
    ends = ~np.isfinite(rows)
    ends[:, 1:] |= rows[:, 1:] < rows[:, :-1]
    for row, place in np.argwhere(ends)[:1].tolist():
        raise ValueError(f"times[{row}][{place}] = {rows[row, place]}: must be finite, not before the last one")
    return np.ascontiguousarray(rows)
