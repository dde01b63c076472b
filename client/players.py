"""An agent's instances, one a game, and what happens when an agent misbehaves: a line in its log, another
try.
"""

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
            action = self._of(view).choose(view)
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
        """Tell the instance of this game that it has ended, and forget it."""
        try:
            self._of(over.view).game_over(over)
        except Exception:
            log.exception("game %s: game_over raised", over.game)
        self._by_game.pop(over.game, None)

    def _of(self, view: View) -> Agent:
        """The instance for this game."""
        if view.game not in self._by_game:
            agent = self._factory()
            self._by_game[view.game] = agent
            agent.game_started(view)
        return self._by_game[view.game]
