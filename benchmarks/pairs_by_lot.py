"""Pairs of games by lot with known expected scores, for studies of statistics.

The expected score of a game is e on average over the two games of a pair and differs by the break; a share of games is
drawn; with probability ``KINSHIP`` the second game repeats the first one's luck, as games on the same racks may.
"""

import numpy as np
from numpy.typing import NDArray

BREAK = 0.3
"""Advantage of the break, as a share of the smaller of e and 1 - e."""
KINSHIP = 0.3

Counts = NDArray[np.int64]


def cell_chances(score: float, draws: float) -> NDArray[np.float64]:
    """Probabilities of the five cells; their mean is exactly ``score``.

    Args:
        score: expected score of the first player.
        draws: share of draws, of the greatest share that the score allows.
    """
    edge = BREAK * min(score, 1.0 - score)
    first, second = (game_chances(score + sign * edge, draws) for sign in (1.0, -1.0))
    cells = (1.0 - KINSHIP) * np.convolve(first, second)
    for low, high, cell in overlap(first, second):
        cells[cell] += KINSHIP * (high - low)
    chances: NDArray[np.float64] = cells
    return chances


def game_chances(score: float, draws: float) -> NDArray[np.float64]:
    """Probabilities of losing, drawing and winning a game."""
    drawn = draws * 2.0 * min(score, 1.0 - score)
    return np.array([1.0 - score - drawn / 2.0, drawn, score - drawn / 2.0])


def overlap(first: NDArray[np.float64], second: NDArray[np.float64]) -> list[tuple[float, float, int]]:
    """Where one uniform number decides both games: its stretches, and the cell of each."""
    one, other = np.cumsum(first), np.cumsum(second)
    cuts = np.unique(np.clip([0.0, *one, *other, 1.0], 0.0, 1.0))
    middles = 0.5 * (cuts[1:] + cuts[:-1])
    cells = np.minimum(np.searchsorted(one, middles), 2) + np.minimum(np.searchsorted(other, middles), 2)
    return list(zip(cuts[:-1].tolist(), cuts[1:].tolist(), cells.tolist(), strict=True))


def draw_cells(score: float, draws: float, shape: tuple[int, ...], chance: np.random.Generator) -> Counts:
    """Cells of pairs, 0 to 4, by lot."""
    cells: Counts = chance.choice(5, size=shape, p=cell_chances(score, draws))
    return cells
