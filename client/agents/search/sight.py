"""What the balls of many tables offer: straight pots and their chances, the elevation a stroke needs."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from client.agents.search import engine
from client.agents.search.race import Race
from client.agents.search.shots import PHI, THETA, Floats, Integers, Shots, Tables
from client.geometry.strokes import azimuths
from physics import Table
from referee.play.noise import NoiseModel
from referee.rules.batch_rulings import target_balls

LEAST_NOISE = 0.1
"""Level below which chances are not told apart: at noise 0 the widest margin is still the best."""
SIGMAS_FREE = 2.5
"""Standard deviations of direction and tip height that must leave the cue free, so that miscues are rare."""
ROOM = 0.02
"""Degrees above the least elevation, for rounding: at the least itself the cue touches."""
HIGHEST = 45.0
"""Degrees: a cue raised further makes the cue ball's path a guess."""


@dataclass(frozen=True, slots=True, eq=False)
class Pots:
    """Straight pots, (s, m), the likeliest of each table first; chance 0 where a table has fewer.

    Attributes:
        ball, pocket: the call. phi: deg. margin: deg, half of the directions that pot it. chance: under the noise.
    """

    ball: Integers
    pocket: Integers
    phi: Floats
    margin: Floats
    chance: Floats


@dataclass(frozen=True, slots=True)
class Valuation:
    """How tables are valued.

    Attributes:
        kitchen: m, the least y of a cue ball in hand. pots: False: the shooter pots nothing.
    """

    kitchen: float = 0.0
    pots: bool = True


class Sight:
    """Plane geometry on one table under one noise, or the Olympiad's at a level."""

    def __init__(self, table: Table, noise: float | NoiseModel) -> None:
        model = NoiseModel.of(noise)
        self._kernels = engine.geometry(table.has_jaws)
        self._table = table
        self._row = engine.table_row(table)
        self._slack, self._sigmas = SIGMAS_FREE * model.level, model.sigmas
        self.sigma = float(np.radians(model.sigmas.phi) * max(model.level, LEAST_NOISE))

    @property
    def has_jaws(self) -> bool:
        """Whether it is a real table's."""
        return self._table.has_jaws

    def survey(self, positions: Floats, hand: NDArray[np.bool_], kitchen: float = 0.0) -> Floats:
        """(n, 2, 5): what each table offers to either group; the columns are CHANCE and its fellows."""
        found = np.empty((len(positions), 2, 5))
        self._kernels.survey(
            self._row, np.ascontiguousarray(positions), self.sigma, hand, kitchen, self._kernels.new_memory(), found
        )
        return found

    def worths(
        self, tables: Tables, before: Floats, hand: NDArray[np.bool_], race: Race, valuation: Valuation
    ) -> Floats:
        """(n,): what each table is worth to its shooter in a race.

        Args:
            before: (n, 16, 2) m, the tables before the stroke that led there: those alike cost less.
            hand: (n,) whether the cue ball is in hand.
        """
        found = np.empty(len(tables))
        shooters = (np.ascontiguousarray(tables.group, np.int8), hand)
        given = (self.sigma, valuation.kitchen, -math.log(race.habits.after_pot), valuation.pots)
        positions = np.ascontiguousarray(tables.positions)
        memory = self._kernels.new_memory()
        before = np.ascontiguousarray(before)
        self._kernels.worths(self._row, before, positions, shooters, given, race.values, memory, found)
        return found

    def pots(self, tables: Tables, most: int, targets: NDArray[np.bool_] | None = None) -> Pots:
        """The best straight pots of each table; `targets` (s, 16) if not every ball that may be called will do."""
        shape = (len(tables), most)
        pots = Pots(
            np.zeros(shape, np.int64), np.zeros(shape, np.int64), np.zeros(shape), np.zeros(shape), np.zeros(shape)
        )
        if targets is None:
            targets = target_balls(tables.positions, tables.group)
        found = (pots.ball, pots.pocket, pots.phi, pots.margin, pots.chance)
        self._kernels.list_pots(self._row, np.ascontiguousarray(tables.positions), targets, self.sigma, found)
        return pots

    def aimed(self, shots: Shots) -> Shots:
        """Straight pots, turned so that the ball leaves along its lane whatever squirt, swerve and throw do.

        On a table with straight mouths nothing squirts, and throw stays within the mouth: there they are left alone.
        """
        if not self._table.has_jaws or not len(shots):
            return shots
        rows, before = np.arange(len(shots)), shots.before()
        cue, ball = before[:, 0], before[rows, shots.ball]
        phi = np.radians(shots.strokes[:, PHI])
        step = np.stack((np.cos(phi), np.sin(phi)), axis=1)
        along = ((ball - cue) * step).sum(axis=1)
        gap = (ball - cue) - along[:, None] * step
        short = np.sqrt(np.maximum(4.0 * self._table.ball_radius**2 - (gap * gap).sum(axis=1), 0.0))
        way = gap + short[:, None] * step  # from the ghost ball to the ball
        leaving = np.degrees(np.arctan2(way[:, 1], way[:, 0]))
        return self.raised(shots.aimed(azimuths(self._table, cue, ball, leaving, shots.strokes)))

    def raised(self, shots: Shots, extra: Floats | float = 0.0) -> Shots:
        """The strokes with the cue raised as far as it has to be; those that cannot be played are left out.

        Args:
            extra: degrees beyond that, for jump shots.
        """
        strokes = shots.strokes.copy()
        strokes[:, THETA] = self.least(shots) + extra
        highest = np.where(np.asarray(extra) > 0.0, self._table.theta_max, min(HIGHEST, self._table.theta_max))
        return replace(shots, strokes=strokes)[strokes[:, THETA] <= highest]

    def least(self, shots: Shots) -> Floats:
        """(k,) deg: the least elevation that leaves the cue free under the noise; NaN where none does."""
        _, phi, _, a, b = shots.strokes.T
        theta = np.empty(len(shots))
        columns = (phi.copy(), a.copy(), b - self._slack * self._sigmas.b)
        positions = np.ascontiguousarray(shots.tables.positions)
        self._kernels.elevations(self._row, positions, shots.table, columns, self._slack * self._sigmas.phi, theta)
        least: Floats = theta + self._slack * self._sigmas.theta + ROOM
        return least
