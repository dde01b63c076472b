"""`stdio:COMMAND`: agents in any language, as real processes that behave and misbehave."""

import json
import logging
import re
import shlex
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest
from support.require import ROOT, require

import client
from client import errors
from client.adapters.stdio import StdioAgent
from client.agents.registry import titles
from client.run import run_agent

PERL_AGENT = f"stdio:perl {shlex.quote(str(ROOT / 'examples' / 'perl' / 'straight.pl'))}"
BY_THE_RULES = {"R42", "R43", "R44", "R45", "R46", "R49"}
CONCEDE = json.dumps({"decision": "concede"})

PRELUDE = """
import json, sys, time
def told():
    return json.loads(sys.stdin.readline())
def say(text):
    print(text, flush=True)
def turn():
    message = told()
    while message["type"] != "turn":
        message = told()
    return message
"""


@pytest.fixture
def command(tmp_path):
    """Makes a command of some lines of Python."""

    def make(program):
        path = tmp_path / "agent.py"
        path.write_text(PRELUDE + program)
        return [sys.executable, str(path)]

    return make


@pytest.fixture
def asked(command, tmp_path):
    """Asks a command for its first turn; the agent and what came of it."""

    def ask(program, silence=20.0):
        agent = StdioAgent(command(program), logs=tmp_path / "logs", silence=silence)
        outcomes: list[Any] = []

        class Asking(client.Agent):
            def choose(self, view):
                try:
                    agent.game_started(view)
                    outcomes.append(agent.choose(view))
                except errors.AgentFailed as error:
                    outcomes.append(error)
                return client.Action(decision=client.Decision.CONCEDE)

        client.play(Asking, Asking, seed=1)
        agent._end()
        return outcomes[0]

    return ask


@pytest.fixture(scope="module")
def perl():
    """Skip where there is no perl with JSON."""
    found = subprocess.run(["perl", "-MJSON::PP", "-e1"], capture_output=True)
    require(found.returncode == 0, "perl with JSON::PP")


def test_an_agent_in_perl_plays_whole_games_by_the_rules(perl, tmp_path, monkeypatch):
    monkeypatch.setenv("POOLIAD_AGENT_LOGS", str(tmp_path))
    match = client.play(PERL_AGENT, "random", games=3, seed=2)
    assert {game.outcome.rule for game in match.games} <= BY_THE_RULES
    assert match.players == ("straight.pl", "random")
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"local-{n}-seat-0.stderr" for n in range(3)]
    assert all(path.read_text() == "" for path in tmp_path.iterdir()), "no refusal, no complaint"


def test_an_agent_in_perl_plays_on_a_server(perl, hall, tmp_path, monkeypatch):
    monkeypatch.setenv("POOLIAD_AGENT_LOGS", str(tmp_path))
    entries = hall.register("perl"), hall.register("random")
    match = hall.match(*entries, seed=9)
    rival = threading.Thread(target=run_agent, args=("random", hall.url, entries[1].token))
    rival.start()
    run_agent(PERL_AGENT, hall.url, entries[0].token)
    rival.join(60)
    (game,) = hall.organiser.match(match.id).played
    assert game.outcome.rule in BY_THE_RULES
    assert [path.name for path in tmp_path.iterdir()] == [f"{game.id}-seat-0.stderr"]


def test_the_whole_conversation(command, tmp_path, caplog):
    """Started, a turn, a refusal, the turn again, the end: as docs/agents.md tells it."""
    seen = tmp_path / "seen"
    program = f"""
with open({str(seen)!r}, "a") as seen:
    tries = 0
    for line in sys.stdin:
        message = json.loads(line)
        print(message["type"], file=seen, flush=True)
        if message["type"] == "turn":
            tries += 1
            say('{{"decision": "rerack_and_break"}}' if tries == 1 else '{CONCEDE}')
        if message["type"] == "refused":
            print(message["reason"], file=seen, flush=True)
"""
    agent = lambda: StdioAgent(command(program), logs=tmp_path)  # noqa: E731
    with caplog.at_level(logging.ERROR):
        client.play(agent, agent, seed=1)
    started, turn, refused, reason, again, over = seen.read_text().splitlines()
    assert (started, turn, refused, again, over) == ("game_started", "turn", "refused", "turn", "game_over")
    assert "no choice is open" in reason


def test_a_stroke_a_call_and_a_place_come_through(asked):
    stroke = {"shot": {"v": 9, "phi": 270, "theta": 5, "a": 0, "b": 0}, "call": None, "cue_ball": [0.558, 1.75]}
    action = asked(f"turn(); say('{json.dumps(stroke)}')")
    assert (action.shot.v, action.call, action.cue_ball) == (9.0, None, (0.558, 1.75))


def test_the_physics_is_there_for_the_asking(asked):
    program = """
view = turn()["view"]
answers = []
for question in (
    {"ask": "min_elevation", "phi": 270},
    {"ask": "simulate", "shot": {"v": 9, "phi": 270, "theta": 10, "a": 0, "b": 0}, "trace": False},
    {"ask": "simulate_batch", "shots": [{"v": 9, "phi": 270, "theta": 10, "a": 0, "b": 0}] * 2},
    {"ask": "simulate_batch", "tables": [{"0": [0.5, 1.7]}], "shots": [{"v": 1, "phi": 9, "theta": 0, "a": 0, "b": 0}]},
    {"ask": "the oracle"},
    {"ask": "min_elevation"},
    {"ask": "min_elevation", "phi": 270, "balls": {"3": [0.5, 0.5]}},
):
    say(json.dumps(question))
    answers.append(told())
assert [each["type"] for each in answers] == ["answer"] * 4 + ["error"] * 3, answers
assert 0 < answers[0]["theta"] < 60
assert answers[1]["status"] == "at_rest" and len(answers[2]["results"]) == 2
assert answers[3]["results"][0]["balls"].keys() <= {"0"}
assert "min_elevation, simulate, simulate_batch" in answers[4]["reason"]
assert "phi" in answers[5]["reason"]
say('{"decision": "concede"}')
"""
    assert asked(program) == client.Action(decision=client.Decision.CONCEDE)


def test_simulated_shots_count_against_the_budget(command, tmp_path):
    program = """
for _ in range(2):
    turn()
    say('{"ask": "simulate", "trace": false, "shot": {"v": 9, "phi": 270, "theta": 10, "a": 0, "b": 0}}')
    answer = told()
    if answer["type"] == "error":
        print(answer["reason"], file=sys.stderr)
        say('{"decision": "concede"}')
    say('{"decision": "rerack_and_break"}')
"""
    agent = lambda: StdioAgent(command(program), logs=tmp_path / "logs")  # noqa: E731
    client.play(agent, agent, seed=1, simulations=1)
    assert "at most 0 are left" in next((tmp_path / "logs").iterdir()).read_text()


@pytest.mark.parametrize(
    ("program", "words"),
    [
        ("sys.exit(3)", "left with exit code 3"),
        ("turn(); print('no idea', file=sys.stderr); sys.exit(4)", "exit code 4.*ends: no idea"),
        ("import os; turn(); os.close(1); time.sleep(30)", "closed its standard output"),
        ("turn(); say('270 degrees, please')", "'270 degrees, please', which is no JSON"),
        ("turn(); say('[1]')", "an object with shot or decision"),
        ("turn(); say('{}')", "shot"),
        ('turn(); say(\'{"shot": {"v": NaN}}\')', "shot.v"),
        ('turn(); say(\'{"decision": "resign"}\')', "decision"),
        ("turn(); say('[' * 100000)", "no JSON"),
        ("turn(); say('x' * 3000000)", "wrote more than"),
    ],
)
def test_what_a_command_does_wrong_is_said(asked, program, words):
    error = asked(program)
    assert isinstance(error, errors.AgentFailed)
    assert re.search(words, str(error), re.DOTALL), error


@pytest.mark.parametrize(
    ("program", "words"), [("turn(); time.sleep(60)", "no answer in time"), ("time.sleep(60)", "no answer|not read")]
)
def test_silence_ends_with_the_time(asked, program, words):
    started = time.monotonic()
    assert re.search(words, str(asked(program, silence=0.5)))
    assert time.monotonic() - started < 30


def test_what_was_written_unasked_is_no_answer(command, tmp_path, caplog):
    """A late second answer to the first turn must not be taken for one to the next."""
    program = """
turn()
say('{"decision": "rerack_and_break"}\\n{"decision": "accept_table"}')
turn()
say('{"decision": "concede"}')
sys.stdin.readline()
"""
    agent = lambda: StdioAgent(command(program), logs=tmp_path)  # noqa: E731
    with caplog.at_level(logging.WARNING, "pooliad.agent"):
        (game,) = client.play(agent, agent, seed=1).games
    assert len(game.strokes) == 1
    assert "wrote unasked" in caplog.text


def test_an_answer_that_names_another_turn_is_dropped(command, tmp_path, caplog):
    """A late answer, written after the next turn was sent: time alone could not tell it from the right one."""
    program = """
turn()
say('{"turn": 1, "decision": "rerack_and_break"}')
assert turn()["turn"] == 2
say('{"turn": 1, "decision": "accept_table"}')
say('{"turn": 2, "decision": "concede"}')
sys.stdin.readline()
"""
    agent = lambda: StdioAgent(command(program), logs=tmp_path)  # noqa: E731
    with caplog.at_level(logging.WARNING, "pooliad.agent"):
        (game,) = client.play(agent, agent, seed=1).games
    assert [stroke.action.decision for stroke in game.strokes] == ["concede"]
    assert "answered another turn" in caplog.text
    assert "bad action 2" not in caplog.text


@pytest.mark.parametrize(("words", "left"), [("", 0), ("told you so", 1)])
def test_of_its_temporary_files_only_what_was_written_stays(command, tmp_path, monkeypatch, words, left):
    monkeypatch.delenv("POOLIAD_AGENT_LOGS", raising=False)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    agent = lambda: StdioAgent(command(f"turn(); sys.stderr.write({words!r}); say('{CONCEDE}'); told()"))  # noqa: E731
    client.play(agent, agent, seed=1)
    found = list(tmp_path.glob("pooliad-agent-*/*"))
    assert [path.read_text() for path in found] == [words] * left
    assert len(list(tmp_path.glob("pooliad-agent-*"))) == left


def test_a_command_that_left_is_started_anew(command, tmp_path):
    once = tmp_path / "once"
    program = f"""
import pathlib
turn()
once = pathlib.Path({str(once)!r})
if not once.exists():
    once.touch()
    sys.exit(1)
say('{CONCEDE}')
"""
    agent = lambda: StdioAgent(command(program), logs=tmp_path)  # noqa: E731
    (game,) = client.play(agent, agent, seed=1).games
    assert (game.outcome.reason, len(game.strokes)) == ("concession", 1)


def test_a_command_ends_with_its_game_and_what_it_started_with_it(command, tmp_path):
    program = f"""
import subprocess
child = subprocess.Popen(["sleep", "600"])
turn()
open({str(tmp_path / "pids")!r}, "w").write(f"{{child.pid}}")
say('{CONCEDE}')
sys.stdin.read()
time.sleep(600)
"""
    agent = lambda: StdioAgent(command(program), logs=tmp_path)  # noqa: E731
    client.play(agent, agent, seed=1)
    pid = int((tmp_path / "pids").read_text())
    state = Path(f"/proc/{pid}/stat")
    end = time.monotonic() + 10
    while state.exists() and ") Z" not in state.read_text() and time.monotonic() < end:
        time.sleep(0.05)
    assert not state.exists() or ") Z" in state.read_text()


@pytest.mark.parametrize("name", ["stdio:", "stdio:   ", 'stdio:"unclosed'])
def test_a_name_without_a_command_leads_nowhere(name):
    with pytest.raises(errors.AgentNotFound, match="command"):
        client.load(name)


def test_a_command_that_is_not_there_is_named(tmp_path):
    with pytest.raises(errors.AgentNotFound, match="'/no/such/program' is no program that can be run here"):
        client.play("stdio:/no/such/program", "random", seed=1)
    with pytest.raises(errors.AgentUnstartable, match="/no/such/program"):
        client.play(lambda: StdioAgent(["/no/such/program"], logs=tmp_path), "random", seed=1, strict=False)


def test_a_command_that_leaves_before_it_reads_cannot_be_started(tmp_path):
    """Seen: a script with a wrong name lost its games by twenty bad answers each. Its standard error is kept."""
    agent = lambda: StdioAgent([sys.executable, str(tmp_path / "missing.py")], logs=tmp_path)  # noqa: E731
    with pytest.raises(
        errors.AgentUnstartable, match=r"left with exit code 2.*missing\.py.*had not read a line"
    ) as caught:
        client.play(agent, agent, seed=1, strict=False)
    where = re.search(r"standard error is in (\S+) and ends", str(caught.value))[1]
    assert "missing.py" in Path(where).read_text()


def test_commands_have_names_that_a_server_takes():
    assert titles("stdio:perl examples/perl/straight.pl", "random") == ("straight.pl", "random")
    assert titles("stdio:node a.js", "stdio:node a.js") == ("a.js-1", "a.js-2")
    assert titles("stdio:./bot(1).sh -v", "m:Class") == ("bot-1-.sh", "Class")
    assert titles("stdio:--", "stdio:/") == ("command-1", "command-2")
