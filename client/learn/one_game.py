"""One game, played as many are."""

import numpy as np
from numpy.typing import NDArray

from client.learn.codec import ACTION_SIZE, Vector
from client.learn.compiled import layout as to
from client.learn.games import Games
from referee import EightBall, Game, NoiseModel


class OneGame:
    """`Games` of one, by plain values.

    Args:
        rules, noise, start: as for `Games`.
    """

    def __init__(self, rules: EightBall, noise: NoiseModel, start: Game | None) -> None:
        self._games = Games(rules, noise, 1, start=start)

    def begin(self, chance: np.random.Generator) -> None:
        """A new game."""
        self._games.begin(_ONLY, chance)

    def observed(self, seat: int) -> Vector:
        """`codec.observe`."""
        seen: Vector = self._games.observed(_ONLY, np.array([seat]))[0]
        return seen

    def play(self, action: NDArray[np.floating], chance: np.random.Generator) -> None:
        """One action of the player in turn.

        Raises:
            ValueError: the action has another shape, or holds NaN.
        """
        vector = np.asarray(action)
        if vector.shape != (ACTION_SIZE,):
            raise ValueError(f"an action has shape {vector.shape}; it must be ({ACTION_SIZE},)")
        self._games.play(_ONLY, vector[None], chance)

    def reward(self, seat: int) -> float:
        """See `Games.rewards`."""
        return float(self._games.rewards(np.array([seat]))[0])

    def lead(self, seat: int) -> float:
        """See `Games.leads`."""
        return float(self._games.leads(np.array([seat]))[0])

    def game(self) -> Game:
        """As the referee knows it."""
        return self._games.game(0)

    @property
    def is_over(self) -> bool:
        """Whether it has ended."""
        return bool(self._games.state[0, to.PHASE] == to.OVER)

    @property
    def turn(self) -> int:
        """The seat that acts."""
        return int(self._games.state[0, to.TURN])

    @property
    def strokes(self) -> int:
        """Strokes played."""
        return int(self._games.state[0, to.STROKE])

    @property
    def reason(self) -> str:
        """Why it is over; nothing while it goes on."""
        return to.REASONS[int(self._games.state[0, to.REASON])].value if self.is_over else ""


_ONLY = np.zeros(1, np.int64)
