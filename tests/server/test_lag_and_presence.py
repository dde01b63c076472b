"""docs/protocol.md, clocks: the lag given back and its ledger, who never shows up, time in which no server ran."""

import json
import random

import pytest
from support.server_time import SECOND, Stage

from referee.play import Charge, LagAllowance
from server.errors import BudgetSpent, Forbidden, GameFinished, Invalid, KeyReused
from server.security.callers import ORGANISER
from server.services.play import budget, forfeits
from server.services.play.clock import ledger
from server.services.runtime import heartbeat
from server.services.watch.presence import Presence


@pytest.fixture
def stage(tmp_path):
    stages: list[Stage] = []

    def make(**settings):
        stages.append(Stage(tmp_path / f"{len(stages)}.db", **settings))
        return stages[-1]

    yield make
    for each in stages:
        each.close()


def outcome_of(stage, seats):
    """How the game ended; None while it goes on."""
    message = stage.news(seats.mover)
    return message["outcome"]["reason"] if message and message["type"] == "game_over" else None


# what is given back


@pytest.mark.parametrize(
    ("measured", "granted", "lag"),
    [(0, 0, 0), (3, 0, 3), (50, 0, 5), (50, 17, 3), (50, 20, 0), (50, 99, 0)],
)
def test_lag_is_given_back_up_to_a_cap_for_the_turn_and_one_for_the_game(measured, granted, lag):
    charge = LagAllowance(turn_ns=5, game_ns=20).charge(measured, granted)
    assert charge == Charge(measured, lag)
    assert charge.charged_ns == measured - lag


def test_the_ledger_has_every_turn_with_what_was_given_back(stage):
    now = stage(lag_turn=0.5, lag_game=5.0)
    seats = now.game("ann", "bob")
    seats.fetch()
    now.time.pass_(3.0)
    left = seats.concede()["clocks"][seats.breaker]["seconds_left"]
    assert left == 7.5
    book = ledger.read(now.context, seats.id)
    (row,) = book.charges
    assert (row.seat, row.move) == (seats.breaker, 0)
    assert (row.measured_ns, row.lag_ns, row.charged_ns) == (3 * SECOND, SECOND // 2, 5 * SECOND // 2)
    assert book.players[seats.breaker].charged_ns == row.charged_ns
    assert book.players[1 - seats.breaker].charged_ns == 0
    assert (book.lag_turn_seconds, book.lag_game_seconds, book.seconds) == (0.5, 5.0, 10.0)


def test_a_turn_with_lag_given_back_times_out_when_exactly_zero_is_left(stage):
    now = stage(lag_turn=0.5, lag_game=5.0)
    seats = now.game("ann", "bob")
    seats.fetch()
    now.time.pass_(10.5 - 1e-9)
    assert outcome_of(now, seats) is None
    now.time.pass_(1e-9)
    assert outcome_of(now, seats) == "time_out"
    (row,) = ledger.read(now.context, seats.id).charges
    assert (row.move, row.charged_ns, row.lag_ns) == (None, 10 * SECOND, SECOND // 2)


@pytest.mark.parametrize("seed", range(4))
def test_the_ledger_adds_up_however_late_turns_are_fetched_and_whoever_stops_the_server(stage, script, seed):
    """Measured is what passed while a server ran; of it a second a turn and five a game are given back."""
    chance, now = random.Random(seed), stage(lag_turn=0.25, lag_game=1.0)
    heartbeat.begin(now.context, "first", alone=True)
    seats = now.game("ann", "bob", clock={"seconds": 1_000.0}, seed=f"{seed:064x}")
    passed: list[int] = []
    while len(passed) < 24 and (turn := now.waiting(seats)) is not None:
        passed.append(0)
        waited = chance.choice((0.0, 0.5, 0.999, 1.0, 3.0))
        for seconds in (waited, chance.uniform(0.0, 2.0)):
            now.time.pass_(seconds)
            passed[-1] += round(seconds * SECOND)
            if chance.random() < 0.3:
                heartbeat.beat(now.context, "first", stopped=True)
                now.time.pass_(chance.choice((0.0, 100.0)))
                heartbeat.begin(now.context, "first", alone=True)
            view = now.fetched(seats, turn)
        now.act(seats, view, script(view, chance))
    book = ledger.read(now.context, seats.id)
    assert [row.measured_ns for row in book.charges] == passed
    for seat, player in enumerate(book.players):
        rows = [row for row in book.charges if row.seat == seat]
        assert all(row.charged_ns == row.measured_ns - row.lag_ns - row.grace_ns >= 0 for row in rows)
        assert all(row.grace_ns <= SECOND and row.lag_ns <= SECOND // 4 for row in rows)
        assert player.grace_ns == sum(row.grace_ns for row in rows) <= 5 * SECOND
        assert player.lag_ns == sum(row.lag_ns for row in rows) <= SECOND
        assert player.charged_ns == sum(row.charged_ns for row in rows)


def test_fetching_late_gains_five_seconds_a_game_and_no_more(stage, script):
    """Every turn is fetched two seconds late: the sixth is charged all of it."""
    chance, now = random.Random(1), stage(lag_turn=0.0)
    seats = now.game("ann", "bob", clock={"seconds": 1_000.0}, seed="5" * 64)
    given: tuple[list[int], list[int]] = ([], [])
    while min(map(len, given)) < 7 and (turn := now.waiting(seats)) is not None:
        now.time.pass_(2.0)
        now.act(seats, view := now.fetched(seats, turn), script(view, chance))
        row = ledger.read(now.context, seats.id).charges[-1]
        assert row.charged_ns == row.measured_ns - row.grace_ns
        given[row.seat].append(row.grace_ns)
    for graces in given:
        assert sum(graces) == 5 * SECOND
        assert set(graces) == {0, SECOND}


# never there


def test_who_never_fetches_the_first_turn_within_a_minute_is_no_show(stage):
    now = stage()
    seats = now.game("ann", "bob", clock={"seconds": 300.0})
    now.time.pass_(60.0 - 1e-9)
    assert outcome_of_other(now, seats) is None
    now.time.pass_(1e-9)
    assert outcome_of_other(now, seats) == "no_show"


def outcome_of_other(stage, seats):
    message = stage.news(seats.ids[1 - seats.breaker])
    return message and message["outcome"]["reason"]


def test_who_fetched_once_and_then_does_nothing_is_out_of_time(stage):
    now = stage()
    seats = now.game("ann", "bob", clock={"seconds": 100.0})
    seats.fetch()
    now.time.pass_(99.0)
    assert outcome_of(now, seats) is None
    now.time.pass_(1.1)
    assert outcome_of(now, seats) == "time_out"


def test_a_clock_that_runs_out_before_the_minute_is_a_time_out(stage):
    now = stage(lag_turn=0.0)
    seats = now.game("ann", "bob")
    now.time.pass_(11.0)  # the grace and the allowance
    assert outcome_of_other(now, seats) == "time_out"


def test_who_fetched_before_a_restart_is_no_no_show_after_it(stage):
    now = stage()
    seats = now.game("ann", "bob", clock={"seconds": 300.0})
    seats.fetch()
    heartbeat.begin(now.context, "next", alone=True)
    now.time.pass_(200.0)
    assert outcome_of_other(now, seats) is None


# time in which no server ran


def test_nothing_after_the_last_heartbeat_is_charged(stage):
    now = stage(lag_turn=0.0)
    heartbeat.begin(now.context, "first", alone=True)
    seats = now.game("ann", "bob")
    seats.fetch()
    now.time.pass_(2.0)
    heartbeat.beat(now.context, "first")
    now.time.pass_(0.9)  # then the process is killed
    now.time.pass_(3_600.0)
    heartbeat.begin(now.context, "second", alone=True)
    clock = ledger.read(now.context, seats.id).clocks[seats.breaker]
    assert (clock.seconds_left, clock.running) == (8.0, False)
    assert seats.fetch()["clocks"][seats.breaker]["seconds_left"] == 8.0
    now.time.pass_(1.0)
    assert seats.concede()["clocks"][seats.breaker]["seconds_left"] == 7.0
    (row,) = ledger.read(now.context, seats.id).charges
    assert row.measured_ns == 3 * SECOND


def test_what_ran_before_a_restart_still_counts_towards_the_end(stage):
    now = stage(lag_turn=0.0)
    heartbeat.begin(now.context, "first", alone=True)
    seats = now.game("ann", "bob")
    seats.fetch()
    now.time.pass_(6.0)
    heartbeat.beat(now.context, "first", stopped=True)
    now.time.pass_(100.0)
    heartbeat.begin(now.context, "second", alone=True)
    seats.fetch()
    now.time.pass_(4.0 - 1e-9)
    assert outcome_of(now, seats) is None
    now.time.pass_(1e-9)
    assert outcome_of(now, seats) == "time_out"


def test_a_process_that_joins_others_charges_nothing_and_stops_no_clock(stage):
    now = stage(lag_turn=0.0)
    heartbeat.begin(now.context, "first", alone=True)
    seats = now.game("ann", "bob")
    seats.fetch()
    now.time.pass_(2.0)
    heartbeat.begin(now.context, "second", alone=False)
    clock = ledger.read(now.context, seats.id).clocks[seats.breaker]
    assert (clock.seconds_left, clock.running) == (8.0, True)


# ends that a supervisor decides


@pytest.mark.parametrize("reason", ["crash", "stall", "no_show", "forfeit"])
def test_the_organiser_ends_a_game_with_what_was_seen(stage, reason):
    now = stage()
    seats = now.game("ann", "bob")
    body = json.dumps({"seat": 1, "reason": reason}).encode()
    answer = json.loads(forfeits.forfeit(now.context, seats.id, now.command(ORGANISER, body)).body)
    assert answer["outcome"] == {"winner": 0, "reason": reason, "rule": "R48"}
    again = json.loads(forfeits.forfeit(now.context, seats.id, now.command(ORGANISER, body)).body)
    assert again == answer
    with pytest.raises(GameFinished):
        forfeits.forfeit(now.context, seats.id, now.command(ORGANISER, body, key="another"))


def test_no_player_ends_a_game_for_the_other(stage):
    now = stage()
    seats = now.game("ann", "bob")
    body = json.dumps({"seat": 1, "reason": "crash"}).encode()
    with pytest.raises(Forbidden, match="organiser"):
        forfeits.forfeit(now.context, seats.id, now.command(seats.ids[0], body))


@pytest.mark.parametrize("body", [{"seat": 2}, {"seat": 0, "reason": "time_out"}, {"reason": "crash"}, {"seat": True}])
def test_a_verdict_that_is_none_is_refused(stage, body):
    now = stage()
    seats = now.game("ann", "bob")
    with pytest.raises(Invalid):
        forfeits.forfeit(now.context, seats.id, now.command(ORGANISER, json.dumps(body).encode()))


# simulated shots


def test_the_budget_of_simulated_shots_is_counted_by_player_and_game(stage):
    now = stage()
    seats = now.game("ann", "bob", clock={"seconds": 10.0, "simulations": 100})
    first, second = seats.ids
    for agent, key, shots in ((first, "a", 60), (second, "a", 100), (first, "b", 40)):
        budget.count(now.context, now.command(agent, key=key), seats.id, shots)
    for agent in seats.ids:
        with pytest.raises(BudgetSpent, match="more than the 0 that are left"):
            budget.count(now.context, now.command(agent, key="c"), seats.id, 1)
    book = ledger.read(now.context, seats.id)
    assert [player.simulated for player in book.players] == [100, 100]
    assert [clock.simulations_left for clock in book.clocks] == [0, 0]


def test_a_request_that_comes_again_is_counted_once(stage):
    """Also when the budget is spent meanwhile, and the game over; with another body the key is refused, as anywhere."""
    now = stage()
    seats = now.game("ann", "bob", clock={"seconds": 10.0, "simulations": 100})
    sent = now.command(seats.ids[0], b"1")
    for _ in range(2):
        budget.count(now.context, sent, seats.id, 100)
    with pytest.raises(KeyReused):
        budget.count(now.context, now.command(seats.ids[0], b"2"), seats.id, 100)
    seats.concede()
    budget.count(now.context, sent, seats.id, 100)
    assert ledger.read(now.context, seats.id).players[0].simulated == 100


def test_a_batch_beyond_the_budget_is_refused_whole(stage):
    now = stage()
    seats = now.game("ann", "bob", clock={"seconds": 10.0, "simulations": 100})
    with pytest.raises(BudgetSpent):
        budget.count(now.context, now.command(seats.ids[0]), seats.id, 101)
    assert ledger.read(now.context, seats.id).players[0].simulated == 0


def test_nobody_spends_the_budget_of_another(stage):
    now = stage()
    seats, other = now.game("ann", "bob"), now.game("cat", "dan")
    for caller in (other.ids[0], ORGANISER):
        with pytest.raises(Forbidden):
            budget.count(now.context, now.command(caller), seats.id, 1)


def test_a_game_that_is_over_has_no_budget(stage):
    now = stage()
    seats = now.game("ann", "bob")
    seats.concede()
    with pytest.raises(GameFinished):
        budget.count(now.context, now.command(seats.ids[0]), seats.id, 1)


def test_who_left_long_ago_is_not_remembered():
    """An agent that polled once was kept for as long as the process lived."""
    presence = Presence()
    for number in range(1000):
        presence.enter(f"agent_{number}")
        presence.leave(f"agent_{number}", number * SECOND)
    assert presence.here(999 * SECOND) == {f"agent_{number}" for number in range(990, 1000)}
    assert len(presence._last) == 10
