"""Strokes of many games at once: one batch through the physics, each ruling on its own."""

from collections.abc import Sequence

import numpy as np

from physics import Facts, Shot, simulate_batch
from physics.shot import FIELDS
from referee.game import Action, Game, Ruling
from referee.play.noise import NoiseModel
from referee.play.seeds import GameSeeds
from referee.play.stroke import Refused, racked, without_negative_zeros
from referee.rules import EightBall
from referee.rules.checks import start_state

Played = tuple[Ruling, Game]
"""The ruling, and the game as it goes on, racked again if the ruling says so."""


def play_strokes(
    rules: EightBall,
    games: Sequence[Game],
    actions: Sequence[Action],
    seeds: Sequence[GameSeeds],
    noise: NoiseModel,
    *,
    threads: int = 1,
) -> list[Played | Refused]:
    """One action of the player in turn in each of many games: what ``play_stroke`` would make of each, bit for bit.

    Args:
        rules, noise: of all games. games, actions, seeds: one each.
        threads: of the physics.

    Returns:
        for each game its ruling and how it goes on, or why the action is not accepted.
    """
    asked = [without_negative_zeros(action) for action in actions]
    trios = zip(games, asked, seeds, strict=True)
    answers: list[Played | Refused | None] = [_at_once(rules, *trio) for trio in trios]
    rows = [row for row, answer in enumerate(answers) if answer is None]
    if rows:
        shots = [_noisy(asked[row], games[row], seeds[row], noise) for row in rows]
        before = np.stack([start_state(games[row], asked[row]).positions for row in rows])
        values = np.array([[getattr(shot, name) for name in FIELDS] for shot in shots])
        batch = simulate_batch(rules.table, before, values, threads=threads)
        for place, row in enumerate(rows):
            facts = Facts.from_record(batch.facts[place])
            ruling = rules.apply(games[row], asked[row], facts, batch.state(place))
            answers[row] = ruling, racked(rules, ruling, games[row], seeds[row])
    return [answer for answer in answers if answer is not None]


def _at_once(rules: EightBall, game: Game, action: Action, seeds: GameSeeds) -> Played | Refused | None:
    """What needs no physics: a refusal or a decision; None for a stroke."""
    if refusals := rules.check(game, action):
        return Refused(refusals)
    if action.shot is not None:
        return None
    ruling = rules.apply(game, action, None, None)
    return ruling, racked(rules, ruling, game, seeds)


def _noisy(action: Action, game: Game, seeds: GameSeeds, noise: NoiseModel) -> Shot:
    assert action.shot is not None
    return noise.perturb(action.shot, seeds.noise_seed, game.stroke)
