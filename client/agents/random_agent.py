"""`random`: any legal action. The weakest opponent, and the smallest complete example of an agent."""

from collections.abc import Sequence
from typing import Literal, TypeVar

import physics
from client.agent import Agent
from client.agents.chance import generator
from client.geometry import Point, is_free
from protocol import View
from referee import SAFETY, Action, Call, CueBallArea

Choice = TypeVar("Choice")

SLOWEST, FASTEST = 0.5, 6.0
"""m/s, the range of its cue speeds."""
ELEVATION_MARGIN = 0.5
"""Degrees above the least elevation, so that noise seldom lets the cue be blocked."""
TRIES = 1000
"""Draws of a direction or a place before giving up; even on a full table most draws are playable."""


class RandomAgent(Agent):
    """Plays any stroke that the referee does not refuse, and makes any decision but to concede.

    Args:
        seed: repeats its choices; None draws fresh ones.
    """

    def __init__(self, seed: int | None = None) -> None:
        self._seed = seed

    def game_started(self, view: View) -> None:
        """Seed the choices of this game."""
        self._chance = generator(self._seed, view)

    def choose(self, view: View) -> Action:
        """Any legal action."""
        if view.allowed.decisions:
            return Action(decision=self._any(view.allowed.decisions))
        place = self._place(view)
        state = view.state if place is None else view.state.moved(0, place)
        return Action(shot=self._shot(view.table_model(), state), call=self._call(view), cue_ball=place)

    def _call(self, view: View) -> Call | Literal["safety"] | None:
        """Any ball that may be called, into any pocket; a safety when only the 8 is left on an open table."""
        if not view.allowed.call_required:
            return None
        if not view.callable_balls:
            return SAFETY
        return Call(self._any(view.callable_balls), int(self._chance.integers(6)))

    def _place(self, view: View) -> Point | None:
        """Any free place in the area where the cue ball is in hand."""
        area = view.cue_ball_area
        if area is None:
            return None
        for _ in range(TRIES):
            place = float(self._chance.uniform(*area.x)), float(self._chance.uniform(*area.y))
            if is_free(view.table_model(), view.state, place, kitchen=area.name is CueBallArea.KITCHEN):
                return place
        raise RuntimeError(f"no free place for the cue ball in {area!r} after {TRIES} draws")

    def _shot(self, table: physics.Table, state: physics.TableState) -> physics.Shot:
        """Any direction in which the cue is free, at any speed."""
        for _ in range(TRIES):
            phi = float(self._chance.uniform(0.0, 360.0))
            theta = physics.min_elevation(table, state, phi)
            if theta + ELEVATION_MARGIN <= table.theta_max:  # False for NaN: blocked at every elevation
                return physics.Shot(float(self._chance.uniform(SLOWEST, FASTEST)), phi, theta + ELEVATION_MARGIN)
        raise RuntimeError(f"no direction is free for the cue after {TRIES} draws: {state!r}")

    def _any(self, choices: Sequence[Choice]) -> Choice:
        """One of the choices, each as likely."""
        return choices[int(self._chance.integers(len(choices)))]
