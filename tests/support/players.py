"""Simple players for tests of whole games: they aim at something they may call and never look ahead."""

import math
from dataclasses import dataclass, field
from typing import Literal

from physics import SeededStream, Shot, TableState, min_elevation
from protocol import View
from referee.game import Action, Call, Decision


@dataclass
class Potter:
    """Aims at the ghost ball of a ball and a pocket drawn from its own stream; ``strength`` is in m/s."""

    name: str = "potter"
    strength: float = 3.0
    stream: SeededStream = field(init=False)

    def __post_init__(self) -> None:
        self.stream = SeededStream(bytes(32), self.name)

    def __call__(self, view: View) -> Action:
        if "decision" in view.allowed.actions:
            return Action(decision=view.allowed.decisions[self.stream.below(len(view.allowed.decisions))])
        table, state = view.table_model(), view.state
        place = None
        if view.cue_ball_area is not None:
            place, state = self._place(view)
        for attempt in range(200):
            phi, call = self._aim(view, state)
            if attempt > 20:  # everything aimed at is out of the cue's reach: anywhere, then
                phi, call = 360.0 * self.stream.uniform(), call and "safety"
            theta = min_elevation(table, state, phi)
            if not math.isnan(theta) and theta < 60.0:
                return Action(Shot(self._speed(view), phi, theta + 1.0), call, place)
        return Action(decision=Decision.CONCEDE)

    def _speed(self, view: View) -> float:
        return 9.5 if view.phase == "break" else self.strength * (0.5 + self.stream.uniform())

    def _place(self, view: View) -> tuple[tuple[float, float], TableState]:
        assert view.cue_ball_area is not None
        (west, east), (south, north) = view.cue_ball_area.x, view.cue_ball_area.y
        others = view.state.removed(0)
        while True:
            x = west + (east - west) * self.stream.uniform()
            y = south + (north - south) * self.stream.uniform()
            clear = all(math.dist((x, y), others.positions[ball]) > 0.06 for ball in others.balls)
            if clear and view.table_model().contains(x, y):
                return (x, y), others.moved(0, (x, y))

    def _aim(self, view: View, state: TableState) -> tuple[float, Call | Literal["safety"] | None]:
        cue_x, cue_y = state.positions[0].tolist()
        if view.phase == "break":
            x, y = view.table_model().foot_spot
            return math.degrees(math.atan2(y - cue_y, x - cue_x)), None
        if not view.callable_balls:  # the 8 alone on an open table: only a safety may be called
            x, y = state.positions[8].tolist()
            return math.degrees(math.atan2(y - cue_y, x - cue_x)), "safety"
        ball = view.callable_balls[self.stream.below(len(view.callable_balls))]
        pocket = self.stream.below(6)
        (x, y), mouth = state.positions[ball].tolist(), view.table_model().mouths[pocket]
        reach = math.dist((x, y), mouth)
        diameter = 2.0 * view.table_model().ball_radius
        ghost = (x - diameter * (mouth[0] - x) / reach, y - diameter * (mouth[1] - y) / reach)
        return math.degrees(math.atan2(ghost[1] - cue_y, ghost[0] - cue_x)), Call(ball, pocket)
