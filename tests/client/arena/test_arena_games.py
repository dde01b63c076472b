"""Games of an event: every way an agent can fail has its own end, and a game that was broken off goes on."""

import contextlib
import dataclasses
import itertools
import os
import resource
import sys
import textwrap
from pathlib import Path
from typing import Any

import pytest

import client
from client.agents.random_agent import RandomAgent
from client.arena.hosting import Hosting
from client.arena.resumable_game import play
from client.arena.seats import seat_of
from client.arena.tasks import play_pair
from client.arena.terms import Terms
from client.session import AgentSession
from physics.self_test import self_test
from referee import EndReason
from referee.record import verify_record
from tournament import Tournament


@pytest.fixture(autouse=True)
def logs(tmp_path, monkeypatch):
    """What commands write to standard error goes with the test."""
    monkeypatch.setenv("POOLIAD_AGENT_LOGS", str(tmp_path / "logs"))


def terms_of(**values):
    return Terms.from_dict(
        {
            "name": "cup",
            "entrants": [{"name": "one", "agent": "random"}, {"name": "two", "agent": "random"}],
            "seconds": None,
            "seed": 3,
            **values,
        }
    )


def games_of(terms):
    return [terms.game(due) for due in Tournament(terms.spec).due]


def reports_into(found):
    return lambda name, what: found.append((name, what))


def seats(seed=1):
    return tuple(AgentSession(lambda: RandomAgent(seed)) for _ in range(2))


def pair_of(first, second, **values):
    """Both games of a pair between two hostings."""
    terms = terms_of(**values)
    terms = dataclasses.replace(terms, hosting={"one": first, "two": second})
    return play_pair(terms.task(Tournament(terms.spec).due, None))


def script(tmp_path, text):
    """A command that runs a Python script."""
    path = tmp_path / "bot.py"
    path.write_text("import json, os, sys, time\n" + textwrap.dedent(text))
    return f"stdio:{sys.executable} {path}"


@pytest.mark.parametrize(
    ("text", "values", "reason"),
    [
        ("sys.exit(3)", {}, EndReason.CRASH),
        ("sys.stdin.readline(); os.kill(os.getpid(), 9)", {}, EndReason.CRASH),
        ("time.sleep(60)", {}, EndReason.STALL),
        ("os.close(0); time.sleep(60)", {}, EndReason.STALL),
        ("time.sleep(60)", {"seconds": 2.5}, EndReason.TIME_OUT),
        ("for line in sys.stdin:\n  if '\"turn\"' in line: print('nonsense', flush=True)", {}, EndReason.FORFEIT),
        ("for line in sys.stdin: time.sleep(1); print('nonsense', flush=True)", {"seconds": 4.0}, EndReason.TIME_OUT),
        (
            'for line in sys.stdin:\n  if \'"turn"\' in line: print(\'{"decision": "concede"}\', flush=True)',
            {},
            EndReason.CONCESSION,
        ),
        ("for line in sys.stdin: print('x' * 2_000_000, flush=True)", {}, EndReason.CRASH),
        ("x = bytes(10**10)", {}, EndReason.CRASH),
    ],
    ids=["exits", "killed", "silent", "deaf", "slow", "nonsense", "slow nonsense", "concedes", "long line", "memory"],
)
def test_every_failure_has_its_own_end_and_costs_one_game(tmp_path, text, values, reason):
    """Both games are lost in the same way: after the first the process was started again."""
    self_test()  # else the opponent in this process may lose its game while the kernels load
    patience = 3.0 if reason is EndReason.STALL else 60.0
    bad = Hosting(script(tmp_path, text), answer_seconds=patience, memory_mb=4000)
    done = pair_of(bad, Hosting("random"), **values)
    for result, record in zip(done.results, done.records, strict=True):
        assert (result.reason, result.winner) == (reason, 1)
        assert verify_record(record.splitlines()).ok


CONCEDE = """
for line in sys.stdin:
    if json.loads(line)["type"] == "turn":
        print('{"decision": "concede"}', flush=True)
"""


@pytest.fixture
def a_thousand_files():
    """More open files than `select` has descriptors."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(hard, 4096), hard))
    held = [os.open(os.devnull, os.O_RDONLY) for _ in range(1100)]
    yield
    for descriptor in held:
        os.close(descriptor)
    resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))


def test_a_process_is_heard_however_many_files_are_open(tmp_path, a_thousand_files):
    """Seen: `select` raised for descriptors from 1024 on, and every answer was a bad one."""
    done = pair_of(Hosting(script(tmp_path, CONCEDE)), Hosting("random"))
    assert {result.reason for result in done.results} == {EndReason.CONCESSION}


STUBBORN = """
for line in sys.stdin:
    message = json.loads(line)
    if message["type"] == "turn":
        print('{"decision": "%s"}' % ("concede" if refused else "rerack_and_break"), flush=True)
    if message["type"] == "refused":
        refused.append(message["reason"])
        print(refused, file=open(sys.argv[1], "a"))
"""


def test_a_command_is_told_why_its_action_was_refused(tmp_path):
    told = tmp_path / "told"
    command = f"{script(tmp_path, 'refused = []' + STUBBORN)} {told}"
    done = pair_of(Hosting(command), Hosting("random"))
    assert {result.reason for result in done.results} == {EndReason.CONCESSION}
    lines = told.read_text().splitlines()
    assert len(lines) == 2, "once a game"
    assert all("no choice is open" in line for line in lines)


def test_an_agent_inside_is_told_why_its_action_was_refused(tmp_path, caplog):
    told: list[Any] = []

    class Stubborn(client.Agent):
        def choose(self, view):
            return client.Action(decision=client.Decision.CONCEDE if told else client.Decision.RERACK_AND_BREAK)

        def refused(self, view, reason):
            told.append((view.my_turn, reason))
            raise RuntimeError("what a hook raises is logged")

    found: list[Any] = []
    (task, *_) = games_of(terms_of())
    result, _ = play(task, (AgentSession(Stubborn), AgentSession(Stubborn)), None, reports_into(found))
    assert result.reason is EndReason.CONCESSION
    ((mine, reason),) = told
    assert mine
    assert "no choice is open" in reason
    assert "what a hook raises is logged" in caplog.text


ATTACKS = """
import os, signal, sys, time
import client


class Deaf(client.Agent):
    "Wants to outlive its game."

    def choose(self, view):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        time.sleep(600)


class Parent(client.Agent):
    "Leaves in the middle of a game, as if all were well; a child keeps its output open."

    def choose(self, view):
        if os.fork() == 0:
            time.sleep(600)
        os._exit(0)


class Chatterbox(client.Agent):
    "Fills whatever it can write to."

    def choose(self, view):
        while True:
            print("x" * 10_000)
"""


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("Deaf", EndReason.STALL),
        ("Parent", EndReason.CRASH),
        ("Chatterbox", EndReason.CRASH),
    ],
)
def test_an_attack_costs_the_attacker_its_game_and_leaves_nothing_behind(tmp_path, monkeypatch, name, reason):
    monkeypatch.setattr("client.arena.process.LARGEST_FILE", 2_000_000)
    (tmp_path / "attacks.py").write_text(ATTACKS)
    hosting = Hosting(
        f"attacks:{name}",
        answer_seconds=4.0 if name == "Deaf" else 60.0,
        environment={"PYTHONPATH": str(tmp_path), "POOLIAD_ATTACK": str(tmp_path)},
    )
    (task, _) = games_of(terms_of())
    seat = seat_of(hosting, 1, tmp_path / "attack.log", lambda what: None)
    with contextlib.closing(seat):
        result, record = play(task, (seat, seats()[1]), None, reports_into([]))
    assert (result.reason, result.winner) == (reason, 1)
    assert verify_record(record.splitlines()).ok
    assert (tmp_path / "attack.log").stat().st_size <= 2_000_000
    assert [*processes_with(f"POOLIAD_ATTACK={tmp_path}")] == []


def processes_with(variable):
    """Processes that have a variable in their environment and are no zombies (Linux)."""
    for place in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            if variable.encode() in (place / "environ").read_bytes().split(b"\0"):
                yield place.name


def test_a_process_plays_the_very_game_it_plays_inside():
    inside = pair_of(Hosting("random"), Hosting("random"), simulated_shots=10)
    outside = pair_of(Hosting("random", process=True, cores=1), Hosting("random"), simulated_shots=10)
    assert outside.records == inside.records
    assert outside.results == inside.results


def test_both_games_of_a_pair_have_the_same_racks_and_never_the_same_noise():
    """Issue 'Pairs': were the noise the same, the second game could be played with the first one's known."""
    first, second = (verify_and_read(record) for record in pair_of(Hosting("random"), Hosting("random")).records)
    assert first.header["start"]["state"] == second.header["start"]["state"]
    assert first.end["noise_secret"] != second.end["noise_secret"]
    assert [each.header["start"]["breaker"] for each in (first, second)] == [0, 1]


def verify_and_read(record):
    from referee.record import read_record

    assert verify_record(record.splitlines()).ok
    return read_record(record.splitlines())


class Unplugged(BaseException):
    """The machine stops here."""


class Failing(AgentSession):
    """A seat at which everything stops at the n-th question."""

    def __init__(self, factory, questions):
        super().__init__(factory)
        self.questions = questions

    def ask(self, view):
        if next(self.questions) == 0:
            raise Unplugged
        return super().ask(view)


def failing(at):
    """Two seats, at one of which everything stops at the question number ``at`` of both together."""
    countdown = itertools.count(at, -1)
    return tuple(Failing(lambda: RandomAgent(1), countdown) for _ in range(2))


@pytest.mark.parametrize("values", [{}, {"seconds": 1000.0}], ids=["no clock", "clock"])
@pytest.mark.parametrize("at", [0, 1, 2, 17, 40])
def test_a_game_broken_off_goes_on_where_it_was(tmp_path, at, values):
    (task, _) = games_of(terms_of(**values))
    whole, text = play(task, seats(), None, reports_into([]))
    with pytest.raises(Unplugged):
        play(task, failing(at), tmp_path, reports_into([]))
    part = (tmp_path / f"{task.due.id}.part").read_bytes() if at else b""
    assert part.count(b"\n") == (at + 1 if at else 0)
    reports: list[Any] = []
    result, again = play(task, seats(), tmp_path, reports_into(reports))
    if values:
        assert again.encode().startswith(part)  # the moves made stand, with their times
        assert verify_record(again.splitlines()).ok
    else:
        assert (result, again) == (whole, text)
        assert reports == []
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"{task.due.id}.jsonl", f"{task.due.id}.result.json"]


SIMULATING = """
import sys
from client.agents.random_agent import RandomAgent


class Simulating(RandomAgent):
    "Simulates five shots before each of its strokes, and says first how many it may."

    def __init__(self):
        super().__init__(1)

    def choose(self, view):
        print(self.simulator.remaining, file=sys.stderr)
        action = super().choose(view)
        if action.shot is not None:
            self.simulator.simulate_batch(view.table_model(), view.state, [list(action.shot.to_dict().values())] * 5)
        return action
"""


class BrokenOff:
    """A seat at which everything stops at the n-th question."""

    def __init__(self, seat, questions):
        self.seat, self.questions = seat, questions

    def ask(self, view):
        if next(self.questions) == 0:
            raise Unplugged
        return self.seat.ask(view)

    def __getattr__(self, name):
        return getattr(self.seat, name)


@pytest.mark.slow
def test_a_process_goes_on_with_the_budget_it_had_left(tmp_path):
    """Seen: with clocks the new process counts from 0, and was refused until it had simulated as much once more."""
    (tmp_path / "simulating.py").write_text(SIMULATING)
    hosting = Hosting("simulating:Simulating", environment={"PYTHONPATH": str(tmp_path)})
    (task, _) = games_of(terms_of(seconds=1000.0, simulated_shots=5000))
    reports: list[Any] = []

    def attempt(folder, number, wrapped=lambda seat: seat):
        with contextlib.ExitStack() as stack:
            logs = [tmp_path / f"{number}-{side}.log" for side in range(2)]
            both = [seat_of(hosting, side, logs[side], lambda what: reports.append(what)) for side in range(2)]
            for seat in both:
                stack.callback(seat.close)
            result, _ = play(task, tuple(map(wrapped, both)), folder, reports_into(reports))
        return result

    countdown = itertools.count(9, -1)
    games = tmp_path / "games"
    games.mkdir()
    with pytest.raises(Unplugged):
        attempt(games, 0, lambda seat: BrokenOff(seat, countdown))
    result = attempt(games, 1)
    assert reports == []
    assert result.simulated == tuple(5 * strokes for strokes in result.strokes)
    for side in range(2):
        said = [(tmp_path / f"{number}-{side}.log").read_text().split() for number in range(2)]
        assert said[1][0] == str(int(said[0][-1]) - 5)


@pytest.mark.parametrize("cut", [1, 30, 4000])
def test_a_torn_line_is_played_again(tmp_path, cut):
    (task, _) = games_of(terms_of())
    whole = play(task, seats(), None, reports_into([]))
    with pytest.raises(Unplugged):
        play(task, failing(9), tmp_path, reports_into([]))
    part = tmp_path / f"{task.due.id}.part"
    part.write_bytes(part.read_bytes()[:-cut])
    assert play(task, seats(), tmp_path, reports_into([])) == whole


def test_moves_made_stand_even_if_the_player_thinks_otherwise_now(tmp_path):
    (task, _) = games_of(terms_of())
    with pytest.raises(Unplugged):
        play(task, failing(9), tmp_path, reports_into([]))
    part = (tmp_path / f"{task.due.id}.part").read_text()
    reports: list[Any] = []
    _, text = play(task, seats(seed=2), tmp_path, reports_into(reports))
    assert text.startswith(part)
    assert any("otherwise the second time" in what for _, what in reports)


def test_a_game_begun_by_another_engine_is_played_from_its_first_stroke(tmp_path):
    (task, _) = games_of(terms_of())
    whole = play(task, seats(), None, reports_into([]))
    other = games_of(terms_of(seed=4))[0]
    with pytest.raises(Unplugged):
        play(other, failing(9), tmp_path, reports_into([]))
    reports: list[Any] = []
    assert play(task, seats(), tmp_path, reports_into(reports)) == whole
    assert any("first stroke" in what for _, what in reports)
    assert len(list(tmp_path.glob("*.diverged"))) == 1


def test_a_finished_game_is_not_played_again(tmp_path):
    (task, _) = games_of(terms_of(simulated_shots=5))
    first = play(task, seats(), tmp_path, reports_into([]))
    nobody = Failing(lambda: RandomAgent(1), itertools.repeat(0))
    assert play(task, (nobody, nobody), tmp_path, reports_into([])) == first
    (tmp_path / f"{task.due.id}.result.json").write_text("{")
    assert play(task, (nobody, nobody), tmp_path, reports_into([]))[0].winner == first[0].winner
