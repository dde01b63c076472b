"""Events at a server: docs/running-tournaments.md, Over HTTP."""

import json
import sys
import time
from pathlib import Path

import httpx2
import pytest

import client
from client.arena.directory import EventDirectory, EventError
from client.arena.executors import InProcess
from client.arena.journal import Journal
from client.arena.remote import RemoteRunner
from client.arena.runner import Runner
from client.arena.terms import Terms
from client.errors import BudgetSpent, ConnectionFailed
from protocol import Turn, VoidRequest
from referee.record import read_record, verify_record
from tournament import Tournament, game_seeds
from tournament.report import event_report

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


@pytest.mark.slow
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


MODEST = """
import json, sys
for line in sys.stdin:
    if json.loads(line)["type"] == "turn":
        print('{"decision": "concede"}', flush=True)
"""


def test_an_event_whose_secrets_the_server_draws_is_kept_in_the_same_books(tmp_path, hall):
    """Order and levels follow from the lots; the seed, and records with untold noise, come when the event is over."""
    (tmp_path / "bot.py").write_text(MODEST)
    entrants = [{"name": name, "agent": f"stdio:{sys.executable} {tmp_path / 'bot.py'}"} for name in ("ann", "bob")]
    noise = {"range": [0.0, 5.0], "told": False}
    terms = {"name": "cup", "entrants": entrants, "seeding": "drawn", "noise": noise, "seconds": 300.0}
    directory = EventDirectory.create(tmp_path / "cup", Terms.from_dict(terms).to_dict())
    assert directory.terms()["seed"] is None
    ledger = RemoteRunner(directory, hall.url, hall.organiser_token).run()
    spec = Terms.from_dict(directory.terms()).spec
    assert (ledger.event.finished, len(str(spec.seed)), len(str(spec.lots)), spec.foreseeable) == (True, 64, 64, False)
    assert event_report(ledger.event)["terms"]["foreseeable"] is False
    for result in ledger.event.counted:
        path = directory.path / result.record
        assert verify_record(path).ok
        record = read_record(path)
        assert None not in record.header["client_seeds"]
        assert record.header["noise"] == {"level": result.noise, "told": False}
        (due,) = (due for due in Tournament(spec).due if (due.pair.id, due.leg) == (result.pair, result.leg))
        assert due.pair.players == result.players
        assert record.end["noise_secret"] == game_seeds(spec, due.pair, due.leg).noise.hex()
    again = RemoteRunner(directory, hall.url, hall.organiser_token).run()
    assert again.event.counted == ledger.event.counted


STUBBORN = """
import json, sys
refused = []
for line in sys.stdin:
    message = json.loads(line)
    if message["type"] == "refused":
        refused.append(message["reason"])
        print(message["reason"], file=open(sys.argv[1], "a"))
    if message["type"] == "turn":
        print('{"decision": "%s"}' % ("concede" if refused else "rerack_and_break"), flush=True)
"""
NONSENSE = """
import json, sys
for line in sys.stdin:
    if json.loads(line)["type"] == "turn":
        print("asked", file=open(sys.argv[1], "a"))
        print("nonsense", flush=True)
"""
SILENT = "import os, sys, time; open(sys.argv[1], 'a').write(f'{os.getpid()}\\n'); time.sleep(600)"


def runs(pid: int) -> bool:
    """Whether a process is there and no zombie."""
    try:
        status = Path(f"/proc/{pid}/stat").read_text()
    except FileNotFoundError:
        return False
    return status.rpartition(")")[2].split()[0] != "Z"


def all_end(pids: list[int]) -> bool:
    """Whether they all end within a loaded machine's time to end what was killed."""
    deadline = time.monotonic() + 60.0
    while any(map(runs, pids)) and time.monotonic() < deadline:
        time.sleep(0.05)
    return not any(map(runs, pids))


@pytest.mark.parametrize(
    ("text", "reason", "asked"),
    [(STUBBORN, "concession", {2}), (NONSENSE, "forfeit", {40}), (SILENT, "stall", {1, 2, 3})],
    ids=["told why it was refused", "nonsense", "silent without a clock"],
)
def test_an_agent_meets_the_same_patience_at_a_server(tmp_path, hall, text, reason, asked):
    """Seen: it was told nothing, its nonsense was taken for ever, and without clocks it could be silent for a day."""
    (tmp_path / "bot.py").write_text(text)
    command = f"stdio:{sys.executable} {tmp_path / 'bot.py'} {tmp_path / 'asked'}"
    entrants = ["random", {"name": "bot", "agent": command}]
    patience = {"answer_seconds": 3.0 if text is SILENT else 120.0}
    directory = begin(tmp_path / "cup", entrants=entrants, seconds=None, hosting={"bot": patience})
    ledger = RemoteRunner(directory, hall.url, hall.organiser_token).run()
    assert [(one.reason.value, one.players[one.winner]) for one in ledger.event.counted] == [(reason, "random")] * 2
    lines = (tmp_path / "asked").read_text().splitlines()
    assert len(lines) in asked  # once more if it came so far when it was tried before the first game
    if text is SILENT:
        assert all_end([int(pid) for pid in lines]), "seen: the command outlived its host"
    else:
        assert lines[0] == "asked" or "no choice is open" in lines[0]


def test_an_agent_that_crashes_loses_for_that_reason_at_a_server_too(tmp_path, hall):
    bad = {"name": "bad", "agent": f"stdio:{sys.executable} -c 'input()'"}
    directory = begin(tmp_path / "cup", entrants=["random", bad])
    ledger = RemoteRunner(directory, hall.url, hall.organiser_token).run()
    assert {(one.reason.value, one.players[one.winner]) for one in ledger.event.counted} == {("crash", "random")}


def test_whose_declaration_is_always_refused_loses_at_last(tmp_path, hall, monkeypatch):
    """Seen: it was no bad answer, so that the same one was sent until the clock was out, with an incident each."""
    refusal = httpx2.Response(409, request=httpx2.Request("POST", "http://here/v1/games/g/shots"))

    def spent(*_, **__):
        raise BudgetSpent(refusal, None)

    monkeypatch.setattr(client.Pooliad, "act", spent)
    directory = begin(tmp_path / "cup", seconds=20.0)
    ledger = RemoteRunner(directory, hall.url, hall.organiser_token).run()
    assert [one.reason.value for one in ledger.event.counted] == ["forfeit"] * 2


THRIFTY = """
from client import Action
from client.agents.random_agent import RandomAgent
from physics import Shot

class Thrifty(RandomAgent):
    turns = 0

    def choose(self, view):
        self.turns += 1
        if self.turns == 1:
            for _ in range(2):
                self.simulator.simulate(view.table_model(), view.state, Shot(phi=90.0, v=1.0))
        return super().choose(view) if self.turns < 3 else Action(decision="concede")
"""


def test_shots_whose_declaration_was_carried_out_unanswered_are_not_declared_again(tmp_path, hall, monkeypatch):
    """Seen: the count lagged behind the server's for the rest of the game, until the server took no action more."""
    act, declared = client.Pooliad.act, []

    def unanswered(self, game, version, action, *, simulated=0):
        declared.append(simulated)
        act(self, game, version, action, simulated=simulated)
        raise ConnectionFailed("POST", f"/v1/games/{game}", TimeoutError())

    monkeypatch.setattr(client.Pooliad, "act", unanswered)
    (tmp_path / "thrifty.py").write_text(THRIFTY)
    entrants = ["random", {"name": "thrifty", "agent": "thrifty:Thrifty"}]
    hosting = {"thrifty": {"environment": {"PYTHONPATH": str(tmp_path)}}}
    directory = begin(tmp_path / "cup", entrants=entrants, hosting=hosting, simulated_shots=3, seconds=20.0)
    RemoteRunner(directory, hall.url, hall.organiser_token).run()
    assert [count for count in declared if count] == [2, 2]


class Unplugged(BaseException):
    """The runner stops here."""


def unplugged(*_):
    raise Unplugged


@pytest.fixture
def duel(tmp_path, hall):
    """An event of two agents that play by themselves, begun; its runner is away."""
    tokens = [hall.register(name) for name in ("ann", "bob")]
    remote = [{"name": each.agent.name, "agent": f"remote:{each.agent.id}"} for each in tokens]
    directory = begin(tmp_path / "duel", entrants=remote)
    with pytest.raises(Unplugged):
        RemoteRunner(directory, hall.url, hall.organiser_token, unplugged).run()
    players = [client.Pooliad(hall.url, each.token) for each in tokens]
    yield directory, players
    for player in players:
        player.close()


def concede_turn(players):
    """Whoever is to play concedes."""
    for player in players:
        while (message := player.turns(0.0)) is not None:
            if isinstance(message, Turn) and message.view.my_turn:
                player.play(message.game, message.view.version, client.Action(decision=client.Decision.CONCEDE))
                return
    raise AssertionError("nobody is to play")


def test_what_was_decided_while_the_runner_was_away_is_repeated_in_its_order(duel, hall):
    """Seen: all results first, so that a game played again came too late, and its file was in the way for good."""
    directory, players = duel
    tournament = json.loads((directory.path / "server.json").read_text())["tournament"]
    concede_turn(players)
    hall.organiser.direct_tournament(tournament, "void", VoidRequest(pair="r0-m0-p0", leg=0))
    concede_turn(players)
    concede_turn(players)
    ledger = RemoteRunner(directory, hall.url, hall.organiser_token).run()
    assert ledger.event.finished
    assert sorted((one.id, one.void) for one in ledger.event.results) == [
        ("r0-m0-p0-g0", True),
        ("r0-m0-p0-g0-a1", False),
        ("r0-m0-p0-g1", False),
    ]
    assert all(verify_record(directory.path / one.record).ok for one in ledger.event.results)


def test_a_result_whose_journal_line_was_lost_is_taken_again(duel, hall, monkeypatch):
    """Seen: the record was there, so the result was lost for good; a resume in a later round ended without a word."""
    directory, players = duel
    concede_turn(players)
    concede_turn(players)
    append = Journal.append
    monkeypatch.setattr(
        Journal, "append", lambda *args, **fields: unplugged() if args[1] == "game" else append(*args, **fields)
    )
    with pytest.raises(Unplugged):
        RemoteRunner(directory, hall.url, hall.organiser_token).run()
    monkeypatch.undo()
    assert len(list(directory.games.iterdir())) == 1
    ledger = RemoteRunner(directory, hall.url, hall.organiser_token).run()
    assert ledger.event.finished
    assert len(ledger.event.counted) == 2


def test_results_of_another_event_are_not_taken_for_this_ones(duel, tmp_path, hall):
    directory, players = duel
    concede_turn(players)
    strangers = [{"name": name, "agent": "remote"} for name in ("cat", "dan")]
    other = begin(tmp_path / "other", entrants=strangers)
    (other.path / "server.json").write_text((directory.path / "server.json").read_text())
    with pytest.raises(EventError, match="does not fit the event"):
        RemoteRunner(other, hall.url, hall.organiser_token).run()


def test_an_entrant_who_is_not_there_is_named(tmp_path, hall):
    directory = begin(tmp_path / "cup", entrants=["random", {"name": "nobody", "agent": "remote"}])
    with pytest.raises(EventError, match="nobody"):
        RemoteRunner(directory, hall.url, hall.organiser_token).run()
