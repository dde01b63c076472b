"""The randomness of shipped agents."""

import numpy as np

from referee.wire import View


def generator(seed: int | None, view: View) -> np.random.Generator:
    """A generator for one game: fixed by seed, number of the game and seat; fresh without a seed."""
    if seed is None:
        return np.random.Generator(np.random.PCG64())
    return np.random.Generator(np.random.PCG64([seed, view.number, view.seat or 0]))
