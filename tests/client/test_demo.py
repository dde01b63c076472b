"""`pooliad demo` as a user runs it: a process that starts a server and two agents, and leaves nothing
behind.
"""

import json
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = pytest.mark.usefixtures("server_installed")
COMMAND = [sys.executable, "-m", "client.cli"]


def run(*arguments, **options):
    """One `pooliad` command, to its end."""
    command = [*COMMAND, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=240, check=False, **options)


def processes_of(directory):
    """Ids of processes whose command line or environment names the directory."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            if str(directory).encode() in (entry / "cmdline").read_bytes():
                found.append(int(entry.name))
        except OSError:
            continue
    return found


AGENTS = ("--agents", "search:shots=500,safeties=off", "random")
"""One of them with options (docs/agents.md, "search"), in letters that a server does not allow in names."""


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A demo of two games, its account, and its directory."""
    out = tmp_path_factory.mktemp("demo") / "out"
    done = run("demo", *AGENTS, "--games", 2, "--seed", 7, "--out", out, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout), out


def test_every_game_is_won_by_the_rules(finished):
    account, _ = finished
    assert account["status"] == "finished"
    assert account["agents"] == ["search-shots-500-safeties-off", "random"]
    assert len(account["games"]) == 2
    for game in account["games"]:
        assert game["winner"] in account["agents"]
        assert game["rule"] in {"R42", "R43", "R44", "R45", "R46"}
        assert game["reason"]
        assert sum(game["strokes_by_seat"]) == game["strokes"] > 0
        assert game["simulated_seconds"] > 0
    assert sum(account["score"]) == 2


def test_the_command_it_names_verifies_the_record(finished):
    """In a fresh process that has nothing but the file."""
    account, _ = finished
    for game in account["games"]:
        program, *arguments = shlex.split(game["verify"])
        assert program == "pooliad"
        done = run(*arguments, cwd="/")
        assert done.returncode == 0, done.stdout + done.stderr
        assert "verified" in done.stdout


def test_a_changed_record_does_not_verify(finished, tmp_path):
    account, _ = finished
    forged = tmp_path / "forged.jsonl"
    text = Path(account["games"][0]["record"]).read_text()
    forged.write_text(re.sub(r'"duration":(\d)', lambda found: f'"duration":{(int(found[1]) + 1) % 10}', text, count=1))
    done = run("replay", "verify", forged, "--json")
    assert done.returncode == 1
    verdict = json.loads(done.stdout)
    assert verdict["verdict"] == "different"
    assert verdict["difference"]["field"] == "duration"


@pytest.mark.slow
def test_the_seed_repeats_the_match(finished, tmp_path):
    account, _ = finished
    again = json.loads(run("demo", *AGENTS, "--seed", 7, "--out", tmp_path / "again", "--json").stdout)
    kept = ("winner", "reason", "strokes_by_seat", "fouls", "called", "made", "simulated_seconds", "breaker")
    here, there = account["games"][0], again["games"][0]
    assert {name: here[name] for name in kept} == {name: there[name] for name in kept}


def test_the_records_can_be_shown(finished):
    account, _ = finished
    record = account["games"][0]["record"]
    story = run("replay", "show", record).stdout
    assert "breaks" in story
    assert account["games"][0]["reason"] in story
    stroke = json.loads(run("replay", "show", record, "--shot", 1, "--json").stdout)
    assert stroke["stroke"] == 0
    assert stroke["events"][0]["kind"] == "cue_strike"
    missing = run("replay", "show", record, "--shot", 999)
    assert missing.returncode == 2
    assert "999" in missing.stderr


def test_nothing_is_left_running_after_it(finished):
    _, out = finished
    assert processes_of(out) == []


@pytest.mark.slow
def test_progress_is_a_sentence_a_stroke(tmp_path):
    done = run("demo", "--seed", 8, "--out", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    sentences = re.findall(r"^ +\d+  (greedy|random) .*\(R\d+.*\)$", done.stdout, re.MULTILINE)
    (strokes,) = re.findall(r"^  (\d+) strokes,", done.stdout, re.MULTILINE)
    assert len(sentences) == int(strokes)
    assert "pooliad replay verify" in done.stdout


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="looks for processes in /proc")
@pytest.mark.parametrize(
    "number",
    [*(pytest.param(each, marks=pytest.mark.slow) for each in (signal.SIGTERM, signal.SIGINT)), signal.SIGKILL],
)
def test_stopped_in_the_middle_it_takes_everything_with_it(tmp_path, number):
    out = tmp_path / "out"
    command = [*COMMAND, "demo", "--games", "50", "--seed", "9", "--out", str(out)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as demo:
        for line in demo.stdout:
            if re.match(r" +3  ", line):
                break
        children = _children_of(demo.pid)
        assert len(children) == 3
        demo.send_signal(number)
        demo.wait(30)
    deadline = time.monotonic() + 20
    while any(map(_runs, children)) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert [child for child in children if _runs(child)] == []


def _children_of(parent):
    return [int(word) for word in Path(f"/proc/{parent}/task/{parent}/children").read_text().split()]


def _runs(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def test_an_agent_that_breaks_down_ends_the_demo_with_its_words(tmp_path):
    (tmp_path / "broken.py").write_text(
        "import client, os\n\n\nclass Broken(client.Agent):\n    def choose(self, view):\n"
        "        print('my last words', flush=True)\n        os._exit(3)\n"
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(tmp_path), str(Path.cwd())])}
    done = run("demo", "--agents", "broken:Broken", "random", "--seed", 1, "--out", tmp_path / "out", env=environment)
    assert done.returncode == 1
    assert "Broken left with exit code 3" in done.stderr
    assert "my last words" in done.stderr


CLUMSY = """
import json, sys
from pathlib import Path

print("I am on standard error", file=sys.stderr)
turns = Path(sys.argv[1])
for line in sys.stdin:
    if json.loads(line)["type"] == "turn":
        before = len(turns.read_text()) if turns.exists() else 0
        turns.write_text("x" * (before + 1))
        print(("nonsense", '{"decision": "spot_eight"}', '{"decision": "concede"}')[min(before, 2)], flush=True)
"""
"""Answers nonsense, then what is refused, then gives up; it keeps count in a file, since nonsense ends it."""


def test_a_bad_answer_is_shown_as_it_happens_and_a_commands_standard_error_is_kept_with_the_rest(tmp_path):
    """Seen: only the agent's log had it, and the command's words were in a directory that nothing named."""
    (tmp_path / "clumsy.py").write_text(CLUMSY)
    out = tmp_path / "out"
    agent = f"stdio:{sys.executable} {tmp_path / 'clumsy.py'} {tmp_path / 'turns'}"
    done = run("demo", "--agents", agent, agent, "--seed", 1, "--out", out)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    nonsense = next(n for n, line in enumerate(lines) if "nonsense" in line)
    refused = next(n for n, line in enumerate(lines) if "refused: " in line and "R" in line)
    end = next(n for n, line in enumerate(lines) if "concede" in line and "!" not in line)
    assert nonsense < refused < end
    assert re.match(r"   !  turns-[12]: game \S+, stroke 0: choose raised: NonsenseAnswer: ", lines[nonsense])
    assert f"logs and records in {out}" in lines[-1]
    assert next(path.read_text() for path in out.glob("*.stderr")).startswith("I am on standard error\n")


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--agents", "nobody", "random"], "nobody"),
        (["--noise", "7"], "noise"),
        (["--games", "0"], "games"),
        (["--table", "snooker"], "name = 'snooker'"),
    ],
)
def test_wrong_usage_is_exit_code_2(arguments, named):
    done = run("demo", *arguments)
    assert done.returncode == 2
    assert named in done.stderr


def test_an_earlier_demo_is_not_overwritten(finished):
    _, out = finished
    done = run("demo", "--out", out)
    assert done.returncode == 2
    assert str(out) in done.stderr


def test_a_match_between_jaws(tmp_path):
    """`--table` by name: server, both agents, the record and its verification are on the nine-foot table."""
    done = run(
        "demo", "--agents", "random", "random", "--table", "nine_foot", "--seed", 2, "--out", tmp_path / "out", "--json"
    )
    assert done.returncode == 0, done.stderr
    account = json.loads(done.stdout)
    assert (account["status"], account["table"]) == ("finished", "nine_foot")
    (game,) = account["games"]
    header = json.loads(Path(game["record"]).read_text().splitlines()[0])
    assert header["table"]["name"] == "nine_foot"
    verified = run("replay", "verify", game["record"])
    assert verified.returncode == 0, verified.stdout + verified.stderr
    stroke = run("replay", "show", game["record"], "--shot", "1", "--as", "python")
    again = subprocess.run(
        [sys.executable, "-c", stroke.stdout], capture_output=True, text=True, check=False, timeout=240
    )
    assert again.returncode == 0, again.stderr
