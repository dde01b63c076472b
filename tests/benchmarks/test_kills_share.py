"""`benchmarks.kills` sees what must not be: a program that finds no fault proves something when it can find one."""

import asyncio
import json
from typing import Any

import pytest

from benchmarks import kills
from benchmarks.kills import Acknowledged, Hands, of_databases
from benchmarks.load_client import Reply
from benchmarks.load_games import Player

PLAYERS = (Player("one", "match"), Player("two", "match"))
ONE = Acknowledged(b"head", b"body", json.dumps({"game": "g", "stroke": {"n": 0}}).encode())


class Wire:
    """A connection to a server that gives prepared answers."""

    def __init__(self, *replies):
        self.replies = list(replies)

    async def send(self, head, body=b""):
        reply = self.replies.pop(0)
        if isinstance(reply, Exception):
            raise reply
        return reply

    async def get(self, path):
        return await self.send(path)

    async def post(self, path, content, token=None, key=""):
        return {"id": "match", "played": [{"id": "g"}]}

    def close(self):
        pass


def hands_at(*replies: Any) -> Hands:
    wire: Any = Wire(*replies)
    return Hands(wire, PLAYERS, polls=False)


@pytest.mark.parametrize("reply", [Reply(200, b"another"), Reply(409, ONE.answer)])
def test_another_answer_to_the_same_bytes_is_a_fault(reply):
    hands = hands_at(reply)
    asyncio.run(hands.repeat(ONE))
    assert len(hands.faults) == 1


def test_the_same_answer_is_none_however_late_it_comes():
    hands = hands_at(ConnectionResetError(), Reply(503, b""), Reply(200, ONE.answer))
    asyncio.run(hands.repeat(ONE))
    assert (hands.faults, hands.resent) == ([], 1)


@pytest.mark.parametrize(
    "stored", [[], [{"n": 0}, {"n": 0}], [{"n": 1}]], ids=["a stroke is lost", "it is doubled", "it is another"]
)
def test_what_is_stored_must_be_what_was_acknowledged(stored):
    page = Reply(200, json.dumps({"shots": stored, "next_cursor": None}).encode())
    hands = hands_at(Reply(200, ONE.answer), page, Reply(200, b"no record"))
    hands.acknowledged.append(ONE)
    assert asyncio.run(hands.look_over()) == 0
    assert [fault.partition(": ")[2] for fault in hands.faults] == [
        "what is stored is not what was acknowledged",
        "its record does not verify",
    ]


@pytest.mark.slow
def test_a_server_that_is_killed_loses_nothing(monkeypatch):
    monkeypatch.setattr(kills, "MATCHES", 2)
    tables = of_databases(3, ["sqlite"])
    assert tables["failures"] == []
    (row,) = tables["sqlite"]
    assert row["records"] >= 2
    assert row["strokes"] > 3
