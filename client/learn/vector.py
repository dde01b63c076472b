"""Many single-player games at once, their whole step compiled."""

from collections.abc import Callable
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from client.learn.codec import ACTION_SIZE, OBSERVATION_SIZE, Integers, Vector
from client.learn.compiled import layout as to
from client.learn.games import Games, checked_shaping, referee_of
from physics import Table
from referee import Game, NoiseModel

BatchPolicy = Callable[[Vector], Vector]
"""From observations (m, OBSERVATION_SIZE) to actions (m, ACTION_SIZE)."""


class EightBallVectorEnv(VectorEnv[Vector, Vector, NDArray[Any]]):
    """`num_envs` games as `EightBallEnv` plays them, each against the same opponent.

    A game that is over begins anew at the next step, whose action for it is ignored (`AutoresetMode.NEXT_STEP`).

    Args:
        num_envs: how many.
        opponent: a policy over many observations at once; draws its actions at random unless given.
        noise, table, start: as for `EightBallAEC`. threads: of the physics. shaping: as for `EightBallEnv`.
    """

    metadata: dict[str, Any] = {"autoreset_mode": AutoresetMode.NEXT_STEP}  # noqa: RUF012

    def __init__(
        self,
        num_envs: int = 1,
        opponent: BatchPolicy | None = None,
        noise: float | NoiseModel = 1.0,
        table: Table | None = None,
        start: Game | None = None,
        threads: int = 1,
        shaping: float = 0.0,
    ) -> None:
        if isinstance(num_envs, bool) or not isinstance(num_envs, int) or num_envs < 1:
            raise ValueError(f"num_envs is {num_envs!r}; it must be an integer of at least 1")
        self.num_envs, self._shaping = num_envs, checked_shaping(shaping)
        self._rules, self._noise, self._threads = referee_of(table), NoiseModel.of(noise), threads
        self._start = None if start is None else self._rules.begin_from(start)
        self._opponent = opponent
        self._all = np.arange(num_envs)
        self.single_observation_space = Box(0.0, 1.0, (OBSERVATION_SIZE,), np.float32)
        self.single_action_space = Box(-1.0, 1.0, (ACTION_SIZE,), np.float32)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Vector, dict[str, Any]]:
        """Begin all games anew; the seed fixes them and those after them."""
        super().reset(seed=seed)
        self._seats = np.zeros(self.num_envs, dtype=np.int64)
        self._games = Games(self._rules, self._noise, self.num_envs, self._threads, self._start)
        self._begin(self._all)
        self._leads = self._games.leads(self._seats)
        return self._seen(), self._info()

    def step(self, actions: Vector) -> tuple[Vector, NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Play an action in every game, and the opponent's until it is the learner's turn in each, or it is over.

        Raises:
            ValueError: actions that are not `(num_envs, ACTION_SIZE)` numbers.
        """
        asked = np.asarray(actions)
        if asked.shape != (self.num_envs, ACTION_SIZE):
            raise ValueError(f"actions have shape {asked.shape}; it must be ({self.num_envs}, {ACTION_SIZE})")
        over = self._games.over
        begun, going = np.flatnonzero(over), np.flatnonzero(~over)
        if len(going):
            self._games.play(going, asked[going], self.np_random)
        self._begin(begun)
        self._opponent_plays(going)
        rewards = self._games.rewards(self._seats)
        before, self._leads = self._leads, self._games.leads(self._seats)
        rewards[going] += self._shaping * (self._leads[going] - before[going])
        return self._seen(), rewards, self._games.over, np.zeros(self.num_envs, np.bool_), self._info()

    def _begin(self, waiting: Integers) -> None:
        """New games, played on to the learner's first turn; one that the opponent ends before it was no game."""
        while len(waiting):
            self._games.begin(waiting, self.np_random)
            self._seats[waiting] = self.np_random.integers(2, size=len(waiting))
            self._opponent_plays(waiting)
            waiting = waiting[self._games.over[waiting]]

    def _opponent_plays(self, rows: Integers) -> None:
        """Until it is nowhere the opponent's turn."""
        while True:
            state = self._games.state[rows]
            rows = rows[(state[:, to.PHASE] != to.OVER) & (state[:, to.TURN] != self._seats[rows])]
            if not len(rows):
                return
            seen = self._games.observed(rows, 1 - self._seats[rows]) if self._opponent else None
            self._games.play(rows, self._at_random(len(rows)) if seen is None else self._asked(seen), self.np_random)

    def _asked(self, seen: Vector) -> Vector:
        """What a policy answers."""
        assert self._opponent is not None
        answer = np.asarray(self._opponent(seen))
        if answer.shape != (len(seen), ACTION_SIZE):
            raise ValueError(
                f"the opponent's actions have shape {answer.shape}; it must be ({len(seen)}, {ACTION_SIZE})"
            )
        return answer

    def _at_random(self, count: int) -> Vector:
        return self.np_random.uniform(-1.0, 1.0, (count, ACTION_SIZE)).astype(np.float32)

    def _seen(self) -> Vector:
        return self._games.observed(self._all, self._seats)

    def _info(self) -> dict[str, Any]:
        return {"seat": self._seats.copy(), "strokes": self._games.state[:, to.STROKE].copy()}
