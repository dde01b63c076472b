"""What can any value function explain? Positions of the games behind `benchmarks.value`, each played on many times.

The chance to win a position is the mean over its continuations. Two continuations of one position share nothing but
that chance, so the product of their results, each less a half, estimates its squared distance from a half without
bias: no function of the position explains more of who wins than that, on average over positions.
"""

import itertools

import numpy as np

import client
from benchmarks import value
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from benchmarks.straight_pots import Potter
from referee import Game
from tournament.luck import VALUE

SEED = 23
POSITIONS, CONTINUATIONS = {True: 300, False: 5}, {True: 8, False: 2}
EVEN = 0.25
"""Mean square of a result less a half."""


def measure(full: bool) -> Tables:
    """One row."""
    return {"bound": [bound(POSITIONS[full], CONTINUATIONS[full])]}


def bound(positions: int, continuations: int) -> Row:
    """How much of who wins a perfect function would explain, and how much the one in use does."""
    chance = np.random.default_rng(SEED)
    explainable, explained = [], []
    for number in range(positions):
        game, noise = position(number, chance)
        won = np.array([wins(game, noise, number * continuations + each) for each in range(continuations)])
        away = won - 0.5
        explainable.append(np.mean([one * other for one, other in itertools.combinations(away, 2)]) / EVEN)
        explained.append(1.0 - np.mean((won - VALUE(game, game.turn, noise)) ** 2) / EVEN)
    return {
        "positions": positions,
        "continuations": continuations,
        "explainable": round(float(np.mean(explainable)), 4),
        "its_error": round(float(np.std(explainable, ddof=1) / np.sqrt(positions)), 4),
        "explained": round(float(np.mean(explained)), 4),
        "error_of_explained": round(float(np.std(explained, ddof=1) / np.sqrt(positions)), 4),
        "value": VALUE.source,
    }


def position(number: int, chance: np.random.Generator) -> tuple[Game, float]:
    """A turn of a game between two equal players, any stroke of it with equal chances, and the noise level."""
    while True:
        played = value.play(number)
        turns = [stroke.game for stroke in played.strokes if stroke.game.outcome is None]
        if turns:
            return turns[int(chance.integers(len(turns)))], played.header.terms.noise.level
        number += 100_000


def wins(game: Game, noise: float, number: int) -> float:
    """One continuation with noise of its own: 1 if the player in turn wins, a half for a draw."""
    players = [lambda seat=seat: Potter(True, 10_000_000 + 2 * number + seat) for seat in (0, 1)]
    (played,) = client.play(players[0], players[1], seed=SEED * 1_000_000 + number, noise=noise, start=game).games
    winner = played.outcome.winner
    return 0.5 if winner is None else float(winner == played.header.start.turn)


if __name__ == "__main__":
    main("value_bound", measure)
