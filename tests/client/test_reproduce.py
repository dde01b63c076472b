"""`pooliad replay show FILE --shot N --as python|json|curl`: what it prints simulates the recorded stroke again."""

import json
import shutil
import subprocess
import sys

import pytest
from support.require import require

import client
import physics
from client import notation
from protocol import SimulateRequest


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    """A game on a table of its own, with noise, as a file; and its strokes."""
    table = physics.Table.olympiad().replace(mu_slide=0.25)
    (game,) = client.play("random", "random", seed=3, table=table).games
    path = tmp_path_factory.mktemp("record") / "game.jsonl"
    path.write_text("\n".join(game.record()) + "\n")
    return path, [stroke for stroke in game.strokes if stroke.shot is not None]


def show(path, *options, code=0):
    command = [sys.executable, "-m", "client.cli", "replay", "show", str(path), *options]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.returncode == code, done.stderr
    return done.stdout if code == 0 else done.stderr


def test_the_program_ends_as_the_record_says(record):
    path, strokes = record
    program = show(path, "--shot", "4", "--as", "python")
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert notation.read(done.stdout.splitlines()[-1]) == strokes[3].result.final


def test_the_request_is_one_and_ends_as_the_record_says(record):
    path, strokes = record
    request = SimulateRequest.model_validate_json(show(path, "--shot", "4", "--as", "json"))
    result = physics.simulate(
        physics.Table.from_dict(request.table),
        physics.TableState.from_positions(request.balls),
        request.shot.to_shot(),
    )
    assert result.final == strokes[3].result.final


def test_the_command_line_asks_a_server(record, hall):
    require(shutil.which("curl") is not None, "the curl program")
    path, strokes = record
    command = show(path, "--shot", "4", "--as", "curl")
    token = hall.register("reporter").token
    environment = {"URL": hall.url, "TOKEN": token, "PATH": "/usr/bin:/bin"}
    done = subprocess.run(["bash", "-c", command], env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr + done.stdout
    assert physics.TableState.from_dict(json.loads(done.stdout)["balls"]) == strokes[3].result.final


@pytest.mark.parametrize("options", [("--as", "python"), ("--shot", "1", "--as", "python", "--json"), ("--as", "rust")])
def test_usage_is_explained(record, options):
    assert "--as" in show(record[0], *options, code=2)
