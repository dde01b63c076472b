"""How good plans are under the game's noise: many noisy variants of each, simulated and ruled on."""

import sys
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from client.agents.greedy.planned_action import PlannedAction
from client.agents.greedy.worth import worth, worths_of
from client.simulator import Simulator
from physics import Batch
from physics.shot import FIELDS
from referee import Action, Call, CueBallArea, EightBall, Game, Phase
from referee.play.noise import NoiseModel
from referee.rules.batch_rulings import SAFETY_CALL, group_number, read_verdicts

SHARE = 10
"""A judgement simulates at most a tenth of what the budget has left: a game has some dozens of strokes."""


class Judge:
    """Judges the strokes of one turn.

    Args:
        rules: the referee on the game's table.
        game: as it stands; the player in turn is the one whose worth counts.
        noise: to reckon with, or the level of the Olympiad's.
        chance: where the variants come from.
        simulator: the physics; of what its budget has left each judgement takes a share and no more.
    """

    def __init__(
        self,
        rules: EightBall,
        game: Game,
        noise: float | NoiseModel,
        chance: np.random.Generator,
        simulator: Simulator,
    ) -> None:
        self._rules = rules
        self._simulator = simulator
        self._game = game
        model = NoiseModel.of(noise)
        self._spread = model.level * model.sigmas.row()
        self._chance = chance

    def worths(self, plans: Sequence[PlannedAction], variants: int) -> NDArray[np.float64]:
        """Mean worth of each plan over so many noisy variants, (n,); without noise there is but one."""
        copies = min(variants if self._spread.any() else 1, self._affordable() // len(plans))
        if copies == 0:
            return np.zeros(len(plans))
        shots = self._disturbed(np.repeat([_columns(plan) for plan in plans], copies, axis=0))
        before = np.repeat([plan.before.positions for plan in plans], copies, axis=0)
        batch = self._simulator.simulate_batch(self._rules.table, before, shots)
        actions = [plan.action for plan in plans for _ in range(copies)]
        mean: NDArray[np.float64] = self._each(actions, before, batch).reshape(len(plans), copies).mean(axis=1)
        return mean

    def _each(self, actions: Sequence[Action], before: NDArray[np.float64], batch: Batch) -> NDArray[np.float64]:
        """What every stroke came to, (n,): told from arrays where rulings are not needed, on a break by rulings."""
        game = self._game
        if game.phase is Phase.BREAK:
            rulings = self._rules.apply_batch(game, actions, batch)
            return np.array([worth(ruling.game, game.turn) for ruling in rulings])
        calls = [action.call if isinstance(action.call, Call) else None for action in actions]
        ball = np.array([SAFETY_CALL if call is None else call.ball for call in calls])
        pocket = np.array([SAFETY_CALL if call is None else call.pocket for call in calls])
        group = np.full(len(actions), group_number(game.group_of(game.turn)), np.int8)
        kitchen = game.cue_ball_in_hand is CueBallArea.KITCHEN
        verdicts = read_verdicts(self._rules.table, before, group, ball, pocket, batch, kitchen)
        return worths_of(game, verdicts, batch, self._rules.limits)

    def pocketed(self, plans: Sequence[PlannedAction], balls: Sequence[int]) -> list[Call | None]:
        """For each plan the first of `balls` that it sends into a pocket as intended, as a call."""
        if not balls or len(plans) > self._affordable():
            return [None] * len(plans)
        before = np.array([plan.before.positions for plan in plans])
        columns = np.array([_columns(plan) for plan in plans])
        batch = self._simulator.simulate_batch(self._rules.table, before, columns)
        into = batch.pocket[:, list(balls)]
        first = (into >= 0).argmax(axis=1)
        rows = zip(first.tolist(), into[np.arange(len(plans)), first].tolist(), strict=True)
        return [Call(balls[index], pocket) if pocket >= 0 else None for index, pocket in rows]

    def _affordable(self) -> int:
        """How many shots this judgement may simulate."""
        remaining = self._simulator.remaining
        return sys.maxsize if remaining is None else remaining // SHARE

    def _disturbed(self, shots: NDArray[np.float64]) -> NDArray[np.float64]:
        """The shots with noise as the game adds it: speed and elevation clamped to their range."""
        noisy = shots + self._spread * self._chance.standard_normal(shots.shape)
        noisy[:, 0] = np.clip(noisy[:, 0], 0.0, self._rules.table.v_max)
        noisy[:, 2] = np.clip(noisy[:, 2], 0.0, self._rules.table.theta_max)
        return noisy


def _columns(plan: PlannedAction) -> tuple[float, ...]:
    """A plan's shot as a row of a batch."""
    shot = plan.action.shot
    if shot is None:
        raise ValueError(f"{plan.action!r} is a decision; only strokes are simulated")
    return tuple(getattr(shot, name) for name in FIELDS)
