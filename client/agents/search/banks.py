"""Banks, kicks, combinations and caroms, aimed: what the sweep came upon, played at more speeds and in the middle."""

from dataclasses import replace

import numpy as np

from client.agents.search.evaluate import Evaluator, Thinking
from client.agents.search.refine import in_the_middle
from client.agents.search.shots import B, Floats, Shots, V

SPEEDS = (0.7, 0.8, 0.9, 1.0, 1.2, 1.45)
"""Of the speed at which the sweep came upon it."""
TRIES = 9
"""Directions."""
REACH, LEAST, MOST = 4.0, 0.4, 1.5
"""How far to either side directions are tried: standard deviations, and the least and most degrees. A pot that
needs less than the least is nobody's choice, and further off the sweep has strokes of its own."""
COST = len(SPEEDS) * TRIES
"""Simulated shots for each stroke that is aimed."""


def aimed(evaluator: Evaluator, swept: Shots, worth: Floats, most: int) -> Thinking[Shots]:
    """The best of the swept strokes that call a ball, at more speeds, each in the middle of what makes its call.

    Args:
        worth: (k,), of the swept strokes as they are meant. most: how many are aimed.
    """
    calling = np.flatnonzero(swept.ball >= 0)
    best = _spread(swept, calling[np.argsort(-worth[calling], kind="stable")], most)
    shots = swept[np.repeat(best, len(SPEEDS))]
    strokes = shots.strokes.copy()
    strokes[:, V] = np.minimum(strokes[:, V] * np.tile(SPEEDS, len(best)), evaluator.table.v_max)
    sigma = np.degrees(evaluator.values.sight.sigma)
    reach = np.full(len(shots), np.clip(REACH * sigma, LEAST, MOST))
    return (yield from in_the_middle(evaluator, replace(shots, strokes=strokes), reach, TRIES))


def _spread(swept: Shots, order: np.ndarray, most: int) -> np.ndarray:
    """The first of the rows in order, of each call and tip at most a third: not one ball alone in all directions."""
    seen: dict[tuple[int, ...], int] = {}
    chosen: list[int] = []
    for row in order.tolist():
        kind = (int(swept.ball[row]), int(swept.pocket[row]), round(swept.strokes[row, B]))
        if seen.get(kind, 0) < max(1, most // 3):
            seen[kind] = seen.get(kind, 0) + 1
            chosen.append(row)
        if len(chosen) == most:
            break
    return np.array(chosen, np.int64)
