"""How much may be simulated for one stroke: a fixed number of shots, or what fits into some seconds."""

import time
from collections.abc import Callable

from client.agents.search.options import LEAST_SECONDS, Options

GUESS = 30_000.0
"""Simulated shots a second, all work around them included, before anything was measured."""
SMOOTHING = 0.3
"""Weight of the latest stroke in the measured speed."""


SHARE = 0.06
"""Of what is left on the clock, or in the simulation budget, for one stroke: a game seldom takes a player more than
sixteen strokes, and however many it takes something is always left."""
RESERVE = 0.5
"""s of the clock that thinking does not touch: requests take time too."""


def allowance(options: Options, seconds_left: float | None, shots_left: int | None) -> tuple[float, int]:
    """Seconds and shots for one turn; 0 shots stand for as many as fit into the seconds.

    Args:
        seconds_left: on the player's clock; None without one.
        shots_left: in the simulation budget of the game; None without one.
    """
    seconds, shots = options.seconds, int(options.shots)
    if seconds_left is not None:
        fair = max(LEAST_SECONDS, SHARE * (seconds_left - RESERVE))
        seconds, shots = min(seconds, fair), 0 if fair < options.seconds else shots
    if shots_left is not None:
        fair_shots = max(1, int(SHARE * shots_left))
        shots = min(shots, fair_shots) if shots else fair_shots
    return seconds, shots


class Pace:
    """How many shots a second this agent gets through, learnt from stroke to stroke."""

    def __init__(self) -> None:
        self.per_second = GUESS

    def learn(self, simulated: int, seconds: float) -> None:
        """One stroke took so many shots and seconds."""
        if seconds > 0.0 and simulated > 0:
            self.per_second += SMOOTHING * (simulated / seconds - self.per_second)


class Budget:
    """What one stroke may cost.

    Args:
        shots: how many may be simulated; the choice then depends on nothing else. 0: as many as the seconds allow.
        seconds: or the time to think; `clock` (s) says how much of it has passed, `pace` how far it goes.
    """

    def __init__(
        self,
        pace: Pace,
        shots: int = 0,
        seconds: float = 1.0,
        clock: Callable[[], float] = time.perf_counter,
    ) -> None:
        self._pace, self._seconds, self._clock = pace, seconds, clock
        self._shots = shots
        self._started = clock()
        self.simulated = 0

    @property
    def total(self) -> int:
        """Shots that may be simulated in all, as far as that is known."""
        return self._shots or int(self._seconds * self._pace.per_second)

    @property
    def spent(self) -> float:
        """The share of the budget that is used up; 1 and more when it is gone."""
        if self._shots:
            return self.simulated / self._shots
        return (self._clock() - self._started) / max(1e-9, self._seconds)

    def charge(self, shots: int) -> None:
        """So many shots were simulated."""
        self.simulated += shots

    def close(self) -> None:
        """The stroke is chosen: the pace is learnt from it."""
        if not self._shots:
            self._pace.learn(self.simulated, self._clock() - self._started)
