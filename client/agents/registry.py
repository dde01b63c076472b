"""Agents by name: the shipped ones, and anybody's as `module:Class`."""

import importlib
from functools import partial
from typing import Any

from client.agent import Agent, AgentFactory
from client.errors import AgentNotFound

SHIPPED = {
    "random": "client.agents.random_agent:RandomAgent",
    "greedy": "client.agents.greedy:GreedyAgent",
}
"""Name to import path. The classes are imported when asked for: `greedy` needs the compiled physics."""


Player = AgentFactory | str
"""An `Agent` class, a function that makes agents, or a name: `random`, `greedy`, `module:Class`."""


def factory_of(player: Player, seed: int | None = None) -> AgentFactory:
    """What makes the player's instances; raises `AgentNotFound` for a name that leads nowhere."""
    return load(player, seed) if isinstance(player, str) else player


def load(name: str, seed: int | None = None) -> AgentFactory:
    """A function that makes instances of the agent called `name`.

    Args:
        name: of a shipped agent, or `module:Class` with the module on the import path.
        seed: makes a shipped agent repeat its choices; other agents keep their own randomness.

    Raises:
        AgentNotFound: no such name, module or class, or the class is no `client.Agent`.
    """
    if name in SHIPPED:
        return partial(_class_at(SHIPPED[name]), seed=seed)
    factory: AgentFactory = _class_at(name)
    return factory


def titles(first: str, second: str) -> tuple[str, str]:
    """What to call two players in a match: their names or class names, numbered when they are the same."""
    one, other = first.rpartition(":")[2], second.rpartition(":")[2]
    return (one, other) if one != other else (f"{one}-1", f"{other}-2")


def _class_at(path: str) -> Any:
    """The agent class at an import path."""
    module, _, attribute = path.partition(":")
    if not module or not attribute:
        raise AgentNotFound(f"there is no agent {path!r}; shipped are {sorted(SHIPPED)}, others go by module:Class")
    try:
        found = getattr(importlib.import_module(module), attribute)
    except (ImportError, AttributeError) as error:
        raise AgentNotFound(f"agent {path!r} cannot be imported: {error}") from error
    if not (isinstance(found, type) and issubclass(found, Agent)):
        raise AgentNotFound(f"agent {path!r} is {found!r}, which is no subclass of client.Agent")
    return found
