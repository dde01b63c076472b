"""The stroke after this one: what positions are worth to their shooter when pots are played out, not reckoned."""

import numpy as np
from numpy.typing import NDArray

from client.agents.search.clusters import Choice, as_they_come, representatives
from client.agents.search.evaluate import Evaluator, Outcomes
from client.agents.search.pots import in_all_ways
from client.agents.search.refine import centred
from client.agents.search.shots import Floats, Integers, Tables
from referee.rules.verdicts import OPEN

POTS, WAYS, AIMS, ROUGH, KEPT, CAREFUL = 3, 8, 5, 4, 2, 12
"""For each position: pots considered, ways to play each, directions tried, noisy copies of all; how many are kept, and
played how many times more."""
COST = POTS * WAYS * (AIMS + ROUGH) + KEPT * CAREFUL
"""Simulated shots for one position, at most."""


def played_out(evaluator: Evaluator, tables: Tables) -> Floats:
    """What each position is worth to its shooter, (s,): the best pot under noise, or else playing safe."""
    sight, worth = evaluator.values.sight, evaluator.values.without_pot(tables)
    shots = sight.raised(in_all_ways(tables, sight.pots(tables, POTS), WAYS))
    shots = centred(evaluator, shots, AIMS)
    if not len(shots):
        return worth
    shots = shots[best_of_each(shots.table, evaluator.noisy(shots, ROUGH).mean(), KEPT)]
    np.maximum.at(worth, shots.table, evaluator.noisy(shots, CAREFUL).mean())
    return worth


def best_of_each(table: Integers, worth: Floats, most: int) -> Integers:
    """Rows of the `most` best strokes of each table."""
    order = np.lexsort((-worth, table))
    ordered = table[order]
    starts = np.flatnonzero(np.r_[True, ordered[1:] != ordered[:-1]])
    rank = np.arange(len(order)) - np.repeat(starts, np.diff(np.r_[starts, len(order)]))
    found: Integers = order[rank < most]
    return found


def correction(evaluator: Evaluator, outcomes: Outcomes, most: int, clustered: bool = True) -> Floats:
    """What looking closer adds to each stroke's mean worth, (k,).

    The tables that each stroke leaves are clustered, up to `most` for each; the one that stands for a cluster is played
    out, and what that differs from its value is taken to hold for the whole cluster. If not `clustered`, tables are
    taken as they come, each for as many.
    """
    stroke, weight, rows, mine = _clusters(outcomes, most, representatives if clustered else as_they_come)
    if not len(stroke):
        return np.zeros(len(outcomes.worth))
    copies = outcomes.copies
    positions = outcomes.positions.reshape(-1, 16, 2)[rows]
    group = outcomes.group.reshape(-1)[rows]
    mover = np.where(mine | (group == OPEN), group, 1 - group).astype(np.int8)
    better = played_out(evaluator, Tables(positions, mover)) - evaluator.values.to_shoot(
        positions, mover, np.zeros(len(rows), bool)
    )
    gain = np.where(mine, better, -better) * weight / copies
    return np.bincount(stroke, gain, minlength=len(outcomes.worth)).astype(np.float64)


def _clusters(
    outcomes: Outcomes, most: int, chosen_by: Choice
) -> tuple[Integers, Integers, Integers, NDArray[np.bool_]]:
    """Of each cluster: its stroke, its size, the row that stands for it, whether the shooter goes on."""
    found: list[tuple[int, int, int, bool]] = []
    to_play = ~outcomes.over & ~outcomes.fouled
    for stroke in range(len(outcomes.worth)):
        for mine in (True, False):
            copies = np.flatnonzero(to_play[stroke] & (outcomes.continues[stroke] == mine))
            share = max(1, round(most * len(copies) / outcomes.copies))
            if not len(copies):
                continue
            chosen, nearest = chosen_by(outcomes.positions[stroke, copies], share)
            sizes = np.bincount(nearest, minlength=len(chosen))
            rows = stroke * outcomes.copies + copies[chosen]
            found += [(stroke, int(size), int(row), mine) for size, row in zip(sizes, rows, strict=True)]
    columns = np.array(found, dtype=np.int64).reshape(-1, 4).T
    return columns[0], columns[1], columns[2], columns[3].astype(bool)
