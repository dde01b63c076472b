"""How an entrant is run: as part of the worker, as a process under limits, or by somebody else at the server."""

import json
import re
import shlex
import sys
from collections.abc import Mapping
from dataclasses import field
from enum import StrEnum
from typing import Annotated, Any, Self

from client.agents.registry import SHIPPED, STDIO
from client.arena.directory import EventError
from physics.errors import FieldError, shown
from referee.play.clock import MOST_SECONDS
from tournament.entrant import LONGEST_AGENT
from tournament.validation import Flag, Must, Value, above, integer, text, value

ANSWER_SECONDS = 60.0
"""How long an agent may be silent in an event without clocks: a program that is not dead has answered by then."""
MOST_MEMORY_MB = 2**20
MOST_CORES = 1024

_IMPORT_PATH = re.compile(r"[A-Za-z_][\w.]*:[A-Za-z_]\w*")
_REMOTE = re.compile(r"remote(:[A-Za-z0-9_.:-]{1,64})?")


class Kind(StrEnum):
    """What an entrant's ``agent`` names."""

    SHIPPED = "shipped"
    """An agent of this package, by name."""
    IMPORT_PATH = "import_path"
    """A ``client.Agent`` class, as ``module:Class``."""
    COMMAND = "command"
    """A program in any language, as ``stdio:COMMAND``."""
    REMOTE = "remote"
    """An agent that plays at the server by itself: ``remote:AGENT_ID``, or ``remote`` for the one of that name."""


def _refusal(name: str, given: Any, allowed: str) -> EventError:
    return EventError(f"{name} = {shown(given)}: {allowed}")


@value(_refusal, "hosting")
class Hosting(Value):
    """How one entrant is run.

    Attributes:
        agent: as for ``client.load`` (``search:seconds=0.3``, ``module:Class``, ``stdio:COMMAND``), or ``remote``,
            ``remote:AGENT_ID``.
        options: keyword arguments for the agent's class.
        process: a process of its own, under the limits below; None: all but shipped ones.
        memory_mb: address space, MiB. cores: how many processor cores. Only for processes.
        answer_seconds: in an event without clocks, how long it may be silent before the game is lost by a stall.
        environment: variables beside those of the runner. Only for processes.

    Raises:
        EventError: naming the field, its value and what is allowed.
    """

    agent: Annotated[str, text(LONGEST_AGENT)]
    options: Mapping[str, Any] = field(default_factory=dict, hash=False)
    process: Flag | None = None
    memory_mb: Annotated[int, integer(1, MOST_MEMORY_MB)] | None = None
    cores: Annotated[int, integer(1, MOST_CORES)] | None = None
    answer_seconds: Annotated[float, above(0.0, MOST_SECONDS)] = ANSWER_SECONDS
    environment: Mapping[str, Annotated[str, Must("a text")]] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        if self.kind is Kind.IMPORT_PATH and not _IMPORT_PATH.fullmatch(self.agent):
            names = f"{', '.join(SHIPPED)}, module:Class, stdio:COMMAND, remote or remote:AGENT_ID"
            raise FieldError("agent", self.agent, f"must be {names}")
        try:
            shlex.split(self.agent)
        except ValueError as error:
            raise FieldError("agent", self.agent, f"must be a command as a shell would read it ({error})") from None
        if self.options and self.kind not in (Kind.SHIPPED, Kind.IMPORT_PATH):
            allowed = f"must be empty for a {self.kind}: options are a class's arguments"
            raise FieldError("options", dict(self.options), allowed)
        if not self.as_process and (self.memory_mb or self.cores or self.environment):
            raise FieldError("process", self.process, "must be true if memory_mb, cores or environment are given")

    @classmethod
    def of(cls, agent: str, table: Any) -> Self:
        """An entrant's ``agent`` and its table of an event file, or what ``to_dict`` wrote."""
        return cls.from_dict({"agent": agent, **table} if isinstance(table, Mapping) else table)

    @property
    def kind(self) -> Kind:
        """What ``agent`` names."""
        if self.agent.partition(":")[0] in SHIPPED:
            return Kind.SHIPPED
        if _REMOTE.fullmatch(self.agent):
            return Kind.REMOTE
        return Kind.COMMAND if self.agent.startswith(STDIO) else Kind.IMPORT_PATH

    @property
    def as_process(self) -> bool:
        """Whether it gets a process of its own. Code that is not ours always does unless told otherwise."""
        if self.kind is Kind.COMMAND:
            return True
        return self.kind is Kind.IMPORT_PATH if self.process is None else self.process

    @property
    def remote_id(self) -> str | None:
        """The agent's id at the server, when it is given."""
        return self.agent.partition(":")[2] or None if self.kind is Kind.REMOTE else None

    def command(self, seed: int) -> list[str]:
        """The command line of its process (``client.arena.hosted_agents``); ``seed`` is for agents of this package."""
        here = [sys.executable, "-P", "-m", "client.arena.hosted_agents", self.agent]
        return [*here, "--seed", str(seed), "--options", json.dumps(dict(self.options))]
