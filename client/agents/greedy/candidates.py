"""Strokes worth considering: every open pot at a few speeds, a fan of other directions, breaks.

Each is played at the least elevation at which the cue stays free whatever the noise does, within reason.
"""

import math
from collections.abc import Iterable, Sequence
from typing import Literal

from client.agents.greedy.planned_action import PlannedAction
from client.geometry import Point, Pot, aimed, azimuth, pots
from physics import Shot, Table, TableState, min_elevation
from referee import SAFETY, Action, Call
from referee.play.noise import NoiseModel

POT_SPEEDS = (0.8, 1.4, 2.4, 4.0)
"""m/s of the cue: from just enough for a short pot to enough for the length of the table with a thin cut."""
TIPS = (0.0, 7.0, -7.0)
"""Tip heights in mm: plain, follow and draw; they steer the cue ball clear of pockets."""
NEAR_SPEEDS = (0.8, 1.0, 1.25)
NEAR_TIPS = (-4.0, 0.0, 4.0)
NEAR_DIRECTIONS = (-0.2, 0.0, 0.2)
"""Factors of the speed, millimetres and degrees around a good plan: half the steps of the first look."""
FAN_SPEEDS = (1.0, 2.0, 4.0)
FAN_DIRECTIONS = 72
"""Every 5 degrees: a ball a metre away fills 6.5 degrees, so the fan finds most contacts."""
BREAK_SPEEDS = (1.0, 0.9)
"""Shares of the table's greatest cue speed."""
BREAK_OFFSETS = (-1.5, 0.0, 1.5)
"""Where the break aims, in millimetres beside the apex ball's centre."""
SIGMAS_OFF = 2.5
"""Standard deviations of direction and tip height that must leave the cue free, so that miscues are rare."""


class Candidates:
    """Makes plans on one table under one noise, or the Olympiad's at a level."""

    def __init__(self, table: Table, noise: float | NoiseModel) -> None:
        model = NoiseModel.of(noise)
        self._table = table
        self._slack, self._sigmas = SIGMAS_OFF * model.level, model.sigmas

    def pots(self, before: TableState, place: Point | None, balls: Sequence[int], most: int) -> list[PlannedAction]:
        """The `most` easiest open pots of `balls`, each at several speeds."""
        easiest = pots(self._table, before, balls)[:most]
        return [plan for pot in easiest for plan in self._pot(before, place, pot)]

    def fan(self, before: TableState, place: Point | None) -> list[PlannedAction]:
        """Strokes in all directions, called as safeties."""
        directions = (360.0 * index / FAN_DIRECTIONS for index in range(FAN_DIRECTIONS))
        return [plan for phi in directions for plan in self._aimed(before, place, phi, FAN_SPEEDS, SAFETY)]

    def breaks(self, before: TableState, place: Point) -> list[PlannedAction]:
        """Full strokes at the apex ball, and a little beside it."""
        x, y = self._table.foot_spot
        speeds = tuple(share * self._table.v_max for share in BREAK_SPEEDS)
        aims = (azimuth(place, (x + 1e-3 * offset, y)) for offset in BREAK_OFFSETS)
        return [plan for phi in aims for plan in self._aimed(before, place, phi, speeds, None)]

    def near(self, plan: PlannedAction) -> list[PlannedAction]:
        """The plan's neighbours in speed, tip height and direction."""
        shot, call, place = plan.action.shot, plan.action.call, plan.action.cue_ball
        if shot is None:
            return []
        speeds = tuple(min(self._table.v_max, factor * shot.v) for factor in NEAR_SPEEDS)
        return [
            each
            for turn in NEAR_DIRECTIONS
            for b in NEAR_TIPS
            for each in self._aimed(plan.before, place, shot.phi + turn, speeds, call, shot.b + b)
        ]

    def _pot(self, before: TableState, place: Point | None, pot: Pot) -> list[PlannedAction]:
        """One pot at several speeds and tip heights."""
        call = Call(pot.ball, pot.pocket)
        if not self._table.has_jaws:  # nothing squirts, and what is thrown stays within the mouth
            return [plan for b in TIPS for plan in self._aimed(before, place, pot.phi, POT_SPEEDS, call, b)]
        return [
            plan
            for b in TIPS
            for v in POT_SPEEDS
            for plan in self._aimed(before, place, self._azimuth(before, pot, v, b), (v,), call, b)
        ]

    def _azimuth(self, before: TableState, pot: Pot, v: float, b: float) -> float:
        """Where to aim so that the pot's ball leaves for its pocket."""
        theta = self._elevation(before, pot.phi, b)
        return pot.phi if math.isnan(theta) else aimed(self._table, before, pot, Shot(v, pot.phi, theta, 0.0, b)).phi

    def _aimed(
        self,
        before: TableState,
        place: Point | None,
        phi: float,
        speeds: Iterable[float],
        call: Call | Literal["safety"] | None,
        b: float = 0.0,
    ) -> list[PlannedAction]:
        """Plans in one direction; none where the cue is blocked at every elevation."""
        theta = self._elevation(before, phi, b)
        if math.isnan(theta):
            return []
        return [
            PlannedAction(Action(shot=Shot(v, phi, theta, 0.0, b), call=call, cue_ball=place), before) for v in speeds
        ]

    def _elevation(self, before: TableState, phi: float, b: float) -> float:
        """The least elevation (deg) at which the cue stays free under noise; NaN when there is none."""
        aside, lower = self._slack * self._sigmas.phi, b - self._slack * self._sigmas.b
        least = [min_elevation(self._table, before, phi + turn, 0.0, lower) for turn in (-aside, 0.0, aside)]
        theta = max(least) + self._slack * self._sigmas.theta
        return theta if theta <= self._table.theta_max else math.nan
