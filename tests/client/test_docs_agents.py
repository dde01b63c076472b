"""docs/agents.md does what it says: its agent plays, its curl commands play a turn."""

import os
import re
import shutil
import subprocess
from typing import Any

import pytest
from support.require import ROOT, require

import client

TEXT = (ROOT / "docs" / "agents.md").read_text(encoding="utf-8")


def blocks(language):
    """The fenced code blocks of one language."""
    return re.findall(rf"^```{language}\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)


def own_agent(names):
    """The document's agent, defined by its first Python block."""
    exec(compile(blocks("python")[0], "docs/agents.md", "exec"), names)
    return names["Straight"]


def test_the_own_agent_has_fewer_than_twenty_lines():
    lines = [line for line in blocks("python")[0].splitlines() if line.strip()]
    assert len(lines) < 20


def test_every_python_block_runs(capsys):
    names: dict[str, Any] = {}
    own_agent(names)
    for block in blocks("python")[1:]:
        exec(compile(block, "docs/agents.md", "exec"), names)
    assert len(names["match"].games) == 2
    assert "no answer from the server" in capsys.readouterr().out


def test_the_own_agent_plays_by_the_rules_to_the_end():
    """Whole games without one refused action: the forfeit that would follow is no end by the rules."""
    straight = own_agent({})
    for seed in (1, 2, 3):
        (game,) = client.play(straight, "random", seed=seed).games
        assert game.outcome.rule in {"R42", "R43", "R44", "R45", "R46", "R49"}


@pytest.fixture
def shell(hall, tmp_path):
    """Runs a block as bash would, in a directory of its own, with URL and TOKEN of an agent whose turn it
    is.
    """
    require(shutil.which("curl") is not None, "the curl program")
    first, second = hall.register("documented"), hall.register("reader")
    hall.match(first, second)
    environment = os.environ | {"URL": hall.url, "TOKEN": first.token}

    def run(block):
        done = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", block],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr + done.stdout
        return done.stdout

    return run


def test_the_curl_commands_play_a_turn(shell):
    wait, break_shot, elevation = blocks("bash")
    shell(wait)
    assert '"status":"at_rest"' in shell(break_shot)
    assert '"theta"' in shell(elevation)


def test_the_curl_stroke_sent_twice_is_played_once(shell):
    """As the document says of the Idempotency-Key: the stored answer comes back, byte for byte."""
    wait, break_shot, _ = blocks("bash")
    shell(wait)
    assert shell(break_shot) == shell(break_shot)
