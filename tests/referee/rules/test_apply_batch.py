"""``apply_batch`` gives the same answers as ``apply``."""

from random import Random

import numpy as np
import pytest
from support.situations import RULES, SOLIDS, TABLE, situation

import physics
from physics.shot import Shot
from referee.errors import InvalidAction
from referee.game import Action, Call

BALLS = {0: (0.6, 1.118), 3: (0.9, 1.118), 5: (0.8, 0.4), 8: (0.3, 0.5), 11: (0.5, 0.4), 12: (0.3, 1.9)}


def test_batch_of_strokes_is_ruled_like_single_ones():
    random = Random(1)
    game = situation(BALLS, groups=SOLIDS)
    shots = [
        Shot(random.uniform(0.5, 6.0), random.uniform(0, 360), random.uniform(0, 20), b=random.uniform(-9, 9))
        for _ in range(300)
    ]
    shots.append(Shot(2.0, 0.0, 10.0, a=40.0))
    actions = [Action(shot=shot, call=Call(3, 4)) for shot in shots]
    rows = np.array([[shot.v, shot.phi, shot.theta, shot.a, shot.b] for shot in shots])
    batch = physics.simulate_batch(TABLE, game.state, rows)
    rulings = RULES.apply_batch(game, actions, batch)
    for action, ruling in zip(actions, rulings, strict=True):
        assert action.shot is not None
        result = physics.simulate(TABLE, game.state, action.shot)
        assert ruling == RULES.apply(game, action, result.facts, result.final)
    assert any("R39" in ruling.fouls for ruling in rulings)
    assert any(ruling.made for ruling in rulings)


def test_one_action_a_row():
    game = situation(BALLS, groups=SOLIDS)
    batch = physics.simulate_batch(TABLE, game.state, np.array([[1.0, 0.0, 10.0, 0.0, 0.0]]))
    with pytest.raises(InvalidAction, match="1 actions, one for each row"):
        RULES.apply_batch(game, [], batch)
