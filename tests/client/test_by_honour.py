"""The simulation budget over a server: counted where the server simulates, by honour elsewhere (docs/protocol.md)."""

import threading

import httpx2
import pytest

import client
import physics
from client.errors import BudgetSpent as RefusedForBudget
from client.run import run_agent
from protocol import ClockTerms
from referee.record import verify_record

BREAK = client.Action(shot=physics.Shot(9.0, 270.0, 5.0), cue_ball=(0.558, 1.75))
CONCEDE = client.Action(decision=client.Decision.CONCEDE)
SHOT = physics.Shot(1.0, 270.0, 10.0)


def begun(hall, simulations):
    entries = hall.register("one"), hall.register("two")
    hall.match(*entries, clock=ClockTerms(seconds=300.0, simulations=simulations))
    return entries


def seat_0(hall, entries):
    return client.Pooliad(hall.url, entries[0].token)


def test_the_servers_simulations_count_and_end_with_the_budget(hall):
    entries = begun(hall, 5)
    with seat_0(hall, entries) as player:
        view = player.turns(10).view
        assert (view.budget.simulations, view.budget.counted) == (5, "by_honour")
        table, state = view.table_model(), view.state
        player.simulate(table, state, SHOT, game=view.game)
        player.simulate_batch(table, state, [SHOT] * 3, game=view.game)
        player.simulate(table, state, SHOT)
        assert player.game(view.game).view.clocks[0].simulations_left == 1
        with pytest.raises(RefusedForBudget, match="1 that are left"):
            player.simulate_batch(table, state, [SHOT] * 2, game=view.game)
        assert player.clock(view.game).players[0].simulated == 4
    with client.Pooliad(hall.url, entries[1].token) as other:
        assert other.clock(view.game).clocks[1].simulations_left == 5


def test_what_is_declared_counts_with_the_stroke_and_more_than_is_left_is_refused(hall):
    with seat_0(hall, begun(hall, 10)) as player:
        view = player.turns(10).view
        with pytest.raises(RefusedForBudget):
            player.play(view.game, view.version, BREAK, simulated=11)
        assert player.game(view.game).view.version == view.version
        answer = player.play(view.game, view.version, BREAK, simulated=10)
        assert answer.clocks[0].simulations_left == 0
        assert answer.clocks[1].simulations_left == 10


def test_the_record_holds_the_budget_and_what_was_counted(hall):
    entries = begun(hall, 10)
    with seat_0(hall, entries) as player, client.Pooliad(hall.url, entries[1].token) as other:
        view = player.turns(10).view
        player.simulate(view.table_model(), view.state, SHOT, game=view.game)
        view = player.play(view.game, view.version, BREAK, simulated=4).view
        (player, other)[view.turn].play(view.game, view.version, CONCEDE)
        found = verify_record(player.record(view.game).decode().splitlines())
    assert found.ok
    assert found.budget.to_dict() == {"simulations": 10, "counted": "by_honour"}
    assert found.simulated == (5, 0)
    assert "5 and 0 of 10 simulated shots each, counted by honour" in str(found)


def test_an_agents_simulator_is_declared_and_knows_what_is_left(hall):
    seen = []

    class Thinking(client.Agent):
        def choose(self, view):
            seen.append((view.clocks[0].simulations_left, self.simulator.remaining))
            self.simulator.simulate_batch(view.table_model(), view.state, [[1.0, 270.0, 10.0, 0.0, 0.0]] * 7)
            return BREAK if view.phase == "break" else CONCEDE

    class Giving(client.Agent):
        def choose(self, view):
            return CONCEDE

    entries = begun(hall, 100)
    other = threading.Thread(target=run_agent, args=(Giving, hall.url, entries[1].token))
    other.start()
    over = run_agent(Thinking, hall.url, entries[0].token)
    other.join(30)
    (game,) = hall.organiser.match(over.match).played
    assert seen[0] == (100, 100)
    assert all(told == known for told, known in seen)
    assert hall.organiser.clock(game.id).players[0].simulated in (7, 14)


def test_an_agent_that_asks_for_too_much_is_told_and_asked_again(hall, caplog):
    tried = []

    class Greedy(client.Agent):
        def choose(self, view):
            tried.append(self.simulator.remaining)
            if len(tried) == 1:
                self.simulator.simulate_batch(view.table_model(), view.state, [[1.0, 270.0, 10.0, 0.0, 0.0]] * 4)
            return CONCEDE

    entries = begun(hall, 3)
    assert run_agent(Greedy, hall.url, entries[0].token).winner == 1
    assert tried == [3, 3]
    assert "at most 3 are left in this game" in caplog.text


class LosesAnswers(httpx2.BaseTransport):
    """The real network, but the first answer to each path is lost on its way back."""

    def __init__(self):
        self._real, self.lost = httpx2.HTTPTransport(), []

    def handle_request(self, request):
        response = self._real.handle_request(request)
        if request.url.path in self.lost:
            return response
        response.read()
        self.lost.append(request.url.path)
        raise httpx2.ReadError("the answer is lost", request=request)

    def close(self):
        self._real.close()


def test_a_simulation_whose_answer_was_lost_is_asked_for_again_and_counted_once(hall):
    entries, transport = begun(hall, 5), LosesAnswers()
    with seat_0(hall, entries) as player:
        view = player.turns(10).view
    retry = client.Retry(first_pause=0.01)
    with client.Pooliad(hall.url, entries[0].token, retry=retry, transport=transport) as player:
        table, state = view.table_model(), view.state
        answer = player.simulate(table, state, SHOT, game=view.game)
        assert len(player.simulate_batch(table, state, [SHOT] * 4, game=view.game).results) == 4
        assert player.game(view.game).view.clocks[0].simulations_left == 0
    assert answer.status == "at_rest"
    assert transport.lost[:2] == ["/v1/simulate", "/v1/simulate/batch"]


def test_a_simulation_that_counts_needs_a_key(hall):
    entries = begun(hall, 5)
    with seat_0(hall, entries) as player:
        view = player.turns(10).view
    body = {"shot": SHOT.to_dict(), "balls": view.state.to_dict(), "game": view.game}
    with httpx2.Client(headers={"Authorization": f"Bearer {entries[0].token}"}, timeout=60) as http:
        without = http.post(f"{hall.url}/v1/simulate", json=body)
        assert (without.status_code, without.json()["code"]) == (400, "bad_header")
        assert http.post(f"{hall.url}/v1/simulate", json=body | {"game": None}).status_code == 200
