"""`search` on known positions and over whole games (docs/agents.md)."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from support.whole_game import whole_game

import client
import physics
from client.agents.registry import titles
from client.agents.search import SearchAgent
from client.agents.search.breaks import best_break
from client.agents.search.budget import GUESS, Budget, Pace, allowance
from client.agents.search.engine import geometry
from client.agents.search.evaluate import AT_ONCE
from client.agents.search.options import Options
from client.agents.search.race import race
from client.agents.search.refine import longest_run
from client.agents.search.shots import Tables
from client.agents.search.sight import ROOM, Sight
from client.agents.search.thinking import AIMS, MOST_POTS
from client.errors import AgentNotFound
from protocol import ClockView, GameTerms, NoiseView, View
from referee import Action, CueBallArea, Decision, EightBall, EndReason, Game, Group, Phase

TABLE = physics.Table.olympiad()
RULES = EightBall(TABLE)
FEW = 2500
"""Simulated shots a stroke, for tests."""


def view_of(balls, noise=1.0, seconds=None, **fields):
    """What seat 0 sees with these balls on the table."""
    state = physics.TableState.from_positions(balls)
    game = Game(state, fields.pop("phase", Phase.PLAY), 0, 0, **({"groups": SOLIDS} | fields))
    terms = GameTerms(
        game="g", match="m", number=0, games=1, players=("search", "x"), rules="eight_ball", table=TABLE.to_dict(),
        noise=NoiseView(told=True, level=noise), dry_visits_limit=24, replays_limit=2, strokes_limit=400,
        commitment="0" * 64,
    )  # fmt: skip
    clocks = (ClockView(seconds_left=seconds, running=True), ClockView(seconds_left=seconds, running=False))
    return View.of(terms, game, seat=0, version=1, clocks=clocks, score=(0.0, 0.0), strokes_since=())


SOLIDS = (Group.SOLIDS, Group.STRIPES)


def choice(balls, noise=1.0, shots=FEW, **fields):
    """What `search` does with these balls, its thought with it."""
    view = view_of(balls, noise, **fields)
    agent = SearchAgent(seed=1, shots=shots)
    agent.game_started(view)
    action = agent.choose(view)
    assert RULES.check(view.to_game(), action) == ()
    return action, agent.thoughts[-1] if agent.thoughts else None


def played(balls, action):
    """The result of the action without noise."""
    state = physics.TableState.from_positions(balls)
    state = state if action.cue_ball is None else state.moved(0, action.cue_ball)
    return physics.simulate(TABLE, state, action.shot)


def test_a_hanging_ball_is_potted():
    balls = {0: (0.5, 1.0), 3: (0.09, 0.09), 12: (0.9, 1.8), 8: (0.7, 1.6)}
    action, thought = choice(balls)
    assert (action.call.ball, action.call.pocket) == (3, 0)
    assert played(balls, action).facts.pocket[3] == 0
    assert thought.worth > 0.8


def test_on_the_8_it_finishes():
    balls = {0: (0.5, 0.9), 8: (0.3, 0.5), 12: (0.9, 1.8)}
    action, thought = choice(balls, noise=0.0)
    assert action.call.ball == 8
    assert thought.worth == 1.0
    assert played(balls, action).facts.pocket[8] == action.call.pocket


def test_hidden_behind_other_balls_it_strikes_its_own_all_the_same():
    """Snookered on its only ball: a kick, or a safety that fouls nobody. Without noise it must get there."""
    balls = {0: (0.2, 1.0), 3: (0.9, 1.0), 9: (0.35, 0.97), 10: (0.35, 1.03), 11: (0.36, 0.91), 8: (0.36, 1.09)}
    action, _ = choice(balls, noise=0.0, shots=20_000)
    facts = played(balls, action).facts
    assert facts.struck_first == (3,)


def test_without_a_pot_it_plays_safe():
    """The 3 is frozen behind the 9 and 10 in the middle of the short cushion; the opponent's balls lie open."""
    balls = {0: (0.2, 2.0), 3: (0.558, 0.03), 9: (0.52, 0.078), 10: (0.596, 0.078), 11: (0.558, 0.125), 8: (0.9, 1.1)}
    action, _ = choice(balls, shots=10_000)
    assert action.is_safety


@pytest.mark.parametrize("area", [CueBallArea.ANYWHERE, CueBallArea.KITCHEN])
def test_ball_in_hand_is_put_where_a_pot_is_easy(area):
    balls = {3: (0.3, 1.3), 8: (0.7, 1.2), 12: (0.9, 0.6)}
    action, thought = choice(balls, cue_ball_in_hand=area)
    assert action.call.ball == 3
    assert thought.worth > 0.8
    assert played({0: (0.5, 1.8), **balls}, action).facts.pocket[3] == action.call.pocket


def test_the_break_is_the_studied_one():
    state = physics.rack(TABLE, "eight_ball", seed=3)
    balls = {ball: state.position(ball) for ball in state.balls}
    action, _ = choice(balls, phase=Phase.BREAK, groups=None, cue_ball_in_hand=CueBallArea.KITCHEN)
    assert action.call is None
    assert played(balls, action).facts.struck_first


def test_a_break_makes_way_for_a_ball_in_its_place():
    """A game may begin anywhere: here a ball lies where the studied break puts the cue ball."""
    place = best_break(1.0, TABLE).place
    balls = {5: place, 1: (0.558, 0.559), 8: (0.4, 0.3)}
    action, _ = choice(balls, phase=Phase.BREAK, groups=None, cue_ball_in_hand=CueBallArea.KITCHEN)
    assert action.cue_ball != place


def test_decisions_go_to_the_better_table():
    """An easy pot: the table is accepted. Everything hidden: the balls are racked again."""
    decisions = (Decision.ACCEPT_TABLE, Decision.RERACK_AND_BREAK)
    easy = {0: (0.5, 1.0), 3: (0.15, 0.15), 8: (0.2, 1.2)}
    fields = {"phase": Phase.DECISION, "decisions": decisions, "choice": "R12"}
    assert choice(easy, **fields)[0].decision is Decision.ACCEPT_TABLE
    hard = {0: (0.2, 2.0), 3: (0.558, 0.03), 9: (0.52, 0.078), 10: (0.596, 0.078), 11: (0.558, 0.125), 8: (0.9, 1.1)}
    assert choice(hard, **fields)[0].decision is Decision.RERACK_AND_BREAK


def test_a_fixed_number_of_shots_repeats_the_choice():
    balls = {0: (0.5, 1.0), 1: (0.3, 0.3), 2: (0.8, 0.5), 9: (0.7, 1.7), 8: (0.2, 1.8)}
    (first, one), (second, other) = choice(balls), choice(balls)
    assert first == second
    assert one == other


@pytest.mark.parametrize("shots", [500, 5_000, 50_000])
def test_it_keeps_to_its_number_of_shots(shots):
    """Up to the floor of a first look, and a last round that was begun."""
    balls = {0: (0.5, 1.0), 1: (0.3, 0.3), 2: (0.8, 0.5), 5: (1.0, 1.0), 9: (0.7, 1.7), 8: (0.2, 1.8)}
    _, thought = choice(balls, shots=shots)
    assert thought.simulated <= 1.25 * shots + 1500


@pytest.mark.parametrize("noise", [0.0, 1.0, 5.0])
@pytest.mark.parametrize("opponent", ["random", "greedy"])
def test_no_action_is_refused(opponent, noise):
    """Whole games, every phase of them."""
    agents = [client.load(f"search:shots={FEW}", seed=1), client.load(opponent, seed=1)]
    game, refused = whole_game(agents, 5, noise)
    assert game.outcome.reason not in (EndReason.FORFEIT, EndReason.CONCESSION)
    assert refused == []


class Ticking:
    """A clock that a simulated shot moves on."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


class Slow(client.Simulator):
    """The physics on a machine that gets through ten thousand shots a second, by a clock of its own."""

    def __init__(self, clock):
        super().__init__()
        self._clock = clock

    def simulate_batch(self, table, states, shots, threads=1):
        self._clock.now += 1e-4 * len(shots)
        return super().simulate_batch(table, states, shots, threads)


def test_it_is_never_out_of_time(monkeypatch):
    """Forty strokes on a clock of 20 s, on a machine six times slower than it guesses at first."""
    clock, left = Ticking(), 20.0
    monkeypatch.setattr("client.agents.search.agent.time", SimpleNamespace(perf_counter=clock))
    agent = SearchAgent(seed=1, seconds=2.0)
    agent.simulator = Slow(clock)
    balls = {0: (0.5, 1.0), 1: (0.3, 0.3), 2: (0.8, 0.5), 5: (1.0, 1.0), 9: (0.7, 1.7), 8: (0.2, 1.8)}
    agent.game_started(view_of(balls, seconds=left))
    for _ in range(40):
        before = clock.now
        agent.choose(view_of(balls, seconds=left))
        left -= clock.now - before
        assert left > 0.0
    assert left < 16.0  # and it does use its time


class Stalling(Slow):
    """A machine that stands still for an hour, once, at the batch of this number."""

    def __init__(self, clock, number):
        super().__init__(clock)
        self._left = number
        self.after = 0

    def simulate_batch(self, table, states, shots, threads=1):
        self._left -= 1
        self._clock.now += 3600.0 * (self._left == 0)
        self.after += self._left < 0
        return super().simulate_batch(table, states, shots, threads)


@pytest.mark.parametrize("number", [1, 2, 3, 4, 6, 9, 14])
def test_a_stall_in_any_phase_ends_the_thinking(monkeypatch, number):
    """Pots, sweep, banks, polishing: what was found until then is played, and nothing more is simulated."""
    clock = Ticking()
    monkeypatch.setattr("client.agents.search.agent.time", SimpleNamespace(perf_counter=clock))
    agent = SearchAgent(seed=1, seconds=2.0)
    agent.simulator = Stalling(clock, number)
    balls = {0: (0.5, 1.0), 1: (0.56, 0.06), 9: (0.56, 0.2), 10: (0.5, 0.2), 11: (0.62, 0.2), 8: (0.2, 1.8)}
    view = view_of(balls, seconds=None)
    agent.game_started(view)
    action = agent.choose(view)
    assert RULES.check(view.to_game(), action) == ()
    assert clock.now >= 3600.0, "the stall came"
    assert agent.simulator.after == 0


def test_batches_are_small_enough_for_a_clock():
    """Between two looks at the clock no more than a small part of a second passes."""
    batches = []

    class Watched(client.Simulator):
        def simulate_batch(self, table, states, shots, threads=1):
            batches.append(len(shots))
            return super().simulate_batch(table, states, shots, threads)

    agent = SearchAgent(seed=1, seconds=0.5)
    agent.simulator = Watched()
    balls = {0: (0.5, 1.0), 1: (0.3, 0.3), 2: (0.8, 0.5), 5: (1.0, 1.0), 9: (0.7, 1.7), 8: (0.2, 1.8)}
    view = view_of(balls)
    agent.game_started(view)
    agent.choose(view)
    assert max(batches) <= AT_ONCE


def test_more_seconds_are_more_shots():
    """Anytime: what it simulates grows with the time it is given."""
    balls = {0: (0.5, 1.0), 1: (0.3, 0.3), 2: (0.8, 0.5), 9: (0.7, 1.7), 8: (0.2, 1.8)}
    simulated = [choice(balls, shots=shots)[1].simulated for shots in (1_000, 4_000, 16_000)]
    assert simulated == sorted(simulated)
    assert simulated[2] > 3 * simulated[1]


def test_seconds_left_are_never_used_up():
    """However many strokes a game takes, a share of what is left is always left."""
    left = 30.0
    for _ in range(200):
        seconds, _ = allowance(Options(seconds=10.0), left, None)
        left -= seconds
        assert left > 0.0


def test_shots_left_are_shared_out():
    left = 100_000
    for _ in range(100):
        _, shots = allowance(Options(), None, left)
        assert 1 <= shots <= max(1, left)
        left -= shots
        if not left:
            break


def test_a_budget_of_shots_and_seconds_is_spent_by_either():
    """A simulation budget does not make it forget the clock, nor the clock the budget."""
    seconds, shots = allowance(Options(seconds=2.0), 10.0, 1_000_000)
    assert seconds == pytest.approx(0.57)
    assert shots == 60_000
    clock = Ticking()
    budget = Budget(Pace(), shots, seconds, clock)
    assert budget.total == int(seconds * GUESS)
    clock.now = 0.6
    assert budget.spent > 1.0
    other = Budget(Pace(), shots, seconds, clock)
    other.charge(60_000)
    assert other.spent == 1.0


def test_a_number_of_shots_needs_no_clock():
    assert allowance(Options(shots=500), None, None) == (math.inf, 500)
    assert allowance(Options(shots=500), None, 1_000) == (math.inf, 60)


def test_a_budget_of_seconds_learns_how_far_it_goes():
    pace, clock = Pace(), Ticking()
    for _ in range(50):
        budget = Budget(pace, 0, 0.5, clock)
        while budget.spent < 1.0:
            budget.charge(1000)
            clock.now += 0.01
        budget.close()
    assert pace.per_second == pytest.approx(100_000, rel=0.02)
    assert Budget(pace, 0, 0.5, clock).total == pytest.approx(50_000, rel=0.02)


def test_a_stroke_tells_itself_how_far_its_seconds_go():
    """From the first thousand shots on; a new agent on a fast machine uses its time on the first stroke already."""
    clock = Ticking()
    budget = Budget(Pace(), 0, 0.5, clock)
    budget.charge(999)
    clock.now = 0.001
    assert budget.total == int(0.5 * GUESS)
    budget.charge(1001)
    clock.now = 0.01
    assert budget.total == 100_000


@pytest.mark.parametrize(
    "name",
    ["search:speed=1", "search:seconds=", "search:seconds=-1", "search:shots=0.5", "search:cpu=1", "greedy:seconds=1"],
)
def test_a_bad_option_is_named(name):
    with pytest.raises(AgentNotFound, match=name):
        client.load(name)


def test_its_title_is_a_name_that_servers_allow():
    assert titles("search:seconds=0.3", "search") == ("search-seconds-0.3", "search")


def test_options_reach_the_agent():
    agent = client.load("search:seconds=0.25,ways=off", seed=3)()
    assert isinstance(agent, SearchAgent)
    assert agent._options == Options(seconds=0.25, ways=False)


def test_the_race_is_a_chance_and_fewer_balls_are_better():
    grid, values, shooter = np.arange(1.0, 9.0), race(1.0).values, geometry().shooter

    def worths(chance):
        return np.array([[shooter(values, needs, other, chance, True) for needs in grid] for other in grid])

    worth = worths(0.8)
    assert ((worth >= 0.0) & (worth <= 1.0)).all()
    assert (np.diff(worth, axis=1) < 0.0).all()  # more to make
    assert (np.diff(worth, axis=0) > 0.0).all()  # the opponent has more to make
    assert (worths(0.95) >= worth).all()


def test_pots_agree_with_plain_geometry():
    """Direction and margin are those of `client.geometry.pots`, which knows nothing of balls beside the path."""
    balls = {0: (0.5, 1.2), 2: (0.8, 0.5), 3: (0.3, 0.9)}
    state = physics.TableState.from_positions(balls)
    known = {(one.ball, one.pocket): one for one in client.geometry.pots(TABLE, state, (2, 3))}
    tables = Tables(state.positions[None].copy(), np.array([0], np.int8))
    pots = Sight(TABLE, 1.0).pots(tables, 6)
    found = [place for place in range(6) if pots.chance[0, place] > 0.01]
    assert found
    for place in found:
        one = known[int(pots.ball[0, place]), int(pots.pocket[0, place])]
        assert pots.phi[0, place] == pytest.approx(one.phi, abs=1e-6)
        assert pots.margin[0, place] == pytest.approx(one.tolerance, rel=0.1)


def test_the_cue_is_raised_no_less_than_it_has_to_be():
    """Against `physics.min_elevation`, at every place where the cue may be raised so far."""
    chance = np.random.default_rng(7)
    around = {ball: (0.5 + 0.08 * math.cos(ball), 1.0 + 0.08 * math.sin(ball)) for ball in (1, 3, 5)}
    state = physics.TableState.from_positions({0: (0.5, 1.0), 9: (0.1, 0.1), **around})
    sight, equal = Sight(TABLE, 0.0), 0
    for phi, a, b in chance.uniform((0.0, -12.0, -12.0), (360.0, 12.0, 12.0), (300, 3)):
        shots = one_shot(state, phi, a, b)
        raised = sight.raised(shots)
        needed = physics.min_elevation(TABLE, state, phi, a, b)
        if len(raised):
            theta = raised.strokes[0, 2]
            assert theta >= needed - 1e-6
            assert physics.check(TABLE, state, physics.Shot(2.0, phi, theta, a, b)) is None
            equal += theta == pytest.approx(needed + ROOM, abs=1e-3)
    assert equal > 200  # more only where a low tip could pass under a ball's widest part


def one_shot(state, phi, a, b):
    from client.agents.search.shots import Shots

    nothing = np.array([-1])
    tables = Tables(state.positions[None].copy(), np.array([0], np.int8))
    return Shots(tables, np.array([0]), np.array([[2.0, phi, 0.0, a, b]]), nothing, nothing, np.zeros(1))


def test_the_longest_run_of_directions():
    made = np.array([[0, 1, 1, 0, 1], [1, 1, 1, 1, 1], [0, 0, 0, 0, 1], [0, 0, 0, 0, 0]], bool)
    first, last = longest_run(made)
    assert first.tolist()[:3] == [1, 0, 4]
    assert last.tolist()[:3] == [2, 4, 4]


def test_a_cue_ball_in_hand_makes_no_endless_batches():
    """However large the budget: pots from all places are tried in so many ways in all, each in so many directions."""
    balls = {1: (0.3, 1.3), 2: (0.8, 1.7), 3: (0.7, 0.5), 4: (0.9, 0.6), 5: (0.2, 0.9), 8: (0.5, 1.2), 12: (0.9, 1.9)}
    batches = []

    class Watched(client.Simulator):
        def simulate_batch(self, table, states, shots, threads=1):
            batches.append(len(shots))
            return super().simulate_batch(table, states, shots, threads)

    agent = SearchAgent(seed=1, shots=10**8)
    agent.simulator = Watched()
    view = view_of(balls, noise=0.0, cue_ball_in_hand=CueBallArea.ANYWHERE)
    agent.game_started(view)
    agent.choose(view)
    assert max(batches) <= AIMS * MOST_POTS


def test_with_nothing_left_to_simulate_it_plays_on():
    """A simulation budget that lasts for a few strokes: then pots are reckoned, and no action is bad."""
    match = client.play(f"search:shots={FEW}", "random", seed=2, simulations=3_000)
    (game,) = match.games
    assert game.outcome.reason not in (EndReason.FORFEIT, EndReason.CONCESSION)
    assert game.simulated[0] <= 3_000


@pytest.mark.parametrize("part", ["safeties", "ways"])
def test_without_a_part_it_plays_all_the_same(part):
    match = client.play(f"search:shots={FEW},{part}=off", "random", seed=6)
    assert match.games[0].outcome.reason not in (EndReason.FORFEIT, EndReason.CONCESSION)


def test_it_is_far_ahead_of_random():
    match = client.play(f"search:shots={FEW}", "random", games=4, seed=4)
    assert match.score[0] >= 3.0


def test_actions_are_values_of_the_referee():
    action, _ = choice({0: (0.5, 1.0), 3: (0.09, 0.09), 8: (0.7, 1.6)})
    assert Action.from_dict(action.to_dict()) == action
