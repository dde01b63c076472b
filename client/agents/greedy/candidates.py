"""Strokes worth considering: every open pot at a few speeds, a fan of other directions, breaks.

Each is played at the least elevation at which the cue is free, plus what the noise may take away.
"""

import math
from collections.abc import Iterable, Sequence

from client.agents.greedy.plan import Plan
from client.geometry import Point, Pot, azimuth, pots
from physics import Shot, Table, TableState, min_elevation
from referee import SAFETY, Action, Call

POT_SPEEDS = (0.8, 1.4, 2.4, 4.0)
"""m/s of the cue: from just enough for a short pot to enough for the length of the table with a thin cut."""
FAN_SPEEDS = (1.0, 2.0, 4.0)
FAN_DIRECTIONS = 72
"""Every 5 degrees: a ball a metre away fills 6.5 degrees, so the fan finds most contacts."""
BREAK_SPEEDS = (1.0, 0.9)
"""Shares of the table's greatest cue speed."""
BREAK_OFFSETS = (-1.5, 0.0, 1.5)
"""Where the break aims, in millimetres beside the apex ball's centre."""
ELEVATION_MARGIN = 0.3
"""Degrees above the least elevation for each noise level: three standard deviations."""


class Candidates:
    """Makes plans on one table under one noise level."""

    def __init__(self, table: Table, noise: float) -> None:
        self._table = table
        self._margin = ELEVATION_MARGIN * noise

    def pots(self, before: TableState, place: Point | None, balls: Sequence[int], most: int) -> list[Plan]:
        """The `most` easiest open pots of `balls`, each at several speeds."""
        easiest = pots(self._table, before, balls)[:most]
        return [plan for pot in easiest for plan in self._pot(before, place, pot)]

    def fan(self, before: TableState, place: Point | None) -> list[Plan]:
        """Strokes in all directions, called as safeties."""
        directions = (360.0 * index / FAN_DIRECTIONS for index in range(FAN_DIRECTIONS))
        return [
            plan for phi in directions for plan in self._at_speeds(before, place, phi, FAN_SPEEDS, SAFETY)
        ]

    def breaks(self, before: TableState, place: Point) -> list[Plan]:
        """Full strokes at the apex ball, and a little beside it."""
        x, y = self._table.foot_spot
        speeds = tuple(share * self._table.v_max for share in BREAK_SPEEDS)
        aims = (azimuth(place, (x + 1e-3 * offset, y)) for offset in BREAK_OFFSETS)
        return [plan for phi in aims for plan in self._at_speeds(before, place, phi, speeds, None)]

    def _pot(self, before: TableState, place: Point | None, pot: Pot) -> list[Plan]:
        """One pot at several speeds."""
        return self._at_speeds(before, place, pot.phi, POT_SPEEDS, Call(pot.ball, pot.pocket))

    def _at_speeds(
        self,
        before: TableState,
        place: Point | None,
        phi: float,
        speeds: Iterable[float],
        call: Call | str | None,
    ) -> list[Plan]:
        """Plans in one direction; none where the cue is blocked at every elevation."""
        least = min_elevation(self._table, before, phi)
        if math.isnan(least):
            return []
        theta = min(self._table.theta_max, least + self._margin)
        return [Plan(Action(shot=Shot(v, phi, theta), call=call, cue_ball=place), before) for v in speeds]
