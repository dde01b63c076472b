"""What the server does again and again: a failure costs one turn, and all ends with the block."""

import asyncio

import pytest

from server.errors import Unavailable
from server.services.runtime.periodic import Periodic, at_work


def run(work, turns, **options):
    """Let the work be done that often; the times it was called, and the outages that were told."""
    calls: list[int] = []
    outages: list[int] = []
    options |= {"outage": lambda: outages.append(len(calls))}

    async def once():
        calls.append(len(calls))
        if len(calls) == turns:
            done.set()
        await work(len(calls))

    async def main():
        async with Periodic("the work", once, 0.001, **options).running():
            await asyncio.wait_for(done.wait(), 60)

    done = asyncio.Event()
    asyncio.run(main())
    return calls, outages


def test_work_that_fails_is_logged_and_done_again(caplog):
    async def work(turn):
        if turn == 2:
            raise ZeroDivisionError("by chance")

    calls, outages = run(work, 5)
    assert calls[:5] == [0, 1, 2, 3, 4]
    assert outages == []
    (record,) = caplog.records
    assert record.getMessage() == "the work failed; the next is due in 0.001 s"
    assert record.exc_info[0] is ZeroDivisionError


def test_an_outage_of_the_database_is_told_and_no_failure(caplog):
    async def work(turn):
        if turn in (1, 3):
            raise Unavailable("the database does not answer")

    assert run(work, 4)[1] == [1, 3]
    assert caplog.records == []


def test_the_first_time_may_come_at_once():
    async def work(turn):
        pass

    assert run(work, 1, first=0)[0][0] == 0


def test_tasks_have_ended_when_the_block_is_left():
    """Cancelled, and awaited: what they do at their end is done; also when the block fails."""
    ended = []

    async def task(name):
        try:
            await asyncio.sleep(3600)
        finally:
            await asyncio.sleep(0)
            ended.append(name)

    async def main():
        async with at_work(task("a"), task("b")):
            await asyncio.sleep(0)
            raise KeyError("the block")

    with pytest.raises(KeyError, match="the block"):
        asyncio.run(main())
    assert sorted(ended) == ["a", "b"]
