"""Who sits at a table of the arena: a session in this process, or a process of its own."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from client.agents.registry import load
from client.arena.hosting import Hosting, Kind
from client.arena.process import ProcessSeat
from client.session import AgentSession, Session


def seat_of(hosting: Hosting, seed: int, log: Path | None, tell: Callable[[str], None]) -> Session:
    """The seat of an entrant.

    Args:
        hosting: how it is run; not ``remote``.
        seed: for agents of this package.
        log: where a process's standard error goes; nowhere if None.
        tell: told what goes wrong with it, in a sentence.

    Raises:
        client.AgentNotFound: no such name, module or class.
        ValueError: a remote agent; those play at a server.
    """
    if hosting.kind is Kind.REMOTE:
        raise ValueError(f"agent = {hosting.agent!r}: remote agents play at a server, not here")
    if hosting.as_process:
        return ProcessSeat(hosting, seed, log, tell)
    return AgentSession(partial(load(hosting.agent, seed), **hosting.options))
