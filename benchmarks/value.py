"""The weights of `tournament.luck.value`: a logistic regression on who won, over every turn of many games.

Two equal players by geometry (`benchmarks.straight_pots`), the noise level drawn for each game; a fifth of the games is
kept
out of the fit to see how well it predicts. Between equal players who wins is due to the situation and the noise alone.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

import client
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from benchmarks.straight_pots import Potter
from client.local_game import PlayedGame
from tournament.luck.value import FEATURES, features

SEED = 11
GAMES = {True: 2400, False: 20}
RIDGE = 1.0
"""Prior precision of every weight: as good as none for features that occur often."""
HIGHEST = 5.0

Floats = NDArray[np.float64]


def measure(full: bool) -> Tables:
    """Fit on four fifths of the games, predict the rest."""
    games = [play(number) for number in range(GAMES[full])]
    kept = [index % 5 == 0 for index in range(len(games))]
    fitted = [game for game, out in zip(games, kept, strict=True) if not out]
    held = [game for game, out in zip(games, kept, strict=True) if out]
    weights = fit(*rows_of(fitted))
    return {
        "weights": [{"feature": name, "weight": round(float(w), 4)} for name, w in zip(FEATURES, weights, strict=True)],
        "prediction": [predicted(weights, held)],
        "calibration": calibration(weights, held),
    }


def play(number: int) -> PlayedGame:
    """One game of two equal players at its own noise level."""
    level = HIGHEST * float(np.random.default_rng((SEED, number)).random())
    players = [lambda seat=seat: Potter(True, 2 * number + seat) for seat in (0, 1)]
    (game,) = client.play(players[0], players[1], seed=SEED * 100_000 + number, noise=level).games
    return game


def rows_of(games: Sequence[PlayedGame]) -> tuple[Floats, Floats]:
    """A row for every turn: the features, and whether the player in turn won. Drawn games are passed over."""
    rows, won = [], []
    for played in games:
        if played.outcome.winner is None:
            continue
        for game in [played.header.start, *(stroke.game for stroke in played.strokes)]:
            if game.outcome is None:
                found = features(game, played.header.terms.noise.level)
                rows.append([found.get(name, 0.0) for name in FEATURES])
                won.append(float(game.turn == played.outcome.winner))
    return np.array(rows), np.array(won)


def fit(rows: Floats, won: Floats) -> Floats:
    """Logistic regression with a weak ridge, by Newton's method."""
    weights = np.zeros(rows.shape[1])
    for _ in range(50):
        chance = 1.0 / (1.0 + np.exp(-rows @ weights))
        slope = rows.T @ (won - chance) - RIDGE * weights
        curve = (rows * (chance * (1.0 - chance))[:, None]).T @ rows + RIDGE * np.eye(len(weights))
        step = np.linalg.solve(curve, slope)
        weights = weights + step
        if np.abs(step).max() < 1e-10:
            break
    return weights


def predicted(weights: Floats, games: Sequence[PlayedGame]) -> Row:
    """How well the chances fit games that the weights have not seen."""
    rows, won = rows_of(games)
    chance = 1.0 / (1.0 + np.exp(-rows @ weights))
    loss = -np.mean(won * np.log(chance) + (1.0 - won) * np.log(1.0 - chance))
    even = float(np.mean((won - 0.5) ** 2))
    return {
        "games": len(games),
        "turns": len(won),
        "log_loss": round(float(loss), 4),
        "log_loss_of_a_half": round(float(np.log(2.0)), 4),
        "variance_explained": round(1.0 - float(np.mean((won - chance) ** 2)) / even, 4),
    }


def calibration(weights: Floats, games: Sequence[PlayedGame]) -> list[Row]:
    """Chances by fifths of [0, 1] beside the share won."""
    rows, won = rows_of(games)
    chance = 1.0 / (1.0 + np.exp(-rows @ weights))
    bins = np.minimum((chance * 5.0).astype(int), 4)
    return [
        {
            "chance_from": 0.2 * index,
            "turns": int((bins == index).sum()),
            "mean_chance": round(float(chance[bins == index].mean()), 3),
            "share_won": round(float(won[bins == index].mean()), 3),
        }
        for index in range(5)
        if (bins == index).any()
    ]


if __name__ == "__main__":
    main("value", measure)
