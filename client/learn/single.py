"""One player against an opponent, as a Gymnasium environment."""

from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box

from client.learn.codec import ACTION_SIZE, OBSERVATION_SIZE, Vector
from client.learn.frames import Window, pixels, rendered
from client.learn.games import checked_shaping, referee_of
from client.learn.one_game import OneGame
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
        noise, table, start: as for `EightBallAEC`.
        render_mode: `ansi`; `rgb_array`, which needs the extra `pictures` and is what `RecordVideo` takes; or `human`,
            a window, which needs pygame too.
        shaping: weight of what a step adds to the lead (`Games.leads`), paid beside the game's end. Shaping by a
            potential leaves the best policy what it is (Ng, Harada & Russell 1999), and what an episode pays.
    """

    metadata: dict[str, Any] = {"render_modes": ["ansi", "rgb_array", "human"], "render_fps": 1}  # noqa: RUF012

    def __init__(
        self,
        opponent: Policy | None = None,
        noise: float | NoiseModel = 1.0,
        table: Table | None = None,
        start: Game | None = None,
        render_mode: str | None = None,
        shaping: float = 0.0,
    ) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode = {render_mode!r}: must be 'ansi', 'rgb_array', 'human' or None")
        self._shaping = checked_shaping(shaping)
        self._window = None if render_mode != "human" else Window(1.0 / self.metadata["render_fps"])
        self._rules, self._noise = referee_of(table), NoiseModel.of(noise)
        self._start = None if start is None else self._rules.begin_from(start)
        self._opponent = opponent
        self.render_mode = render_mode
        self.observation_space = Box(0.0, 1.0, (OBSERVATION_SIZE,), np.float32)
        self.action_space = Box(-1.0, 1.0, (ACTION_SIZE,), np.float32)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Vector, dict[str, Any]]:
        """Begin a new game, and play it on to the learner's first turn; the seed fixes it and those after it."""
        super().reset(seed=seed)
        self._games = OneGame(self._rules, self._noise, self._start)
        while True:
            self._games.begin(self.np_random)
            self._seat = int(self.np_random.integers(2))
            self._opponent_plays()
            if not self._games.is_over:  # an opponent may win from the break: that was no game
                self._lead = self._games.lead(self._seat)
                self._show()
                return self._games.observed(self._seat), self._info()

    def step(self, action: Vector) -> tuple[Vector, float, bool, bool, dict[str, Any]]:
        """Play an action, and the opponent's until it is the learner's turn again or the game is over."""
        self._games.play(action, self.np_random)
        self._opponent_plays()
        self._show()
        before, self._lead = self._lead, self._games.lead(self._seat)
        seen, reward = self._games.observed(self._seat), self._games.reward(self._seat)
        return seen, reward + self._shaping * (self._lead - before), self._games.is_over, False, self._info()

    def render(self) -> Any:
        """The position: in one line in mode `ansi`, as pixels (h, w, 3) uint8 in mode `rgb_array`.

        In mode `human` every step shows it, and this is None.
        """
        return rendered(self.render_mode, self.game.state, self.table)

    def close(self) -> None:
        """Close the window, if there is one."""
        if self._window is not None:
            self._window.close()

    @property
    def table(self) -> Table:
        """The table it is played on."""
        return self._rules.table

    @property
    def game(self) -> Game:
        """The game as the referee knows it, at the learner's turn."""
        return self._games.game()

    def _show(self) -> None:
        if self._window is not None:
            self._window.show(pixels(self.game.state, self.table))

    def _opponent_plays(self) -> None:
        """Until it is the learner's turn, or the game is over."""
        other = 1 - self._seat
        while not self._games.is_over and self._games.turn == other:
            choice = self._opponent(self._games.observed(other)) if self._opponent else self._at_random()
            self._games.play(choice, self.np_random)

    def _at_random(self) -> Vector:
        return self.np_random.uniform(-1.0, 1.0, ACTION_SIZE).astype(np.float32)

    def _info(self) -> dict[str, Any]:
        return {"seat": self._seat, "strokes": self._games.strokes, "reason": self._games.reason}
