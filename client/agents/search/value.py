"""What positions are worth: the compiled survey of a table, put through the race, and borne out by games."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from client.agents.search.odds import Odds, odds
from client.agents.search.race import race
from client.agents.search.shots import Floats, Groups, Tables
from client.agents.search.sight import Sight, Valuation
from referee.rules.batch_rulings import OPEN, Verdicts


@dataclass(frozen=True, slots=True)
class Values:
    """Values positions under one level of noise."""

    sight: Sight
    noise: float

    @property
    def odds(self) -> Odds:
        """What games bear out of what the race says."""
        return odds(self.noise, self.sight.has_jaws)

    def after(self, before: Floats, positions: Floats, verdicts: Verdicts) -> Floats:
        """What each stroke's result is worth to the one who played it, (n,), in [0, 1]; `before` the tables before."""
        going = ~(verdicts.won | verdicts.lost) & verdicts.played
        worth = np.where(verdicts.won, 1.0, 0.0)
        continues, group = verdicts.continues[going], verdicts.group[going]
        mover = np.where(continues | (group == OPEN), group, 1 - group).astype(np.int8)
        left = Tables(positions[going], mover)
        found = self._borne_out(left, before[going], verdicts.fouled[going], Valuation())
        worth[going] = np.where(continues, found, 1.0 - found)
        return worth

    def to_shoot(self, positions: Floats, group: Groups, hand: NDArray[np.bool_], kitchen: float = 0.0) -> Floats:
        """What each position is worth to whoever shoots next, (n,).

        Args:
            group: the shooter's. hand: whether the cue ball is in hand; kitchen: the least y it may be put at then.
        """
        return self._borne_out(Tables(positions, group), positions, hand, Valuation(kitchen))

    def without_pot(self, tables: Tables) -> Floats:
        """What each position is worth to its shooter when no ball is potted: a safety, or a miss."""
        nowhere = np.zeros(len(tables), bool)
        return self._borne_out(tables, tables.positions, nowhere, Valuation(pots=False))

    def raced(self, tables: Tables, before: Floats, hand: NDArray[np.bool_], valuation: Valuation) -> Floats:
        """What the race alone says, (n,); see `Sight.worths`."""
        return self.sight.worths(tables, before, hand, race(self.noise), valuation)

    def _borne_out(self, tables: Tables, before: Floats, hand: NDArray[np.bool_], valuation: Valuation) -> Floats:
        """What games say of it, (n,)."""
        return self.odds.of(self.raced(tables, before, hand, valuation))
