"""What `greedy` reads from arrays of verdicts is what it would read from the referee's rulings."""

from dataclasses import replace
from typing import Literal

import numpy as np
import pytest

from client.agents.greedy.worth import worth, worths_of
from physics import Shot, Table, TableState, simulate_batch
from referee import Action, Call, CueBallArea, EightBall, Game, Group, Phase
from referee.rules.batch_rulings import group_number, read_verdicts

RULES = EightBall(Table.olympiad())
CROWDED = Game(
    TableState.from_positions(
        {0: (0.5, 1.2), 1: (0.08, 0.07), 2: (0.3, 0.6), 8: (1.05, 1.1), 9: (0.6, 0.6), 10: (1.0, 2.15)}
    ),
    phase=Phase.PLAY,
    turn=0,
    breaker=0,
)
GAMES = {
    "open": CROWDED,
    "solids": replace(CROWDED, groups=(Group.SOLIDS, Group.STRIPES), visit_strokes=1),
    "stripes, stalemate near": replace(CROWDED, turn=1, groups=(Group.SOLIDS, Group.STRIPES), dry_visits=23),
    "no replay left": replace(CROWDED, turn=1, dry_visits=23, replays=2),
    "last stroke": replace(CROWDED, stroke=399),
    "on the 8": replace(CROWDED, groups=(Group.SOLIDS, Group.STRIPES), state=CROWDED.state.removed(1, 2)),
    "in hand": replace(CROWDED, cue_ball_in_hand=CueBallArea.ANYWHERE),
}


@pytest.mark.parametrize("name", GAMES)
def test_worths_of_verdicts_are_those_of_rulings(name):
    game, count = GAMES[name], 600
    chance = np.random.default_rng(5)
    shots = chance.uniform([1.0, 0.0, 20.0, -5.0, -5.0], [9.0, 360.0, 30.0, 5.0, 5.0], (count, 5))
    ball = chance.choice(RULES.legal(game).callable, count)
    pocket = chance.integers(0, 6, count)
    safe = chance.random(count) < 0.1
    calls: list[Call | Literal["safety"]] = [
        "safety" if none else Call(int(one), int(into)) for one, into, none in zip(ball, pocket, safe, strict=True)
    ]
    batch = simulate_batch(RULES.table, game.state, shots)
    actions = [Action(Shot(*shot), call) for shot, call in zip(shots.tolist(), calls, strict=True)]
    expected = [worth(ruling.game, game.turn) for ruling in RULES.apply_batch(game, actions, batch)]
    before = np.repeat(game.state.positions[None], count, axis=0)
    group = np.full(count, group_number(game.group_of(game.turn)), np.int8)
    verdicts = read_verdicts(RULES.table, before, group, np.where(safe, -1, ball), np.where(safe, -1, pocket), batch)
    assert worths_of(game, verdicts, batch, RULES.limits).tolist() == expected
    assert len(set(expected)) > 1 or name == "last stroke"
