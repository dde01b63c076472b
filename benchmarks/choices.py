"""What a budget buys: the worth of the stroke that `search` chooses, judged afterwards by copies without a part in it.

Positions come from lock-step games. In each, every player thinks once, and its choice is played many times under
fresh noise, the same for all; the mean of what the tables left are worth is the worth of the choice. Differences are
paired by position: sixty tell half a hundredth. The judge is the agent's own value of tables, so that this
measures how well it finds what it looks for, not whether it looks for the right thing; games tell that (`strength`).
"""

import math
from collections.abc import Iterator, Sequence

import numpy as np

import physics
from benchmarks.command import main
from benchmarks.lockstep import MatchUp, play
from benchmarks.recording import Row, Tables
from client.agents.registry import options_of
from client.agents.search.budget import Budget, Pace
from client.agents.search.evaluate import Evaluator, Responder, answered
from client.agents.search.explaining import thought_about
from client.agents.search.options import Options
from client.agents.search.shots import Shots
from client.agents.search.shots import Tables as Positions
from client.agents.search.sight import Sight
from client.agents.search.value import Values
from physics import Table, TableState
from referee import Action, Call, EightBall, Game, Group, Phase
from referee.rules.batch_rulings import SAFETY_CALL

PLAYERS = (
    "shots=1000",
    "shots=1000,even_draws=off",
    "shots=10000",
    "shots=10000,polish=off",
    "shots=10000,even_draws=off",
)
"""The first is what the others are compared with."""
SHORT = ("shots=300", "shots=1000")
SCENES = (("olympiad", 1.0), ("nine_foot", 2.0), ("nine_foot", 5.0))
POSITIONS, COPIES = {True: 60, False: 4}, {True: 600, False: 50}
GROUPS = {-1: None, 0: (Group.SOLIDS, Group.STRIPES), 1: (Group.STRIPES, Group.SOLIDS)}
SEED = 77


def measure(full: bool) -> Tables:
    """A row for each table, noise and player."""
    players = PLAYERS if full else SHORT
    scenes = SCENES if full else SCENES[-1:]
    return {"choices": [row for scene in scenes for row in rows(*scene, players, POSITIONS[full], COPIES[full])]}


def rows(table: str, noise: float, players: Sequence[str], count: int, copies: int) -> Iterator[Row]:
    """What each player's choices are worth in the same positions."""
    games = positions(table, noise, count)
    found = np.array(
        [[judged(table, noise, game, player, n, copies) for player in players] for n, game in enumerate(games)]
    )
    for place, player in enumerate(players):
        worth, reckoned, simulated = found[:, place].T
        gain = worth - found[:, 0, 0]
        yield {
            "table": table,
            "noise": noise,
            "player": player,
            "positions": len(games),
            "worth": round(float(worth.mean()), 4),
            "gain": round(float(gain.mean()), 4),
            "gain_error": round(float(gain.std(ddof=1) / math.sqrt(len(gain))), 4),
            "reckoned_too_high": round(float((reckoned - worth).mean()), 4),
            "shots": round(float(simulated.mean())),
        }


def positions(table: str, noise: float, count: int) -> list[Game]:
    """Turns of lock-step games, drawn by lot."""
    turns: list[Game] = []
    first = 0
    while len(turns) < count:
        match = MatchUp(("search:shots=300",) * 2, noise, table, seed=SEED, first=first, pairs=6)
        turns += [_game(turn.positions, turn.group) for game in play(match) for turn in game.turns]
        first += match.pairs
    chosen = np.random.default_rng(SEED).permutation(len(turns))[:count]
    return [turns[place] for place in chosen]


def _game(lies: np.ndarray, group: int) -> Game:
    """A turn of seat 0."""
    balls = {ball: (float(x), float(y)) for ball, (x, y) in enumerate(lies) if not math.isnan(x)}
    return Game(TableState.from_positions(balls), Phase.PLAY, 0, 0, groups=GROUPS[group])


def judged(table: str, noise: float, game: Game, player: str, number: int, copies: int) -> tuple[float, float, int]:
    """What a player's choice is worth, what it was reckoned to be, and the shots that took."""
    rules = EightBall(Table.named(table))
    thought = thought_about(rules, game, noise, Options(**options_of(player, player)), seed=number)  # type: ignore[arg-type]
    values = Values(Sight(rules.table, noise), noise)
    fresh = np.random.default_rng([SEED, number])
    evaluator = Evaluator(rules.table, values, noise, fresh, Budget(Pace()), kitchen=False)
    shots = _shots(game, thought.action)
    worth = answered(evaluator.noisy(shots, copies), Responder(rules.table, values, physics.simulate_batch))
    return float(worth.mean()), thought.worth, thought.simulated


def _shots(game: Game, action: Action) -> Shots:
    """A choice as the evaluator takes it."""
    shot, call = action.shot, action.call
    if shot is None:
        raise ValueError(f"action = {action!r}: must be a stroke")
    ball, pocket = (call.ball, call.pocket) if isinstance(call, Call) else (SAFETY_CALL, SAFETY_CALL)
    group = next(number for number, groups in GROUPS.items() if groups == game.groups)
    return Shots(
        Positions(game.state.positions[None].copy(), np.array([group], np.int8)),
        np.zeros(1, np.int64),
        np.array([[shot.v, shot.phi, shot.theta, shot.a, shot.b]]),
        np.array([ball]),
        np.array([pocket]),
        np.zeros(1),
    )


if __name__ == "__main__":
    main("choices", measure)
