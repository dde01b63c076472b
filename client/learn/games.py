"""Many games as arrays: looked at, played and begun anew by the compiled step."""

import math

import numpy as np
from numpy.typing import NDArray

from client.learn.codec import OBSERVATION_SIZE, TURNS, Floats, Integers, Vector
from client.learn.compiled import layout as to
from client.learn.engine import lattice_of, step, table_row
from client.learn.rows import NEW, game_of, row_of
from physics import Facts, Shot, Table, TableState, simulate_batch
from physics.constants import N_BALLS
from physics.engine import workspace
from physics.facts import FACTS_WORDS
from physics.parameters import parameters
from physics.rack import jitter_of
from physics.shot import FIELDS
from referee import Action, Decision, EightBall, Game, NoiseModel
from referee.rules.rack import places as triangle_of

RACK_TRIES = 3
"""Draws of a rack's disorder: one in 3,000 leaves two balls touching, and after so many the exact triangle is taken."""


class Games:
    """Games under way.

    Args:
        rules, noise: of all. count: how many. threads: of the physics. start: where each begins instead of a break.

    Attributes:
        places: (count, 16, 2) m, NaN for absent balls. state: (count, WIDTH) int64, columns by `compiled.layout`.
    """

    def __init__(self, rules: EightBall, noise: NoiseModel, count: int, threads: int = 1, start: Game | None = None):
        self.rules, self._noise, self._threads = rules, noise, threads
        self.places = np.full((count, N_BALLS, 2), np.nan)
        self.state = np.zeros((count, to.WIDTH), np.int64)
        self._start = None if start is None else (start.state.positions.copy(), row_of(start))
        self._step, table = step(), rules.table
        self._table, self._lattice = table_row(table), lattice_of(table)
        self._aim = self._step.aim_with_jaws if table.has_jaws else self._step.aim_straight
        self._parameters = parameters(table, rules.limits.events)
        self._limits = np.array([rules.limits.dry_visits, rules.limits.replays, rules.limits.strokes])
        self._sigmas = noise.level * noise.sigmas.row()
        self._triangle = np.array([place for row in triangle_of(table) for place in row])
        self._cue_ball = np.array([0.5 * table.width, table.head_string + table.ball_radius])

    @property
    def over(self) -> NDArray[np.bool_]:
        """(count,): whether the game has ended."""
        ended: NDArray[np.bool_] = self.state[:, to.PHASE] == to.OVER
        return ended

    def begin(self, rows: Integers, chance: np.random.Generator) -> None:
        """New games: racked, the breaker drawn, or from the position given."""
        if self._start is not None:
            self.places[rows], self.state[rows] = self._start
            return
        self.state[rows] = NEW
        self.state[rows, to.TURN] = self.state[rows, to.BREAKER] = chance.integers(2, size=len(rows))
        self._rack(rows, chance)

    def rewards(self, seats: Integers) -> Floats:
        """(count,): 1 for a game won by the seat, -1 for one lost, 0 while it goes on and for a draw."""
        winner = self.state[:, to.WINNER]
        won: Floats = np.where(winner == to.NOBODY, 0.0, np.where(winner == seats, 1.0, -1.0))
        return won

    def leads(self, seats: Integers) -> Floats:
        """(count,): how many more balls of the other group than of the seat's are left, of 7; 0 on an open table.

        Also 0 once the game is over: as a potential it then adds nothing to what an episode pays (`shaping`).
        """
        left = ~np.isnan(self.places[:, :, 0])
        solids, stripes = left[:, 1:8].sum(axis=1), left[:, 9:].sum(axis=1)
        group = self.state[:, to.GROUP]
        known = (group != to.OPEN) & (self.state[:, to.PHASE] != to.OVER)
        has_solids = (group == 0) == (seats == 0)
        lead: Floats = np.where(known, np.where(has_solids, stripes - solids, solids - stripes) / 7.0, 0.0)
        return lead

    def observed(self, rows: Integers, seats: Integers) -> Vector:
        """`codec.observe` of these games by these seats, (m, OBSERVATION_SIZE)."""
        seen = np.empty((len(rows), OBSERVATION_SIZE), np.float32)
        self._step.observe(self._table, self.places, self.state, rows, seats, seen)
        return seen

    def play(self, rows: Integers, vectors: NDArray[np.floating], chance: np.random.Generator) -> None:
        """One action in each of these games, (m, ACTION_SIZE) numbers, those beyond [-1, 1] counting as the bound.

        Raises:
            ValueError: an action holds NaN, or the cue is blocked in every direction.
        """
        count = len(rows)
        asked = np.ascontiguousarray(vectors, np.float64)
        if np.isnan(asked).any():
            raise ValueError(f"an action is {asked[np.isnan(asked).any(axis=1)][0].tolist()}; NaN is no number")
        before, shots = np.empty((count, N_BALLS, 2)), np.zeros((count, len(FIELDS)))
        calls, became = np.empty((count, 2), np.int64), np.zeros(count, np.int64)
        noise = self._sigmas, chance.standard_normal((count, len(FIELDS)))
        decides = self.state[rows, to.PHASE] == to.DECISION
        self._aim(
            *(self._parameters, workspace(), self._table, self._lattice, self.places, self.state, rows, asked),
            *(noise, before, shots, calls, became, TURNS),
        )
        self._refuse_blocked(before, became)
        self._referee_decides(rows[became == to.TO_REFEREE])
        strikes = np.flatnonzero(~decides)
        self._struck(rows[strikes], before[strikes], shots[strikes], calls[strikes])
        awaiting = rows[self.state[rows, to.PHASE] == to.RERACK]
        if len(awaiting):
            self.state[awaiting, to.RACK] += 1
            self._rack(awaiting, chance)

    def game(self, row: int) -> Game:
        """One of the games, as the referee knows it."""
        return game_of(self.places[row], self.state[row])

    def _struck(self, rows: Integers, before: Floats, shots: Floats, calls: Integers) -> None:
        """Simulate strokes and rule on them."""
        batch = simulate_batch(
            self.rules.table, before, shots, threads=self._threads, event_limit=self.rules.limits.events
        )
        facts = batch.facts.view(np.int32).reshape(len(rows), FACTS_WORDS)
        became = np.zeros(len(rows), np.int64)
        self._step.rule(
            *(self.rules.table.head_string, self._limits, self.places, self.state, rows),
            *(before, calls, batch.positions, facts, became),
        )
        for number in np.flatnonzero(became == to.TO_REFEREE).tolist():
            action = _as_submitted(before[number], shots[number])
            state = TableState.trusted(batch.positions[number].copy())
            ruled = self.rules.apply(self.game(int(rows[number])), action, Facts.from_words(facts[number]), state)
            self._take(int(rows[number]), ruled.game)

    def _referee_decides(self, rows: Integers) -> None:
        """The decision to have the 8 spotted: where it goes takes exact arithmetic, and it is rare."""
        for row in rows.tolist():
            self._take(row, self.rules.apply(self.game(row), Action(decision=Decision.SPOT_EIGHT)).game)

    def _take(self, row: int, game: Game) -> None:
        """Go on with a game as the referee has it."""
        self.places[row], self.state[row] = game.state.positions, row_of(game)

    def _refuse_blocked(self, before: Floats, became: Integers) -> None:
        for number in np.flatnonzero(became == to.UNSTRUCK).tolist():
            raise ValueError(f"the cue is blocked in every direction, the balls at {before[number].tolist()}")

    def _rack(self, rows: Integers, chance: np.random.Generator) -> None:
        """New balls for the break, the cue ball in hand in the kitchen."""
        uniforms, normals = chance.random((len(rows), 15)), chance.standard_normal((len(rows), RACK_TRIES, 15, 2))
        racked, table = np.empty((len(rows), N_BALLS, 2)), self.rules.table
        sigma, diameter = jitter_of(table.rack_gap), 2.0 * table.ball_radius
        self._step.rack(self._triangle, diameter, sigma, self._cue_ball, uniforms, normals, racked)
        self.places[rows] = racked
        self.state[rows, to.PHASE], self.state[rows, to.AREA] = to.BREAK, to.KITCHEN


def checked_shaping(shaping: float) -> float:
    """The weight of a step's gain; raises ValueError unless it is a number from 0 on."""
    if isinstance(shaping, bool) or not isinstance(shaping, int | float) or not 0.0 <= shaping < math.inf:
        raise ValueError(f"shaping = {shaping!r}: must be a number from 0 on")
    return float(shaping)


def referee_of(table: Table | None) -> EightBall:
    """The referee on a table; the Olympiad's unless given."""
    return EightBall(table or Table.olympiad())


def _as_submitted(before: Floats, shot: Floats) -> Action:
    """A break as a player would submit it; its noise does not matter to the referee."""
    x, y = before[0].tolist()
    return Action(shot=Shot(*shot.tolist()), cue_ball=(x, y))
