"""The physics as an agent may use it: every simulated shot counts against the game's budget, if it has one."""

from typing import TYPE_CHECKING

import physics
from physics.batch import checked_shots
from referee import SimulationBudget

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import ArrayLike, NDArray


class Simulator:
    """`physics.simulate` and `physics.simulate_batch`, counted.

    Args:
        budget: what it is counted against; without one any number of shots may be simulated.
    """

    def __init__(self, budget: SimulationBudget | None = None) -> None:
        self.budget = budget or SimulationBudget()

    @property
    def remaining(self) -> int | None:
        """Shots that may still be simulated in this game; None for any number."""
        return self.budget.remaining

    def simulate(
        self, table: physics.Table, state: physics.TableState, shot: physics.Shot, trace: bool = True
    ) -> physics.Result:
        """One shot, as `physics.simulate` plays it.

        Raises:
            referee.BudgetSpent: the budget is spent; nothing was simulated.
        """
        self.budget.spend(1)
        return physics.simulate(table, state, shot, trace=trace)

    def simulate_batch(
        self,
        table: physics.Table,
        states: "physics.TableState | NDArray[np.float64]",
        shots: "ArrayLike | Sequence[physics.Shot]",
        threads: int = 1,
    ) -> physics.Batch:
        """Many shots, as `physics.simulate_batch` plays them; each row counts, also one that cannot be played.

        Raises:
            referee.BudgetSpent: fewer are left than there are rows; nothing was simulated.
            physics.InvalidShot: the shots are not as `physics.simulate_batch` takes them; none is counted.
        """
        rows = checked_shots(shots)
        self.budget.spend(len(rows))
        return physics.simulate_batch(table, states, rows, threads=threads)
