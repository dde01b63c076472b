"""A quick player for studies that need hundreds of whole games: it plays an open pot by geometry alone.

The careful one takes the easiest pot, the careless one any open pot. Without one, both roll the cue ball at a ball
of theirs.
"""

import math
from typing import Literal

import client
from client.agents.chance import generator
from client.geometry import Point, Pot, azimuth, lattice, pots
from physics import Shot, Table, TableState, min_elevation
from protocol import View
from referee import SAFETY, Action, Call, CueBallArea, Decision, EightBall, Game, Phase

PREFERRED = (Decision.BALL_IN_HAND, Decision.SPOT_EIGHT, Decision.ACCEPT_TABLE, Decision.RERACK_AND_BREAK)
SLACK = 1.0
"""Degrees above the least elevation, so that noise seldom makes the cue touch something."""
COLUMNS, ROWS = 3, 4
"""Places tried with the cue ball in hand."""


class Potter(client.Agent):
    """Plays pots.

    Args:
        careful: takes the easiest pot; else any open one.
        seed: repeats its choices.
    """

    def __init__(self, careful: bool, seed: int) -> None:
        self._careful, self._seed = careful, seed

    def game_started(self, view: View) -> None:
        """Set up for the game's table."""
        self._chance = generator(self._seed, view)
        self._rules = EightBall(view.table_model())

    def choose(self, view: View) -> Action:
        """A stroke, or the first choice of a fixed order."""
        if view.allowed.decisions:
            return Action(decision=next((one for one in PREFERRED if one in view.allowed.decisions), Decision.CONCEDE))
        game = view.to_game()
        places = self._places(game)
        if game.phase is Phase.BREAK:
            return self._stroke(game.state.moved(0, places[0]), self._rules.table.foot_spot, 9.5, None, places[0])
        balls = self._rules.legal(game).callable
        tables = [(place, game.state if place is None else game.state.moved(0, place)) for place in places]
        found = [
            (pot, place, state)
            for place, state in tables
            for pot in pots(self._rules.table, state, balls)
            if not math.isnan(min_elevation(self._rules.table, state, pot.phi))
        ]
        if found:
            return self._pot(*self._chosen(found))
        place, state = tables[0]
        target = state.position(balls[int(self._chance.integers(len(balls)))]) or self._rules.table.foot_spot
        return self._stroke(state, target, 2.0, SAFETY, place)

    def _places(self, game: Game) -> list[Point | None]:
        if game.cue_ball_in_hand is None:
            return [None]
        kitchen = game.cue_ball_in_hand is CueBallArea.KITCHEN
        return list(lattice(self._rules.table, game.state.removed(0), COLUMNS, ROWS, kitchen=kitchen))

    def _chosen(self, found: list[tuple[Pot, Point | None, TableState]]) -> tuple[Pot, Point | None, TableState]:
        if self._careful:
            return max(found, key=lambda each: each[0].tolerance)
        return found[int(self._chance.integers(len(found)))]

    def _pot(self, pot: Pot, place: Point | None, state: TableState) -> Action:
        v = min(6.0, (1.0 + pot.cue_distance + 1.5 * pot.ball_distance) / max(0.3, math.cos(math.radians(pot.cut))))
        return self._stroke(state, pot.ghost, v, Call(pot.ball, pot.pocket), place)

    def _stroke(
        self, state: TableState, target: Point, v: float, call: Call | Literal["safety"] | None, place: Point | None
    ) -> Action:
        table: Table = self._rules.table
        cue_ball = state.position(0)
        phi = 0.0 if cue_ball is None else azimuth(cue_ball, target)
        while math.isnan(least := min_elevation(table, state, phi)):
            phi = float(self._chance.uniform(0.0, 360.0))  # the cue is blocked: somewhere else
        return Action(shot=Shot(v, phi, min(least + SLACK, table.theta_max)), call=call, cue_ball=place)
