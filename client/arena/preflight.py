"""Whether every entrant can be made and started: found out before the first game, so that nobody loses points by it."""

import contextlib
import os
import signal
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Final

from client.adapters.stdio import LOGS
from client.agents.registry import load
from client.arena.confine import confined
from client.arena.directory import EventError, file_name
from client.arena.executors import Pool
from client.arena.hosting import Hosting, Kind
from client.arena.terms import Terms

SECONDS: Final = 120.0
"""How long an entrant may take to load; one with more time for an answer may take that."""
LINES: Final = 15
"""Of what it wrote, in the message: the end of a traceback."""


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
    candidates = [
        (name, hosting, terms.agent_seed, None if logs is None else str(logs.resolve() / f"start-{file_name(name)}"))
        for name, hosting in terms.hosting.items()
        if hosting.kind is not Kind.REMOTE and name not in (withdrawn or {})
    ]
    complaints = [each for each in pool.everywhere(complaint, candidates) if each is not None]
    if complaints:
        raise EventError("\n".join(dict.fromkeys(complaints)))


def complaint(candidate: tuple[str, Hosting, int, str | None]) -> str | None:
    """Why an entrant cannot be made or started on this machine, in words; None if it can.

    Args:
        candidate: name, how it is run, the seed for agents of this package, the directory for standard error.
    """
    name, hosting, seed, logs = candidate
    try:
        if hosting.kind is Kind.SHIPPED:
            load(hosting.agent, seed)(**hosting.options)
            return None
        why = _tried(hosting, seed, logs)
    except Exception as error:
        why = f"{type(error).__name__}: {error}"
    return why and f"entrant {name!r}: agent = {hosting.agent!r}: cannot be started: {why}"


def _tried(hosting: Hosting, seed: int, logs: str | None) -> str | None:
    """Start it in a process under its limits, and say how that ended if it failed."""
    memory = None if hosting.memory_mb is None else hosting.memory_mb * 2**20
    command = confined([*hosting.command(seed), "--check", str(hosting.answer_seconds)], memory=memory)
    process = subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env=os.environ | ({} if logs is None else {LOGS: logs}) | dict(hosting.environment),
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
