"""Agents play on through a server that is killed and started again on its database: every stroke once."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from typing import Any

import pytest

import client
from client.run import run_agent
from protocol import MatchRequest
from referee.record import verify_record

ORGANISER = "organiser-token-of-the-tests-0123456789"


class Mortal:
    """A server process that can be killed and started again, on one port and one SQLite file."""

    def __init__(self, database):
        self._database, self._port = database, "0"
        self.start()

    def start(self):
        command = [sys.executable, "-m", "server", "--port", self._port, "--database", f"sqlite:///{self._database}"]
        environment = os.environ | {"POOLIAD_ORGANISER_TOKEN": ORGANISER}
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, env=environment, text=True)
        self.url = json.loads(self.process.stdout.readline())["url"]
        self._port = self.url.rpartition(":")[2]

    def end(self, number):
        self.process.send_signal(number)
        self.process.wait(30)
        self.process.stdout.close()


@pytest.fixture
def mortal(server_installed, tmp_path):
    server = Mortal(tmp_path / "games.db")
    yield server
    server.end(signal.SIGKILL)


@pytest.mark.parametrize(
    "number", [signal.SIGKILL, pytest.param(signal.SIGTERM, marks=pytest.mark.slow)], ids=["killed", "stopped"]
)
def test_a_match_goes_on_after_the_server_went_down(mortal, number):
    with client.Pooliad(mortal.url, ORGANISER) as organiser:
        entries = [organiser.register(f"player {seat}") for seat in (0, 1)]
        agents = (entries[0].agent.id, entries[1].agent.id)
        match = organiser.create_match(MatchRequest(agents=agents, seed="7" * 64))
        overs: list[Any] = [None, None]

        def play(seat):
            overs[seat] = run_agent(client.load("random", seed=seat), mortal.url, entries[seat].token)

        threads = [threading.Thread(target=play, args=(seat,)) for seat in (0, 1)]
        for thread in threads:
            thread.start()
        for strokes in (3, 6):
            while organiser.match(match.id).played[0].strokes < strokes:
                time.sleep(0.02)
            mortal.end(number)
            mortal.start()
        for thread in threads:
            thread.join(120)
        assert [over.status for over in overs] == ["finished", "finished"]
        (game,) = organiser.match(match.id).played
        found = verify_record(organiser.record(game.id).decode().splitlines())
        assert found.ok, str(found)
        assert game.outcome.rule in {"R42", "R43", "R44", "R45", "R46", "R49"}
