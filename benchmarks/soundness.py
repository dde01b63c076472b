"""What is wrong with the end of a shot, or with an instant of it: NaN, escapes, overlaps, no rest."""

import dataclasses
import itertools

import numpy as np
from numpy.typing import NDArray

import physics
from benchmarks import pieces
from benchmarks.scenes import Booleans, Floats

PERMITTED = 1e-12
"""m. Overlap, and distance beyond a cushion line, that is no fault; the start's if that is more."""

ROUNDING = 1e-15
"""m, of a place as it is written and read."""

NOT_PLAYED = (
    physics.Status.CUE_OBSTRUCTED,
    physics.Status.TIP_OFF_BALL,
    physics.Status.OUT_OF_RANGE,
    physics.Status.NO_CUE_BALL,
)


@dataclasses.dataclass(frozen=True)
class Verdict:
    """Per shot: what is wrong, and the figures behind it.

    Attributes:
        faults: name to (n,) bool.
        overlap: (n,) m, deepest overlap of two balls at the end, 0 if none.
        beyond: (n,) m, furthest a ball lies beyond a cushion line, 0 if none.
    """

    faults: dict[str, Booleans]
    overlap: Floats
    beyond: Floats


def overlap(table: physics.Table, states: Floats) -> Floats:
    """(n,) m: deepest overlap in each of states (n, 16, 2)."""
    rows, columns = np.triu_indices(states.shape[1], 1)
    gap = states[:, rows] - states[:, columns]
    with np.errstate(invalid="ignore"):
        depth = 2.0 * table.ball_radius - np.sqrt((gap * gap).sum(axis=2))
    return np.fmax.reduce(depth, axis=1, initial=0.0)


def beyond(table: physics.Table, states: Floats) -> Floats:
    """(n,) m: how far the outermost ball lies beyond a cushion line or a corner mouth's line, or in a jaw or a hole."""
    if isinstance(table, physics.RealTable):
        return np.fmax.reduce(pieces.beyond(pieces.pieces_of(table), states), axis=1, initial=0.0)
    side = np.abs(states[..., 0] - 0.5 * table.width)
    end = np.abs(states[..., 1] - 0.5 * table.length)
    line_x, line_y = 0.5 * table.width - table.ball_radius, 0.5 * table.length - table.ball_radius
    corner = line_x + line_y + table.ball_radius - table.corner_reach
    out = np.fmax(np.fmax(side - line_x, end - line_y), (side + end - corner) / np.sqrt(2.0))
    return np.fmax.reduce(out, axis=1, initial=0.0)


def misplaced(table: physics.Table, states: Floats) -> Booleans:
    """Whether a ball of each state lies where ``Table.contains`` says none may lie."""
    if isinstance(table, physics.RealTable):
        return np.asarray((~table.contains(states[..., 0], states[..., 1]) & ~np.isnan(states[..., 0])).any(axis=1))
    side = np.abs(states[..., 0] - 0.5 * table.width)
    end = np.abs(states[..., 1] - 0.5 * table.length)
    margin = 1e-6
    line_x, line_y = 0.5 * table.width - table.ball_radius, 0.5 * table.length - table.ball_radius
    corner = line_x + line_y + table.ball_radius - table.corner_reach
    doubtful = (side > line_x - margin) | (end > line_y - margin) | (side + end > corner - margin)
    found = np.zeros(len(states), dtype=bool)
    for row, ball in np.argwhere(doubtful).tolist():
        found[row] |= not table.contains(*states[row, ball].tolist())
    return found


def judge(table: physics.Table, states: Floats, batch: physics.Batch) -> Verdict:
    """Look at the ends of a batch of shots that started from ``states``."""
    final = batch.positions
    gone = np.isnan(final).any(axis=2)
    accounted = (batch.pocket >= 0) | (batch.pocket == -2) | (batch.facts["off_table"] >= 0)
    deep, out = overlap(table, final), beyond(table, final)
    permitted = np.maximum(overlap(table, states), PERMITTED)
    refused = np.isin(batch.status, NOT_PLAYED)
    same = ((final == states) | (np.isnan(final) & np.isnan(states))).all(axis=(1, 2))
    faults = {
        "event limit": batch.status == physics.Status.EVENT_LIMIT,
        "unnamed status": ~np.isin(batch.status, [int(status) for status in physics.Status]),
        "nan": (gone != accounted).any(axis=1) | ~np.isfinite(batch.duration) | (batch.duration < 0.0),
        "escape": misplaced(table, final) | (out > np.maximum(beyond(table, states) + ROUNDING, PERMITTED)),
        "overlap": deep > permitted,
        "moved though refused": refused & ~same,
    }
    return Verdict(faults, deep, out)


def judge_flight(table: physics.Table, result: physics.Result, instants: int) -> tuple[float, float, bool]:
    """(overlap m, beyond m, all finite) over a shot's events and the middles between them, at most ``instants``."""
    times = [event.time for event in result.events[: instants // 2]]
    middles = [0.5 * (one + two) for one, two in itertools.pairwise(times)]
    snapshots = [result.at(time) for time in (*times, *middles)]
    states = np.array([snapshot.positions for snapshot in snapshots])
    moving = np.array([np.concatenate([s.velocities, s.spins], axis=1) for s in snapshots])
    return float(overlap(table, states).max()), float(beyond(table, states).max()), bool(np.isfinite(moving).all())


def first_rows(found: Booleans, most: int) -> NDArray[np.intp]:
    """The first rows that are True."""
    return np.flatnonzero(found)[:most]
