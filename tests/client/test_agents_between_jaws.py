"""The shipped agents on tables with jaws (docs/agents.md): whole games, the break, and pots that need aiming."""

from collections import Counter

import pytest

import client
import physics
from client import geometry
from client.agents.greedy.candidates import Candidates
from client.agents.search.breaks import best_break
from physics.table import NAMED
from referee import Call, EightBall, Phase
from referee.record import verify_record

NINE = physics.Table.nine_foot()
BY_RULE = {"R42", "R43", "R44", "R45", "R46", "R49"}


@pytest.mark.parametrize(
    ("first", "second", "seed"),
    [("random", "random", 2), ("greedy", "random", 1), ("search:shots=400,safeties=off", "random", 1)],
)
def test_whole_games_end_by_the_rules(first, second, seed):
    match = client.play(first, second, seed=seed, table=NINE)
    (game,) = match.games
    assert game.outcome.rule in BY_RULE
    assert game.header.terms.rules.table == NINE
    assert verify_record(list(game.record())).ok


def test_search_makes_what_it_calls():
    """16 of 16 in the first games that were measured, at noise 1; a miss of everything would be no geometry at all."""
    match = client.play("search:shots=1500,safeties=off", "random", seed=1, table=NINE)
    calls = [
        stroke.ruling.made
        for stroke in match.games[0].strokes
        if stroke.seat == 0 and isinstance(stroke.action.call, Call)
    ]
    assert match.winner == "search-shots-1500-safeties-off"
    assert sum(calls) >= 0.75 * len(calls)
    assert Counter(calls)[True] >= 5


@pytest.mark.parametrize("name", sorted(NAMED))
@pytest.mark.parametrize("noise", [0.0, 1.0, 5.0])
def test_the_studied_break_can_be_played_on_every_table(name, noise):
    table = physics.Table.named(name)
    rules = EightBall(table)
    game = rules.new_game(3)
    assert game.phase is Phase.BREAK
    one = best_break(noise, table)
    assert geometry.is_free(table, game.state, one.place, kitchen=True)
    state = game.state.moved(0, one.place)
    result = physics.simulate(table, state, one.stroke(table, state))
    assert result.facts.miscue == 0
    moved = (result.final.positions - state.positions)[1:]
    assert (abs(moved).max(axis=1) > 0.05).sum() >= 4, "the rack is broken"


def test_greedy_aims_off_the_ghost_ball_where_balls_throw():
    """A slow stun shot throws the ball by degrees: each speed of a pot has a direction of its own."""
    state = physics.TableState.from_positions({0: (0.95, 1.2), 3: (0.75, 0.72)})
    pot = geometry.pot(NINE, state, 3, "SW")
    assert pot.cut > 15.0
    plans = [plan for plan in Candidates(NINE, 0.0).pots(state, None, [3], 1) if plan.action.shot.b == 0.0]
    assert len({plan.action.shot.phi for plan in plans}) == len(plans)
    made = [physics.simulate(NINE, state, plan.action.shot).facts.pocket[3] == pot.pocket for plan in plans]
    plain = [
        physics.simulate(NINE, state, physics.Shot(shot.v, pot.phi, shot.theta, 0.0, 0.0)).facts.pocket[3] == pot.pocket
        for shot in (plan.action.shot for plan in plans)
    ]
    assert sum(made) > sum(plain)
