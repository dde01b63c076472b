"""An agent's instances, one a game; when one misbehaves, its log says how, and it is asked again."""

import logging

from client.agent import Agent, AgentFactory
from referee import Action
from referee.wire import GameOver, View

log = logging.getLogger("pooliad.agent")


class Players:
    """The instances of one agent, by game, created when a game is first seen.

    No exception of the agent's code leaves this class; each is logged with its traceback.
    """

    def __init__(self, factory: AgentFactory) -> None:
        self._factory = factory
        self._by_game: dict[str, Agent] = {}

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

    def refused(self, view: View, reason: object) -> None:
        """Log why an action was not accepted."""
        log.error("game %s, stroke %d: refused: %s", view.game, view.stroke, reason)

    def game_over(self, over: GameOver) -> None:
        """Tell the instance of this game that it has ended, and forget it; without a turn there is none."""
        agent = self._by_game.pop(over.game, None)
        if agent is None:
            return
        try:
            agent.game_over(over)
        except Exception:
            log.exception("game %s: game_over raised", over.game)

    def _of(self, view: View) -> Agent:
        """The instance for this game."""
        if view.game not in self._by_game:
            agent = self._factory()
            agent.game_started(view)
            self._by_game[view.game] = agent
        return self._by_game[view.game]
