"""Agents by name: the shipped ones, anybody's as `module:Class`, and in any language as `stdio:COMMAND`."""

import importlib
import re
import shlex
import shutil
from functools import partial
from pathlib import Path
from typing import Any

from client.agent import Agent, AgentFactory
from client.errors import AgentNotFound

SHIPPED = {
    "random": "client.agents.random_agent:RandomAgent",
    "greedy": "client.agents.greedy:GreedyAgent",
    "search": "client.agents.search:SearchAgent",
}
"""Name to import path. The classes are imported when asked for: `greedy` and `search` need the compiled physics."""


Player = AgentFactory | str
"""An `Agent` class, a function that makes agents, or a name: `search:seconds=0.3`, `module:Class`, `stdio:COMMAND`."""

STDIO = "stdio:"
"""What the name of an agent starts with that is a command: `stdio:perl my_agent.pl`, split as a shell does."""


def factory_of(player: Player, seed: int | None = None) -> AgentFactory:
    """What makes the player's instances; raises `AgentNotFound` for a name that leads nowhere."""
    return load(player, seed) if isinstance(player, str) else player


def load(name: str, seed: int | None = None) -> AgentFactory:
    """A function that makes instances of the agent called `name`.

    Args:
        name: of a shipped agent, with options if it has any (`search:seconds=0.3,safeties=off`), `module:Class`
            with the module on the import path, or `stdio:COMMAND`.
        seed: makes a shipped agent repeat its choices; other agents keep their own randomness.

    Raises:
        AgentNotFound: no such name, option, module, class or program, or the class is no `client.Agent`.
    """
    shipped, _, options = name.partition(":")
    if shipped in SHIPPED:
        return _with_options(name, partial(_class_at(SHIPPED[shipped]), seed=seed, **options_of(name, options)))
    if name.startswith(STDIO):
        return _command(name)
    factory: AgentFactory = _class_at(name)
    return factory


def titles(first: str, second: str) -> tuple[str, str]:
    """What to call two players in a match: their names or class names, numbered when they are the same."""
    one, other = _title(first), _title(second)
    return (one, other) if one != other else (f"{one}-1", f"{other}-2")


def _title(name: str) -> str:
    """A shipped agent's name with its options, another's class, a command's last word that is no option."""
    if name.partition(":")[0] in SHIPPED:
        return _allowed(name)
    if not name.startswith(STDIO):
        return name.rpartition(":")[2]
    words = [word for word in name.removeprefix(STDIO).split() if not word.startswith("-")]
    return _allowed(Path(words[-1]).name if words else "") or "command"


def _allowed(title: str) -> str:
    """A title in the letters that servers allow in names."""
    return re.sub(r"[^A-Za-z0-9 _.-]", "-", title).lstrip(" _.-")[:60]


def options_of(name: str, text: str) -> dict[str, bool | int | float | str]:
    """The options of an agent's name: `seconds=0.3,safeties=off` as values by option.

    Raises:
        AgentNotFound: the text is not of this form.
    """
    pairs = [pair.partition("=") for pair in text.split(",")] if text else []
    for option, equals, value in pairs:
        if not (option and equals and value):
            raise AgentNotFound(f"agent {name!r}: options go as name:option=value,option=value")
    return {option: _value(value) for option, _, value in pairs}


def _value(text: str) -> bool | int | float | str:
    """What an option's text means: on, off, a number, or itself."""
    if text in ("on", "off"):
        return text == "on"
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def _with_options(name: str, factory: AgentFactory) -> AgentFactory:
    """The factory, once it has shown that it can make an agent with these options."""
    try:
        factory()
    except (TypeError, ValueError) as error:
        raise AgentNotFound(f"agent {name!r}: {error}") from error
    return factory


def _command(name: str) -> AgentFactory:
    """What starts a command for every game."""
    from client.adapters.stdio import StdioAgent

    try:
        command = shlex.split(name.removeprefix(STDIO))
    except ValueError as error:
        raise AgentNotFound(f"agent {name!r} is no command: {error}") from None
    if not command:
        raise AgentNotFound(f"agent {name!r} names no command; it goes like stdio:perl my_agent.pl")
    if shutil.which(command[0]) is None:
        raise AgentNotFound(f"agent {name!r}: {command[0]!r} is no program that can be run here")
    return partial(StdioAgent, command)


def _class_at(path: str) -> Any:
    """The agent class at an import path."""
    module, _, attribute = path.partition(":")
    if not module or not attribute:
        raise AgentNotFound(
            f"there is no agent {path!r}; shipped are {sorted(SHIPPED)}, others are module:Class or stdio:COMMAND"
        )
    try:
        found = getattr(importlib.import_module(module), attribute)
    except (ImportError, AttributeError) as error:
        raise AgentNotFound(f"agent {path!r} cannot be imported: {error}") from error
    if not (isinstance(found, type) and issubclass(found, Agent)):
        raise AgentNotFound(f"agent {path!r} is {found!r}, which is no subclass of client.Agent")
    return found
