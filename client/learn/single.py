"""One player against an opponent, as a Gymnasium environment."""

from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box

from client import notation
from client.learn.codec import ACTION_SIZE, OBSERVATION_SIZE, Vector, act, observe
from client.learn.episodes import Episode, referee_of
from physics import Table
from referee import Game, NoiseModel

Policy = Callable[[Vector], Vector]
"""From an observation to an action, as `observe` and `act` have them."""


class EightBallEnv(gymnasium.Env[Vector, Vector]):
    """8-ball against an opponent who plays within `step`: 1 for a game won, -1 for one lost, 0 otherwise.

    The learner's seat is drawn anew for every game. An episode is a game; it ends by the rules, at the latest after 400
    strokes (R49), so that nothing is ever truncated.

    Args:
        opponent: a policy; draws its actions at random unless given.
        noise, table, start, render_mode: as for `EightBallAEC`.
    """

    metadata: dict[str, Any] = {"render_modes": ["ansi"], "render_fps": 1}  # noqa: RUF012

    def __init__(
        self,
        opponent: Policy | None = None,
        noise: float = 1.0,
        table: Table | None = None,
        start: Game | None = None,
        render_mode: str | None = None,
    ) -> None:
        if render_mode not in (None, "ansi"):
            raise ValueError(f"render_mode is {render_mode!r}; it must be 'ansi' or None")
        self._rules, self._noise = referee_of(table), NoiseModel(noise)
        self._start = None if start is None else self._rules.begin_from(start)
        self._opponent = opponent or self._at_random
        self.render_mode = render_mode
        self.observation_space = Box(0.0, 1.0, (OBSERVATION_SIZE,), np.float32)
        self.action_space = Box(-1.0, 1.0, (ACTION_SIZE,), np.float32)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Vector, dict[str, Any]]:
        """Begin a new game, and play it on to the learner's first turn; the seed fixes it and those after it."""
        super().reset(seed=seed)
        while True:
            self._course = Episode.begin(self._rules, self._noise, self.np_random, self._start)
            self._seat = int(self.np_random.integers(2))
            self._opponent_plays()
            if not self._course.game.is_over:  # an opponent may win from the break: that was no game
                return self._seen(), self._info()

    def step(self, action: Vector) -> tuple[Vector, float, bool, bool, dict[str, Any]]:
        """Play an action, and the opponent's until it is the learner's turn again or the game is over."""
        self._course.play(act(self._rules.table, self._course.game, action))
        self._opponent_plays()
        over = self._course.game.is_over
        return self._seen(), self._course.reward(self._seat), over, False, self._info()

    def render(self) -> str | None:
        """The position in one line, in mode `ansi`."""
        return notation.write(self._course.game.state) if self.render_mode == "ansi" else None

    def _opponent_plays(self) -> None:
        """Until it is the learner's turn, or the game is over."""
        table, other = self._rules.table, 1 - self._seat
        while not self._course.game.is_over and self._course.game.turn == other:
            choice = self._opponent(observe(table, self._course.game, other))
            self._course.play(act(table, self._course.game, choice))

    def _at_random(self, _observation: Vector) -> Vector:
        return self.np_random.uniform(-1.0, 1.0, ACTION_SIZE).astype(np.float32)

    def _seen(self) -> Vector:
        return observe(self._rules.table, self._course.game, self._seat)

    def _info(self) -> dict[str, Any]:
        game = self._course.game
        reason = "" if game.outcome is None else game.outcome.reason.value
        return {"seat": self._seat, "strokes": game.stroke, "reason": reason}
