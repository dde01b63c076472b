"""The randomness of shipped agents."""

import numpy as np

from referee.wire import View


def generator(seed: int | None, view: View) -> np.random.Generator:
    """A generator for one game: fixed by seed, game and seat; fresh without a seed.

    The game is told by its commitment: the same game is the same wherever it is played, no two share it.
    """
    if seed is None:
        return np.random.Generator(np.random.PCG64())
    return np.random.Generator(np.random.PCG64([seed, int(view.commitment[:16], 16), view.seat or 0]))
