"""How an entrant is run: as part of the worker, as a process under limits, or by somebody else at the server."""

import json
import re
import shlex
import sys
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field, fields
from enum import StrEnum
from typing import Any, Self

from client.agents.registry import SHIPPED, STDIO
from client.arena.directory import EventError
from physics.errors import shown

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


@dataclass(frozen=True, slots=True)
class Hosting:
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

    agent: str
    options: Mapping[str, Any] = field(default_factory=dict, hash=False)
    process: bool | None = None
    memory_mb: int | None = None
    cores: int | None = None
    answer_seconds: float = ANSWER_SECONDS
    environment: Mapping[str, str] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        _check_numbers(self)
        _check_mappings(self)
        if self.process not in (None, True, False):
            _fail("process", self.process, "true or false")
        if self.options and self.kind not in (Kind.SHIPPED, Kind.IMPORT_PATH):
            _fail("options", dict(self.options), f"none for a {self.kind}: options are a class's arguments")
        if not self.as_process and (self.memory_mb or self.cores or self.environment):
            _fail("process", self.process, "true, if memory_mb, cores or environment are given")

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

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return asdict(self) | {"options": dict(self.options), "environment": dict(self.environment)}

    @classmethod
    def from_dict(cls, agent: str, data: Any) -> Self:
        """Read an entrant's table of an event file, or what ``to_dict`` wrote."""
        known = {each.name for each in fields(cls)} - {"agent"}
        if not isinstance(data, Mapping) or not set(data) - {"agent"} <= known:
            _fail("hosting", data, f"a table with {', '.join(sorted(known))}")
        values = {"agent": agent, **data}
        if not isinstance(values["agent"], str):
            _fail("agent", values["agent"], "a text")
        return cls(**values)


def _check_numbers(hosting: Hosting) -> None:
    bounds = {"memory_mb": MOST_MEMORY_MB, "cores": MOST_CORES}
    for name, most in bounds.items():
        value = getattr(hosting, name)
        if value is not None and (isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= most):
            _fail(name, value, f"an integer in [1, {most}]")
    seconds = hosting.answer_seconds
    if isinstance(seconds, bool) or not isinstance(seconds, int | float) or not 0.0 < seconds <= 86_400.0:
        _fail("answer_seconds", seconds, "a number in (0, 86400]")


def _check_mappings(hosting: Hosting) -> None:
    if hosting.kind is Kind.IMPORT_PATH and not _IMPORT_PATH.fullmatch(hosting.agent):
        allowed = f"{', '.join(SHIPPED)}, module:Class, stdio:COMMAND, remote or remote:AGENT_ID"
        _fail("agent", hosting.agent, allowed)
    try:
        shlex.split(hosting.agent)
    except ValueError as error:
        _fail("agent", hosting.agent, f"a command as a shell would read it ({error})")
    for name in ("options", "environment"):
        if not isinstance(getattr(hosting, name), Mapping):
            _fail(name, getattr(hosting, name), "a table")
    if not all(isinstance(each, str) for each in hosting.environment.values()):
        _fail("environment", dict(hosting.environment), "a table of texts")


def _fail(name: str, value: Any, allowed: str) -> None:
    raise EventError(f"hosting.{name} = {shown(value)}: {allowed}")
