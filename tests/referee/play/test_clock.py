"""Clock arithmetic: whole nanoseconds, exactly zero is out of time (RULES.md, known errors)."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from referee.play import Clocks, LagAllowance, nanoseconds
from referee.play.clock import GameClock


def test_time_charged_is_gone():
    clocks = Clocks.of_seconds(300).charged(0, nanoseconds(12.5)).charged(1, 1).charged(0, nanoseconds(0.5))
    assert clocks.remaining_seconds(0) == 287.0
    assert clocks.remaining_ns(1) == 300 * 10**9 - 1


def test_exactly_zero_is_out_of_time():
    """FastFiz took zero for unlimited."""
    clocks = Clocks.of_seconds(1)
    almost = clocks.charged(0, 10**9 - 1)
    assert not almost.is_out_of_time(0)
    assert almost.charged(0, 1).is_out_of_time(0)
    assert almost.charged(0, 2).is_out_of_time(0)
    assert not almost.charged(0, 2).is_out_of_time(1)


def test_time_is_never_given_back():
    """FastFiz let a negative time add to the clock."""
    with pytest.raises(ValueError, match="elapsed_ns = -1: must be >= 0"):
        Clocks.of_seconds(1).charged(0, -1)


@pytest.mark.parametrize("seconds", [0, -5])
def test_no_allowance_is_no_clock(seconds):
    with pytest.raises(ValueError, match="must be > 0"):
        Clocks.of_seconds(seconds)


@given(st.lists(st.tuples(st.integers(0, 1), st.integers(0, 10**12))))
def test_a_ledger_gives_the_same_clocks_as_charging_one_by_one(charges):
    clocks = Clocks.from_charges(10**12, charges)
    for seat in (0, 1):
        used = sum(elapsed for who, elapsed in charges if who == seat)
        assert clocks.remaining_ns(seat) == 10**12 - used
        assert clocks.is_out_of_time(seat) == (used >= 10**12)
        assert clocks.remaining_seconds(seat) >= 0.0


TIMES = st.integers(0, 10**10)
"""ns"""
ALLOWANCES = st.builds(LagAllowance, TIMES, TIMES)
CLOCKS = st.builds(GameClock, st.builds(Clocks, st.integers(1, 10**11)), ALLOWANCES)
NOW = 10**18


@given(CLOCKS, ALLOWANCES, TIMES, TIMES)
def test_a_late_fetch_gains_the_grace_and_no_more(clock, grace, wait, thought):
    """Every nanosecond of a turn is charged, or given back as lag or as grace, within what is allowed."""
    fetched = clock.offered(0, NOW, grace).fetched(NOW + wait)
    charge = fetched.charge_of_action(NOW + wait + thought)
    assert charge.measured_ns == wait + thought
    assert charge.grace_ns == min(wait, grace.turn_ns, grace.game_ns)
    assert charge.lag_ns == min(charge.measured_ns - charge.grace_ns, clock.lag.turn_ns, clock.lag.game_ns)


@given(CLOCKS, ALLOWANCES, TIMES)
def test_an_action_without_a_fetch_is_given_no_grace(clock, grace, thought):
    assert clock.offered(1, NOW, grace).charge_of_action(NOW + thought).grace_ns == 0


@given(CLOCKS, ALLOWANCES, st.lists(st.tuples(TIMES, TIMES), max_size=4), TIMES)
def test_however_often_a_game_stands_still_a_turn_costs_what_it_ran(clock, grace, spells, thought):
    """Each spell runs, then stands for any time; grace and lag together are no more than those of one turn."""
    whole = sum(ran for ran, _ in spells) + thought
    now, stood = NOW, clock.offered(0, NOW, grace)
    for ran, standing in spells:
        stopped, now = now + ran, now + ran + standing
        held = stood.held(stopped, 2**62)
        assert held.at(now) == held.at(2**61), "neither clock nor grace runs while it is held"
        stood = held.resumed(now, now, grace)
    charge = stood.fetched(now).charge(now + thought)
    assert charge.measured_ns == whole
    assert charge.grace_ns <= min(grace.turn_ns, grace.game_ns)
    ended = stood.fetched(now).ended(charge, moved=True)
    assert ended.clocks.used_ns == (charge.charged_ns, 0)
    assert ended.lag_ns == (charge.lag_ns, 0)


@given(CLOCKS, ALLOWANCES, TIMES)
def test_a_turn_runs_out_at_the_moment_from_which_an_action_is_too_late(clock, grace, wait):
    turn = clock.offered(0, NOW, grace).fetched(NOW + wait)
    out = turn.runs_out()
    assert turn.is_too_late(out)
    assert not turn.is_too_late(out - 1)
