"""Whether every entrant can be made and started: found out before the first game, so that nobody loses points by it."""

import contextlib
import json
import os
import signal
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from client.adapters.stdio import HOSTED, LOGS
from client.agents.registry import load
from client.arena.confine import confined
from client.arena.directory import EventError, file_name
from client.arena.executors import Pool
from client.arena.hosting import Hosting, Kind
from client.arena.terms import Terms
from client.prepare import prepare
from physics import Table

SECONDS: Final = 120.0
"""How long an entrant may take to load; one with more time for an answer may take that."""
LINES: Final = 15
"""Of what it wrote, in the message: the end of a traceback."""


@dataclass(frozen=True, slots=True)
class Candidate:
    """An entrant to try.

    Attributes:
        name: of the entrant. hosting: how it is run. seed: for agents of this package. table: of the event.
        logs: directory for standard error; None for nowhere.
    """

    name: str
    hosting: Hosting
    seed: int
    table: Table
    logs: str | None


def require_startable(
    terms: Terms, pool: Pool, logs: Path | None = None, withdrawn: Mapping[str, int] | None = None
) -> None:
    """Try every entrant that is played here on every machine of the pool.

    Args:
        terms: of the event. pool: where its games will be played.
        logs: directory for the standard error of commands.
        withdrawn: entrants that play no more are not tried.

    Raises:
        EventError: some cannot be made or started; the message has each with the end of its traceback.
    """
    table = Table.of(terms.spec.table)
    candidates = [
        Candidate(
            name,
            hosting,
            terms.agent_seed,
            table,
            None if logs is None else str(logs.resolve() / f"start-{file_name(name)}"),
        )
        for name, hosting in terms.hosting.items()
        if hosting.kind is not Kind.REMOTE and name not in (withdrawn or {})
    ]
    complaints = [each for each in pool.everywhere(complaint, candidates) if each is not None]
    if complaints:
        raise EventError("\n".join(dict.fromkeys(complaints)))


def complaint(candidate: Candidate) -> str | None:
    """Why an entrant cannot be made or started on this machine, in words; None if it can.

    The physics of the event's table is compiled on the way, so that no clock pays for it.
    """
    name, hosting = candidate.name, candidate.hosting
    try:
        prepare(candidate.table)
        if hosting.kind is Kind.SHIPPED:
            load(hosting.agent, candidate.seed)(**hosting.options)
            return None
        why = _tried(candidate)
    except Exception as error:
        why = f"{type(error).__name__}: {error}"
    return why and f"entrant {name!r}: agent = {hosting.agent!r}: cannot be started: {why}"


def _tried(candidate: Candidate) -> str | None:
    """Start it in a process under its limits, and say how that ended if it failed."""
    hosting, logs = candidate.hosting, candidate.logs
    memory = None if hosting.memory_mb is None else hosting.memory_mb * 2**20
    check = ["--check", str(hosting.answer_seconds), "--table", json.dumps(candidate.table.to_dict())]
    command = confined([*hosting.command(candidate.seed), *check], memory=memory)
    process = subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env=os.environ | {HOSTED: "1"} | ({} if logs is None else {LOGS: logs}) | dict(hosting.environment),
        start_new_session=True,
    )
    seconds = max(SECONDS, hosting.answer_seconds)
    try:
        said, _ = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        return f"it did not start within {seconds:g} s"
    finally:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    if process.returncode == 0:
        return None
    lines = said.decode(errors="replace").strip().splitlines()
    return "\n".join([lines[-1] if lines else f"exit code {process.returncode}", *lines[-LINES:-1]])
