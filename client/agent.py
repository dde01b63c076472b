"""What a player writes: one method that looks at a view and answers with an action."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property

from client.simulator import Simulator
from protocol import GameOver, View
from referee import Action


class Agent(ABC):
    """A pool-playing program. Every game gets an instance of its own, so attributes are one game's memory.

    An exception in `choose`, or an action that the referee refuses, costs nothing but time: it is logged, and
    `choose` is asked again until the player's clock has run out.
    """

    @cached_property
    def simulator(self) -> Simulator:
        """The physics, counted against the game's simulation budget; whoever runs the agent sets it.

        In an agent that nobody runs it simulates as much as it likes.
        """
        return Simulator()

    @abstractmethod
    def choose(self, view: View) -> Action:
        """Answer a turn: a stroke with its call, or a decision.

        `view` holds everything the player may know; `view.state` and `view.table_model()` are what the
        physics takes.
        """

    def game_started(self, view: View) -> None:  # noqa: B027 - a hook: doing nothing is the right default
        """Called once before the first `choose` of a game."""

    def refused(self, view: View, reason: str) -> None:  # noqa: B027 - a hook: doing nothing is the right default
        """Called when an action was not accepted, before `choose` is asked again; the clock runs on."""

    def game_over(self, over: GameOver) -> None:  # noqa: B027 - a hook: doing nothing is the right default
        """Called once when the game has ended, if this agent ever was at the table in it."""


AgentFactory = Callable[[], Agent]
"""Makes one instance; an `Agent` class is such a factory."""
