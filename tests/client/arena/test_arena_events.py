"""Whole events: on any executor the same, killed at any instant and taken up again, decided about while they run."""

import json
import os
import random
import resource
import subprocess
import sys
import time
from concurrent.futures import Future
from concurrent.futures.process import BrokenProcessPool
from typing import Any

import pytest

from client.arena.directory import EventDirectory, EventError
from client.arena.executors import InProcess, Processes, pool_of
from client.arena.runner import Runner
from client.arena.tasks import PairDone
from client.arena.terms import Terms
from physics import Table
from referee.record import verify_record
from tournament import Tournament, forfeit
from tournament.ledger import Ledger

CUP = {
    "name": "cup",
    "entrants": ["random", {"name": "other", "agent": "random"}, {"name": "third", "agent": "random"}],
    "pairs": 1,
    "seconds": None,
    "seed": 11,
}


def begin(path, **values):
    return EventDirectory.create(path, Terms.from_dict(CUP | values).to_dict())


def run(directory, pool=None):
    return Runner(directory, pool or InProcess()).run()


def files(directory):
    """Everything that counts, byte for byte: the records and the results."""
    return {path.name: path.read_bytes() for path in directory.games.glob("*.json*")}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The event played without interruption, in this process."""
    directory = begin(tmp_path_factory.mktemp("whole") / "cup")
    return run(directory), files(directory)


def test_every_pair_is_played_and_every_record_verifies(whole):
    ledger, kept = whole
    assert ledger.event.finished
    records = [text for name, text in kept.items() if name.endswith(".jsonl")]
    assert len(records) == len(ledger.event.counted) == 6
    assert all(verify_record(record.decode().splitlines()).ok for record in records)


class Forfeiting(InProcess):
    """A pool in which the second player never comes."""

    def submit(self, task):
        future: Future[PairDone] = Future()
        results = tuple(forfeit(game.due, game.due.pair.players[1]) for game in task.games)
        future.set_result(PairDone(results, (), ()))
        return future


@pytest.mark.parametrize("terms", [{"format": "knockout"}, {"format": "swiss", "rounds": 2}], ids=["knockout", "swiss"])
def test_an_event_of_rounds_is_read_from_its_beginning_as_it_was_played(tmp_path, terms):
    """Seen: `status`, `report` and `resume` lost the results of all rounds but the first."""
    names = [{"name": name, "agent": "random"} for name in "abcd"]
    directory = begin(tmp_path / "cup", entrants=names, **terms)
    played = run(directory, Forfeiting())
    assert played.event.finished
    assert {pair.round for pair in played.event.pairs} == {0, 1}
    before = len(directory.journal.path.read_bytes())
    again = Ledger(Tournament(played.event.spec)).after(directory.journal.new())
    assert again.event.counted == played.event.counted
    run(directory, Forfeiting())
    assert b'"kind": "game"' not in directory.journal.path.read_bytes()[before:]


def command(*arguments):
    return [sys.executable, "-m", "client.cli", "tournament", *map(str, arguments)]


def start(*arguments, **options):
    return subprocess.Popen(
        command(*arguments),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        **options,
    )


def killed_again_and_again(directory, kills, executor):
    """Resume the event again and again, each time killed outright a moment after something happened."""
    chance, kept = random.Random(5), 0
    while kept < kills:
        before = activity(directory)
        process = start("resume", directory.path, "--executor", executor, "--workers", 2)
        while process.poll() is None and activity(directory) == before:
            time.sleep(0.005)
        time.sleep(chance.uniform(0.0, 0.25))
        kept += process.poll() is None
        process.kill()
        _, words = process.communicate()
        if process.returncode == 0:
            return kept
        assert process.returncode == -9, words
    return kept


def activity(directory):
    return sum(size(path) for path in directory.games.iterdir() if path.suffix in (".part", ".jsonl"))


def size(path):
    """A record is renamed when it is whole."""
    try:
        return path.stat().st_size
    except FileNotFoundError:
        return 0


def check_kills(tmp_path, whole, kills, executor):
    directory = begin(tmp_path / "cup")
    assert killed_again_and_again(directory, kills, executor) >= 2
    done = subprocess.run(command("resume", directory.path, "--json"), capture_output=True, text=True, check=True)
    assert json.loads(done.stdout)["state"] == "finished"
    assert files(directory) == whole[1]
    ledger = Ledger(Tournament(Terms.from_dict(directory.terms()).spec)).after(directory.journal.new())
    assert ledger.event.counted == whole[0].event.counted
    assert list(directory.games.glob("*.part")) == []


@pytest.mark.slow
def test_an_event_killed_at_many_instants_ends_like_one_that_was_not(tmp_path, whole):
    check_kills(tmp_path, whole, 3, "inline")


@pytest.mark.long
@pytest.mark.parametrize("executor", ["inline", "processes"])
def test_an_event_killed_at_very_many_instants_ends_like_one_that_was_not(tmp_path, executor):
    directory = begin(tmp_path / "whole", pairs=40)
    reference = run(directory), files(directory)
    check_kills_of(tmp_path / "killed", reference, executor)


def check_kills_of(path, reference, executor):
    path.mkdir()
    directory = begin(path / "cup", pairs=40)
    killed_again_and_again(directory, 60, executor)
    subprocess.run(command("resume", directory.path), capture_output=True, check=True)
    assert files(directory) == reference[1]


def test_ctrl_c_leaves_an_event_that_goes_on(tmp_path, whole):
    directory = begin(tmp_path / "cup")
    process = start("resume", directory.path, "--workers", 1)
    while activity(directory) == 0:
        assert process.poll() is None
        time.sleep(0.01)
    process.send_signal(2)
    _, words = process.communicate(timeout=30)
    assert process.returncode == 130
    assert "tournament resume" in words
    assert "Traceback" not in words
    run(directory)
    assert files(directory) == whole[1]


@pytest.mark.slow
def test_a_full_disk_costs_nothing_but_time(tmp_path, whole):
    """A file of limited size stands for a disk without room: a write fails somewhere within a line."""
    directory = begin(tmp_path / "cup")
    limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (300_000, 300_000))  # noqa: E731
    process = start("resume", directory.path, "--executor", "inline", preexec_fn=limit)
    _, words = process.communicate(timeout=300)
    assert process.returncode == 1
    assert "tournament resume" in words
    assert "Traceback" not in words
    assert max(path.stat().st_size for path in directory.games.iterdir()) == 300_000
    run(directory)
    assert files(directory) == whole[1]


def test_a_second_resume_at_the_same_time_is_refused_and_leaves_no_trace(tmp_path):
    directory = begin(tmp_path / "cup")
    directory.journal.append("opened")
    before = directory.journal.path.read_bytes()
    with directory.alone():
        second = subprocess.run(command("resume", directory.path), capture_output=True, text=True, check=False)
    assert second.returncode == 1
    assert "another process" in second.stderr
    assert directory.journal.path.read_bytes() == before


def test_only_one_runs_an_event(tmp_path):
    directory = begin(tmp_path / "cup")
    with directory.alone(), pytest.raises(EventError, match="another process"):
        run(EventDirectory.open(directory.path))
    with pytest.raises(EventError, match="resume"):
        begin(tmp_path / "cup")
    with pytest.raises(EventError, match="holds no event"):
        EventDirectory.open(tmp_path)


def test_a_void_game_is_played_again_with_fresh_noise_on_the_same_racks(tmp_path):
    directory = begin(tmp_path / "cup")
    before = run(directory).event
    directory.journal.append("void", pair="r0-m0-p0", leg=0, by="judge", reason="power cut")
    ledger = run(directory)
    assert ledger.event.finished
    assert len(ledger.event.counted) == len(before.counted)
    old, new = (json.loads((directory.games / f"r0-m0-p0-g0{a}.jsonl").read_text().split("\n")[0]) for a in ("", "-a1"))
    assert old["start"] == new["start"]
    assert old["commitment"] != new["commitment"]
    (again,) = [game for game in ledger.event.counted if game.attempt]
    assert again.record == "games/r0-m0-p0-g0-a1.jsonl"


class Deciding(InProcess):
    """Writes an entry into the journal when the n-th pair has been played."""

    def __init__(self, directory, after, kind, **fields):
        self.directory, self.left, self.kind, self.fields = directory, after, kind, fields

    def submit(self, task):
        future = super().submit(task)
        self.left -= 1
        if self.left == 0:
            self.directory.journal.append(self.kind, **self.fields)
        return future


def test_a_paused_event_starts_nothing_and_goes_on_later(tmp_path, whole):
    directory = begin(tmp_path / "cup")
    ledger = run(directory, Deciding(directory, 2, "pause"))
    assert ledger.paused
    assert not ledger.over
    assert len(ledger.event.counted) == 4
    assert len(run(directory).event.counted) == 4
    directory.journal.append("go_on")
    assert run(directory).event.counted == whole[0].event.counted


def test_an_aborted_event_is_over_for_good(tmp_path):
    directory = begin(tmp_path / "cup")
    assert run(directory, Deciding(directory, 1, "abort")).aborted
    directory.journal.append("go_on")
    assert len(run(directory).event.counted) == 2


def test_who_is_disqualified_forfeits_what_was_begun_and_is_paired_no_more(tmp_path):
    """The first pair stands; the second one is on the board by then, the rest of the event not."""
    directory = begin(tmp_path / "cup", pairs=2)
    played: list[Any] = []

    def decide(ledger, _running):
        if ledger.event.counted and not played:
            played.extend(ledger.event.counted)
            directory.journal.append("disqualify", name=played[0].players[0], reason="cheated")

    event = Runner(directory, InProcess(), decide).run().event
    out, other = played[0].players
    assert event.finished
    assert event.withdrawn == {out: 1}
    assert [game for game in event.counted if out in game.players][:2] == played
    assert {game.reason for game in played}.isdisjoint({"forfeit"})
    forfeits = [game for game in event.counted if out in game.players][2:]
    assert [(game.id, game.reason, game.points_of(other)) for game in forfeits] == [
        ("r0-m0-p1-g0", "forfeit", 1.0),
        ("r0-m0-p1-g1", "forfeit", 1.0),
    ]
    assert len(event.counted) == 8, "and the one meeting of the others"
    assert (directory.games / "r0-m0-p1-g0.jsonl").exists(), "it was played, and came too late"


def test_a_decision_that_cannot_be_is_refused_in_words(tmp_path):
    directory = begin(tmp_path / "cup")
    directory.journal.append("void", pair="r9-m0-p0", leg=0)
    directory.journal.append("disqualify", name="nobody")
    ledger = run(directory)
    assert len(ledger.refused) == 2
    assert ledger.event.finished


class Dying(InProcess):
    """A pool whose workers die over one pair."""

    def __init__(self, pair, times):
        self.pair, self.times = pair, times

    def submit(self, task):
        if task.pair != self.pair or self.times == 0:
            return super().submit(task)
        self.times -= 1
        future: Future[PairDone] = Future()
        future.set_exception(BrokenProcessPool("a worker died"))
        return future


def test_a_pair_whose_worker_died_is_played_by_another(tmp_path, whole):
    directory = begin(tmp_path / "cup")
    assert run(directory, Dying("r1-m0-p0", 2)).event.counted == whole[0].event.counted
    assert files(directory) == whole[1]
    again = begin(tmp_path / "again")
    with pytest.raises(EventError, match="r1-m0-p0"):
        run(again, Dying("r1-m0-p0", 99))


def test_a_worker_killed_in_the_middle_costs_nothing(tmp_path, whole):
    directory = begin(tmp_path / "cup")
    with pool_of("processes", 2) as pool:
        assert isinstance(pool, Processes)
        killed: list[int] = []

        def kill_one(_ledger, running):
            if running and not killed and activity(directory):
                killed.append(next(iter(pool._pool._processes)))
                os.kill(killed[0], 9)

        ledger = Runner(directory, pool, kill_one).run()
    assert killed
    assert ledger.event.counted == whole[0].event.counted
    assert files(directory) == whole[1]


@pytest.mark.slow
def test_the_sequential_test_is_evaluated_in_the_order_of_pairs(tmp_path):
    """Whatever else was finished by then: the counted games are those up to the decision."""
    sprt = {
        "entrants": ["random", {"name": "dead", "agent": "stdio:sh -c 'read line'"}],
        "pairs": 60,
        "sprt": {"elo1": 300.0},
    }
    one = begin(tmp_path / "one", **sprt)
    ledger = run(one)
    assert ledger.event.stopped
    assert ledger.event.test.verdict == "elo1"
    two = begin(tmp_path / "two", **sprt)
    with pool_of("processes", 2) as pool:
        other = run(two, pool)
    assert other.event.counted == ledger.event.counted


def test_an_event_on_a_table_with_jaws(tmp_path):
    """By name and parameters: the file's terms, the games, their records and a second run of the same event agree."""
    table = {"name": "nine_foot", "cushion": "mathavan", "corner_mouth": 0.12}
    values = {"entrants": ["random", {"name": "other", "agent": "random"}], "table": table}
    ledger = run(first := begin(tmp_path / "one", **values))
    assert ledger.event.finished
    expected = Table.nine_foot().replace(cushion="mathavan", corner_mouth=0.12)
    for path in first.games.glob("*.jsonl"):
        record = path.read_text().splitlines()
        assert verify_record(record).ok
        assert Table.from_dict(json.loads(record[0])["table"]) == expected
    run(second := begin(tmp_path / "two", **values))
    assert files(first) == files(second)


def test_entrants_are_tried_on_the_events_table(tmp_path, monkeypatch):
    """Seen: every agent was started on the Olympiad's table, whatever the event was played on."""
    (tmp_path / "asking.py").write_text(
        "import client\n\n\nclass Asking(client.Agent):\n"
        "    def game_started(self, view):\n"
        "        raise RuntimeError('started on ' + view.table_model().name)\n\n"
        "    def choose(self, view):\n"
        "        return client.Action(decision='concede')\n"
    )
    monkeypatch.chdir(tmp_path)
    directory = begin(
        tmp_path / "cup", entrants=["random", {"name": "b", "agent": "asking:Asking"}], table="seven_foot"
    )
    with pytest.raises(EventError, match="started on seven_foot"):
        run(directory)
