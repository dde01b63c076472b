"""The luck of a stroke: what its noise made of it, beyond what noise makes of such a stroke on average.

luck = value of the outcome - mean value over fresh noise draws of the same intended shot. Given the situation and the
intention its mean is zero, for whatever value function, if that was fixed before. So points minus luck estimate the
same expected points, with less variance (a control variate; for poker: White & Bowling, "Learning a value analysis
tool for agent evaluation", IJCAI 2009; Burch et al., "AIVAT", AAAI 2018). What the shot would have done without noise
is shown beside it and not subtracted: a shot that only works without noise was a bad choice, not bad luck.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from physics import simulate_batch
from physics.shot import FIELDS, Shot
from referee.game import Action, Game
from referee.play import NoiseModel
from referee.rules import EightBall
from referee.rules.checks import start_state
from tournament.luck.value import VALUE, ValueModel

DRAWS = 100
"""Fresh draws a stroke: their mean has a tenth of the deviation of one, so it adds a hundredth to luck's variance."""


@dataclass(frozen=True, slots=True)
class StrokeLuck:
    """The luck of one stroke, in chances to win, from the side of whoever played it.

    Attributes:
        stroke: index in the game; seat: who played it.
        value: of the outcome. expected: mean over fresh draws; error: standard error of that mean.
        noiseless: value of what the intended shot does without noise.
    """

    stroke: int
    seat: int
    value: float
    expected: float
    error: float
    noiseless: float

    @property
    def luck(self) -> float:
        """Positive when noise did the player good."""
        return self.value - self.expected

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {name: getattr(self, name) for name in self.__slots__} | {"luck": self.luck}


def stroke_luck(
    rules: EightBall,
    before: Game,
    action: Action,
    after: Game,
    noise: NoiseModel,
    *,
    key: bytes,
    draws: int = DRAWS,
    value: ValueModel = VALUE,
) -> StrokeLuck:
    """The luck of one stroke that was played.

    Args:
        rules: of the game.
        before: the game before the stroke; after: the game after it.
        action: the intended stroke, not a decision.
        noise: of the game.
        key: where the fresh draws come from; not the game's own noise seed.
        draws: how many, at least 2.
        value: the value function.

    Raises:
        ValueError: the action is a decision, or ``draws`` is below 2.
    """
    if action.shot is None:
        raise ValueError(f"action = {action!r}: must be a stroke; a decision has no noise")
    if isinstance(draws, bool) or not isinstance(draws, int) or draws < 2:
        raise ValueError(f"draws = {draws!r}: must be an integer of at least 2")
    seat = before.turn
    fresh = [noise.perturb(action.shot, key, before.stroke * draws + index, rules.table) for index in range(draws)]
    games = _outcomes(rules, before, action, [action.shot, *fresh])
    noiseless, *values = (value(game, seat, noise.level) for game in games)
    return StrokeLuck(
        stroke=before.stroke,
        seat=seat,
        value=value(after, seat, noise.level),
        expected=float(np.mean(values)),
        error=float(np.std(values, ddof=1) / np.sqrt(draws)),
        noiseless=noiseless,
    )


def _outcomes(rules: EightBall, before: Game, action: Action, shots: Sequence[Shot]) -> list[Game]:
    """The games that these shots lead to, each ruled on as the intended action."""
    rows = np.array([[getattr(shot, name) for name in FIELDS] for shot in shots])
    batch = simulate_batch(rules.table, start_state(before, action), rows)
    return [ruling.game for ruling in rules.apply_batch(before, [action] * len(shots), batch)]
