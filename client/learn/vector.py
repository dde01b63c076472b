"""Many single-player games at once: their strokes go through the physics as one batch."""

from collections.abc import Callable
from itertools import compress
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from client.learn.codec import ACTION_SIZE, OBSERVATION_SIZE, Vector, act, observe_all, strokes
from client.learn.episodes import Episode, referee_of, reward
from physics import Table
from physics.shot import FIELDS
from referee import Game, NoiseModel
from referee.play.batch import play_strokes

BatchPolicy = Callable[[Vector], Vector]
"""From observations (m, OBSERVATION_SIZE) to actions (m, ACTION_SIZE)."""
Flags = NDArray[np.bool_]


class EightBallVectorEnv(VectorEnv[Vector, Vector, NDArray[Any]]):
    """`num_envs` games as `EightBallEnv` plays them, each against the same opponent.

    A game that is over begins anew at the next step, whose action for it is ignored (`AutoresetMode.NEXT_STEP`).

    Args:
        num_envs: how many.
        opponent: a policy over many observations at once; draws its actions at random unless given.
        noise, table, start: as for `EightBallAEC`. threads: of the physics.
    """

    metadata: dict[str, Any] = {"autoreset_mode": AutoresetMode.NEXT_STEP}  # noqa: RUF012

    def __init__(
        self,
        num_envs: int = 1,
        opponent: BatchPolicy | None = None,
        noise: float = 1.0,
        table: Table | None = None,
        start: Game | None = None,
        threads: int = 1,
    ) -> None:
        if isinstance(num_envs, bool) or not isinstance(num_envs, int) or num_envs < 1:
            raise ValueError(f"num_envs is {num_envs!r}; it must be an integer of at least 1")
        self.num_envs = num_envs
        self._rules, self._noise, self._threads = referee_of(table), NoiseModel(noise), threads
        self._start = None if start is None else self._rules.begin_from(start)
        self._opponent = opponent or self._at_random
        self.single_observation_space = Box(0.0, 1.0, (OBSERVATION_SIZE,), np.float32)
        self.single_action_space = Box(-1.0, 1.0, (ACTION_SIZE,), np.float32)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Vector, dict[str, Any]]:
        """Begin all games anew; the seed fixes them and those after them."""
        super().reset(seed=seed)
        self._seats = np.zeros(self.num_envs, dtype=np.int64)
        self._courses: list[Episode] = [self._course() for _ in range(self.num_envs)]
        self._over: Flags = np.zeros(self.num_envs, dtype=np.bool_)
        self._begin(range(self.num_envs))
        return self._seen(), self._info()

    def step(self, actions: Vector) -> tuple[Vector, NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Play an action in every game, and the opponent's until it is the learner's turn in each, or it is over.

        Raises:
            ValueError: actions that are not `(num_envs, ACTION_SIZE)` numbers.
        """
        asked = np.asarray(actions)
        if asked.shape != (self.num_envs, ACTION_SIZE):
            raise ValueError(f"actions have shape {asked.shape}; it must be ({self.num_envs}, {ACTION_SIZE})")
        begun = np.flatnonzero(self._over).tolist()
        going = np.flatnonzero(~self._over).tolist()
        self._play(going, asked[going])
        self._begin(begun)
        self._opponent_plays(going)
        self._over = np.array([course.game.is_over for course in self._courses])
        rewards = [reward(course.game, int(seat)) for course, seat in zip(self._courses, self._seats, strict=True)]
        return self._seen(), np.array(rewards), self._over.copy(), np.zeros(self.num_envs, np.bool_), self._info()

    def _course(self) -> Episode:
        return Episode.begin(self._rules, self._noise, self.np_random, self._start)

    def _begin(self, rows: "range | list[int]") -> None:
        """New games, played on to the learner's first turn; one that the opponent ends before it was no game."""
        waiting = list(rows)
        while waiting:
            for row in waiting:
                self._courses[row], self._seats[row] = self._course(), self.np_random.integers(2)
            self._opponent_plays(waiting)
            waiting = [row for row in waiting if self._courses[row].game.is_over]

    def _opponent_plays(self, rows: list[int]) -> None:
        """Until it is nowhere the opponent's turn."""
        while turns := [row for row in rows if self._is_opponents(row)]:
            games = [self._courses[row].game for row in turns]
            seen = observe_all(self._rules.table, games, (1 - self._seats[turns]).tolist())
            self._play(turns, self._opponent(seen))

    def _is_opponents(self, row: int) -> bool:
        game = self._courses[row].game
        return not game.is_over and game.turn != self._seats[row]

    def _play(self, rows: list[int], vectors: Vector) -> None:
        """One action in each of these games, the strokes as one batch."""
        courses = [self._courses[row] for row in rows]
        deciding = [bool(course.game.decisions) for course in courses]
        for course, vector in compress(zip(courses, vectors, strict=True), deciding):
            course.play(act(self._rules.table, course.game, vector))
        striking = np.flatnonzero(~np.array(deciding, np.bool_)).tolist()
        if not striking:
            return
        games = [courses[number].game for number in striking]
        draws = self.np_random.standard_normal((len(games), len(FIELDS)))
        asked = strokes(self._rules.table, games, vectors[striking])
        after = play_strokes(self._rules, asked, self._noise, draws, threads=self._threads)
        for number, game in zip(striking, after, strict=True):
            courses[number].follow(game)

    def _at_random(self, observations: Vector) -> Vector:
        return self.np_random.uniform(-1.0, 1.0, (len(observations), ACTION_SIZE)).astype(np.float32)

    def _seen(self) -> Vector:
        return observe_all(self._rules.table, [course.game for course in self._courses], self._seats.tolist())

    def _info(self) -> dict[str, Any]:
        strokes_played = np.array([course.game.stroke for course in self._courses])
        return {"seat": self._seats.copy(), "strokes": strokes_played}
