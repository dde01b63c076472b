"""What a game that goes on is worth: the chance to win it, by a logistic function of what anybody can count.

It has to be fixed before an event, or luck could be measured to taste. It need not be exact: whatever it is, luck has
mean zero; the better it is, the more of the noise it explains. The weights were fitted to games between two equal
players at noise levels drawn from [0, 5] (``benchmarks/value.py``; docs/benchmarks.md has the data).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

from referee.game import CueBallArea, Game, Phase, remaining

WON, LOST, DRAWN = 1.0, 0.0, 0.5

FEATURES: Final = (
    "shooting",
    "shooting_noise",
    "in_hand",
    "in_kitchen",
    "ahead",
    "ahead_noise",
    "at_eight",
    "opponent_at_eight",
    "open_table",
    "breaking",
    "deciding",
)
"""What is looked at, from the side of the player in turn:

shooting: a stroke awaits, no break; shooting_noise: the same times the noise level; in_hand, in_kitchen: the cue ball
is in hand anywhere, behind the head string; ahead: balls the opponent has left more; ahead_noise: the same times the
level; at_eight, opponent_at_eight: only the 8 is left; open_table: no groups yet; breaking: a break awaits; deciding: a
choice.
"""


@dataclass(frozen=True, slots=True)
class ValueModel:
    """A value function.

    Attributes:
        weights: by feature.
        source: id of the data line that they come from.
    """

    weights: Mapping[str, float]
    source: str

    def __call__(self, game: Game, seat: int, noise: float) -> float:
        """The chance of ``seat`` to win ``game`` at this noise level, in [0, 1]; a draw is worth a half."""
        if game.outcome is not None:
            winner = game.outcome.winner
            return DRAWN if winner is None else WON if winner == seat else LOST
        logit = sum(self.weights[name] * value for name, value in features(game, noise).items())
        chance = 1.0 / (1.0 + math.exp(-logit))
        return chance if game.turn == seat else 1.0 - chance


def features(game: Game, noise: float) -> dict[str, float]:
    """The features of a game that goes on, those that are not 0."""
    if game.phase in (Phase.BREAK, Phase.RERACK):
        return {"breaking": 1.0}
    if game.phase is Phase.DECISION:
        return {"deciding": 1.0}
    own, theirs = len(remaining(game, game.turn)), len(remaining(game, game.opponent))
    values = {
        "shooting": 1.0,
        "shooting_noise": noise,
        "in_hand": float(game.cue_ball_in_hand is CueBallArea.ANYWHERE),
        "in_kitchen": float(game.cue_ball_in_hand is CueBallArea.KITCHEN),
        "open_table": float(game.groups is None),
    }
    if game.groups is not None:
        values |= {"ahead": float(theirs - own), "ahead_noise": noise * (theirs - own)}
        values |= {"at_eight": float(own == 0), "opponent_at_eight": float(theirs == 0)}
    return {name: value for name, value in values.items() if value}


VALUE: Final = ValueModel(
    MappingProxyType(
        {
            "shooting": 0.1016,
            "shooting_noise": -0.0228,
            "in_hand": 0.0908,
            "in_kitchen": 0.0205,
            "ahead": 0.1116,
            "ahead_noise": 0.0091,
            "at_eight": 0.7092,
            "opponent_at_eight": -0.4106,
            "open_table": -0.0751,
            "breaking": -0.0295,
            "deciding": -0.0339,
        }
    ),
    "value-20261122T025914",
)
"""What luck is measured by unless another function is given."""
