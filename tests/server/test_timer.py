"""The timer's flag against a request that is being worked on: the clock stopped when its last byte came."""

import json

import pytest

from referee.wire import AgentRequest
from server.security.callers import ORGANISER, Caller
from server.services import agents, matches, turns
from server.services.commands import Command
from server.services.context import Context
from server.services.timer import flag
from server.settings import Settings
from server.store.database import Database
from server.store.upgrade import upgrade

SECOND = 1_000_000_000


class StoppedTime:
    """A time that moves when it is told to."""

    def __init__(self) -> None:
        self.value = 1_000 * SECOND

    def now(self) -> int:
        return self.value


@pytest.fixture
def context(tmp_path):
    database = Database(f"sqlite:///{tmp_path / 'timer.db'}")
    upgrade(database)
    yield Context(Settings(), database, time=StoppedTime())
    database.dispose()


@pytest.fixture
def turn(context):
    """A game of 10 seconds whose first turn has just been delivered: its id and its mover's."""
    registered = [agents.register(context, AgentRequest(name=name)) for name in ("ann", "bob")]
    ids = [json.loads(answer.body)["agent"]["id"] for answer in registered]
    body = json.dumps({"agents": ids, "clock": {"seconds": 10.0}}).encode()
    command = Command(Caller(ORGANISER, "t"), "/v1/matches", "k", None, "application/json", body, context.time.now())
    match = json.loads(matches.create(context, command).body)
    mover = ids[match["first_breaker"]]
    message = turns.next_message(context, mover)
    return json.loads(message)["game"], mover


def ended(context, turn):
    """Whether the mover has been told that the game is over."""
    flag(context)
    message = turns.next_message(context, turn[1])
    return message is not None and json.loads(message)["type"] == "game_over"


def test_exactly_zero_is_out_of_time(context, turn):
    context.time.value += 10 * SECOND - 1
    assert not ended(context, turn)
    context.time.value += 1
    assert ended(context, turn)


def test_a_request_that_came_in_time_holds_the_flag_until_it_is_done(context, turn):
    context.in_hand[turn[0]].append(context.time.now() + 10 * SECOND - 1)
    context.time.value += 15 * SECOND
    assert not ended(context, turn)
    context.in_hand.clear()
    assert ended(context, turn)


def test_a_request_that_came_too_late_does_not(context, turn):
    context.in_hand[turn[0]].append(context.time.now() + 10 * SECOND)
    context.time.value += 15 * SECOND
    assert ended(context, turn)


def test_redelivery_never_restarts_the_clock(context, turn):
    context.time.value += 6 * SECOND
    assert not ended(context, turn)
    context.time.value += 4 * SECOND
    assert ended(context, turn)
