"""An agent's instances, one a game; when one misbehaves, its log says how, and it is asked again."""

import logging
from dataclasses import dataclass, field

from client.agent import Agent, AgentFactory
from client.simulator import Simulator
from protocol import GameOver, View
from referee import Action, SimulationBudget

log = logging.getLogger("pooliad.agent")


class Instance:
    """One instance of an agent at the table of one game, made when it is asked first; what it raises is its host's.

    Args:
        factory: makes it.
        budget: of its simulator.
    """

    def __init__(self, factory: AgentFactory, budget: SimulationBudget) -> None:
        self._factory = factory
        self._agent: Agent | None = None
        self.budget = budget
        self.last: View | None = None

    def choose(self, view: View) -> Action:
        """Its answer to a turn."""
        if self._agent is None:
            agent = self._factory()
            agent.simulator = Simulator(self.budget)
            agent.game_started(view)
            self._agent = agent
        self.last = view
        return self._agent.choose(view)

    def refused(self, reason: str) -> None:
        """Tell it why its last action was not accepted."""
        if self._agent is not None and self.last is not None:
            self._agent.refused(self.last, reason)

    def game_over(self, over: GameOver) -> None:
        """Tell it how the game ended, if it was ever asked."""
        if self._agent is not None:
            self._agent.game_over(over)


@dataclass(slots=True)
class Honour:
    """What one instance simulates by itself in a game on a server: counted here, declared with its next action.

    Attributes:
        declared: how many of the simulated shots the server knows of.
    """

    budget: SimulationBudget = field(default_factory=SimulationBudget)
    declared: int = 0

    @property
    def undeclared(self) -> int:
        """Shots simulated since the last action that was accepted."""
        return self.budget.used - self.declared

    def told(self, view: View) -> None:
        """The server says what is left: it has counted what was declared, and what it simulated itself."""
        left = None if view.seat is None else view.clocks[view.seat].simulations_left
        self.budget.allowed = None if left is None else self.declared + left


class Players:
    """The instances of one agent, by game, created when a game is first seen.

    No exception of the agent's code leaves this class; each is logged with its traceback.
    """

    def __init__(self, factory: AgentFactory) -> None:
        self._factory = factory
        self._by_game: dict[str, Instance] = {}
        self._by_honour: dict[str, Honour] = {}

    def choose(self, view: View) -> Action | None:
        """The agent's action; None when it raised or returned something else, which is logged."""
        try:
            action: object = self._of(view).choose(view)
        except Exception:
            log.exception("game %s, stroke %d: choose raised", view.game, view.stroke)
            return None
        if isinstance(action, Action):
            return action
        log.error(
            "game %s, stroke %d: choose returned %r, which is no client.Action",
            view.game,
            view.stroke,
            action,
        )
        return None

    def simulated(self, game: str) -> int:
        """Shots that the game's instance simulated and has not declared yet."""
        return self._by_honour[game].undeclared

    def declared(self, game: str, shots: int) -> None:
        """The server has counted so many of them."""
        self._by_honour[game].declared += shots

    def refused(self, view: View, reason: object) -> None:
        """Log why an action was not accepted, and tell the instance."""
        log.error("game %s, stroke %d: refused: %s", view.game, view.stroke, reason)
        try:
            self._of(view).refused(str(reason))
        except Exception:
            log.exception("game %s: refused raised", view.game)

    def game_over(self, over: GameOver) -> None:
        """Tell the instance of this game that it has ended, and forget it; without a turn there is none."""
        instance = self._by_game.pop(over.game, None)
        self._by_honour.pop(over.game, None)
        if instance is None:
            return
        try:
            instance.game_over(over)
        except Exception:
            log.exception("game %s: game_over raised", over.game)

    def _of(self, view: View) -> Instance:
        """The instance for this game."""
        honour = self._by_honour.setdefault(view.game, Honour())
        honour.told(view)
        return self._by_game.setdefault(view.game, Instance(self._factory, honour.budget))
