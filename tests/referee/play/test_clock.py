"""Clock arithmetic: whole nanoseconds, exactly zero is out of time (RULES.md, known errors)."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from referee.play import Clocks, nanoseconds


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
