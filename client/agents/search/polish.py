"""Finalists made better: strokes near the best ones, under noise, for what they are worth and not for the pot alone.

The middle of the pocket is seldom the best place to aim at: a little more speed or side may leave the cue ball better,
and the edge that is missed may be the one that scratches. So the best strokes get neighbours, drawn around them ever
closer (a cross-entropy search with a population of several means), all played under the same draws.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from client.agents.search.evaluate import Evaluator, Thinking
from client.agents.search.finalists import Finalists
from client.agents.search.shots import PHI, THETA, A, B, Shots, V

PARENTS = 3
"""Strokes that get neighbours in a round."""
CHILDREN = 8
"""Neighbours of each."""
COPIES = 16
"""Noisy copies of each in the first round; each round has half as many again."""
SPEED, SIDE, HEIGHT = 0.12, 2.5, 3.5
"""First spread of the speed, as a share of it, and of the tip, mm."""
AIM = 0.35
"""First spread of the direction, of the margin."""
CLOSER = 0.7
"""From round to round."""
ROUNDS, MOST_COPIES = 12, 1000
"""However large the budget."""
JUMP = 1.0
"""Degrees above what a stroke needs from which on it is a jump, and stays one."""
FURTHEST = 18.0
"""mm: a tip further from the middle may miscue."""


def rounds(shots: float) -> Iterator[tuple[float, int]]:
    """The rounds that ``shots`` pay for: the spread of each, as a share of the first, and its copies."""
    spread, copies = 1.0, COPIES
    for _ in range(ROUNDS):
        shots -= PARENTS * (CHILDREN + 1) * copies
        if shots < 0:
            return
        yield spread, copies
        spread, copies = spread * CLOSER, min(MOST_COPIES, copies + copies // 2)


def neighbours(evaluator: Evaluator, parents: Shots, spread: float, chance: np.random.Generator) -> Shots:
    """Strokes near these, as many of each; those that cannot be played are left out."""
    near = parents[np.repeat(np.arange(len(parents)), CHILDREN)]
    draws = spread * chance.standard_normal((len(near), 4))
    strokes = near.strokes.copy()
    strokes[:, V] = np.clip(strokes[:, V] * np.exp(SPEED * draws[:, 0]), 0.05, evaluator.table.v_max)
    width = np.clip(near.margin, 0.05, 2.0 * np.degrees(evaluator.values.sight.sigma))
    strokes[:, PHI] = (strokes[:, PHI] + AIM * width * draws[:, 1]) % 360.0
    strokes[:, A] += SIDE * draws[:, 2]
    strokes[:, B] += HEIGHT * draws[:, 3]
    off = np.hypot(strokes[:, A], strokes[:, B])
    shrink = np.minimum(1.0, FURTHEST / np.maximum(off, 1e-9))
    strokes[:, A] *= shrink
    strokes[:, B] *= shrink
    sight = evaluator.values.sight
    extra = np.maximum(0.0, near.strokes[:, THETA] - sight.least(near))
    return sight.raised(replace(near, strokes=strokes), np.where(extra > JUMP, extra, 0.0))


def better(
    evaluator: Evaluator, found: Finalists, spread: float, copies: int, chance: np.random.Generator
) -> Thinking[Finalists]:
    """The finalists after one round: the best played again with their neighbours."""
    ordered = found.best(len(found))
    parents, rest = ordered[np.arange(min(PARENTS, len(found)))], ordered[np.arange(PARENTS, len(found))]
    near = neighbours(evaluator, parents.shots, spread, chance)
    worths = yield from evaluator.noisy(parents.shots.joined(near), copies)
    known = parents.again(worths[: len(parents)])
    return known.joined(Finalists.of(near, worths[len(parents) :])).joined(rest)
