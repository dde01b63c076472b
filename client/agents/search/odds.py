"""The race's chances as games bear them out.

The race is too sure of itself: the player behind meets easier tables than it reckons with, the player ahead harder
balls. In log-odds games follow it on a straight line, which `benchmarks/search_odds.py` fits by noise and table.
"""

import functools
from dataclasses import dataclass

import numpy as np

from client.agents.search.shots import Floats

SUREST = 1e-4
"""Chances nearer to 0 and 1 than that count as that near."""


@dataclass(frozen=True, slots=True)
class Odds:
    """The shooter's log-odds to win: ``shift`` plus ``scale`` times those of the race.

    Attributes:
        shift: nats. scale: 1 where games bear the race out.
    """

    shift: float
    scale: float

    def of(self, race: Floats) -> Floats:
        """The chances of games for those of the race, (n,)."""
        known = np.clip(race, SUREST, 1.0 - SUREST)
        odds = np.log(known) - np.log1p(-known)
        found: Floats = 1.0 / (1.0 + np.exp(-self.shift - self.scale * odds))
        return found


MEASURED = {
    False: {0.0: Odds(0.0, 1.0), 1.0: Odds(0.0, 1.0), 2.0: Odds(0.471, 0.498), 5.0: Odds(0.214, 0.233)},
    True: {0.0: Odds(0.096, 0.685), 1.0: Odds(0.096, 0.685), 2.0: Odds(0.22, 0.455), 5.0: Odds(0.026, 0.706)},
}
"""By whether the table has jaws, and by level of noise; between two levels they are interpolated. Line
`search_odds-20261130T200637`, seed 101, 10 minutes of processor time; at noise 0 hardly a ball is missed, and what
holds at 1 serves. At noise 1 on a table without jaws the race stands as it is, though 0.359 and 0.571 predict games
better: a player that chose its strokes by them won no more of its games."""


@functools.lru_cache(maxsize=8)
def odds(noise: float, jaws: bool) -> Odds:
    """What games bear out under a level of noise, 0 to 5."""
    measured = MEASURED[jaws]
    levels = sorted(measured)
    shift, scale = (
        float(np.interp(noise, levels, [getattr(measured[level], name) for level in levels]))
        for name in ("shift", "scale")
    )
    return Odds(shift, scale)


AFTER_SAFETIES = {0.0: -1.5, 1.0: -1.5, 2.0: 0.0}
"""Nats that the log-odds of safeties are shifted by on tables without jaws, by level of noise: at noise 1 the 34
safeties of 200 games were reckoned at 0.59 and won 0.18 (line `strength-20261201T010200`). The model knows nothing of
the banks and combinations that the opponent finds."""


def safety_odds(noise: float, jaws: bool) -> Odds:
    """What games bear out of the worth of a safety under a level of noise."""
    levels = sorted(AFTER_SAFETIES)
    shift = 0.0 if jaws else float(np.interp(noise, levels, [AFTER_SAFETIES[level] for level in levels]))
    return Odds(shift, 1.0)
