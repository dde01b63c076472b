"""The randomness of shipped agents."""

import hashlib

import numpy as np

from protocol import View


def generator(seed: int | None, view: View) -> np.random.Generator:
    """A generator for one game: fixed by seed, game and seat; fresh without a seed.

    The game is told by what the player sees first of it, so that a game with the same racks and the same noise is the
    same wherever it is played, under whatever name.
    """
    if seed is None:
        return np.random.Generator(np.random.PCG64())
    return np.random.Generator(np.random.PCG64([seed, _seen(view), view.number, view.breaker, view.seat or 0]))


def _seen(view: View) -> int:
    """A number for where the balls lie."""
    places = repr(sorted(view.balls.items()))
    return int.from_bytes(hashlib.sha256(places.encode()).digest()[:8], "big")
