"""`client.spar` and `pooliad agent spar`: a match against a house bot of a real server."""

import json
import subprocess
import sys
from typing import Any

import pytest

import client
from client import errors
from client.cli import embedded
from client.cli.processes import children
from physics import TableState
from referee import Game, Phase

POSITION = {"balls": {"0": [0.5, 1.7], "3": [0.4, 0.6], "8": [0.9, 0.4]}}


class Conceding(client.Agent):
    """Gives up at once, and keeps where it was asked."""

    seen: list[Any]

    def choose(self, view):
        self.seen.append(view)
        return client.Action(decision=client.Decision.CONCEDE)


@pytest.fixture(scope="module")
def house(server_installed, tmp_path_factory):
    """A server with `random` in the house."""
    with children() as started, pytest.MonkeyPatch.context() as patch:
        patch.setenv("POOLIAD_HOUSE_BOTS", "random")
        yield embedded.start(started, tmp_path_factory.mktemp("house"))


@pytest.fixture
def guest(house):
    with client.Pooliad(house.url) as server:
        return server.register(f"guest {len(server.agents().agents)}")


def test_sparring_is_a_match_from_the_position_asked_for(house, guest):
    Conceding.seen = []
    start = Game(TableState.from_dict(POSITION["balls"]), Phase.PLAY, 0, 0)
    over = client.spar(Conceding, house.url, guest.token, "random", games=2, start=start)
    assert (over.status, over.winner, over.score) == ("finished", 1, (0.0, 2.0))
    assert Conceding.seen[0].players == (guest.agent.name, "random")
    assert Conceding.seen[0].to_game() == start
    with client.Pooliad(house.url, guest.token) as server:
        match = server.match(over.match)
        assert (match.rated, match.challenger, server.me()) == (False, 0, guest.agent)


def test_a_bot_that_is_not_there_is_named_with_those_that_are(house, guest):
    with pytest.raises(errors.AgentNotFound, match=r"'greedy'.*\['random'\]"):
        client.spar(Conceding, house.url, guest.token, "greedy")


def test_the_command_spars_and_reports(house, guest, tmp_path):
    (tmp_path / "quitter.py").write_text(
        "import client\n\n\nclass Quitter(client.Agent):\n"
        "    def choose(self, view):\n        return client.Action(decision='concede')\n"
    )
    (tmp_path / "start.json").write_text(json.dumps(POSITION))
    options = ["--url", house.url, "--token", guest.token, "--start", "start.json", "--json"]
    done = subprocess.run(
        [sys.executable, "-m", "client.cli", "agent", "spar", "quitter:Quitter", "random", *options],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["winner"] == 1


@pytest.mark.parametrize("content", [b"{}", b"\xff", b'{"balls": {"0": [0.5, 1.7], "3": [0.5, 1.7]}}'])
def test_a_file_that_holds_no_position_is_a_matter_of_usage(guest, house, tmp_path, content):
    (tmp_path / "start.json").write_bytes(content)
    options = ["--url", house.url, "--token", guest.token, "--start", str(tmp_path / "start.json")]
    command = [sys.executable, "-m", "client.cli", "agent", "spar", "random", "random", *options]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout) == (2, "")
    assert "is no position" in done.stderr
    assert "Traceback" not in done.stderr
