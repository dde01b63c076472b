"""docs/protocol.md, clocks: one process has the monotonic clock, several have the database's."""

import time

import pytest

from server.services.runtime.time import DatabaseTime, TimeSource
from server.store.database import Database

SECOND = 1_000_000_000


class TwoClocks:
    """A process's clock and a database's, which is asked over a way that takes a while."""

    def __init__(self, ahead: int, there: int = 0, back: int = 0) -> None:
        self.mine, self.ahead, self.there, self.back = 50 * SECOND, ahead, there, back

    def monotonic(self) -> int:
        return self.mine

    def read(self) -> int:
        self.mine += self.there
        told = self.mine + self.ahead
        self.mine += self.back
        return told


@pytest.mark.parametrize(("there", "back"), [(0, 0), (3, 7), (10, 0), (0, 10)])
@pytest.mark.parametrize("ahead", [-20 * SECOND, 0, 10**18, 3 * 10**18])
def test_every_process_is_within_a_round_trip_of_the_database(ahead, there, back):
    clocks = TwoClocks(ahead, there, back)
    source = DatabaseTime(clocks.read, clocks.monotonic)
    source.adjust()
    assert abs(source.now() - (clocks.mine + ahead)) <= there + back


def test_two_processes_agree_whatever_their_own_clocks_say():
    one, other = TwoClocks(10**18, 2, 5), TwoClocks(10**18 + 7_777 * SECOND, 4, 1)
    other.mine -= 7_777 * SECOND
    sources = [DatabaseTime(each.read, each.monotonic) for each in (one, other)]
    for source in sources:
        source.adjust()
    one.mine = other.mine + 7_777 * SECOND
    assert abs(sources[0].now() - sources[1].now()) <= 12


def test_a_clock_that_is_set_back_never_takes_time_back():
    clocks = TwoClocks(10**18)
    source = DatabaseTime(clocks.read, clocks.monotonic)
    source.adjust()
    before = source.now()
    clocks.ahead -= 5 * SECOND
    source.adjust()
    assert source.now() == before
    clocks.mine += 6 * SECOND
    assert source.now() == before + SECOND


def test_one_process_is_monotonic_and_near_the_wall():
    source = TimeSource()
    seen = [source.now() for _ in range(1000)]
    assert seen == sorted(seen)
    assert abs(seen[-1] - time.time_ns()) < SECOND


def test_the_clock_of_postgresql_is_read_in_nanoseconds(postgres):
    database = Database(postgres.new())
    source = DatabaseTime(database.clock)
    source.adjust()
    first, again = database.clock(), database.clock()
    assert first < again
    assert abs(source.now() - again) < 5 * SECOND
    database.dispose()
