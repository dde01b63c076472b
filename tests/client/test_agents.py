"""The shipped agents: always legal, sensible where the stroke is plain, `greedy` far ahead of `random`."""

import math

import numpy as np
import pytest
from support.whole_game import whole_game

import client
import physics
from client import geometry
from client.agents.greedy.agent import _Turn
from client.agents.greedy.candidates import Candidates
from client.agents.greedy.worth import worth
from referee import Action, Call, CueBallArea, Decision, EightBall, EndReason, Game, Group, Outcome, Phase
from referee.play import NoiseModel

TABLE = physics.Table.olympiad()
RULES = EightBall(TABLE)
SNOOKERED = {0: (0.2, 0.2), 3: (0.9, 1.8)} | {
    ball: (0.2 + 0.07 * math.cos(angle), 0.2 + 0.07 * math.sin(angle))
    for ball, angle in zip((8, 9, 10, 11, 12), (0.0, 1.0, 2.0, 3.0, 5.2), strict=True)
}
"""The cue ball among five others, the only solid far away."""


def turn(balls, noise=1.0, **fields):
    """Greedy's view of a turn of seat 0 with these balls on the table."""
    game = Game(physics.TableState.from_positions(balls), fields.pop("phase", Phase.PLAY), 0, 0, **fields)
    chance = np.random.Generator(np.random.PCG64(1))
    return game, _Turn(RULES, game, noise, chance, client.Simulator())


@pytest.mark.parametrize("noise", [0.0, 1.0, pytest.param(5.0, marks=pytest.mark.slow)])
@pytest.mark.parametrize("pair", [("random", "random"), ("greedy", "random")], ids="-".join)
def test_no_action_of_a_shipped_agent_is_refused(pair, noise):
    """Whole games, every phase of them: breaks, ball in hand, decisions, the 8."""
    for seed in range(3):
        game, refused = whole_game([client.load(name, seed=seed) for name in pair], seed, noise)
        assert game.outcome.reason not in (EndReason.FORFEIT, EndReason.CONCESSION)
        assert refused == []


@pytest.mark.slow
def test_greedy_is_far_ahead_of_random():
    """It wins 99 of 100 (docs/agents.md): three lost of ten would happen to one seed in ten thousand."""
    assert client.play("greedy", "random", games=10, seed=21).score[0] >= 8.0


def test_greedy_plays_the_plain_pot():
    _, mine = turn({0: (0.5, 1.2), 3: (0.3, 0.5), 12: (0.9, 1.8)}, groups=(Group.SOLIDS, Group.STRIPES))
    action, value = mine.best_stroke()
    assert action.call.ball == 3
    assert value > 0.6


def test_greedy_finishes_on_the_eight():
    game, mine = turn({0: (0.5, 0.9), 8: (0.3, 0.5), 12: (0.9, 1.8)}, groups=(Group.SOLIDS, Group.STRIPES), noise=0.0)
    action, value = mine.best_stroke()
    assert action.call.ball == 8
    assert value == 1.0
    result = physics.simulate(TABLE, game.state, action.shot)
    assert RULES.apply(game, action, result.facts, result.final).game.outcome.reason is EndReason.EIGHT_MADE


def test_greedy_with_ball_in_hand_lines_up_the_pot():
    game, mine = turn(
        {3: (0.3, 0.5), 12: (0.9, 1.8)},
        groups=(Group.SOLIDS, Group.STRIPES),
        cue_ball_in_hand=CueBallArea.ANYWHERE,
    )
    action, value = mine.best_stroke()
    assert RULES.check(game, action) == ()
    placed = game.state.moved(0, action.cue_ball)
    assert geometry.pot(TABLE, placed, 3, action.call.pocket).cut < 5.0
    assert value > 0.65


def test_greedy_hidden_behind_balls_still_acts_legally():
    """Snookered: no straight way to any ball of its own, the 8 and stripes around the cue ball."""
    game, mine = turn(SNOOKERED, groups=(Group.SOLIDS, Group.STRIPES))
    assert geometry.pots(TABLE, game.state, (3,)) == []
    action, _ = mine.best_stroke()
    assert RULES.check(game, action) == ()


def test_greedy_takes_a_good_table_and_refuses_a_hopeless_one():
    """R12: accept the table with a plain pot on it, break again when a long one under much noise is left."""
    choices = {
        "decisions": (Decision.ACCEPT_TABLE, Decision.RERACK_AND_BREAK, Decision.OPPONENT_RERACKS),
        "choice": "R12",
        "phase": Phase.DECISION,
    }
    _, good = turn({0: (0.5, 0.9), 3: (0.3, 0.5), 8: (0.9, 1.2), 12: (0.9, 1.8)}, **choices)
    assert good.best_decision() == Action(decision=Decision.ACCEPT_TABLE)
    _, hopeless = turn({0: (0.1, 0.1), 3: (1.0, 1.8), 8: (0.3, 0.7)}, noise=5.0, **choices)
    assert hopeless.best_decision() == Action(decision=Decision.RERACK_AND_BREAK)


def test_with_nothing_but_the_eight_on_an_open_table_there_is_a_safety():
    """R23: all other balls went down without deciding the groups; no ball may be called."""
    game, mine = turn({0: (0.5, 0.9), 8: (0.3, 0.5)})
    action, _ = mine.best_stroke()
    assert action.call == "safety"
    assert RULES.check(game, action) == ()


def test_the_worth_of_situations_is_ordered():
    """Won, still at the table, opponent shooting, opponent with ball in hand, lost."""
    game, _ = turn({0: (0.5, 0.9), 3: (0.3, 0.5), 8: (0.9, 1.2)})
    mine = game
    theirs = Game(game.state, Phase.PLAY, 1, 0)
    in_hand = Game(game.state, Phase.PLAY, 1, 0, cue_ball_in_hand=CueBallArea.ANYWHERE)
    won, lost, drawn = (
        Game(game.state, Phase.OVER, 0, 0, outcome=Outcome(winner, EndReason.EIGHT_MADE, "R46"))
        for winner in (0, 1, None)
    )
    worths = [worth(each, 0) for each in (won, mine, theirs, in_hand, lost)]
    assert worths == sorted(worths, reverse=True)
    assert len(set(worths)) == 5
    assert worth(drawn, 0) == worth(drawn, 1) == 0.5


def test_candidates_keep_the_cue_free_of_neighbours():
    """The elevation leaves room for noise of direction and tip: 200 noisy strokes, hardly a miscue."""
    state = physics.TableState.from_positions({0: (0.5, 1.0), 3: (0.5, 0.6), 9: (0.5, 1.15)})
    (plan,) = Candidates(TABLE, 1.0)._aimed(state, None, 270.0, (2.0,), Call(3, 0))
    model = NoiseModel(1.0)
    seeds = [bytes([index]) * 32 for index in range(200)]
    shots = [model.perturb(plan.action.shot, seed, 0) for seed in seeds]
    miscues = sum(physics.check(TABLE, state, shot) is not None for shot in shots)
    assert miscues <= 4
