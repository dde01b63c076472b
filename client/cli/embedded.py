"""A server for the length of a command: a process on a free port, its database in a directory."""

import json
import secrets
import time
from dataclasses import dataclass
from pathlib import Path

from client.cli.output import fail
from client.cli.processes import Child
from client.cli.serve import server_command

START_SECONDS = 60.0
"""Longest wait for the server to listen: it imports in a second or two, far more on a loaded machine."""
LOOK_EVERY = 0.05


@dataclass(frozen=True, slots=True)
class Embedded:
    """A running server: its address, and the token of its organiser."""

    url: str
    organiser: str


def start(started: list[Child], directory: Path) -> Embedded:
    """Start a server among the children `started`; its database and log lie in `directory`.

    Leaves the command with the server's last words when it does not come up.
    """
    token = secrets.token_hex(32)
    command = server_command("127.0.0.1", 0, f"sqlite:///{directory / 'pooliad.db'}")
    child = Child("server", command, directory / "server.log", {"POOLIAD_ORGANISER_TOKEN": token})
    started.append(child)
    deadline = time.monotonic() + START_SECONDS
    while (url := _announced(child)) is None:
        if child.exit_code is not None:
            fail(f"the server left with exit code {child.exit_code}:\n{child.last_words()}")
        if time.monotonic() > deadline:
            fail(f"the server did not listen within {START_SECONDS:g} s:\n{child.last_words()}")
        time.sleep(LOOK_EVERY)
    return Embedded(url, token)


def _announced(server: Child) -> str | None:
    """The address in the server's first line, once it is there."""
    for line in server.written():
        if line.startswith("{") and line.endswith("}"):
            said = json.loads(line)
            if said.get("event") == "listening":
                return str(said["url"])
    return None
