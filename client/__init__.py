"""Play pool against a referee: the SDK for a Pooliad server, agents, local matches, and the `pooliad`
command.

`Pooliad` and `AsyncPooliad` speak the protocol, `Agent` is what a player writes, `run_agent` plays it on a
server and `play` without one. Names are loaded when first used, so that importing this package is quick.
"""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from client.agent import Agent, AgentFactory
    from client.agents.registry import load
    from client.aio import AsyncPooliad
    from client.errors import PooliadError
    from client.http import Pooliad
    from client.local import LocalMatch, play
    from client.retry import Retry
    from client.run import run_agent, serve_agent
    from client.simulator import Simulator
    from client.sparring import spar
    from protocol import GameOver, MatchRequest, View
    from referee import SAFETY, Action, BudgetSpent, Call, Decision

__all__ = [
    "SAFETY",
    "Action",
    "Agent",
    "AgentFactory",
    "AsyncPooliad",
    "BudgetSpent",
    "Call",
    "Decision",
    "GameOver",
    "LocalMatch",
    "MatchRequest",
    "Pooliad",
    "PooliadError",
    "Retry",
    "Simulator",
    "View",
    "load",
    "play",
    "run_agent",
    "serve_agent",
    "spar",
]

_HOMES = {
    "Agent": "client.agent",
    "AgentFactory": "client.agent",
    "load": "client.agents.registry",
    "AsyncPooliad": "client.aio",
    "PooliadError": "client.errors",
    "Pooliad": "client.http",
    "LocalMatch": "client.local",
    "play": "client.local",
    "Retry": "client.retry",
    "run_agent": "client.run",
    "serve_agent": "client.run",
    "spar": "client.sparring",
    "Simulator": "client.simulator",
    "SAFETY": "referee",
    "Action": "referee",
    "BudgetSpent": "referee",
    "Call": "referee",
    "Decision": "referee",
    "GameOver": "protocol",
    "MatchRequest": "protocol",
    "View": "protocol",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'client' has no attribute {name!r}; it exports {', '.join(__all__)}")
    return getattr(importlib.import_module(_HOMES[name]), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
