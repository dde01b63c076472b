"""Whole games of random legal actions, to their end, with what must hold throughout."""

import json
from collections.abc import Iterator
from math import isnan
from random import Random
from typing import Literal

from hypothesis import given, settings
from hypothesis import strategies as st
from support.situations import RULES, TABLE, Place, R, ghost, towards

import physics
from physics.shot import Shot
from referee.game import (
    Action,
    Call,
    CueBallArea,
    Decision,
    EndReason,
    Game,
    Legal,
    Outcome,
    Phase,
    Ruling,
    remaining,
)

SKILL = 0.7
"""Share of strokes that are aimed; the rest go anywhere. Aimed strokes are what brings games to the 8."""


def a_place(random: Random, game: Game, area: CueBallArea) -> Place:
    low = TABLE.head_string if area is CueBallArea.KITCHEN else R
    while True:
        place = (random.uniform(R, TABLE.width - R), random.uniform(low, TABLE.length - R))
        if not RULES.check(game, Action(shot=Shot(1.0, 0.0, 70.0), call="safety", cue_ball=place)):
            return place
        if game.phase is Phase.BREAK:
            return (random.uniform(0.2, 0.9), random.uniform(low + 0.001, 2.0))


def a_call(random: Random, allowed: Legal) -> Call | Literal["safety"] | None:
    if not allowed.call_required:
        return None
    if not allowed.callable or random.random() < 0.05:
        return "safety"
    return Call(random.choice(allowed.callable), random.choice(allowed.pockets))


def a_direction(random: Random, game: Game, call: Call | str | None, place: Place) -> float:
    if game.phase is Phase.BREAK:
        return towards(place, TABLE.foot_spot) + random.gauss(0.0, 2.0)
    if not isinstance(call, Call) or random.random() > SKILL:
        return random.uniform(0.0, 360.0)
    ball = tuple(game.state.positions[call.ball].tolist())
    mouth = tuple(TABLE.mouths[call.pocket].tolist())
    return towards(place, ghost(ball, mouth)) + random.gauss(0.0, 0.2)


def an_action(random: Random, game: Game) -> Action:
    """A legal action, made from what ``legal`` says and nothing else."""
    allowed = RULES.legal(game)
    if "decision" in allowed.actions:
        return Action(decision=random.choice(allowed.decisions))
    while True:
        place = a_place(random, game, allowed.cue_ball) if allowed.cue_ball else None
        before = game.state if place is None else game.state.moved(0, place)
        start = before.position(0)
        assert start is not None
        call = a_call(random, allowed)
        phi = a_direction(random, game, call, start)
        theta = physics.min_elevation(TABLE, before, phi)
        if not isnan(theta):
            v = random.uniform(1.0, 10.0) if game.phase is Phase.BREAK else random.uniform(0.5, 5.0)
            shot = Shot(v, phi, min(theta + 0.01, 70.0))
            return Action(shot=shot, call=call, cue_ball=place)


def moves(seed: int) -> Iterator[tuple[Game, Action, Ruling, Game]]:
    """Game before, action, ruling, game after (racked again if need be)."""
    random = Random(seed)
    game = RULES.new_game(seed, breaker=seed % 2)
    while not game.is_over:
        action = an_action(random, game)
        assert RULES.check(game, action) == ()
        if action.shot is None:
            ruling = RULES.apply(game, action)
        else:
            before = game.state if action.cue_ball is None else game.state.moved(0, action.cue_ball)
            result = physics.simulate(TABLE, before, action.shot, trace=False)
            ruling = RULES.apply(game, action, result.facts, result.final)
        after = RULES.rerack(ruling.game, random.randrange(2**32)) if ruling.rerack else ruling.game
        yield game, action, ruling, after
        game = after


def objects(game: Game) -> set[int]:
    return set(game.state.balls) - {0}


def assert_balls_come_back_only_from_a_rack_or_the_spot(before: Game, ruling: Ruling, after: Game) -> None:
    back = objects(after) - objects(before)
    if ruling.rerack:
        assert objects(after) == set(range(1, 16))
    else:
        assert back <= ({8} if "R31" in ruling.rules else set())
    if "R31" in ruling.rules:
        assert before.phase in (Phase.BREAK, Phase.DECISION)


def assert_consistent(game: Game) -> None:
    allowed = RULES.legal(game)
    assert game.turn in (0, 1)
    assert Game.from_dict(json.loads(json.dumps(game.to_dict()))) == game
    assert (game.outcome is not None) == game.is_over
    assert bool(game.decisions) == (game.phase is Phase.DECISION) == (game.choice is not None)
    if game.phase in (Phase.BREAK, Phase.DECISION):
        assert game.groups is None
    if game.phase is Phase.PLAY:
        assert 8 in game.state.balls
        assert 0 in game.state.balls or game.cue_ball_in_hand is not None
        assert allowed.safety
        assert allowed.callable == (remaining(game, game.turn) or ((8,) if game.groups else ()))
    assert game.stroke <= RULES.limits.strokes
    assert game.dry_visits <= RULES.limits.dry_visits


def assert_ruling(before: Game, action: Action, ruling: Ruling) -> None:
    assert ruling.rules
    assert len(set(ruling.rules)) == len(ruling.rules)
    assert set(ruling.fouls) <= set(ruling.rules)
    assert ruling.words.endswith(".")
    assert ruling.game.stroke == before.stroke + (action.shot is not None)
    json.dumps(ruling.to_dict(), allow_nan=False)
    if before.groups is not None and ruling.game.phase is Phase.PLAY:
        assert ruling.game.groups == before.groups, "groups never change once fixed"
    if ruling.fouls and ruling.game.phase is Phase.PLAY:
        assert ruling.turn != before.turn
        assert ruling.game.cue_ball_in_hand is not None
    if ruling.made and ruling.game.phase is Phase.PLAY:
        assert ruling.turn == before.turn


def assert_result(outcome: Outcome | None) -> None:
    assert outcome is not None
    drawn = outcome.reason in (EndReason.STALEMATE, EndReason.STROKE_LIMIT)
    assert (outcome.winner is None) == drawn
    assert outcome.winner in (None, 0, 1)


@settings(max_examples=150)
@given(st.integers(min_value=0, max_value=2**32))
def test_random_game_runs_to_its_end(seed):
    """R1 to R51 together."""
    after = None
    for before, action, ruling, after in moves(seed):
        assert_ruling(before, action, ruling)
        assert_balls_come_back_only_from_a_rack_or_the_spot(before, ruling, after)
        assert_consistent(after)
    assert after is not None
    assert_result(after.outcome)


def test_games_are_a_fair_sample():
    """The random games reach what they are meant to reach: groups, wins and losses on the 8, choices."""
    reasons, decisions = set(), set()
    for seed in range(60):
        played = list(moves(seed))
        decisions |= {action.decision for _, action, _, _ in played}
        outcome = played[-1][3].outcome
        assert outcome is not None
        reasons.add(outcome.reason)
    assert {EndReason.EIGHT_MADE, EndReason.EIGHT_TOO_EARLY, EndReason.EIGHT_WITH_FOUL} <= reasons
    assert decisions & {Decision.ACCEPT_TABLE, Decision.SPOT_EIGHT, Decision.BALL_IN_HAND}


def test_a_game_is_a_pure_function_of_its_actions():
    """Same seed, same game, bit for bit."""
    assert [after for *_, after in moves(11)] == [after for *_, after in moves(11)]
