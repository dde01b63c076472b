"""Many shots at once: ``simulate_batch``."""

import dataclasses
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from physics.constants import BALL_RADIUS, EVENT_LIMIT, N_BALLS, PLACEMENT_TOLERANCE
from physics.engine import kernels, workspace
from physics.errors import InvalidShot, InvalidState
from physics.facts import FACTS_DTYPE, FACTS_WORDS
from physics.kernels.layout import N_COUNTERS
from physics.parameters import parameters
from physics.shot import FIELDS, Shot
from physics.simulation import NO_COUNTERS, NO_TRACE, checked_positions
from physics.state import TableState
from physics.status import Status
from physics.table import Table

PARTS_PER_THREAD = 8
"""A batch is cut finer than into one part a thread: a thread that was held up leaves its parts to the others."""
CHECKED_ROWS = 64
"""Some two milliseconds of ordinary shots."""


@dataclasses.dataclass(frozen=True, eq=False)
class Batch:
    """Results of ``simulate_batch``; row i is shot i.

    Attributes:
        positions: (n, 16, 2) float64 m, final; NaN where the ball is not on the table.
        pocket: (n, 16) int8, the pocket; -1 on the table, -2 absent from the start.
        status: (n,) int8 of ``Status``.
        facts: (n,) structured array of ``FACTS_DTYPE``.
    """

    positions: NDArray[np.float64]
    pocket: NDArray[np.int8]
    status: NDArray[np.int8]
    facts: NDArray[np.void]

    @property
    def duration(self) -> NDArray[np.float64]:
        """(n,) s."""
        return self.facts["duration"]

    @property
    def n_events(self) -> NDArray[np.int32]:
        """(n,) number of events, the cue strike included."""
        return self.facts["n_events"]

    def __len__(self) -> int:
        return len(self.status)

    def __repr__(self) -> str:
        numbers, counts = np.unique(self.status, return_counts=True)
        ended = [f", {count} {Status(number).name}" for number, count in zip(numbers, counts, strict=True)]
        return f"Batch({len(self)} shots{''.join(ended)})"

    def state(self, row: int) -> TableState:
        """Final state of one shot."""
        return TableState.trusted(self.positions[row].copy())


def simulate_batch(
    table: Table,
    states: TableState | NDArray[np.float64],
    shots: ArrayLike | Sequence[Shot],
    threads: int = 1,
    counters: NDArray[np.int64] | None = None,
    check: Callable[[], None] | None = None,
    event_limit: int = EVENT_LIMIT,
) -> Batch:
    """Simulate n shots without traces. Each has the same bits as ``simulate`` gives it, whatever ``threads``.

    Args:
        states: one ``TableState`` for all shots, or positions (n, 16, 2) in metres with NaN for absent balls.
        shots: (n, 5) float64, columns v, phi, theta, a, b in Olympiad units; or a list of ``Shot``.
        threads: how many threads share the rows; the interpreter is not held meanwhile.
        counters: (n, 4) int64 to be filled with the work each shot took: predictions of a ball's next event, pairs the
            filter left, contacts solved, looks at the boundary.
        check: called before every ``CHECKED_ROWS`` rows or fewer; what it raises ends the batch.
        event_limit: as for ``simulate``, of each shot.

    A shot that cannot be played is a result: its status says why, positions unchanged, no events.

    Raises:
        InvalidShot: wrong shape, or a value that is not finite; names the first bad row.
        InvalidState: wrong shape, not finite, off the table or overlapping; names the first bad row.
        ValueError: ``threads`` is not a positive integer, ``event_limit`` out of range, or ``counters`` another kind of
            array.
    """
    if isinstance(threads, bool) or not isinstance(threads, int) or threads < 1:
        raise ValueError(f"threads = {threads!r}: must be a positive integer")
    strokes = checked_shots(shots)
    n = len(strokes)
    positions = checked_states(table, states, n)
    final, pocket = np.empty((n, N_BALLS, 2)), np.empty((n, N_BALLS), np.int8)
    facts, counted = np.empty(n, FACTS_DTYPE), NO_COUNTERS if counters is None else _checked_counters(counters, n)
    by_row = (strokes, final.reshape(n, 2 * N_BALLS), pocket, facts.view(np.int32).reshape(n, FACTS_WORDS))
    run, row = kernels(table.has_jaws).simulate_rows, parameters(table, event_limit)

    def part(first: int, last: int) -> None:
        if check is not None:
            check()
        given = positions if len(positions) == 1 else positions[first:last]
        if not isinstance(states, TableState):
            refuse_bad_rows(table, given, first)
        shots, *outputs = (array[first:last] for array in by_row)
        run(row, workspace(), given, shots, *outputs, NO_TRACE, counted[first:last])

    parts = 1 if threads == 1 else PARTS_PER_THREAD * threads
    if check is not None:
        parts = max(parts, -(-n // CHECKED_ROWS))
    parts = min(n, parts)
    edges = [n * k // parts for k in range(parts + 1)] if parts else [0]
    if threads == 1 or parts < 2:
        for first, last in pairwise(edges):
            part(first, last)
    else:
        with ThreadPoolExecutor(threads) as pool:
            for _ in pool.map(part, edges[:-1], edges[1:]):  # in order: the first bad row is the one named
                pass
    return Batch(final, pocket, facts["status"].astype(np.int8), facts)


def checked_shots(shots: ArrayLike | Sequence[Shot]) -> NDArray[np.float64]:
    """Return the shots as (n, 5) float64, columns v, phi, theta, a, b in Olympiad units.

    Raises:
        InvalidShot: wrong shape, or a value that is not finite; names the first bad row.
    """
    if isinstance(shots, Shot):
        raise InvalidShot("shots", shots, "must be a list of shots, or rows (n, 5); write [shot] for a single one")
    if isinstance(shots, list | tuple) and any(isinstance(shot, Shot) for shot in shots):
        shots = [_row(number, shot) for number, shot in enumerate(shots)]
    try:
        given = np.asarray(shots)
    except ValueError:  # ragged
        given = np.empty(0, object)
    whole_numbers_in_lists = given.dtype.kind in "iu" and not isinstance(shots, np.ndarray)
    if given.dtype != np.float64 and not whole_numbers_in_lists:
        raise InvalidShot("shots", given.dtype.name, "must be float64")
    strokes = np.ascontiguousarray(given, dtype=np.float64)
    if strokes.ndim != 2 or strokes.shape[1] != len(FIELDS):
        raise InvalidShot("shots", strokes.shape, f"must have shape (n, 5), columns {FIELDS}")
    bad = np.argwhere(~np.isfinite(strokes))
    if len(bad):
        row, column = bad[0].tolist()
        raise InvalidShot(f"shots[{row}].{FIELDS[column]}", float(strokes[row, column]), "must be a finite number")
    return strokes


def _row(number: int, shot: object) -> tuple[float, ...]:
    """One of a list of ``Shot``, as a row."""
    if not isinstance(shot, Shot):
        raise InvalidShot(f"shots[{number}]", shot, "must be a physics.Shot, as other shots of this list are")
    return shot.v, shot.phi, shot.theta, shot.a, shot.b


def _checked_counters(counters: NDArray[np.int64], n: int) -> NDArray[np.int64]:
    fits = isinstance(counters, np.ndarray) and counters.dtype == np.int64 and counters.shape == (n, N_COUNTERS)
    if not (fits and counters.flags.c_contiguous and counters.flags.writeable):
        raise ValueError(f"counters: must be a writeable C-contiguous int64 array of shape ({n}, {N_COUNTERS})")
    return counters


def checked_states(table: Table, states: TableState | NDArray[np.float64], n: int) -> NDArray[np.float64]:
    """Positions (n, 32), or (1, 32) of a state for all; of an array the shape alone is checked."""
    if isinstance(states, TableState):
        return checked_positions(table, states)
    positions = np.ascontiguousarray(states)
    if positions.dtype != np.float64 or positions.shape != (n, N_BALLS, 2):
        raise InvalidState(
            "states", (positions.dtype.name, positions.shape), f"must be float64 of shape ({n}, {N_BALLS}, 2)"
        )
    return positions.reshape(n, 2 * N_BALLS)


def refuse_bad_rows(
    table: Table, positions: NDArray[np.float64], first: int, nearest: float = 2.0 * BALL_RADIUS - PLACEMENT_TOLERANCE
) -> None:
    """Raise for the first row whose balls are off the table or overlap.

    Args:
        positions: (n, 32) m.
        first: the number of the first row.
        nearest: how near two centres may be, m.

    Raises:
        InvalidState: names the row and the ball.
    """
    find = kernels(table.has_jaws).first_bad_row
    row, ball, other = find(parameters(table), workspace(), positions, nearest * nearest, PLACEMENT_TOLERANCE)
    if row < 0:
        return
    allowed = "must be two finite numbers inside the cushion lines and outside the mouths"
    if other >= 0:
        allowed = f"overlaps ball {other}; centres must be at least {2.0 * BALL_RADIUS} m apart"
    place = positions[row, 2 * ball : 2 * ball + 2].tolist()
    raise InvalidState(f"states[{first + row}][{ball}]", place, allowed)
