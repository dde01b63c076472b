"""What positions are worth: the compiled survey of a table, put through the race."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from client.agents.search.race import race
from client.agents.search.shots import CHANCE, LAYOUT, PLACED, SEEN, Floats, Groups, Tables
from client.agents.search.sight import Sight
from referee.rules.batch_rulings import OPEN, Verdicts


@dataclass(frozen=True, slots=True)
class Values:
    """Values positions under one level of noise."""

    sight: Sight
    noise: float

    def after(self, positions: Floats, verdicts: Verdicts) -> Floats:
        """What each stroke's result is worth to the one who played it, (n,), in [0, 1]."""
        going = ~(verdicts.won | verdicts.lost) & verdicts.played
        worth = np.where(verdicts.won, 1.0, 0.0)
        continues, group = verdicts.continues[going], verdicts.group[going]
        mover = np.where(continues | (group == OPEN), group, 1 - group).astype(np.int8)
        found = self.to_shoot(positions[going], mover, verdicts.fouled[going])
        worth[going] = np.where(continues, found, 1.0 - found)
        return worth

    def to_shoot(self, positions: Floats, group: Groups, hand: NDArray[np.bool_], kitchen: float = 0.0) -> Floats:
        """What each position is worth to whoever shoots next, (n,).

        Args:
            group: the shooter's. hand: whether the cue ball is in hand; kitchen: the least y it may be put at then.
        """
        return self._best(self.sight.survey(positions, hand, kitchen), positions, group, hand)

    def without_pot(self, tables: Tables) -> Floats:
        """What each position is worth to its shooter when no ball is potted: a safety, or a miss."""
        offers = self.sight.survey(tables.positions, np.zeros(len(tables), bool))
        offers[:, :, CHANCE] = 0.0
        return self._best(offers, tables.positions, tables.group, np.zeros(len(tables), bool))

    def _best(self, offers: Floats, positions: Floats, group: Groups, hand: NDArray[np.bool_]) -> Floats:
        """The value for the shooter's group; for the better one on an open table."""
        needs = self.needs(positions, offers)
        either = [self._of_group(offers[:, g], needs[:, g], needs[:, 1 - g], hand) for g in (0, 1)]
        best = np.maximum(*either)
        worth: Floats = np.where(group == OPEN, best, np.where(group == 1, either[1], either[0]))
        return worth

    def needs(self, positions: Floats, offers: Floats) -> Floats:
        """(n, 2): how many perfect balls each group still has to make, the 8 included."""
        there = ~np.isnan(positions[:, :, 0])
        count = np.stack((there[:, 1:8].sum(axis=1), there[:, 9:16].sum(axis=1)), axis=1) + 1.0
        needed: Floats = count + offers[:, :, LAYOUT] / -math.log(race(self.noise).habits.after_pot)
        return needed

    def _of_group(self, offer: Floats, needs: Floats, other: Floats, hand: NDArray[np.bool_]) -> Floats:
        chance = np.where(hand, offer[:, PLACED], offer[:, CHANCE])
        return race(self.noise).shooter(needs, other, chance, hand | (offer[:, SEEN] > 0.0))
