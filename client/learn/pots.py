"""Actions a beginner of learning can start with: which ball into which pocket, and how hard."""

import math
from typing import Any, Final

import gymnasium
import numpy as np
from gymnasium.spaces import Discrete
from numpy.typing import NDArray

from client import geometry
from client.geometry import Point, Pot
from client.learn.codec import LATTICE, MARGIN, Vector, encode
from client.learn.single import EightBallEnv
from physics import Shot, Table, TableState
from physics.constants import N_BALLS, N_POCKETS
from physics.cue import min_elevation
from referee import Action, Call, CueBallArea, Game, Phase
from referee.game import callable_balls

SPEEDS: Final = (1.0, 2.0, 4.0)
"""m/s, the strengths to choose from."""
COLUMNS, ROWS = LATTICE[0] // 2 + 1, LATTICE[1] // 2
"""Of the places tried for a cue ball in hand."""
SAFETY: Final = (N_BALLS - 1) * N_POCKETS * len(SPEEDS)
"""The last action: a soft stroke at the nearest ball, called a safety."""


class PotActions(gymnasium.Wrapper[Vector, Any, Vector, Vector]):
    """`EightBallEnv` with `Discrete` actions: the open pots, by ball, pocket and speed, or a safety.

    Action `((ball - 1) * 6 + pocket) * 3 + speed` aims the pot that geometry finds (squirt, swerve and throw reckoned
    with), struck in the middle; `SAFETY` is the last one. `info["action_mask"]`, (n,) int8, says which can be played,
    as `action_space.sample(mask)` takes it; another is played as `SAFETY`. The break is always struck as hard as can be
    at the apex, the first decision offered is taken, and a cue ball in hand goes where the most forgiving pot is.

    Args:
        env: an `EightBallEnv`, wrapped or not.
    """

    def __init__(self, env: gymnasium.Env[Vector, Vector]) -> None:
        super().__init__(env)
        if not isinstance(env.unwrapped, EightBallEnv):
            raise TypeError(f"env = {env}: must be an EightBallEnv")
        self._of = env.unwrapped
        self.action_space = Discrete(SAFETY + 1)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Vector, dict[str, Any]]:
        """As the environment; with the mask."""
        seen, info = self.env.reset(seed=seed, options=options)
        return seen, self._looked_at(info)

    def step(self, action: int) -> tuple[Vector, Any, bool, bool, dict[str, Any]]:
        """Play the action; raises ValueError unless it is one of the space's."""
        if not self.action_space.contains(action):
            raise ValueError(f"action = {action!r}: must be an integer from 0 to {SAFETY}")
        game, table = self._of.game, self._of.table
        seen, reward, over, cut, info = self.env.step(encode(table, game, self._action(table, game, int(action))))
        return seen, reward, over, cut, self._looked_at(info)

    def _looked_at(self, info: dict[str, Any]) -> dict[str, Any]:
        """The mask, and what it was made from kept for the next step."""
        game = self._of.game
        mask: NDArray[np.int8] = np.zeros(SAFETY + 1, np.int8)
        mask[SAFETY] = 1
        self._place, self._pots = None, {}
        if game.phase is Phase.PLAY:
            self._place, pots = _best_place(self._of.table, game)
            self._pots = {(pot.ball, pot.pocket): pot for pot in pots}
            for ball, pocket in self._pots:
                first = ((ball - 1) * N_POCKETS + pocket) * len(SPEEDS)
                mask[first : first + len(SPEEDS)] = 1
        return info | {"action_mask": mask}

    def _action(self, table: Table, game: Game, number: int) -> Action:
        if game.decisions:
            return Action(decision=game.decisions[0])
        if game.phase is Phase.BREAK:
            behind = 0.5 * table.width, table.head_string + table.ball_radius
            return _at(table, game.state.moved(0, behind), table.foot_spot, table.v_max, behind)
        state = game.state if self._place is None else game.state.moved(0, self._place)
        target, speed = divmod(number, len(SPEEDS))
        pot = self._pots.get((target // N_POCKETS + 1, target % N_POCKETS)) if number != SAFETY else None
        if pot is None:
            return _at(table, state, _nearest(game, state), SPEEDS[0], self._place)
        shot = geometry.aimed(table, state, pot, _raised(table, state, SPEEDS[speed], pot.phi))
        return Action(shot, Call(pot.ball, pot.pocket), self._place)


def _best_place(table: Table, game: Game) -> tuple[Point | None, list[Pot]]:
    """Where a cue ball in hand goes, None if it is not, and the open pots from there or from where it lies."""
    balls = callable_balls(game)
    if game.cue_ball_in_hand is None:
        return None, _pots(table, game.state, balls)
    places = geometry.lattice(table, game.state, COLUMNS, ROWS, game.cue_ball_in_hand is CueBallArea.KITCHEN)
    found = [(place, _pots(table, game.state.moved(0, place), balls)) for place in places]
    return max(found, key=lambda each: max((pot.tolerance for pot in each[1]), default=0.0))


def _pots(table: Table, state: TableState, balls: tuple[int, ...]) -> list[Pot]:
    """Those that the cue can be laid on for."""
    return [pot for pot in geometry.pots(table, state, balls) if not math.isnan(min_elevation(table, state, pot.phi))]


def _nearest(game: Game, state: TableState) -> Point:
    """The nearest ball that may be struck first."""
    cue_ball = state.position(0)
    assert cue_ball is not None
    places = [place for ball in callable_balls(game) if (place := state.position(ball)) is not None]
    return min(places, key=lambda place: geometry.distance(cue_ball, place))


def _at(table: Table, state: TableState, target: Point, speed: float, place: Point | None) -> Action:
    """A safety: a stroke straight at a place."""
    cue_ball = state.position(0)
    assert cue_ball is not None
    return Action(_raised(table, state, speed, geometry.azimuth(cue_ball, target)), "safety", place)


def _raised(table: Table, state: TableState, speed: float, phi: float) -> Shot:
    """A stroke at the middle of the ball, `MARGIN` degrees above the least elevation.

    Where the cue is blocked at every elevation the stroke is flat, and `act` turns it.
    """
    least = min_elevation(table, state, phi)
    return Shot(speed, phi, 0.0 if math.isnan(least) else min(table.theta_max, least + MARGIN))
