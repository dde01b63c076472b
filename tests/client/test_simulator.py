"""`Agent.simulator`: the physics counted against the game's budget (docs/agents.md)."""

import inspect
from typing import Any

import pytest

import client
import physics
from referee import SimulationBudget

TABLE = physics.Table.olympiad()
STATE = physics.TableState.from_positions({0: (0.5, 1.7), 3: (0.4, 0.6)})
SHOT = physics.Shot(2.0, 260.0, 10.0)
ROW = [[2.0, 260.0, 10.0, 0.0, 0.0]]
CONCEDE = client.Action(decision=client.Decision.CONCEDE)


def test_it_answers_as_the_physics_does():
    simulator = client.Simulator()
    assert simulator.simulate(TABLE, STATE, SHOT).final == physics.simulate(TABLE, STATE, SHOT).final
    batch = simulator.simulate_batch(TABLE, STATE, ROW * 3)
    assert batch.state(2) == physics.simulate(TABLE, STATE, SHOT).final
    assert (simulator.budget.used, simulator.remaining) == (4, None)


def agent_that(*, simulates, seen):
    class Curious(client.Agent):
        def choose(self, view):
            left = view.clocks[view.seat].simulations_left
            assert left == self.simulator.remaining
            seen.append(left)
            self.simulator.simulate_batch(view.table_model(), view.state, ROW * simulates)
            return CONCEDE

    return Curious


def test_a_local_game_counts_and_tells():
    seen: list[Any] = []
    match = client.play(agent_that(simulates=4, seen=seen), "random", games=2, seed=1, simulations=10)
    mine = [game.simulated[0] for game in match.games if game.simulated[0]]
    assert seen == [10] * len(seen)
    assert mine == [4] * len(seen)
    assert all(game.simulated[1] == 0 for game in match.games)


def test_beyond_the_budget_nothing_is_simulated_and_the_game_goes_on_as_after_any_fault(caplog):
    """The twentieth fault in a row forfeits a local game; the budget stays as it was."""
    match = client.play(agent_that(simulates=11, seen=[]), "random", seed=2, simulations=10, strict=False)
    (game,) = match.games
    assert (game.outcome.reason, game.outcome.winner) == ("forfeit", 1)
    assert game.simulated == (0, 0)
    assert "at most 10 are left in this game" in caplog.text


def test_without_a_budget_the_view_names_none():
    class Looking(client.Agent):
        def choose(self, view):
            assert view.budget is None
            assert view.clocks[0].simulations_left is None
            assert self.simulator.remaining is None
            return CONCEDE

    assert client.play(Looking, Looking, seed=1).games[0].outcome.reason == "concession"


def test_the_view_says_who_counts():
    class Looking(client.Agent):
        def choose(self, view):
            assert (view.budget.simulations, view.budget.counted) == (5, "by_driver")
            return CONCEDE

    assert client.play(Looking, Looking, seed=1, simulations=5).games[0].outcome.reason == "concession"


@pytest.mark.parametrize("simulations", [0, 2000])
def test_greedy_plays_by_the_rules_within_any_budget_and_repeats_itself(simulations):
    once, again = (client.play("greedy", "random", seed=3, simulations=simulations) for _ in range(2))
    (game,) = once.games
    assert game.simulated[0] <= simulations
    assert (game.simulated[0] > 0) == (simulations > 0)
    assert game.outcome.reason not in ("forfeit", "concession")
    assert list(game.record()) == list(again.games[0].record())


def test_a_negative_budget_is_refused():
    with pytest.raises(ValueError, match="allowed = -1"):
        client.play("random", "random", simulations=-1)


def test_its_defaults_are_those_of_the_physics():
    """Seen: an agent asked `simulate(...).events` and there was no trace, although `physics.simulate` keeps one."""
    for name in ("simulate", "simulate_batch"):
        ours = inspect.signature(getattr(client.Simulator, name)).parameters
        theirs = inspect.signature(getattr(physics, name)).parameters
        shared = ours.keys() & theirs.keys()
        assert {"table", "threads" if name == "simulate_batch" else "trace"} <= shared
        assert {key: ours[key].default for key in shared} == {key: theirs[key].default for key in shared}
    assert client.Simulator().simulate(TABLE, STATE, SHOT).events[0].kind == "cue_strike"


def test_a_batch_of_shots_is_counted_as_its_rows():
    simulator = client.Simulator(SimulationBudget(2))
    assert simulator.simulate_batch(TABLE, STATE, [SHOT, SHOT]).state(1) == physics.simulate(TABLE, STATE, SHOT).final
    assert simulator.remaining == 0


@pytest.mark.parametrize("shots", [[[2.0, 260.0]], SHOT, [[float("nan")] * 5]])
def test_shots_that_cannot_be_are_not_counted(shots):
    simulator = client.Simulator()
    with pytest.raises(physics.InvalidShot):
        simulator.simulate_batch(TABLE, STATE, shots)
    assert simulator.budget.used == 0
