"""The terms of a match that views repeat: noise and clock."""

from typing import Annotated, Literal, Self

from pydantic import Field

from protocol.values import Flag, Integer, Message, Number, Request
from referee.play.clock import LEAST_SECONDS, MOST_SECONDS
from referee.play.noise import LEVEL_MAX, OLYMPIAD_SIGMAS, SIGMA_MAX, NoiseModel, Sigmas

SIMULATIONS_MAX = 1_000_000_000
"""Simulated shots a player and game: days of one core, and far below what a column holds."""


class SigmaTerms(Request):
    """Standard deviations of a shot's parameters at level 1.

    Attributes:
        v: m/s. phi, theta: deg. a, b: mm. Those left out are the Olympiad's.
    """

    v: Annotated[Number, Field(ge=0, le=SIGMA_MAX["v"])] = OLYMPIAD_SIGMAS.v
    phi: Annotated[Number, Field(ge=0, le=SIGMA_MAX["phi"])] = OLYMPIAD_SIGMAS.phi
    theta: Annotated[Number, Field(ge=0, le=SIGMA_MAX["theta"])] = OLYMPIAD_SIGMAS.theta
    a: Annotated[Number, Field(ge=0, le=SIGMA_MAX["a"])] = OLYMPIAD_SIGMAS.a
    b: Annotated[Number, Field(ge=0, le=SIGMA_MAX["b"])] = OLYMPIAD_SIGMAS.b


Others = Annotated[SigmaTerms | None, Field(exclude_if=lambda sigmas: sigmas is None)]
"""Standard deviations other than the Olympiad's; else left out."""


class NoiseTerms(Request):
    """Execution noise of a match.

    Attributes:
        level: factor on the standard deviations; 1 is the standard, 0 leaves every bit of a shot.
        told: whether the players are told the level.
        sigmas: the standard deviations where they are not the Olympiad's.
    """

    level: Annotated[Number, Field(ge=0, le=LEVEL_MAX)] = 1.0
    told: Flag = True
    sigmas: Others = None

    @classmethod
    def of(cls, noise: NoiseModel) -> Self:
        """The wire's form of a noise."""
        return cls(level=noise.level, told=noise.told, sigmas=_terms(noise))

    def model(self) -> NoiseModel:
        """The noise itself."""
        sigmas = OLYMPIAD_SIGMAS if self.sigmas is None else Sigmas(**self.sigmas.model_dump())
        return NoiseModel(self.level, self.told, sigmas)


class ClockTerms(Request):
    """Thinking time, and what may be simulated in it.

    Attributes:
        seconds: for each player and game.
        simulations: shots that each player may simulate in a game; null for any number.
    """

    seconds: Annotated[Number, Field(ge=LEAST_SECONDS, le=MOST_SECONDS)] = 300.0
    simulations: Annotated[Integer, Field(ge=0, le=SIMULATIONS_MAX)] | None = None


class NoiseView(Message):
    """The noise as a view tells it: the level is null when the players are not told.

    Attributes:
        told: whether the players know. level: factor on the standard deviations.
        sigmas: these, where they are known and not the Olympiad's; else left out.
    """

    told: bool
    level: Number | None
    sigmas: Others = None

    @classmethod
    def of(cls, noise: NoiseModel, known: bool) -> "NoiseView":
        """What may be known of a noise."""
        return cls(told=noise.told, level=noise.level if known else None, sigmas=_terms(noise) if known else None)

    def model(self, level: float) -> NoiseModel:
        """The noise as a player reckons with it; ``level``: where it is not told."""
        sigmas = OLYMPIAD_SIGMAS if self.sigmas is None else Sigmas(**self.sigmas.model_dump())
        return NoiseModel(level if self.level is None else self.level, self.told, sigmas)


def _terms(noise: NoiseModel) -> SigmaTerms | None:
    return None if noise.others is None else SigmaTerms(**noise.others.to_dict())


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
