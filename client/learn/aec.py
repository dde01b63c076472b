"""The game of both players, as a PettingZoo AEC environment."""

from typing import Any, Final

import numpy as np
from gymnasium.spaces import Box, Space
from pettingzoo import AECEnv

from client.learn.codec import ACTION_SIZE, OBSERVATION_SIZE, Vector
from client.learn.frames import rendered
from client.learn.games import referee_of
from client.learn.one_game import OneGame
from physics import Table
from referee import Game, NoiseModel

SEATS: Final = ("seat_0", "seat_1")


class EightBallAEC(AECEnv[str, Vector, Vector | None]):
    """8-ball between `seat_0` and `seat_1`: observations of `observe`, actions of `act`, 1 for a win and -1 for a loss.

    Args:
        noise: level, 0 to 5, 1 is the Olympiad's; or a `NoiseModel` with standard deviations of its own.
        table: the Olympiad's unless given.
        start: where every game begins instead of a break.
        render_mode: `ansi`; `rgb_array`, which needs the extra `pictures`; or None.

    Raises:
        ValueError: a level of noise, a start or a render mode that is none.
    """

    metadata: dict[str, Any] = {  # noqa: RUF012
        "name": "eight_ball_v0",
        "render_modes": ["ansi", "rgb_array"],
        "is_parallelizable": False,
    }

    def __init__(
        self,
        noise: float | NoiseModel = 1.0,
        table: Table | None = None,
        start: Game | None = None,
        render_mode: str | None = None,
    ) -> None:
        super().__init__()
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode = {render_mode!r}: must be 'ansi', 'rgb_array' or None")
        self._rules, self._noise = referee_of(table), NoiseModel.of(noise)
        self._start = None if start is None else self._rules.begin_from(start)
        self._chance = np.random.default_rng()
        self.render_mode = render_mode
        self.possible_agents = list(SEATS)
        self.agents: list[str] = []
        self.observation_spaces = {seat: Box(0.0, 1.0, (OBSERVATION_SIZE,), np.float32) for seat in SEATS}
        self.action_spaces = {seat: Box(-1.0, 1.0, (ACTION_SIZE,), np.float32) for seat in SEATS}

    def observation_space(self, agent: str) -> Space[Any]:
        """Of either seat."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Space[Any]:
        """Of either seat."""
        return self.action_spaces[agent]

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> None:
        """Begin a new game; the seed fixes it and those after it."""
        if seed is not None:
            self._chance = np.random.default_rng(seed)
        self._games = OneGame(self._rules, self._noise, self._start)
        self._games.begin(self._chance)
        self.agents = list(SEATS)
        self.rewards = dict.fromkeys(SEATS, 0.0)
        self._cumulative_rewards = dict.fromkeys(SEATS, 0.0)
        self.terminations = dict.fromkeys(SEATS, False)
        self.truncations = dict.fromkeys(SEATS, False)
        self.infos: dict[str, dict[str, Any]] = {seat: {} for seat in SEATS}
        self.agent_selection = SEATS[self._games.turn]

    def observe(self, agent: str) -> Vector:
        """The game as this seat sees it."""
        return self._games.observed(SEATS.index(agent))

    def step(self, action: Vector | None) -> None:
        """Play an action of the seat in turn."""
        if self.terminations[self.agent_selection]:
            self._was_dead_step(None)
            return
        assert action is not None
        self._cumulative_rewards[self.agent_selection] = 0.0
        self._games.play(action, self._chance)
        self.rewards = {seat: self._games.reward(number) for number, seat in enumerate(SEATS)}
        self.terminations = dict.fromkeys(SEATS, self._games.is_over)
        self.agent_selection = SEATS[self._games.turn]
        self._accumulate_rewards()

    def render(self) -> Any:
        """The position: in one line in mode `ansi`, as pixels (h, w, 3) uint8 in mode `rgb_array`."""
        return rendered(self.render_mode, self._games.game().state, self._rules.table)

    def close(self) -> None:
        """Nothing is held."""
