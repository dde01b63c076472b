"""The direction of a pot: the middle of those that pot it, found by simulation.

Geometry knows the line of centres; it does not know throw, the bend of a stroke with a raised cue, or that a ball that
touches the cushion beside the mouth may still fall.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from client.agents.search.evaluate import Evaluator, Thinking
from client.agents.search.shots import PHI, Floats, Integers, Shots
from physics import Batch
from physics.facts import NEVER

WIDEST = 4.0
"""Standard deviations of direction: a margin wider than that is as good as any."""
OVERLAP = 1.25
"""The directions tried reach that far beyond the margin that geometry gives."""


def centred(evaluator: Evaluator, shots: Shots, tries: int) -> Thinking[Shots]:
    """Straight pots, each in the middle of the directions that pot its ball; its margin is what was found.

    Args:
        tries: directions to simulate for each, odd.
    """
    widest = WIDEST * np.degrees(evaluator.values.sight.sigma)
    return (yield from in_the_middle(evaluator, shots, OVERLAP * np.minimum(shots.margin, widest), tries))


def in_the_middle(evaluator: Evaluator, shots: Shots, reach: Floats, tries: int) -> Thinking[Shots]:
    """Strokes in the middle of the directions, `reach` (deg) to either side, that make the call; the others go."""
    if not len(shots):
        return shots
    offsets = reach[:, None] * np.linspace(-1.0, 1.0, tries)[None, :]
    spread = shots[np.repeat(np.arange(len(shots)), tries)]
    spread = spread.aimed(spread.strokes[:, PHI] + offsets.reshape(-1))
    batch = yield from evaluator.simulated(spread)
    made = falls(spread, batch).reshape(len(shots), tries)
    first, last = longest_run(made)
    rows = np.arange(len(shots))
    low, high = offsets[rows, first], offsets[rows, last]
    better = replace(shots.aimed((shots.strokes[:, PHI] + 0.5 * (low + high)) % 360.0), margin=0.5 * (high - low))
    return better[np.flatnonzero(made.any(axis=1))]


def falls(shots: Shots, batch: Batch) -> NDArray[np.bool_]:
    """(k,) bool: the called ball falls into the called pocket and the cue ball stays up."""
    rows = np.arange(len(shots))
    fell: NDArray[np.bool_] = (batch.pocket[rows, shots.ball] == shots.pocket) & (
        batch.facts["pocketed"][:, 0] == NEVER
    )
    return fell


def longest_run(made: NDArray[np.bool_]) -> tuple[Integers, Integers]:
    """First and last place of the longest run of True in each row, (k,) each; of the first of several."""
    run = np.zeros(made.shape, np.int64)
    run[:, 0] = made[:, 0]
    for place in range(1, made.shape[1]):
        run[:, place] = (run[:, place - 1] + 1) * made[:, place]
    last = run.argmax(axis=1)
    length = run[np.arange(len(run)), last]
    return last - np.maximum(length, 1) + 1, last
