"""The value of a position: who wins the race, given how hard both layouts are and what the shooter faces now.

The game as a Markov chain. Either player needs some number of *perfect balls*: the balls of the group and the 8, each
weighed by how hard it lies. A shooter with a pot of chance p makes it and goes on, or misses and the opponent comes to
the table; or plays safe. What chance the next shot has after a pot, a miss, a safety or a foul is a typical
distribution, measured in games of this agent (`benchmarks/search_habits.py`). The chain's values are the fixed point.
"""

import functools
from dataclasses import dataclass

import numpy as np

from client.agents.search.shots import HIDDEN, MADE, MISSED, SAFE, Floats

MOST = 24
"""Perfect balls beyond which it makes no difference."""
ROUNDS = 200
"""Of the fixed point's iteration; the values change by less than 1e-9 long before."""

Mixture = tuple[tuple[float, float], ...]
"""Chances of a shot with their shares."""


@dataclass(frozen=True, slots=True)
class Habits:
    """What happens typically under one level of noise.

    Attributes:
        after_pot: chance of the next shot of a player who goes on.
        after_miss, after_safety: chance of the first shot of a player who comes to the table, with shares.
        in_hand: likewise with the cue ball in hand.
        foul_on_miss, foul_on_safety, foul_when_hidden: shares of fouls; hidden: no ball can be struck straight.
    """

    after_pot: float
    after_miss: Mixture
    after_safety: Mixture
    in_hand: float
    foul_on_miss: float
    foul_on_safety: float
    foul_when_hidden: float


MEASURED = {
    0.0: Habits(0.99, ((0.95, 0.85), (0.1, 0.15)), ((0.8, 0.4), (0.0, 0.6)), 0.99, 0.05, 0.02, 0.2),
    1.0: Habits(0.96, ((0.95, 0.67), (0.16, 0.33)), ((0.83, 0.25), (0.09, 0.75)), 0.97, 0.3, 0.25, 0.33),
    5.0: Habits(0.52, ((0.8, 0.2), (0.26, 0.8)), ((0.9, 0.13), (0.13, 0.87)), 0.94, 0.14, 0.13, 0.2),
}
"""By level of noise; between two levels they are interpolated. Level 5 is from line `search_habits-20261122T031911`;
level 1 from more games of an earlier version, with which that line agrees; at 0 nothing is missed, and they hardly
matter."""


@functools.lru_cache(maxsize=8)
def race(noise: float) -> "Race":
    """The chain under a level of noise, 0 to 5."""
    return Race(habits(noise))


def habits(noise: float) -> Habits:
    """What happens typically under a level of noise."""
    levels = sorted(MEASURED)
    high = next(level for level in levels if level >= noise)
    low = max((level for level in levels if level <= noise), default=high)
    share = 0.0 if high == low else (noise - low) / (high - low)
    return _between(MEASURED[low], MEASURED[high], share)


def _between(low: Habits, high: Habits, share: float) -> Habits:
    def mixed(one: Mixture, other: Mixture) -> Mixture:
        return tuple((p + share * (q - p), a + share * (b - a)) for (p, a), (q, b) in zip(one, other, strict=True))

    def number(one: float, other: float) -> float:
        return one + share * (other - one)

    return Habits(
        number(low.after_pot, high.after_pot),
        mixed(low.after_miss, high.after_miss),
        mixed(low.after_safety, high.after_safety),
        number(low.in_hand, high.in_hand),
        number(low.foul_on_miss, high.foul_on_miss),
        number(low.foul_on_safety, high.foul_on_safety),
        number(low.foul_when_hidden, high.foul_when_hidden),
    )


class Race:
    """The chain's values as tables over (balls the shooter needs, balls the opponent needs).

    Attributes:
        values: (4, MOST + 1, MOST + 1), MADE and its fellows, looked up by `compiled.worths.shooter`.
    """

    def __init__(self, habits: Habits) -> None:
        self.habits = habits
        self.values: Floats = np.full((4, MOST + 1, MOST + 1), 0.5)
        self.values[MADE, 0] = 1.0
        for _ in range(ROUNDS):
            self._iterate()

    def _iterate(self) -> None:
        """One round: the values from those of the round before."""
        one = self.habits
        against_miss = 1.0 - self._mixed(one.after_miss).T
        against_safety = 1.0 - self._mixed(one.after_safety).T
        against_foul = 1.0 - self._facing(one.in_hand).T
        self.values[MISSED] = (1.0 - one.foul_on_miss) * against_miss + one.foul_on_miss * against_foul
        self.values[SAFE] = (1.0 - one.foul_on_safety) * against_safety + one.foul_on_safety * against_foul
        self.values[HIDDEN] = (1.0 - one.foul_when_hidden) * against_miss + one.foul_when_hidden * against_foul
        self.values[MADE, 1:] = self._facing(one.after_pot)[1:]

    def _mixed(self, mixture: Mixture) -> Floats:
        """The shooter faces one of several chances."""
        total: Floats = np.zeros((MOST + 1, MOST + 1))
        for chance, share in mixture:
            total += share * self._facing(chance)
        return total

    def _facing(self, chance: float) -> Floats:
        """The shooter faces a pot of this chance; a table for every (needs, opponent needs)."""
        made, missed, safe = self.values[MADE], self.values[MISSED], self.values[SAFE]
        after = np.vstack((made[:1], made[:-1]))
        worth: Floats = np.maximum(chance * after + (1.0 - chance) * missed, safe)
        worth[0] = 1.0
        return worth
