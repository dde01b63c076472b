"""Events at a server: docs/running-tournaments.md, Over HTTP."""

import json
import sys

import pytest

from client.arena.directory import EventDirectory, EventError
from client.arena.executors import InProcess
from client.arena.remote import RemoteRunner
from client.arena.runner import Runner
from client.arena.terms import Terms
from referee.record import read_record, verify_record

CUP = {
    "name": "cup",
    "entrants": ["random", {"name": "other", "agent": "random"}],
    "pairs": 1,
    "seconds": 300.0,
    "seed": 11,
}


def begin(path, **values):
    return EventDirectory.create(path, Terms.from_dict(CUP | values).to_dict())


def game(path):
    """What was played: all that does not depend on time, names of games and who signs."""
    record = read_record(path)
    header = {name: record.header[name] for name in ("players", "rules", "table", "noise", "start")}
    kept = ("stroke", "seat", "action", "shot", "events", "final", "ruling", "game")
    entries = [{name: entry.get(name) for name in kept} for entry in record.entries]
    return header, entries, record.end["outcome"], record.end["noise_secret"]


def test_the_same_terms_and_seed_are_the_same_games_with_and_without_a_server(tmp_path, hall):
    """Ids, times, commitments (they name the match) and signatures differ; everything that was played does not."""
    here, there = begin(tmp_path / "here"), begin(tmp_path / "there")
    local = Runner(here, InProcess()).run()
    remote = RemoteRunner(there, hall.url, hall.organiser_token).run()
    assert remote.event.finished
    names = sorted(path.name for path in there.games.glob("*.jsonl"))
    assert names == sorted(path.name for path in here.games.glob("*.jsonl"))
    for name in names:
        assert verify_record(there.games / name).ok
        assert game(there.games / name) == game(here.games / name)
    assert [one.winner for one in remote.event.counted] == [one.winner for one in local.event.counted]
    view = hall.organiser.tournament(json.loads((there.path / "server.json").read_text())["tournament"])
    assert view.status == "finished"
    assert RemoteRunner(there, hall.url, hall.organiser_token).run().event.counted == remote.event.counted


def test_an_agent_that_crashes_loses_for_that_reason_at_a_server_too(tmp_path, hall):
    bad = {"name": "bad", "agent": f"stdio:{sys.executable} -c pass"}
    directory = begin(tmp_path / "cup", entrants=["random", bad])
    ledger = RemoteRunner(directory, hall.url, hall.organiser_token).run()
    assert {(one.reason.value, one.players[one.winner]) for one in ledger.event.counted} == {("crash", "random")}


def test_an_entrant_who_is_not_there_is_named(tmp_path, hall):
    directory = begin(tmp_path / "cup", entrants=["random", {"name": "nobody", "agent": "remote"}])
    with pytest.raises(EventError, match="nobody"):
        RemoteRunner(directory, hall.url, hall.organiser_token).run()
