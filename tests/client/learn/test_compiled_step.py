"""The compiled step, game by game: `codec` says what an action is, physics and referee what follows."""

from collections import Counter
from copy import deepcopy
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support.situations import situation

from client.learn import EightBallVectorEnv, act, observe
from client.learn.codec import ACTION_SIZE
from client.learn.games import Games
from client.learn.rows import row_of
from physics import Shot, Table, simulate
from physics.shot import FIELDS
from referee import CueBallArea, EightBall, Game, Group, Limits, NoiseModel, Phase
from referee.rules.rack import (
    apex_on_foot_spot,
    back_corners_differ,
    balls_separated,
    eight_in_third_row,
)

SHORT = Limits(dry_visits=5, replays=1, strokes=40)
TABLES = {"olympiad": Table.olympiad(), "nine_foot": Table.nine_foot()}
LAST = {0: (0.5, 1.7), 8: (0.06, 0.06), 12: (1.05, 0.07)}
STARTS = {
    "break": None,
    "8 at a pocket": situation(LAST, groups=(Group.STRIPES, Group.SOLIDS)),
    "on the 8": situation({0: (0.5, 0.9), 8: (0.06, 0.06)}, groups=(Group.SOLIDS, Group.STRIPES)),
    "kitchen": situation({3: (0.4, 0.6), 8: (0.9, 0.4), 5: (0.6, 1.9)}, cue_ball_in_hand=CueBallArea.KITCHEN),
}


def by_referee(rules: EightBall, game: Game, vector: Any, noise: NoiseModel, draw: Any) -> Game:
    """The game after an action, by the referee and `simulate`; a new rack is still awaited."""
    action = act(rules.table, game, vector)
    assert rules.check(game, action) == ()
    if action.shot is None:
        return rules.apply(game, action).game
    meant = np.array([[getattr(action.shot, name) for name in FIELDS]])
    shot = Shot(*noise.perturb_rows(meant, draw[None], rules.table)[0].tolist())
    state = game.state if action.cue_ball is None else game.state.moved(0, action.cue_ball)
    result = simulate(rules.table, state, shot, event_limit=rules.limits.events)
    return rules.apply(game, action, result.facts, result.final).game


@pytest.mark.parametrize(
    ("table", "start", "level", "rounds"),
    [
        ("olympiad", "break", 1.0, 40),
        ("olympiad", "break", 0.0, 10),
        ("olympiad", "8 at a pocket", 1.0, 12),
        ("olympiad", "on the 8", 3.0, 12),
        ("olympiad", "kitchen", 1.0, 6),
        ("nine_foot", "break", 1.0, 10),
    ],
)
def test_games_are_the_referees_bit_for_bit(table, start, level, rounds):
    """Every action of 48 games: both observations before it, the game after it, racks by the rules of racks."""
    rules, noise, count = EightBall(TABLES[table], SHORT), NoiseModel(level), 48
    begin = None if STARTS[start] is None else rules.begin_from(STARTS[start])
    games, chance, actions = Games(rules, noise, count, start=begin), np.random.default_rng(1), np.random.default_rng(2)
    games.begin(np.arange(count), chance)
    seen: Counter[Any] = Counter()
    for _ in range(rounds):
        games.begin(np.flatnonzero(games.over), chance)
        rows = np.arange(count)
        before = [games.game(row) for row in rows.tolist()]
        for seat in (0, 1):
            found = games.observed(rows, np.full(count, seat))
            np.testing.assert_array_equal(found, [observe(rules.table, game, seat) for game in before])
        vectors = actions.uniform(-1.2, 1.2, (count, ACTION_SIZE))
        draws = deepcopy(chance).standard_normal((count, len(FIELDS)))
        games.play(rows, vectors, chance)
        for row, game in enumerate(before):
            expected, after = by_referee(rules, game, vectors[row], noise, draws[row]), games.game(row)
            np.testing.assert_array_equal(row_of(after), games.state[row])
            if expected.phase is Phase.RERACK:
                assert_racked(rules, after)
                assert after.rack == expected.rack + 1
                after = replace(after, state=expected.state, phase=Phase.RERACK, cue_ball_in_hand=None, rack=game.rack)
            assert after == expected
            seen[expected.phase, expected.choice, expected.outcome and expected.outcome.rule] += 1
    if rounds == 40:
        assert {(Phase.RERACK, None, None), (Phase.OVER, None, "R49"), (Phase.DECISION, "R12", None)} <= set(seen)
    if start in ("8 at a pocket", "on the 8"):
        assert {rule for _, _, rule in seen} & {"R42", "R43", "R44", "R46"}


def assert_racked(rules: EightBall, game: Game) -> None:
    """R1 to R7."""
    assert game.phase is Phase.BREAK
    assert game.cue_ball_in_hand is CueBallArea.KITCHEN
    for holds in (apex_on_foot_spot, eight_in_third_row, back_corners_differ, balls_separated):
        assert holds(rules.table, game.state), holds


@pytest.mark.parametrize("choice", ["R12", "R12a", "R13", "R14", "R16", "R17"])
def test_every_decision_is_the_referees(choice):
    """All that a choice offers, the 8 spotted among them, with and without a cue ball."""
    rules, noise = EightBall(TABLES["olympiad"]), NoiseModel(0.0)
    balls = {3: (0.4, 0.6), 12: (0.3, 1.2)}
    if choice not in ("R13", "R14"):
        balls |= {8: (0.9, 0.4)}
    asked = (
        [rules.begin_from(situation(balls | {0: (0.5, 1.7)}, Phase.DECISION, choice=choice))] if choice != "R14" else []
    )
    if choice in ("R12a", "R14"):
        asked.append(rules.begin_from(situation(balls, Phase.DECISION, choice=choice)))
    for game in asked:
        games, chance = Games(rules, noise, 40, start=game), np.random.default_rng(1)
        rows, vectors = np.arange(40), np.zeros((40, ACTION_SIZE))
        vectors[:, -1] = np.linspace(-1.0, 1.0, 40)
        games.begin(rows, chance)
        games.play(rows, vectors, chance)
        for row in rows.tolist():
            expected, after = by_referee(rules, game, vectors[row], noise, np.zeros(5)), games.game(row)
            if expected.phase is Phase.RERACK:
                after = replace(after, state=expected.state, phase=Phase.RERACK, cue_ball_in_hand=None, rack=game.rack)
            assert after == expected


def test_racks_are_by_the_rules_and_every_arrangement_is_as_likely():
    """2,000 racks: R1 to R5, and each ball at each free place about as often (5 sigma)."""
    rules, count = EightBall(TABLES["olympiad"]), 2_000
    games = Games(rules, NoiseModel(1.0), count)
    games.begin(np.arange(count), np.random.default_rng(4))
    for row in range(100):
        assert_racked(rules, games.game(row))
    apex = (np.hypot(*(games.places - rules.table.foot_spot).transpose(2, 0, 1)) < 1e-5).argmax(axis=1)
    often = np.bincount(apex, minlength=16)
    assert often[0] == often[8] == 0
    # A ball is in a back corner with chance 1/7, else at each of the 12 free places as often: 6/7 / 12 = 1/14.
    expected = count / 14
    assert (abs(often[[*range(1, 8), *range(9, 16)]] - expected) < 5 * np.sqrt(expected)).all()
    assert len(np.unique(games.places.round(12), axis=0)) == count


def test_ten_thousand_games_need_little_memory():
    """Bytes of all arrays that an environment keeps: under 200 MB; a round's own are of the same size."""
    env = EightBallVectorEnv(10_000)
    env.reset(seed=1)
    kept = env._games.places.nbytes + env._games.state.nbytes + env._seats.nbytes
    assert kept < 10e6
    seen, _, _, _, _ = env.step(np.zeros((10_000, ACTION_SIZE), np.float32))
    assert seen.nbytes < 10e6
