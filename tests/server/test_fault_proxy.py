"""Matches between SDK agents through a proxy that loses, repeats and delays (docs/operations.md, "Exactly once")."""

import itertools
import json
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
from support.fault_proxy import FAULTS, FaultProxy, serving
from support.players import Potter

import client
from client import run as client_run
from referee.record import verify_record

SEED = "f" * 64
SHARE = 0.4
"""Of the requests meet a fault."""
DECIDED = ("stroke", "seat", "action", "before", "shot", "events", "status", "final", "ruling", "game")
"""Fields of a record's line that do not depend on when things happened or what the game is called."""


class Potting(client.Agent):
    """Deterministic: what it plays depends on the course of the game alone."""

    def __init__(self):
        self._potter = Potter("fixed", 4.0)

    def choose(self, view):
        return self._potter(view)


@pytest.fixture
def short_polls(monkeypatch):
    """News that were lost with their reply are looked up when a poll ends: soon."""
    monkeypatch.setattr(client_run, "POLL", 1.0)


def played(table, url):
    """The match played by two SDK agents at this address: its records."""
    with ThreadPoolExecutor(2) as pool:
        runs = [pool.submit(client.run_agent, Potting, url, player.token) for player in table.players]
        ends = [run.result() for run in runs]
    assert {end.match for end in ends} == {table.match["id"]}
    match = table.organiser.get(f"/v1/matches/{table.match['id']}").json()
    records = []
    for game in match["played"]:
        lines = table.organiser.get(f"/v1/games/{game['id']}/record").text.splitlines()
        assert verify_record(lines).ok
        records.append([json.loads(line) for line in lines])
    return records


def decided(record):
    """The course of a game."""
    return [{field: line.get(field) for field in DECIDED} for line in strokes_of(record)]


def strokes_of(record):
    """The lines about strokes and decisions."""
    return [line for line in record if line["type"] == "stroke"]


def test_a_match_through_faults_is_the_match_without_them(server, new_table, short_polls):
    calm = played(new_table(seed=SEED), server.url)
    proxy, table = FaultProxy(server.url, 1, SHARE), new_table(seed=SEED)
    with serving(proxy) as url:
        rough = played(table, url)
    assert all(count > 0 for count in proxy.faults.values()), proxy.faults
    assert set(proxy.faults) == set(FAULTS)
    assert [decided(record) for record in rough] == [decided(record) for record in calm]
    check_history(proxy, rough)


def check_history(proxy, records):
    """Versions are consecutive, whatever was acknowledged is there once, and a repeated request got the same bytes."""
    accepted = [one for one in proxy.exchanges if one.method == "POST" and one.status == 200]
    by_key: dict[Any, bytes] = {}
    for one in accepted:
        assert by_key.setdefault((one.path, one.key), one.body) == one.body
    answers = [json.loads(body) for body in by_key.values()]
    for record in records:
        (game,) = {answer["game"] for answer in answers if answer["game"] == record[0]["game"]}
        ours = sorted((answer for answer in answers if answer["game"] == game), key=lambda a: a["view"]["version"])
        assert [answer["view"]["version"] for answer in ours] == list(range(2, len(ours) + 2))
        assert [line["entry"] for line in strokes_of(record)] == list(range(len(ours)))
        for answer, line in zip(ours, strokes_of(record), strict=True):
            assert answer["view"]["strokes_since"][-1]["shot"] == line.get("shot")
    kept = set(by_key.values())
    assert all(one.body in kept for one in accepted if one.acknowledged)
    repeated = [len(list(group)) for _, group in itertools.groupby(sorted((one.path, one.key) for one in accepted))]
    assert max(repeated) > 1, "some accepted request came more than once"
