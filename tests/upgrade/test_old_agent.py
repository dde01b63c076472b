"""An agent written for 0.1.0 plays today: its `search`, from a checkout of its own, as a command (docs/agents.md)."""

import io
import shlex
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

import pytest

import client
from referee import EndReason
from referee.record import verify_record

V0_1_0 = "8336b41"
ROOT = Path(__file__).resolve().parents[2]

AGENT = """
import json, sys
import physics
from client.agents.search import SearchAgent
from referee.wire import View

assert sys.argv[1] in physics.__file__, physics.__file__
agent = SearchAgent(seed=1, shots=400)
for line in sys.stdin:
    message = json.loads(line)
    if message["type"] == "game_started":
        agent.game_started(View.model_validate(message["view"]))
    if message["type"] == "turn":
        print(json.dumps(agent.choose(View.model_validate(message["view"])).to_dict()), flush=True)
"""


@pytest.fixture
def checkout(tmp_path):
    """The files of 0.1.0."""
    if shutil.which("git") is None:
        pytest.skip("git is not installed")
    command = ["git", "-C", str(ROOT), "archive", V0_1_0]
    made = subprocess.run(command, capture_output=True, check=False)
    if made.returncode != 0:
        pytest.skip(f"the history does not reach back to {V0_1_0}: {made.stderr.decode(errors='replace').strip()}")
    folder = tmp_path / "v0_1_0"
    with tarfile.open(fileobj=io.BytesIO(made.stdout)) as files:
        files.extractall(folder, filter="data")
    return folder


@pytest.mark.long
def test_the_search_of_0_1_0_plays_a_whole_game(checkout, monkeypatch):
    """On the Olympiad's table, which both know; its kernels are compiled first, in its own process."""
    script = checkout.parent / "agent.py"
    script.write_text(AGENT)
    monkeypatch.setenv("PYTHONPATH", str(checkout))
    warm = "from client.agents.search import SearchAgent; SearchAgent(seed=1, shots=400)"
    subprocess.run([sys.executable, "-P", "-c", warm], check=True, cwd=checkout.parent)
    command = shlex.join(["stdio:" + sys.executable, "-P", str(script), str(checkout)])
    match = client.play(command, "random", seed=3)
    (game,) = match.games
    assert game.outcome.reason not in (EndReason.FORFEIT, EndReason.CRASH, EndReason.STALL)
    assert game.outcome.winner == 0
    assert any(stroke.ruling.made for stroke in game.strokes if stroke.seat == 0)
    assert verify_record(list(game.record())).ok
