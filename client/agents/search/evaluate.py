"""How good strokes are: simulated as meant, or many times under the game's noise, ruled on, and valued."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from client.agents.search.budget import Budget
from client.agents.search.shots import THETA, Floats, Shots, V
from client.agents.search.value import Values
from physics import Batch, Table
from physics.shot import FIELDS
from referee.play.noise import SIGMA_A, SIGMA_B, SIGMA_PHI, SIGMA_THETA, SIGMA_V
from referee.rules.batch_rulings import read_verdicts

SIGMAS = np.array([SIGMA_V, SIGMA_PHI, SIGMA_THETA, SIGMA_A, SIGMA_B])
"""Standard deviations of a stroke's columns at level 1."""

Simulate = Callable[[Table, Floats, Floats], Batch]
"""As `client.Simulator.simulate_batch`: table, positions (n, 16, 2), strokes (n, 5)."""


class Evaluator:
    """Plays strokes in the mind.

    Args:
        table: the game's. values: of positions. noise: the level. chance: where the noise comes from.
        simulate: the physics, counted. budget: of the stroke.

    `kitchen` of its methods says whether the cue ball is in hand behind the head string (R38).
    """

    def __init__(
        self,
        table: Table,
        values: Values,
        noise: float,
        chance: np.random.Generator,
        simulate: Simulate,
        budget: Budget,
    ) -> None:
        self.table, self.values, self.budget = table, values, budget
        self.noise, self._spread = noise, noise * SIGMAS
        self._chance, self._simulate = chance, simulate

    def simulated(self, shots: Shots) -> Batch:
        """The strokes as they are meant, without noise."""
        return self._run(shots.before(), shots.strokes)

    def as_meant(self, shots: Shots, kitchen: bool) -> Floats:
        """What the strokes are worth without noise, (k,)."""
        return self._judged(shots, self.simulated(shots), 1, kitchen)[:, 0]

    def noisy(self, shots: Shots, copies: int, kitchen: bool) -> Floats:
        """What each copy of each stroke is worth under noise, (k, copies), or (k, 1) where there is none.

        All strokes are played under the same draws: their differences are not the draws'.
        """
        copies = copies if self.noise > 0.0 else 1
        draws = self._spread * self._chance.standard_normal((copies, len(FIELDS)))
        strokes = (shots.strokes[:, None, :] + draws[None, :, :]).reshape(-1, len(FIELDS))
        strokes[:, V] = np.clip(strokes[:, V], 0.0, self.table.v_max)
        strokes[:, THETA] = np.clip(strokes[:, THETA], 0.0, self.table.theta_max)
        batch = self._run(np.repeat(shots.before(), copies, axis=0), strokes)
        return self._judged(shots, batch, copies, kitchen)

    def _judged(self, shots: Shots, batch: Batch, copies: int, kitchen: bool) -> Floats:
        """The worth of a batch to the player, by referee and race: (k, copies), `copies` rows of it a stroke."""

        def each(values: NDArray[np.int64]) -> NDArray[np.int64]:
            return np.repeat(values, copies)

        before, group = np.repeat(shots.before(), copies, axis=0), np.repeat(shots.group(), copies)
        verdicts = read_verdicts(self.table, before, group, each(shots.ball), each(shots.pocket), batch, kitchen)
        return self.values.after(batch.positions, verdicts).reshape(len(shots), copies)

    def _run(self, before: Floats, strokes: Floats) -> Batch:
        self.budget.charge(len(strokes))
        return self._simulate(self.table, before, strokes)
