"""How much may be simulated for one stroke: a fixed number of shots, or what fits into some seconds."""

import math
import time
from collections.abc import Callable

from client.agents.search.options import LEAST_SECONDS, MOST_SHOTS, Options

GUESS = 60_000.0
"""Simulated shots a second, all work around them included, before anything was measured."""
TELLING = 1000
"""Simulated shots of a stroke from which on they tell how fast this one goes."""
SMOOTHING = 0.3
"""Weight of the latest stroke in the measured speed."""
SHARE = 0.06
"""Of what is left on the clock, or in the simulation budget, for one stroke: a game seldom takes a player more than
sixteen strokes, and however many it takes something is always left."""
RESERVE = 0.5
"""s of the clock that thinking does not touch: requests take time too."""


def allowance(options: Options, seconds_left: float | None, shots_left: int | None) -> tuple[float, int]:
    """Seconds (infinite where only shots count) and shots (0 for any number) for one turn.

    Args:
        seconds_left: on the player's clock; None without one.
        shots_left: in the simulation budget of the game; None without one.
    """
    seconds, shots = math.inf if options.shots else options.seconds, options.shots
    if seconds_left is not None:
        seconds = min(seconds, max(LEAST_SECONDS, SHARE * (seconds_left - RESERVE)))
    if shots_left is not None:
        fair = max(1, int(SHARE * shots_left))
        shots = min(shots, fair) if shots else fair
    return seconds, shots


class TimeUp(Exception):
    """The seconds of a stroke have passed: what was found until then is played."""


class Pace:
    """How many shots a second this agent gets through, learnt from stroke to stroke."""

    def __init__(self) -> None:
        self.per_second = GUESS

    def learn(self, simulated: int, seconds: float) -> None:
        """One stroke took so many shots and seconds."""
        if seconds > 0.0 and simulated > 0:
            self.per_second += SMOOTHING * (simulated / seconds - self.per_second)


class Budget:
    """What one stroke may cost: shots, seconds, or both, whichever is spent first.

    Args:
        shots: how many may be simulated, 0 for any number. Without seconds, the choice depends on nothing else.
        seconds: how long it may take, infinity for any time; `clock` (s) says how much of it has passed, `pace` how far
            it goes.
    """

    def __init__(
        self,
        pace: Pace,
        shots: int = 0,
        seconds: float = math.inf,
        clock: Callable[[], float] = time.perf_counter,
    ) -> None:
        self._pace, self._clock = pace, clock
        self._shots, self._seconds = shots or math.inf, seconds
        self._started = clock()
        self.simulated = 0

    @property
    def total(self) -> int:
        """Shots that may be simulated in all, as far as that is known."""
        return int(min(self._shots, self._seconds * self._per_second, MOST_SHOTS))

    @property
    def _per_second(self) -> float:
        """How fast it goes: as seen in this stroke once that tells, before as in the strokes before."""
        passed = self._clock() - self._started if self.is_timed and self.simulated >= TELLING else 0.0
        return self.simulated / passed if passed > 0.0 else self._pace.per_second

    @property
    def spent(self) -> float:
        """The share of the budget that is used up; 1 and more when it is gone."""
        by_time = (self._clock() - self._started) / self._seconds if self.is_timed else 0.0
        return max(by_time, self.simulated / self._shots)

    @property
    def is_timed(self) -> bool:
        """Whether seconds count."""
        return self._seconds < math.inf

    def charge(self, shots: int) -> None:
        """So many shots were simulated."""
        self.simulated += shots

    def close(self) -> None:
        """The stroke is chosen: the pace is learnt from it."""
        if self.is_timed:
            self._pace.learn(self.simulated, self._clock() - self._started)
