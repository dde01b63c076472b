"""`pooliad agent check`: every bad agent is caught by the name of its fault, good ones pass."""

import json
import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from support.require import require

from client.compliance import SITUATIONS, Checker, FindingName
from client.compliance.situations import Twist

BAD = Path(__file__).parent / "bad_agents.py"
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(BAD.parent), os.environ.get("PYTHONPATH")]))
BY_NAME = {situation.name: situation for situation in SITUATIONS}

WHERE = {
    "silent": replace(BY_NAME["open table"], seconds=6.0),
    "late": replace(BY_NAME["low clock"], seconds=2.0),
    "crashes": BY_NAME["open table"],
    "unstartable": BY_NAME["open table"],
    "raises": BY_NAME["open table"],
    "malformed": BY_NAME["open table"],
    "refused": BY_NAME["groups"],
    "concedes": BY_NAME["open table"],
    "no-version": BY_NAME["open table"],
    "stale": BY_NAME["open table"],
    "no-key": BY_NAME["open table"],
    "key-reused": BY_NAME["open table"],
    "not-your-turn": BY_NAME["reconnect"],
    "acts-after-end": BY_NAME["game over"],
    "gives-up": BY_NAME["lost reply"],
    "impatient": BY_NAME["draining"],
    "hammers": BY_NAME["game over"],
}
"""In which situation each fault shows."""


def command_of(fault):
    """A program with one fault; `raises` is that of an agent in Python, whose exceptions are seen by its host."""
    if fault == "raises":
        return [sys.executable, "-m", "client.cli", "agent", "run", "--forever", "bad_agents_in_python:Raises"]
    return [sys.executable, str(BAD), fault]


def checked(hall, tmp_path, command, situations):
    checker = Checker(hall.url, hall.organiser_token, command, tmp_path)
    return checker.run(situations)


def test_every_fault_has_a_bad_agent():
    assert set(WHERE) == {name.value for name in FindingName}


@pytest.mark.parametrize("fault", sorted(WHERE))
def test_a_bad_agent_is_caught_by_name(hall, tmp_path, fault):
    (report,) = checked(hall, tmp_path, command_of(fault), [WHERE[fault]])
    assert fault in {found.name.value for found in report.faults}, report


def in_python(*options, agent):
    """`pooliad agent check` of an agent in bad_agents_in_python.py; its exit code and report."""
    command = [sys.executable, "-m", "client.cli", "agent", "check", agent, *options, "--json"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    return done.returncode, json.loads(done.stdout)["situations"]


def test_an_exception_is_called_one_with_its_traceback(server_installed, tmp_path):
    """Seen: an agent with a slip in it was `silent`, after the whole clock of every situation."""
    code, (first, second) = in_python(
        "--only", "open table", "--only", "groups", "--out", str(tmp_path), agent="bad_agents_in_python:Raises"
    )
    assert code == 1
    for report in (first, second):
        (fault,) = report["faults"]
        assert fault["name"] == "raises"
        assert "choose raised" in fault["words"]
        assert 'raise LookupError("no idea")' in fault["words"]
    tries = (tmp_path / "agent.log").read_text().count("choose raised")
    assert tries < 60, "an agent that is asked again until its clock is out fails some seventy times a situation"


@pytest.mark.parametrize(
    ("agent", "words"),
    [
        ("bad_agents_in_python:Unmade", "FileNotFoundError: model.bin"),
        (f"stdio:{sys.executable} /no/such/script.py", "/no/such/script.py"),
    ],
)
def test_what_cannot_be_started_is_called_so_at_once_and_once(server_installed, tmp_path, agent, words):
    """Seen: every one of 25 situations waited for an agent that could not be there."""
    code, (report,) = in_python("--out", str(tmp_path), agent=agent)
    assert code == 1
    assert [fault["name"] for fault in report["faults"]] == ["unstartable"]
    assert words in report["faults"][0]["words"]


@pytest.mark.slow
def test_a_commands_standard_error_is_where_the_output_says(server_installed, tmp_path):
    agent = f"stdio:{sys.executable} /no/such/script.py"
    _, (report,) = in_python("--out", str(tmp_path), agent=agent)
    where = re.search(r"standard error is in (\S+) and ends", report["faults"][0]["words"])[1]
    assert "/no/such/script.py" in Path(where).read_text()


def test_the_same_agent_without_a_fault_passes(hall, tmp_path):
    """Else the bad ones might be caught for something else."""
    situations = list(
        {each.name: each for each in (*WHERE.values(), BY_NAME["refused"], BY_NAME["new fields"])}.values()
    )
    reports = checked(hall, tmp_path, [sys.executable, str(BAD), "none"], situations)
    assert [fault for report in reports for fault in report.faults] == []


@pytest.mark.slow
def test_a_shipped_agent_passes_everything(server_installed):
    command = [sys.executable, "-m", "client.cli", "agent", "check", "random", "--json"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    report = json.loads(done.stdout)
    assert [each["situation"] for each in report["situations"]] == list(BY_NAME)
    assert (done.returncode, report["ok"]) == (0, True), done.stdout


@pytest.mark.long
@pytest.mark.parametrize("agent", ["greedy", "search", "stdio:perl examples/perl/straight.pl"])
def test_the_other_agents_pass_everything(server_installed, agent):
    found = subprocess.run(["perl", "-MJSON::PP", "-e1"], capture_output=True)
    require(found.returncode == 0, "perl with JSON::PP")
    command = [sys.executable, "-m", "client.cli", "agent", "check", agent, "--json"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=900)
    faulty = [each for each in json.loads(done.stdout)["situations"] if not each["ok"]]
    assert (done.returncode, faulty) == (0, [])


def test_the_log_of_every_run_is_kept(hall, tmp_path):
    """An agent that left is started anew for the next situation."""
    checked(hall, tmp_path, [sys.executable, str(BAD), "crashes"], [BY_NAME["open table"], BY_NAME["groups"]])
    assert (tmp_path / "agent.log").read_text().count("something is wrong with me") == 2


@pytest.mark.parametrize(("fault", "kept"), [("refused", True), ("none", False)])
def test_what_was_written_meanwhile_stays_if_there_are_faults(server_installed, tmp_path, fault, kept):
    command = [sys.executable, "-m", "client.cli", "agent", "check", "--only", "groups", "--json"]
    command += ["--command", f"{sys.executable} {BAD} {fault}"]
    environment = os.environ | {"TMPDIR": str(tmp_path)}
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)
    directory = json.loads(done.stdout)["directory"]
    assert (directory is not None) is kept
    assert [str(path) for path in tmp_path.glob("pooliad-check-*")] == ([directory] if kept else [])


def test_the_command_says_what_is_wrong_and_leaves_with_one(server_installed, tmp_path):
    bad = f"{sys.executable} {BAD} refused"
    command = [sys.executable, "-m", "client.cli", "agent", "check", "--command", bad, "--only", "groups"]
    done = subprocess.run([*command, "--out", str(tmp_path)], capture_output=True, text=True, timeout=120)
    assert done.returncode == 1
    assert "refused: /v1/games/" in done.stdout
    assert "R23" in done.stdout
    assert "1 situations, 1 faults" in done.stdout


@pytest.mark.parametrize(
    "options",
    [
        [],
        ["random", "--command", "x"],
        ["nobody"],
        ["random", "--only", "a draw"],
        ["--command", '"'],
        ["--command", ""],
        ["--command", "./nowhere"],
    ],
)
def test_usage_is_explained(options):
    command = [sys.executable, "-m", "client.cli", "agent", "check", *options]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout) == (2, "")
    assert "Traceback" not in done.stderr


def test_every_decision_and_every_twist_is_among_the_situations():
    choices = {each.start.choice for each in SITUATIONS if each.start is not None}
    assert {"R12", "R12a", "R13", "R14", "R16", "R17"} <= choices
    assert {each.twist for each in SITUATIONS} == set(Twist)
