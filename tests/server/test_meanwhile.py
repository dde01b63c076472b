"""What others do while a stroke is between its two transactions: nothing is lost, the stroke is played once.

And what is refused is refused before any noise is drawn: from a stroke that was simulated and refused a player would
learn what its noise is (docs/security.md).
"""

import json

import pytest
from support.server_time import SECOND, Stage, next_message

from server.errors import BudgetSpent
from server.security import keys
from server.services.play import budget, history, strokes
from server.services.play.clock import ledger
from server.services.play.clock.flag import flag

BREAK = {"v": 8.0, "phi": 270.0, "theta": 5.0, "a": 0.0, "b": 0.0}
BUDGET = {"clock": {"seconds": 10.0, "simulations": 100}}


@pytest.fixture
def stage(tmp_path):
    made = Stage(tmp_path / "meanwhile.db")
    yield made
    made.close()


def simulated(stage, seats):
    return [player.simulated for player in ledger.read(stage.context, seats.id).players]


def played(stage, seats):
    return len(history.shots(stage.context, seats.id, 0, 50).shots)


def count(stage, seats, agent, shots, key="n"):
    return lambda: budget.count(stage.context, stage.command(agent, key=key), seats.id, shots)


@pytest.mark.parametrize("terms", [{}, BUDGET], ids=["no budget", "a budget"])
@pytest.mark.parametrize("own", [True, False])
def test_simulations_counted_meanwhile_are_kept_and_bounce_no_stroke(stage, terms, own):
    """An opponent who simulates without pause must not have the mover's stroke played again and again."""
    seats = stage.game("ann", "bob", **terms)
    seats.fetch()
    who = seats.breaker if own else 1 - seats.breaker
    reached = stage.meanwhile("shot-simulated", count(stage, seats, seats.ids[who], 5))
    seats.shoot(BREAK, simulated=3)
    assert reached.count("shot-simulated") == 1
    expected = [0, 0]
    expected[seats.breaker] += 3
    expected[who] += 5
    assert simulated(stage, seats) == expected
    assert played(stage, seats) == 1


def test_the_answer_and_the_record_have_what_was_counted_meanwhile(stage):
    seats = stage.game("ann", "bob", **BUDGET)
    seats.fetch()
    stage.meanwhile("shot-simulated", count(stage, seats, seats.ids[1 - seats.breaker], 5))
    clocks = seats.concede()["clocks"]
    assert clocks[1 - seats.breaker]["simulations_left"] == 95
    lines = [json.loads(line) for line in history.record(stage.context, seats.id).splitlines()]
    (end,) = (line for line in lines if line["type"] == "end")
    assert end["simulated"] == simulated(stage, seats)


def test_a_turn_delivered_meanwhile_is_still_one_stroke(stage):
    """Two workers of one agent: one fetches the turn that the other is playing, which moves the clock."""
    seats = stage.game("ann", "bob")
    reached = stage.meanwhile("shot-simulated", lambda: next_message(stage.context, seats.mover))
    seats.shoot(BREAK)
    assert reached.count("shot-simulated") == 2
    assert played(stage, seats) == 1


def test_a_stroke_beyond_the_budget_is_not_simulated(stage, monkeypatch):
    def drawn(*_):
        raise AssertionError("the stroke was simulated")

    seats = stage.game("ann", "bob", **BUDGET)
    seats.fetch()
    monkeypatch.setattr(strokes, "play_stroke", drawn)
    with pytest.raises(BudgetSpent):
        seats.shoot(BREAK, simulated=101)


def test_a_stroke_that_was_simulated_is_stored_though_the_budget_was_spent_meanwhile(stage):
    seats = stage.game("ann", "bob", **BUDGET)
    seats.fetch()
    stage.meanwhile("shot-simulated", count(stage, seats, seats.mover, 1))
    answer = seats.shoot(BREAK, simulated=100)
    assert answer["clocks"][seats.breaker]["simulations_left"] == 0
    assert simulated(stage, seats)[seats.breaker] == 100
    assert played(stage, seats) == 1


def test_after_a_late_flag_the_next_game_begins_now(stage):
    """A flag that comes late, because the process stood still, costs the next game's breaker nothing."""
    seats = stage.game("ann", "bob", games=2)
    seats.fetch()
    stage.time.pass_(200.0)
    flag(stage.context)
    flag(stage.context)
    with stage.context.database.reading() as connection:
        rows = connection.exec_driver_sql("SELECT status, available_at, used_0 + used_1 FROM games ORDER BY number")
        (first, _, used), (second, available_at, _) = rows.all()
    assert (first, used) == ("finished", 10 * SECOND)
    assert (second, available_at) == ("running", stage.time.now())


def test_no_seal_is_older_than_its_key(stage):
    """Who rotated the key may have a clock that is ahead of the server's."""
    seats = stage.game("ann", "bob")
    seats.fetch()
    with stage.context.writing() as writing:
        keys.rotate(writing.connection, stage.time.now() + 30 * SECOND)
    seats.concede()
    seal = json.loads(history.record(stage.context, seats.id).splitlines()[-1])
    with stage.context.database.reading() as connection:
        (key,) = (key for key in keys.published(connection).keys if key.id == seal["key"])
    assert seal["signed_at"] >= keys.time_text(round(key.valid_from.timestamp() * SECOND))
