"""Who sits at a table of the arena: something that can be asked, and can fail in its own ways."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Protocol

from client.agent import AgentFactory
from client.agents.registry import load
from client.arena.hosting import Hosting, Kind
from client.arena.process import ProcessSeat
from client.players import Instance
from protocol import GameOver, View
from referee import Action, SimulationBudget


class Seat(Protocol):
    """A player for the games of a pair."""

    def begin(self, budget: SimulationBudget) -> None:
        """A new game begins, in which so many shots may be simulated."""

    def ask(self, view: View, seconds: float | None) -> Action:
        """The answer to a turn; ``seconds`` is what the clock has left, None without one.

        Raises:
            client.local_game.Lost: the player is out of the game.
            Exception: a bad answer; it may be asked again.
        """

    def refused(self, reason: str) -> None:
        """The last answer was an action that the referee does not accept; the turn is asked again."""

    def over(self, message: GameOver) -> None:
        """The game has ended."""

    def close(self) -> None:
        """No game is left to play."""


class InlineSeat:
    """An agent inside this process: fast, and trusted to come back from ``choose``."""

    def __init__(self, factory: AgentFactory) -> None:
        self._factory = factory
        self._instance = Instance(factory, SimulationBudget())

    def begin(self, budget: SimulationBudget) -> None:
        """Forget the last game's instance."""
        self._instance = Instance(self._factory, budget)

    def ask(self, view: View, _seconds: float | None) -> Action:
        """What the agent chooses."""
        return self._instance.choose(view)

    def refused(self, reason: str) -> None:
        """Tell the agent."""
        self._instance.refused(reason)

    def over(self, message: GameOver) -> None:
        """Tell the agent, if it was ever asked."""
        self._instance.game_over(message)

    def close(self) -> None:
        """Nothing to stop."""


def seat_of(hosting: Hosting, seed: int, log: Path | None, tell: Callable[[str], None]) -> Seat:
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
    return InlineSeat(partial(load(hosting.agent, seed), **hosting.options))
