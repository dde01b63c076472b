"""One agent at the table of one game: made, asked, told and counted here, whoever hosts it.

Agents on a server (`client.run`, house bots), seats of events (`client.arena`) and local games (`client.local`) are
all sessions; what differs is what a host does about a bad answer.
"""

import logging
from abc import ABC, abstractmethod
from typing import Final

from client.agent import Agent, AgentFactory
from client.errors import AgentUnstartable, NonsenseAnswer
from client.geometry.aim import looks_like_radians
from client.simulator import Simulator
from physics.errors import shown
from protocol import GameOver, View
from referee import Action, SimulationBudget

log = logging.getLogger("pooliad.agent")
"""Where sessions tell what an agent does wrong; `kind` of a record: raised, nonsense, refused, unstartable, radians."""

AZIMUTHS: Final = 4
"""Strokes after which directions that all lie within a radian circle are doubted. Directions in degrees do so by
chance once in 600,000 times."""


class Session(ABC):
    """A player in a game, wherever its code runs; after the game it may begin the next one.

    Attributes:
        budget: of the shots it simulates itself.
        last: the view it was asked about last in this game; None before.
    """

    def __init__(self) -> None:
        self.begin(SimulationBudget())

    def begin(self, budget: SimulationBudget) -> None:
        """A new game begins, in which `budget` is what may be simulated."""
        self.budget = budget
        self.last: View | None = None
        self._declared = self._doubtful = 0
        self._left: int | None = None

    @abstractmethod
    def ask(self, view: View) -> Action:
        """The answer to a turn.

        Raises:
            AgentUnstartable: there is nobody to be asked, and asking again is in vain.
            client.local_game.Lost: the player is out of this game.
            Exception: a bad answer; the player may be asked again.
        """

    @abstractmethod
    def refused(self, reason: str) -> None:
        """The last answer was not accepted; the turn is asked again. Never raises."""

    @abstractmethod
    def over(self, message: GameOver) -> None:
        """The game has ended. Never raises."""

    def close(self) -> None:  # noqa: B027 - nothing to stop is the right default
        """No game is left to play."""

    @property
    def undeclared(self) -> int:
        """Shots simulated since the last action whose declaration was counted."""
        return self.budget.used - self._declared

    def declared(self, shots: int) -> None:
        """The referee has counted so many more of the shots."""
        self._declared += shots

    def doubted(self, shots: int) -> None:
        """No answer came to a declaration of so many shots: they may have been counted or not."""
        self._doubtful = shots

    def told(self, view: View) -> None:
        """The referee says what is left: it has counted what was declared, and what it simulated for the player."""
        left = None if view.seat is None else view.clocks[view.seat].simulations_left
        if left is not None and self._left is not None and 0 < self._doubtful <= self._left - left:
            self._declared += self._doubtful
        self._doubtful, self._left = 0, left
        self.budget.allowed = None if left is None else self._declared + left


class AgentSession(Session):
    """An agent in this process; every game gets an instance of its own.

    What goes wrong in it is logged with its traceback.

    Args:
        factory: makes the instances.
    """

    def __init__(self, factory: AgentFactory) -> None:
        self._factory = factory
        super().__init__()

    def begin(self, budget: SimulationBudget) -> None:
        """Forget the last game's instance."""
        super().begin(budget)
        self._agent: Agent | None = None
        self._azimuths: list[float] = []

    def make(self) -> Agent:
        """Return this game's instance, made now if it was not before.

        Raises:
            AgentUnstartable: it cannot be made; the cause is what its factory raised.
        """
        if self._agent is None:
            try:
                agent = self._factory()
                agent.simulator = Simulator(self.budget)
            except Exception as error:
                log.error("the agent cannot be made", exc_info=error, extra={"kind": "unstartable"})
                raise AgentUnstartable(f"the agent cannot be made: {type(error).__name__}: {error}") from error
            self._agent = agent
        return self._agent

    def start(self, view: View) -> None:
        """Tell this game's instance that the game starts.

        Raises:
            AgentUnstartable: it cannot be made, or the command behind it cannot be started.
            Exception: what `game_started` raises. The next try has another instance: each is told once.
        """
        agent = self.make()
        try:
            agent.game_started(view)
        except Exception as error:
            self._agent = None
            _tell(view, _kind(error), "game_started raised", error)
            raise
        self.last = view

    def ask(self, view: View) -> Action:
        """What the agent chooses, or raises; what is no action raises `NonsenseAnswer`."""
        if self.last is None:
            self.start(view)
        agent, self.last = self.make(), view
        try:
            action: object = agent.choose(view)
        except Exception as error:
            _tell(view, _kind(error), "choose raised", error)
            raise
        if not isinstance(action, Action):
            words = f"choose returned {shown(action)}: must be a client.Action"
            _tell(view, "nonsense", words)
            raise NonsenseAnswer(words)
        self._doubt_radians(view, action)
        return action

    def refused(self, reason: str) -> None:
        """Log why the last action was not accepted, and tell the agent."""
        if self._agent is None or self.last is None:
            return
        _tell(self.last, "refused", f"refused: {reason}")
        try:
            self._agent.refused(self.last, reason)
        except Exception as error:
            _tell(self.last, "raised", "refused raised", error)

    def over(self, message: GameOver) -> None:
        """Tell the agent, if it was ever asked in this game."""
        if self._agent is None or self.last is None:
            return
        try:
            self._agent.game_over(message)
        except Exception as error:
            _tell(self.last, "raised", "game_over raised", error)

    def _doubt_radians(self, view: View, action: Action) -> None:
        """Say so, once a game, when every azimuth so far looks like radians."""
        if action.shot is None or len(self._azimuths) >= AZIMUTHS:
            return
        self._azimuths.append(action.shot.phi)
        if len(set(self._azimuths)) == AZIMUTHS and all(map(looks_like_radians, self._azimuths)):
            shown = ", ".join(f"{phi:.3g}" for phi in self._azimuths)
            _tell(
                view, "radians", f"phi = {shown}: must be in degrees; these look like radians (math.degrees converts)"
            )


def _kind(error: Exception) -> str:
    return "unstartable" if isinstance(error, AgentUnstartable) else "raised"


def _tell(view: View, kind: str, words: str, error: Exception | None = None) -> None:
    log.log(
        logging.WARNING if kind == "radians" else logging.ERROR,
        "game %s, stroke %d: %s", view.game, view.stroke, words, exc_info=error, extra={"kind": kind},
    )  # fmt: skip


class GameSessions:
    """A player's sessions, one for each game, begun when a game is first seen; a host that does more overrides this."""

    def __init__(self, factory: AgentFactory) -> None:
        self._factory = factory
        self._by_game: dict[str, AgentSession] = {}

    def of(self, view: View) -> Session:
        """The session of this game, which knows what the view says is left to simulate."""
        session = self._by_game.setdefault(view.game, AgentSession(self._factory))
        session.told(view)
        return session

    def over(self, message: GameOver) -> None:
        """Tell the session of this game that it has ended, and forget it; without a turn there is none."""
        session = self._by_game.pop(message.game, None)
        if session is not None:
            session.over(message)

    def failed(self, view: View, error: Exception) -> None:
        """An answer was bad: `ask` raised this, or the action was not accepted. The turn is asked again."""

    def acted(self) -> None:
        """An action was accepted."""
