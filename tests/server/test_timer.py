"""The timer's flag against a request that is being worked on: the clock stopped when its last byte came."""

import asyncio
import json
import logging

import pytest
from support.server_time import SECOND, StoppedTime, next_message

from protocol import AgentRequest
from server.errors import OutOfTime
from server.http.commands import Command
from server.security.callers import Caller
from server.services.accounts import agents
from server.services.matches import matches
from server.services.play import games, strokes
from server.services.play.clock.flag import flag
from server.services.runtime.context import Context
from server.settings import Settings
from server.store.database import Database
from server.store.upgrade import upgrade


@pytest.fixture
def context(tmp_path):
    database = Database(f"sqlite:///{tmp_path / 'timer.db'}")
    upgrade(database)
    yield Context(Settings(lag_turn=0.0, lag_game=0.0), database, time=StoppedTime())
    database.dispose()


@pytest.fixture
def unfetched(context):
    """A game of 10 seconds whose first turn nobody has fetched: its id and its mover's."""
    return new_game(context, "ann", "bob")


@pytest.fixture
def turn(context, unfetched):
    """The same game once its first turn has been delivered."""
    next_message(context, unfetched[1])
    return unfetched


def new_game(context, *names):
    registered = [agents.register(context, AgentRequest(name=name)) for name in names]
    ids = [json.loads(answer.body)["agent"]["id"] for answer in registered]
    body = json.dumps({"agents": ids, "clock": {"seconds": 10.0}}).encode()
    command = Command(
        Caller.organiser("t"), "/v1/matches", names[0], None, "application/json", body, context.time.now()
    )
    match = json.loads(matches.create(context, command).body)
    return match["played"][0]["id"], ids[match["first_breaker"]]


def concede(context, game, mover):
    """The mover's action, and the time that it leaves the mover."""
    command = Command(Caller(mover, "t"), "/concede", "c", '"1"', None, b"", context.time.now())
    answer = json.loads(strokes.concede(context, game, lambda _: command).body)
    return answer["clocks"][answer["stroke"]["seat"]]["seconds_left"]


def ended(context, turn):
    """Whether the mover has been told that the game is over."""
    flag(context)
    message = next_message(context, turn[1])
    return message is not None and json.loads(message)["type"] == "game_over"


def test_exactly_zero_is_out_of_time(context, turn):
    context.time.value += 10 * SECOND - 1
    assert not ended(context, turn)
    context.time.value += 1
    assert ended(context, turn)


def test_a_game_that_ends_while_the_server_stops_is_ended_in_silence(context, turn, caplog):
    """The loop is closed before the timer's last look is over: whoever waited has been sent home. Each was an error."""

    async def starts():
        context.wakeups.start()

    asyncio.run(starts())
    context.time.value += 10 * SECOND
    with caplog.at_level(logging.ERROR):
        assert ended(context, turn)
    assert not caplog.records


def test_a_request_that_came_in_time_holds_the_flag_until_it_is_done(context, turn):
    with context.in_hand.working_on(turn[0], context.time.now() + 10 * SECOND - 1):
        context.time.value += 15 * SECOND
        assert not ended(context, turn)
    assert ended(context, turn)


def test_a_request_that_came_too_late_does_not(context, turn):
    with context.in_hand.working_on(turn[0], context.time.now() + 10 * SECOND):
        context.time.value += 15 * SECOND
        assert ended(context, turn)


def test_redelivery_never_restarts_the_clock(context, turn):
    context.time.value += 6 * SECOND
    assert not ended(context, turn)
    context.time.value += 4 * SECOND
    assert ended(context, turn)


@pytest.mark.parametrize(("late", "left"), [(0.25, 9.0), (1.0, 9.0), (1.5, 8.5), (4.0, 6.0), (8.9, 1.1)])
def test_a_turn_that_is_fetched_late_gains_a_second_at_most(context, unfetched, late, left):
    """It gained the whole of five seconds: the clock started with the fetch, and the table can be read before it."""
    context.time.value += round(late * SECOND)
    next_message(context, unfetched[1])
    context.time.value += SECOND
    assert concede(context, *unfetched) == pytest.approx(left)


def test_who_plays_without_fetching_the_turn_pays_from_when_it_was_there(context, unfetched):
    """The view can be read elsewhere: the wait for the fetch is no free time to think."""
    context.time.value += 4 * SECOND
    assert concede(context, *unfetched) == 6.0


@pytest.mark.parametrize(("thought", "is_late"), [(10 * SECOND - 1, False), (10 * SECOND, True)])
def test_who_plays_without_fetching_the_turn_has_no_more_time_than_others(context, unfetched, thought, is_late):
    context.time.value += thought
    if is_late:
        with pytest.raises(OutOfTime):
            concede(context, *unfetched)
    else:
        assert concede(context, *unfetched) == pytest.approx(0.0, abs=1e-6)


def test_a_game_that_cannot_be_ended_does_not_keep_the_others_running(context, monkeypatch, caplog):
    broken, whole = new_game(context, "ann", "bob"), new_game(context, "cat", "dan")

    def end(writing, live, *how, **when):
        if live.id == broken[0]:
            raise RuntimeError("its row is damaged")
        return real(writing, live, *how, **when)

    real = games.end_from_outside
    monkeypatch.setattr(games, "end_from_outside", end)
    context.time.value += 20 * SECOND
    assert ended(context, whole)
    assert broken[0] in caplog.text
