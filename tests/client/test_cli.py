"""The `pooliad` command: what it prints, how it leaves (0 worked, 1 failed, 2 wrong usage), and that help
is quick.
"""

import json
import os
import re
import signal
import subprocess
import sys
import urllib.request
from importlib import metadata

import pytest
from typer.testing import CliRunner

import client
import physics
from client import notation
from client.cli import application, serve
from physics.engine import digest
from physics.table import NAMED
from referee.record import this_engine

POSITION = "0:0.5,1.7 3:0.4,0.6"
TABLE = physics.Table.olympiad()
STATE = notation.read(POSITION)


def run(*arguments):
    """A command in this process."""
    return CliRunner().invoke(application(), [str(argument) for argument in arguments])


def test_help_loads_nothing_heavy():
    """`pooliad --help` has to answer at once: no compiler, no models, no HTTP."""
    program = (
        "import sys; from client.cli import application; application();"
        "print([name for name in ('numba', 'scipy', 'pydantic', 'httpx2', 'numpy') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("name", ["demo", "serve", "simulate", "doctor", "agent", "replay"])
def test_every_command_has_help(name):
    done = run(name, "--help")
    assert done.exit_code == 0
    assert name in run("--help").output


def test_the_version_is_that_of_the_distribution():
    done = run("--version")
    assert (done.exit_code, done.stdout) == (0, f"pooliad {metadata.version('pooliad')}\n")


def test_a_stroke_in_full_names_cushions_as_cushions(tmp_path):
    """Seen: `rail_collision of 3 and 1`, as if ball 3 had met ball 1."""
    file = tmp_path / "game.jsonl"
    file.write_text("".join(f"{line}\n" for line in client.play("random", "random", seed=5).games[0].record()))
    told = run("replay", "show", file, "--shot", "1").stdout
    assert re.search(r"^ +\d+ +\d\.\d{6} s  ball \d+  rail collision at the [WESN] cushion$", told, re.MULTILINE)
    events = [line for line in told.splitlines() if re.match(r" +\d+  \d+\.\d{6} s  ", line)]
    assert len(events) > 1
    assert [line for line in events if " and " in line] == []


def test_simulate_prints_what_the_library_computes():
    done = run("simulate", "--v", 2, "--phi", 260, "--theta", 8, "--b", 3, "--balls", POSITION, "--json")
    told = json.loads(done.stdout)
    result = physics.simulate(TABLE, STATE, physics.Shot(2.0, 260.0, 8.0, 0.0, 3.0))
    assert told["events"] == json.loads(json.dumps([event.to_dict() for event in result.events]))
    assert told["final"] == result.final.to_dict()
    assert told["status"] == "at_rest"


def test_simulate_takes_json_a_file_and_a_rack(tmp_path):
    file = tmp_path / "position.json"
    file.write_text(json.dumps(STATE.to_dict()))
    shot = ["simulate", "--v", 2, "--phi", 260, "--json"]
    answers = [run(*shot, "--balls", given).stdout for given in (POSITION, json.dumps(STATE.to_dict()), f"@{file}")]
    assert answers[0] == answers[1] == answers[2]
    assert json.loads(answers[0])["shot"]["theta"] == physics.min_elevation(TABLE, STATE, 260.0)
    broken = run("simulate", "--v", 9, "--phi", 270, "--rack", 7)
    assert broken.exit_code == 0
    assert "ball collision" in broken.stdout


@pytest.mark.parametrize("command", ["simulate", "demo"])
def test_help_lists_the_tables_there_are(command):
    """From the physics itself: no second list of names."""
    told = " ".join(run(command, "--help").output.replace("│", " ").split())
    assert f"{', '.join(NAMED)}, JSON with parameters, or a TOML file of them." in told


def test_simulate_between_jaws():
    shot = ["simulate", "--v", 4, "--phi", 260, "--theta", 8, "--balls", POSITION, "--json", "--table"]
    nine = json.loads(run(*shot, "nine_foot").stdout)
    hard = json.loads(run(*shot, '{"name": "nine_foot", "cushion": "mathavan"}').stdout)
    assert nine["final"] != hard["final"]
    fast = ["simulate", "--v", 11, "--phi", 260, "--theta", 8, "--balls", POSITION, "--table"]
    assert run(*fast, "nine_foot").exit_code == 0, "its v_max is 12 m/s"
    assert run(*fast, "olympiad").exit_code == 2


def test_simulate_on_another_table():
    shot = ["simulate", "--v", 2, "--phi", 260, "--theta", 8, "--balls", POSITION, "--json", "--table"]
    usual = json.loads(run(*shot, "olympiad").stdout)
    slow = json.loads(run(*shot, '{"name": "olympiad", "mu_roll": 0.03}').stdout)
    assert slow["duration"] < usual["duration"]


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--v", "20", "--phi", "0", "--balls", POSITION], "v = 20"),
        (["--v", "nan", "--phi", "0", "--balls", POSITION], "v = nan"),
        (["--v", "2", "--phi", "0"], "exactly one of --balls and --rack"),
        (["--v", "2", "--phi", "0", "--balls", POSITION, "--rack", "1"], "exactly one"),
        (["--v", "2", "--phi", "0", "--balls", "0:0.5"], "3:0.4,0.6"),
        (["--v", "2", "--phi", "0", "--balls", "0:0.5,0.5 0:0.6,0.6"], "once"),
        (["--v", "2", "--phi", "0", "--balls", "0:0.5,0.5 1:0.5,0.51"], "overlaps"),
        (["--v", "2", "--phi", "0", "--balls", "{"], "not JSON"),
        (["--v", "2", "--phi", "0", "--balls", "@/nowhere/at/all"], "/nowhere/at/all"),
        (
            ["--v", "2", "--phi", "0", "--balls", POSITION, "--table", "snooker"],
            "name = 'snooker': must be one of ('olympiad'",
        ),
        (["--v", "2", "--phi", "0", "--balls", POSITION, "--table", '{"name":'], "--table is not JSON"),
        (
            ["--v", "2", "--phi", "0", "--balls", POSITION, "--table", '{"name": "nine_foot", "v_max": NaN}'],
            "v_max = nan: must be a number from 0.1 to 20 m/s",
        ),
        (["--v", "2", "--phi", "0", "--balls", "3:0.4,0.6"], "there must be a cue ball"),
        (["--v", "2", "--phi", "90", "--theta", "0", "--balls", "0:0.5,0.03"], "cannot be played"),
        (["--v", "2", "--phi", "0", "--a", "40", "--balls", POSITION], "a^2 + b^2"),
        (["--v", "2", "--phi", "0", "--balls", "0:0.5,1 3:0.442849,1"], "every elevation"),
        (["--v", "2", "--phi", "0", "--balls", POSITION, "--table", "{"], "not JSON"),
    ],
)
def test_simulate_names_what_is_wrong(arguments, named):
    done = run("simulate", *arguments)
    assert done.exit_code == 2
    assert named in done.stderr


@pytest.mark.parametrize(
    ("phi", "note"), [("1.5708", "--phi 90.0002"), ("-3.14", "--phi -179.909"), ("2", ""), ("260", "")]
)
def test_simulate_doubts_an_azimuth_that_looks_like_radians(phi, note):
    done = run("simulate", "--v", "2", "--phi", phi, "--theta", "45", "--balls", POSITION)
    assert done.exit_code == 0
    assert (note in done.stderr) if note else not done.stderr


def test_doctor_reports_and_agrees_with_itself(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run("doctor", "--json")
    report = json.loads(done.stdout)
    assert done.exit_code == 0, done.stderr
    assert report["ok"] is True
    again = json.loads(run("doctor", "--json").stdout)
    assert report["self_test"]["digest"] == again["self_test"]["digest"]
    assert set(report["packages"]) == {"physics", "referee", "tournament", "server", "client"}
    assert report["versions"]["pooliad"]
    assert again["kernel_cache"]["state"] == "filled", "the first run compiled what was missing"
    assert report["self_test"]["digest"] in run("doctor").stdout


def test_doctor_names_the_engine_as_records_do():
    """The digest that `replay verify` asks for is that of the record's engine, not that of the compiled kernels."""
    report = json.loads(run("doctor", "--json").stdout)
    assert report["record_engine"] == this_engine().to_dict()
    assert report["kernel_cache"]["kernels_digest"] == digest() != report["record_engine"]["digest"]


def test_doctor_fails_where_something_does_not_work():
    done = run("doctor", "--database", "sqlite:////proc/none/pooliad.db", "--json")
    assert done.exit_code == 1
    assert "cannot be written" in done.stderr
    assert json.loads(done.stdout)["ok"] is False


def test_serve_names_the_install_command_when_the_extra_is_missing(monkeypatch):
    monkeypatch.setattr(serve, "find_spec", lambda name: None)
    done = run("serve")
    assert done.exit_code == 1
    assert "pip install 'pooliad[server]'" in done.stderr


def test_serve_serves_until_it_is_told_to_stop(server_installed, tmp_path):
    command = [
        sys.executable,
        "-m",
        "client.cli",
        "serve",
        "--port",
        "0",
        "--database",
        f"sqlite:///{tmp_path}/a.db",
    ]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            url = json.loads(server.stdout.readline())["url"]
            with urllib.request.urlopen(f"{url}/healthz", timeout=10) as answer:
                assert answer.status == 200
        finally:
            server.send_signal(signal.SIGTERM)
        assert server.wait(20) == 0


def test_agent_run_plays_a_match(hall):
    """The program the demo starts, with address and token from the environment."""
    entries = hall.register("one"), hall.register("two")
    match = hall.match(*entries, seed=3)
    command = [sys.executable, "-m", "client.cli", "agent", "run", "random", "--seed", "3", "--json"]
    agents = [
        subprocess.Popen(
            command,
            stdout=subprocess.PIPE,
            text=True,
            env=os.environ | {"POOLIAD_URL": hall.url, "POOLIAD_TOKEN": entry.token},
        )
        for entry in entries
    ]
    told = [json.loads(agent.communicate(timeout=120)[0]) for agent in agents]
    assert [agent.returncode for agent in agents] == [0, 0]
    assert [each["seat"] for each in told] == [0, 1]
    assert told[0]["score"] == list(hall.organiser.match(match.id).score)


def test_agent_run_names_what_is_wrong(hall):
    unknown = run("agent", "run", "nobody", "--url", hall.url, "--token", "x")
    assert unknown.exit_code == 2
    assert "greedy" in unknown.stderr
    command = [
        sys.executable,
        "-m",
        "client.cli",
        "agent",
        "run",
        "random",
        "--url",
        hall.url,
        "--token",
        "x",
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "unauthorized" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("command", ["show", "verify"])
def test_a_file_that_is_no_record_is_named(command, tmp_path):
    nothing = run("replay", command, tmp_path / "nothing.jsonl")
    assert nothing.exit_code == 2
    assert "nothing.jsonl" in nothing.stderr
    (tmp_path / "text.jsonl").write_text("hello\n")
    text = run("replay", command, tmp_path / "text.jsonl")
    assert text.exit_code == 1


BARE = '{"type": "game"}\n{"type": "end"}\n'
HALF = '{"type":"game","players":["a","b"],"noise":{"level":1}}\n{"type":"stroke","stroke":0}\n{"type":"end"}\n'


@pytest.mark.parametrize("text", [BARE, HALF], ids=["bare", "half"])
@pytest.mark.parametrize("arguments", [["show"], ["show", "--shot", "1"], ["verify"]], ids=" ".join)
def test_a_record_with_missing_parts_is_one_line(text, arguments, tmp_path):
    file = tmp_path / "game.jsonl"
    file.write_text(text)
    done = run("replay", *arguments, file)
    assert done.exit_code in (1, 2)
    assert done.exception is None or isinstance(done.exception, SystemExit)
    told = (done.stderr or done.stdout).strip().splitlines()
    assert len(told) == 1
    assert "game.jsonl" in told[0] or "--shot" in told[0]
    assert "argument after **" not in told[0]


@pytest.mark.parametrize("token", ["\u00e9\u20ac", "two words", "line\nbreak"])
def test_a_token_that_no_header_can_carry_is_named(token):
    done = run("agent", "run", "random", "--url", "http://127.0.0.1:9", "--token", token)
    assert done.exit_code == 2
    assert "token" in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


@pytest.mark.parametrize("table", ['{"name": []}', '{"mu_roll": "x"}', "[]", '{"mouths": [1]}'])
def test_a_table_that_is_none_is_one_line(table):
    done = run("simulate", "--v", "2", "--phi", "0", "--balls", POSITION, "--table", table)
    assert done.exception is None or isinstance(done.exception, SystemExit)
    assert done.exit_code == 2
    assert len(done.stderr.strip().splitlines()) == 1
