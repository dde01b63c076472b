"""Set-up positions, strokes aimed by ghost ball, and the ruling on what really happened."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import atan2, degrees, hypot, isnan
from typing import Any

import physics
from physics.facts import Facts
from physics.shot import Shot
from physics.state import TableState
from physics.table import Table
from referee.game import Action, Call, Game, Group, Phase, Ruling
from referee.rules import EightBall

TABLE = Table.olympiad()
RULES = EightBall(TABLE)
R = TABLE.ball_radius
SOLIDS = (Group.SOLIDS, Group.STRIPES)
"""Seat 0, who plays in these tests, has the solids."""
STRIPES = (Group.STRIPES, Group.SOLIDS)

Place = tuple[float, float]
Balls = Mapping[int, Place]


@dataclass(frozen=True)
class Played:
    """One stroke and its ruling."""

    before: Game
    action: Action
    result: physics.Result
    ruling: Ruling

    @property
    def facts(self) -> Facts:
        return self.result.facts

    @property
    def game(self) -> Game:
        return self.ruling.game

    def proof(self, rule: str) -> list[physics.Event]:
        """The events cited for a rule."""
        return [self.result.events[event] for one in self.ruling.evidence if one.rule == rule for event in one.events]


def situation(balls: Balls, phase: Phase = Phase.PLAY, **fields: Any) -> Game:
    """A game that stands so; seat 0 is in turn and broke unless said otherwise."""
    fields = {"turn": 0, "breaker": 0} | fields
    return Game(state=TableState.from_positions(balls), phase=phase, **fields)


def towards(start: Place, target: Place) -> float:
    """Azimuth in degrees."""
    return degrees(atan2(target[1] - start[1], target[0] - start[0]))


def ghost(ball: Place, target: Place) -> Place:
    """Where the cue ball has to be to send ``ball`` to ``target``."""
    distance = hypot(target[0] - ball[0], target[1] - ball[1])
    scale = 2 * R / distance
    return ball[0] - scale * (target[0] - ball[0]), ball[1] - scale * (target[1] - ball[1])


def pot(balls: Balls, ball: int, pocket: int, v: float, b: float = -8.0, a: float = 0.0) -> Shot:
    """The stroke that sends ``ball`` to ``pocket``, the cue raised as far as need be."""
    mouth = tuple(TABLE.mouths[pocket].tolist())
    return stroke(balls, towards(balls[0], ghost(balls[ball], mouth)), v, b=b, a=a)


def stroke(balls: Balls, phi: float, v: float, b: float = 0.0, a: float = 0.0) -> Shot:
    """A stroke in direction ``phi`` with the lowest cue that clears balls and cushions."""
    theta = physics.min_elevation(TABLE, TableState.from_positions(balls), phi, a=a, b=b)
    assert not isnan(theta), "no elevation clears the cue"
    return Shot(v=v, phi=phi, theta=0.0 if theta == 0.0 else theta + 0.01, a=a, b=b)


def play(
    game: Game,
    shot: Shot,
    call: Call | tuple[int, int] | str | None = None,
    cue_ball: Place | None = None,
    rules: EightBall = RULES,
) -> Played:
    """Check, simulate, rule; the action has to be a legal one."""
    action = Action(shot=shot, call=Call(*call) if isinstance(call, tuple) else call, cue_ball=cue_ball)  # type: ignore[arg-type]
    assert rules.check(game, action) == ()
    before = game.state if cue_ball is None else game.state.moved(0, cue_ball)
    result = physics.simulate(rules.table, before, shot)
    ruling = rules.apply(game, action, result.facts, result.final)
    return Played(game, action, result, ruling)
