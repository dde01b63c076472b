"""`referee.rules.batch_rulings` rules as `EightBall.apply` does (docs/rules.md), on tables and strokes of all kinds."""

from typing import Any

import numpy as np
import pytest
from support.situations import RULES, TABLE

import physics
from referee.game import SAFETY, Action, Call, CueBallArea, Game, Group, Phase, callable_balls
from referee.rules.batch_rulings import OPEN, read_verdicts, target_balls

GROUPS = {OPEN: None, 0: (Group.SOLIDS, Group.STRIPES), 1: (Group.STRIPES, Group.SOLIDS)}
STROKES = 400


def crowded(chance, balls):
    """These balls and the cue ball at random, off the mouths and apart from one another."""
    found: dict[int, Any] = {}
    for ball in (0, *balls):
        while True:
            place = chance.uniform((0.08, 0.08), (TABLE.width - 0.08, TABLE.length - 0.08))
            if all(np.hypot(*(place - other)) > 0.06 for other in found.values()):
                found[ball] = place
                break
    return physics.TableState.from_positions({ball: tuple(place) for ball, place in found.items()})


LAYOUTS = {
    "open": (OPEN, (1, 2, 3, 5, 7, 8, 9, 11, 12, 14, 15)),
    "solids": (0, (2, 3, 4, 8, 9, 10, 13)),
    "stripes": (1, (1, 6, 8, 10, 14)),
    "on_the_8": (0, (8, 9, 15)),
    "only_the_8": (1, (8,)),
}


@pytest.mark.parametrize("area", [None, CueBallArea.KITCHEN], ids=["lies", "kitchen"])
@pytest.mark.parametrize("layout", LAYOUTS, ids=list(LAYOUTS))
def test_verdicts_are_the_rulings(layout, area):
    group, balls = LAYOUTS[layout]
    chance = np.random.default_rng(len(layout))
    seen = set()
    for _ in range(3):
        state = crowded(chance, balls)
        game = Game(state, Phase.PLAY, 0, 1, groups=GROUPS[group], cue_ball_in_hand=area)
        strokes = np.column_stack(
            (
                chance.uniform(0.5, 8.0, STROKES),
                chance.uniform(0.0, 360.0, STROKES),
                chance.uniform(0.0, 20.0, STROKES),  # some are blocked by balls and cushions: miscues
                chance.uniform(-20.0, 20.0, (STROKES, 1)),
                chance.uniform(-21.0, 21.0, (STROKES, 1)),
            )
        )
        batch = physics.simulate_batch(TABLE, state, strokes)
        ball, pocket = called(batch, callable_balls(game), chance)
        before, groups = np.repeat(state.positions[None], STROKES, axis=0), np.full(STROKES, group, np.int8)
        verdicts = read_verdicts(TABLE, before, groups, ball, pocket, batch, kitchen=area is not None)
        actions = [
            Action(physics.Shot(*stroke), SAFETY if one < 0 else Call(one, into))
            for stroke, one, into in zip(strokes.tolist(), ball.tolist(), pocket.tolist(), strict=True)
        ]
        for row, ruling in enumerate(RULES.apply_batch(game, actions, batch)):
            seen.add(agrees(verdicts, row, ruling))
    assert {"foul", "passes"} <= seen
    assert ("won" in seen and "lost" in seen) or layout not in ("on_the_8", "only_the_8")


def called(batch, balls, chance):
    """Calls that often come true: for two strokes of three what fell, if any; else anything, a safety now and then."""
    ball = chance.choice(balls, STROKES)
    pocket = chance.integers(0, 6, STROKES)
    for row in range(STROKES):
        fell = [one for one in balls if batch.pocket[row, one] >= 0]
        if fell and row % 3:
            ball[row], pocket[row] = fell[0], batch.pocket[row, fell[0]]
        elif row % 7 == 0:
            ball[row] = pocket[row] = -1
    return ball.astype(np.int64), pocket.astype(np.int64)


def agrees(verdicts, row, ruling):
    """Compare one row; what kind it was."""
    outcome, after = ruling.game.outcome, ruling.game
    won, lost = outcome is not None and outcome.winner == 0, outcome is not None and outcome.winner == 1
    assert (verdicts.won[row], verdicts.lost[row]) == (won, lost)
    assert verdicts.fouled[row] == bool(ruling.fouls)
    assert verdicts.played[row]
    assert verdicts.continues[row] == (outcome is None and after.turn == 0)
    if outcome is None:
        assert {number for number, pair in GROUPS.items() if pair == after.groups} == {int(verdicts.group[row])}
        assert (after.cue_ball_in_hand is CueBallArea.ANYWHERE) == bool(verdicts.fouled[row])
    return "won" if won else "lost" if lost else "foul" if ruling.fouls else "on" if after.turn == 0 else "passes"


def test_what_cannot_be_played_is_no_stroke():
    state = physics.TableState.from_positions({3: (0.5, 0.5), 8: (0.3, 1.0)})  # no cue ball
    batch = physics.simulate_batch(TABLE, state, np.array([[2.0, 0.0, 0.0, 0.0, 0.0]]))
    nothing = np.array([-1])
    verdicts = read_verdicts(TABLE, state.positions[None], np.array([0], np.int8), nothing, nothing, batch)
    assert not verdicts.played[0]


def test_target_balls_are_those_that_may_be_called():
    chance = np.random.default_rng(3)
    for group, balls in LAYOUTS.values():
        state = crowded(chance, balls)
        game = Game(state, Phase.PLAY, 0, 0, groups=GROUPS[group])
        targets = target_balls(state.positions[None], np.array([group], np.int8))[0]
        assert tuple(np.flatnonzero(targets).tolist()) == callable_balls(game)
