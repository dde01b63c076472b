"""The README's promises beyond its Python blocks: what its commands do, and that its agent plays."""

import json
import shutil

import pytest
from support.documents import PAGES, bash_blocks, python_blocks
from support.require import require

import client

README = PAGES["README.md"]
BY_THE_RULES = {"R42", "R43", "R44", "R45", "R46", "R49"}


def test_the_first_two_blocks_are_the_demo_and_the_tests():
    """They are run literally elsewhere: the second by `.ci/run`, the first from a clone."""
    main_job, tests = bash_blocks(README)[:2]
    assert main_job.splitlines()[-1] == ".venv/bin/pooliad demo"
    assert "-m pytest" in tests.splitlines()[-1]
    assert "sudo" not in main_job + tests


def test_the_agent_is_short_and_plays_by_the_rules_to_the_end():
    """A forfeit, the end after too many refused actions, is no end by the rules."""
    (block,) = [block for block in python_blocks(README) if "client.Agent" in block.parsed]
    assert len([line for line in block.parsed.splitlines() if line.strip()]) < 20
    block.evaluate()
    straight = block.document.namespace["Straight"]
    for seed in (1, 2):
        (game,) = client.play(straight, "random", seed=seed).games
        assert game.outcome.rule in BY_THE_RULES


def test_the_physics_takes_ten_lines():
    (block,) = [block for block in python_blocks(README) if "physics.simulate(" in block.parsed]
    lines = [line for line in block.parsed.splitlines() if line.strip()]
    assert "import physics" in lines
    assert len(lines) <= 10


def test_the_curl_block_starts_a_match_and_breaks(server, shell, tmp_path):
    require(shutil.which("curl") is not None, "the curl program")
    (block,) = [block for block in bash_blocks(README) if "curl" in block]
    shell(block, URL=server.url)
    answer = json.loads((tmp_path / "answer.json").read_text())
    assert answer["stroke"]["status"] == "at_rest"
    assert answer["view"]["version"] > 1


@pytest.mark.slow
@pytest.mark.usefixtures("server")
def test_the_commands_play_show_verify_and_examine(shell, tmp_path):
    (block,) = [block for block in bash_blocks(README) if "replay verify" in block]
    told = shell(block, POOLIAD_DATABASE=f"sqlite:///{tmp_path / 'pooliad.db'}")
    assert "ball collision" in told
    assert "verified" in told
    assert "self test" in told
