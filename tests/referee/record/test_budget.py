"""The simulation budget in a record (docs/protocol.md, "Record"): its terms first, what was counted last."""

import json

import pytest

import physics
from client.local_game import play_game
from referee import Action, EightBall, NoiseModel
from referee.game import Decision
from referee.play import MatchSeed
from referee.play.budget import budgets
from referee.record import Chain, RecordVerdict, verify_record

BREAK = Action(physics.Shot(v=9.0, phi=270.0, theta=5.0), cue_ball=(0.558, 1.75))


def lines(allowed, spent):
    budget = budgets(allowed)

    def chair(seat):
        def choose(view):
            budget[seat].spend(spent[seat])
            return BREAK if view.phase == "break" else Action(decision=Decision.CONCEDE)

        return choose

    played = play_game(
        EightBall(physics.Table.olympiad()),
        (chair(0), chair(1)),
        MatchSeed.of(7).game(0),
        NoiseModel(0.0),
        budget=budget,
    )
    return list(played.record())


def test_terms_and_counts_are_told():
    record = lines(100, (30, 20))
    assert json.loads(record[0])["budget"] == {"simulations": 100, "counted": "by_driver"}
    found = verify_record(record)
    assert found.ok
    assert sum(json.loads(record[-2])["simulated"]) == sum(found.simulated) > 0
    assert "of 100 simulated shots each, counted by the driver" in str(found)


def test_without_a_budget_nothing_is_said():
    record = lines(None, (30, 20))
    assert json.loads(record[0])["budget"] is None
    assert json.loads(record[-2])["simulated"] is None
    found = verify_record(record)
    assert found.ok
    assert (found.budget, found.simulated) == (None, None)
    assert "simulated" not in str(found)


def changed(record, line, **fields):
    objects = [json.loads(each) for each in record]
    objects[line] |= fields
    chain = Chain()
    return [chain.add(each) for each in objects]


def test_more_than_was_granted_is_a_difference():
    found = verify_record(changed(lines(100, (30, 20)), -2, simulated=[101, 0]))
    assert found.verdict is RecordVerdict.DIFFERENT
    assert (found.difference.field, found.difference.recorded) == ("simulated", [101, 0])
    assert "at most 100" in str(found)


@pytest.mark.parametrize("counts", [None, [1], [1, -1], [1, True], [1.5, 0], "12", {"0": 1}])
def test_counts_that_are_none_are_malformed(counts):
    found = verify_record(changed(lines(100, (30, 20)), -2, simulated=counts))
    assert found.verdict is RecordVerdict.MALFORMED
    assert "simulated" in found.problem


@pytest.mark.parametrize(
    "budget", [{}, 5, {"simulations": -1, "counted": "by_driver"}, {"simulations": 5, "counted": "by_nobody"}]
)
def test_a_budget_that_is_none_is_malformed(budget):
    assert verify_record(changed(lines(100, (30, 20)), 0, budget=budget)).verdict is RecordVerdict.MALFORMED


def test_counts_without_a_budget_are_a_difference():
    found = verify_record(changed(lines(None, (0, 0)), -2, simulated=[1, 1]))
    assert (found.verdict, found.difference.field) == (RecordVerdict.DIFFERENT, "simulated")
