"""The terms of a match that views repeat: noise and clock."""

from typing import Annotated, Literal

from pydantic import Field

from protocol.values import Flag, Integer, Message, Number, Request
from referee.play.clock import LEAST_SECONDS, MOST_SECONDS
from referee.play.noise import LEVEL_MAX

SIMULATIONS_MAX = 1_000_000_000
"""Simulated shots a player and game: days of one core, and far below what a column holds."""


class NoiseTerms(Request):
    """Execution noise of a match.

    Attributes:
        level: factor on the Olympiad's sigmas; 1 is the standard, 0 leaves every bit of a shot.
        told: whether the players are told the level.
    """

    level: Annotated[Number, Field(ge=0, le=LEVEL_MAX)] = 1.0
    told: Flag = True


class ClockTerms(Request):
    """Thinking time, and what may be simulated in it.

    Attributes:
        seconds: for each player and game.
        simulations: shots that each player may simulate in a game; null for any number.
    """

    seconds: Annotated[Number, Field(ge=LEAST_SECONDS, le=MOST_SECONDS)] = 300.0
    simulations: Annotated[Integer, Field(ge=0, le=SIMULATIONS_MAX)] | None = None


class NoiseView(Message):
    """The noise as a view tells it: the level is null when the players are not told."""

    told: bool
    level: Number | None

    @classmethod
    def of(cls, terms: NoiseTerms) -> "NoiseView":
        """What the players may know of these terms."""
        return cls(told=terms.told, level=terms.level if terms.told else None)


class BudgetView(Message):
    """The simulation budget of a game.

    Attributes:
        simulations: shots that each player may simulate.
        counted: ``by_driver`` in a local game, where the agent's own simulator counts; ``by_honour`` on a server, which
            counts what it simulates itself and believes what players declare.
    """

    simulations: Integer
    counted: Literal["by_driver", "by_honour"]


class ClockView(Message):
    """A player's clock.

    Attributes:
        seconds_left: s; null in a game without clocks.
        running: whether it is running now.
        simulations_left: shots that may still be simulated; null without a budget.
    """

    seconds_left: Number | None
    running: bool
    simulations_left: Integer | None = None
