"""The agents a command is told to play with, by name."""

from typing import TYPE_CHECKING

from client.cli.output import USAGE, fail

if TYPE_CHECKING:
    from client.agent import AgentFactory


def load_player(name: str, seed: int | None = None) -> "AgentFactory":
    """What makes the instances of an agent; leaves the command when there is none of this name.

    Modules in the current directory are found too, but last: none of them may stand in for an installed one.
    """
    from client.agents.registry import load
    from client.arena.hosted_agents import find_here
    from client.errors import AgentNotFound

    find_here()
    try:
        return load(name, seed)
    except AgentNotFound as error:
        fail(str(error), USAGE)
