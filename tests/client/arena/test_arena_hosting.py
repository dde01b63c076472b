"""How entrants are run: docs/running-tournaments.md, Entrants."""

import dataclasses
import datetime
import json
import math
import os
import signal
import subprocess
import sys
from typing import Any

import pytest

from client.arena.confine import confined
from client.arena.cores import CoreLease
from client.arena.directory import EventError
from client.arena.hosting import Hosting, Kind
from client.arena.terms import Terms
from tournament import Spec

EVENT = {"name": "cup", "entrants": ["random", "greedy"]}


@pytest.mark.parametrize(
    ("agent", "kind", "process"),
    [
        ("greedy", Kind.SHIPPED, False),
        ("search:seconds=0.3", Kind.SHIPPED, False),
        ("my.bots:Best", Kind.IMPORT_PATH, True),
        ("remote", Kind.REMOTE, False),
        ("remote:agent_12", Kind.REMOTE, False),
        ("stdio:./bot --level 3", Kind.COMMAND, True),
        ("stdio:node 'my bot.js'", Kind.COMMAND, True),
    ],
)
def test_an_agent_is_told_by_its_name(agent, kind, process):
    assert Hosting(agent).kind is kind
    assert Hosting(agent).as_process is process
    assert Hosting.from_dict(json.loads(json.dumps(Hosting(agent).to_dict()))) == Hosting(agent)


@pytest.mark.parametrize(
    ("agent", "values", "named"),
    [
        ("greedy", {"memory_mb": 100}, "process"),
        ("stdio:./bot", {"memory_mb": 0}, "memory_mb"),
        ("stdio:./bot", {"memory_mb": True}, "memory_mb"),
        ("stdio:./bot", {"cores": 0.5}, "cores"),
        ("stdio:./bot", {"answer_seconds": 0}, "answer_seconds"),
        ("stdio:./bot", {"answer_seconds": float("nan")}, "answer_seconds"),
        ("stdio:./bot", {"options": {"level": 3}}, "options"),
        ("greedy", {"options": [3]}, "options"),
        ("stdio:./bot", {"environment": {"A": 3}}, "environment"),
        ("stdio:./bot", {"memory": 3}, "memory"),
        ("stdio:./bot 'open", {}, "agent"),
        (" ", {}, "agent"),
        ("./bot", {}, "stdio:COMMAND"),
    ],
)
def test_what_cannot_be_is_named(agent, values, named):
    with pytest.raises(EventError, match=named):
        Hosting.of(agent, values)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("name = 3", "name"),
        ('name = "x"\nentrants = ["random", "greedy"]\nsed = 3', "sed"),
        ('name = "x"\nentrants = ["random", "greedy"]\n[hosting.c]', "hosting"),
        ('name = "x"\nentrants = ["random", "greedy"]\n[hosting.random]\ncores = -1', "cores"),
        ("name = ", "cannot be read"),
        ("seed = 1" + "0" * 5000, "cannot be read"),
        ("name = " + "[" * 5000, "cannot be read"),
        ("\x00", "cannot be read"),
    ],
)
def test_a_bad_event_file_is_one_line_that_names_the_fault(tmp_path, text, named):
    (tmp_path / "cup.toml").write_text(text)
    with pytest.raises(EventError, match=named):
        Terms.read(tmp_path / "cup.toml")


ODD: tuple[Any, ...]
ODD = (None, True, -1, 0, 10**400, math.inf, math.nan, "", "x" * 10**5, "\0", "\ud800", [], [[]], {}, {1: 2})
ODD += ({"levels": "x"}, {"range": 5}, {"range": [1]}, {"elo0": "x"}, datetime.date(2026, 1, 1), b"x")
SPEC = [each.name for each in dataclasses.fields(Spec)]
HOSTING = [each.name for each in dataclasses.fields(Hosting)]


@pytest.mark.parametrize("field", [*SPEC, "preset", "hosting", "unknown"])
def test_whatever_stands_in_an_event_file_is_accepted_or_named_in_a_sentence(field):
    for value in ODD:
        accepted_or_named(EVENT | {field: value}, field)


@pytest.mark.parametrize("field", [*HOSTING, "unknown"])
def test_whatever_stands_in_a_hosting_table_is_accepted_or_named_in_a_sentence(field):
    for value in ODD:
        accepted_or_named(EVENT | {"hosting": {"random": {field: value}}}, field)


def accepted_or_named(event, field):
    words = complaint(event)
    assert words is None or field.rstrip("s") in words or "entrant" in words
    assert words is None or len(words) < 500


def complaint(event):
    """What is said against an event's terms."""
    try:
        Terms.from_dict(event)
    except EventError as error:
        return str(error)
    return None


def test_terms_come_back_as_they_were():
    terms = Terms.from_dict(EVENT | {"hosting": {"greedy": {"process": True, "memory_mb": 2000}}})
    again = Terms.from_dict(json.loads(json.dumps(terms.to_dict())))
    assert again == terms
    assert again.hosting["greedy"].memory_mb == 2000


def test_no_two_leases_share_a_core():
    available = len(os.sched_getaffinity(0))
    leases = [CoreLease(1) for _ in range(available + 1)]
    try:
        held = [cpu for lease in leases for cpu in lease.cpus]
        assert len(set(held)) == len(held) <= available
        assert leases[-1].cpus == []
    finally:
        for lease in leases:
            lease.release()


def run_confined(script, memory=None):
    core = sorted(os.sched_getaffinity(0))[:1]
    command = confined([sys.executable, "-c", script], memory=memory, file=1000, cpus=core)
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_limits_hold_in_the_process():
    said = run_confined(
        "import os, resource; print(len(os.sched_getaffinity(0)), resource.getrlimit(resource.RLIMIT_FSIZE)[0])"
    )
    assert said.stdout.split() == ["1", "1000"]
    assert "MemoryError" in run_confined("x = bytes(10**9)", memory=500 * 2**20).stderr


@pytest.mark.parametrize("name", ["PIPE", "XFSZ"])
def test_a_confined_command_has_the_signals_of_any_other(name):
    """Seen: what Python ignores for itself stayed ignored in the command it became, so a shell's pipes did not end."""
    command = ["sh", "-c", f"kill -s {name} $$; echo still here"]
    said = subprocess.run(confined(command), capture_output=True, text=True, check=False)
    assert (said.returncode, said.stdout) == (-signal.Signals[f"SIG{name}"], "")
