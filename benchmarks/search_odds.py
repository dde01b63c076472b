"""What the race of `search` reckons against what its games show: the two numbers of `client.agents.search.odds`.

Games of the agent against itself, in lock-step. A turn is a row: the chance that the race gives the shooter, and
whether the shooter won the game. Shift and scale of the log-odds are fitted to the even pairs and judged on the odd
ones; what is copied is the fit to all. The breaker's share of the games is what a new rack is worth
(`client.agents.search.breaks`).
"""

import time

import numpy as np

from benchmarks.command import main
from benchmarks.lockstep import MatchUp, Played, play
from benchmarks.recording import Row, Tables
from benchmarks.strength import log_loss
from client.agents.search.odds import Odds
from client.agents.search.shots import Floats
from client.agents.search.shots import Tables as Positions
from client.agents.search.sight import Sight, Valuation
from client.agents.search.value import Values
from physics import Table

SEED = 101
PLAYER = "search:shots=1500"
PAIRS = {True: 80, False: 3}
LEVELS = (1.0, 2.0, 5.0)
TABLES = ("olympiad", "nine_foot")
ROUNDS, RIDGE = 50, 1e-3


def measure(full: bool) -> Tables:
    """A row for each table and level."""
    levels = LEVELS if full else LEVELS[-1:]
    return {"odds": [row(table, noise, PAIRS[full]) for table in TABLES for noise in levels]}


def row(table: str, noise: float, pairs: int) -> Row:
    """Play, fit on the even pairs, judge on the odd ones."""
    started = time.process_time()
    games = play(MatchUp((PLAYER, PLAYER), noise, table, seed=SEED, pairs=pairs))
    race, won, pair = turns(table, noise, games)
    even = pair % 2 == 0
    apart, all_of_them = fitted(race[even], won[even]), fitted(race, won)
    judged, truth = race[~even], won[~even]
    return {
        "table": table,
        "noise": noise,
        "games": len(games),
        "turns": len(won),
        "shift": round(all_of_them.shift, 3),
        "scale": round(all_of_them.scale, 3),
        "log_loss_of_race": log_loss(judged, truth),
        "log_loss": log_loss(apart.of(judged), truth),
        "log_loss_of_constant": log_loss(np.full(len(truth), won[even].mean()), truth),
        "breaks_kept": round(float(np.mean([game.kept for game in games])), 4),
        "breaks_won": round(float(np.mean([game.winner == game.breaker for game in games])), 4),
        "break_and_run": round(float(np.mean([game.run_out for game in games])), 4),
        "cpu_minutes": round((time.process_time() - started) / 60.0, 2),
    }


def turns(table: str, noise: float, games: list[Played]) -> tuple[Floats, Floats, Floats]:
    """Of every called stroke: the race's chance before it, whether its player won, and the pair."""
    values = Values(Sight(Table.named(table), noise), noise)
    found = [(turn, game) for game in games if game.winner is not None for turn in game.turns]
    positions = np.array([turn.positions for turn, _ in found])
    group, hand = np.array([turn.group for turn, _ in found], np.int8), np.array([turn.hand for turn, _ in found])
    race = values.raced(Positions(positions, group), positions, hand, Valuation())
    won = np.array([float(game.winner == turn.seat) for turn, game in found])
    return race, won, np.array([game.pair for _, game in found])


def fitted(race: Floats, won: Floats) -> Odds:
    """The likeliest shift and scale, by Newton's method."""
    known = np.clip(race, 1e-4, 1.0 - 1e-4)
    rows = np.stack((np.ones(len(race)), np.log(known / (1.0 - known))), axis=1)
    weights = np.array([0.0, 1.0])
    for _ in range(ROUNDS):
        chance = 1.0 / (1.0 + np.exp(-rows @ weights))
        slope = rows.T @ (won - chance) - RIDGE * weights
        curve = (rows * (chance * (1.0 - chance))[:, None]).T @ rows + RIDGE * np.eye(2)
        weights = weights + np.linalg.solve(curve, slope)
    return Odds(float(weights[0]), float(weights[1]))


if __name__ == "__main__":
    main("search_odds", measure)
