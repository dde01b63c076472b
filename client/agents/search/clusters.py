"""Tables that are nearly the same, taken together: one of each kind is looked at closely."""

from collections.abc import Callable

import numpy as np

from client.agents.search.shots import Floats, Integers


def representatives(positions: Floats, most: int) -> tuple[Integers, Integers]:
    """Up to `most` of the tables, far apart from one another, and which of them each table is nearest to.

    The first is the one nearest to the mean; the next is always the one farthest from those there are. The cue ball
    counts three times: where it lies decides what can be played.

    Args:
        positions: (n, 16, 2) m, n >= 1.

    Returns:
        (r,) rows of the representatives; (n,) for each table, which of the r is nearest.
    """
    flat = _features(positions)
    first = int(((flat - flat.mean(axis=0)) ** 2).sum(axis=1).argmin())
    chosen, nearest = [first], np.zeros(len(flat), np.int64)
    gap = ((flat - flat[first]) ** 2).sum(axis=1)
    while len(chosen) < most and gap.max() > 0.0:
        chosen.append(int(gap.argmax()))
        to_new = ((flat - flat[chosen[-1]]) ** 2).sum(axis=1)
        closer = to_new < gap
        nearest[closer], gap = len(chosen) - 1, np.where(closer, to_new, gap)
    return np.array(chosen), nearest


def as_they_come(positions: Floats, most: int) -> tuple[Integers, Integers]:
    """Up to `most` of the tables, the first ones, each standing for as many: what clustering is measured against."""
    chosen = np.arange(min(most, len(positions)))
    return chosen, np.arange(len(positions)) % len(chosen)


Choice = Callable[[Floats, int], tuple[Integers, Integers]]
"""Picks tables to look at, and says for each table which of them stands for it."""

CUE_WEIGHT = 3.0
OFF_TABLE = -1.0
"""m: a place far from any ball's, for one that is off the table."""


def _features(positions: Floats) -> Floats:
    flat = np.nan_to_num(positions, nan=OFF_TABLE)
    flat[:, 0] *= CUE_WEIGHT
    return flat.reshape(len(flat), -1)
