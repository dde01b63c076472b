"""How good strokes are: simulated as meant, or many times under the game's noise, ruled on, and valued."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from client.agents.search.budget import Budget
from client.agents.search.shots import THETA, Floats, Shots, V
from client.agents.search.value import Values
from physics import Batch, Table
from physics.constants import THETA_MAX, V_MAX
from physics.shot import FIELDS
from referee.play.noise import SIGMA_A, SIGMA_B, SIGMA_PHI, SIGMA_THETA, SIGMA_V
from referee.rules.verdicts import Verdicts, read_verdicts

SIGMAS = np.array([SIGMA_V, SIGMA_PHI, SIGMA_THETA, SIGMA_A, SIGMA_B])
"""Standard deviations of a stroke's columns at level 1."""

Simulate = Callable[[Table, Floats, Floats], Batch]
"""As `client.Simulator.simulate_batch`: table, positions (n, 16, 2), strokes (n, 5)."""


@dataclass(frozen=True, slots=True, eq=False)
class Outcomes:
    """What strokes came to, each played `copies` times; arrays are (k, copies, ...).

    Attributes:
        positions: (k, copies, 16, 2) m afterwards.
        worth: (k, copies) to the player, by the positions' value.
        continues, fouled, over: (k, copies) bool: the shooter goes on; a foul; the game is decided.
        group: (k, copies) int8, the shooter's group afterwards.
    """

    positions: Floats
    worth: Floats
    continues: NDArray[np.bool_]
    fouled: NDArray[np.bool_]
    over: NDArray[np.bool_]
    group: NDArray[np.int8]

    @property
    def copies(self) -> int:
        """How often each stroke was played."""
        return int(self.worth.shape[1])

    def mean(self) -> Floats:
        """(k,): what each stroke is worth."""
        found: Floats = self.worth.mean(axis=1)
        return found

    def __getitem__(self, rows: NDArray[np.int64]) -> "Outcomes":
        return Outcomes(*(getattr(self, name)[rows] for name in _ARRAYS))

    def joined(self, other: "Outcomes") -> "Outcomes":
        """These strokes and others, all played equally often."""
        return Outcomes(*(np.concatenate((getattr(self, name), getattr(other, name))) for name in _ARRAYS))

    def more(self, other: "Outcomes") -> "Outcomes":
        """The same strokes, played more often."""
        return Outcomes(*(np.concatenate((getattr(self, name), getattr(other, name)), axis=1) for name in _ARRAYS))


_ARRAYS = ("positions", "worth", "continues", "fouled", "over", "group")


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

    def as_meant(self, shots: Shots, kitchen: bool = False) -> Outcomes:
        """What the strokes come to without noise; (k, 1)."""
        return self._judged(shots, self.simulated(shots), 1, kitchen)

    def noisy(self, shots: Shots, copies: int, kitchen: bool = False) -> Outcomes:
        """What the strokes come to under noise, all under the same draws: their differences are not the draws'."""
        copies = copies if self.noise > 0.0 else 1
        draws = self._spread * self._chance.standard_normal((copies, len(FIELDS)))
        strokes = (shots.strokes[:, None, :] + draws[None, :, :]).reshape(-1, len(FIELDS))
        strokes[:, V] = np.clip(strokes[:, V], 0.0, V_MAX)
        strokes[:, THETA] = np.clip(strokes[:, THETA], 0.0, THETA_MAX)
        batch = self._run(np.repeat(shots.before(), copies, axis=0), strokes)
        return self._judged(shots, batch, copies, kitchen)

    def _judged(self, shots: Shots, batch: Batch, copies: int, kitchen: bool) -> Outcomes:
        """The referee's and the race's opinion of a batch, `copies` rows a stroke."""

        def each(values: NDArray[np.int64]) -> NDArray[np.int64]:
            return np.repeat(values, copies)

        before, group = np.repeat(shots.before(), copies, axis=0), np.repeat(shots.group(), copies)
        verdicts = read_verdicts(self.table, before, group, each(shots.ball), each(shots.pocket), batch, kitchen)
        worth = self.values.after(batch.positions, verdicts)
        return _shaped(batch.positions, worth, verdicts, (len(shots), copies))

    def _run(self, before: Floats, strokes: Floats) -> Batch:
        self.budget.charge(len(strokes))
        return self._simulate(self.table, before, strokes)


def _shaped(positions: Floats, worth: Floats, verdicts: Verdicts, shape: tuple[int, int]) -> Outcomes:
    """Rows folded into (k, copies)."""
    over = verdicts.won | verdicts.lost | ~verdicts.played
    return Outcomes(
        positions.reshape(*shape, 16, 2),
        worth.reshape(shape),
        verdicts.continues.reshape(shape),
        verdicts.fouled.reshape(shape),
        over.reshape(shape),
        verdicts.group.reshape(shape),
    )
