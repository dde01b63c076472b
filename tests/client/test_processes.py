"""Child processes of a command, and what they wrote."""

import sys
from typing import Any

import httpx2

from client.cli import embedded
from client.cli.processes import Child, children


def run(log: Any, words: str) -> Child:
    child = Child("talker", [sys.executable, "-c", f"print({words!r})"], log, {})
    assert child.wait(60) == 0
    return child


def test_a_child_keeps_what_others_wrote_and_speaks_for_itself(tmp_path):
    """Seen: `agent check` restarts its agent, and only the last run's log was left."""
    log = tmp_path / "talker.log"
    assert run(log, "one\ntwo").last_words() == "  talker: one\n  talker: two"
    assert run(log, "three").last_words() == "  talker: three"
    silent = Child("silent", ["true"], log, {})
    assert silent.wait(60) == 0
    assert silent.last_words() == "  silent wrote nothing"
    assert log.read_text() == "one\ntwo\nthree\n"


def test_a_server_in_a_used_directory_is_found_where_it_listens_now(server_installed, tmp_path):
    """The log still says where the one before it did."""
    with children() as started:
        for _ in range(2):
            server = embedded.start(started, tmp_path)
            assert httpx2.get(f"{server.url}/healthz").status_code == 200
            started.pop().stop()
    assert (tmp_path / "server.log").read_text().count('"listening"') == 2
