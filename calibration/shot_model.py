"""One shot as the model has it: residuals of its samples as a function of a table and of the shot's own unknowns.

Those unknowns, the *nuisances*, are the stroke, the time of the strike if the data do not know it, and where the balls
that moved lay at the start. Each has a prior: what was intended, or next to nothing.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from calibration.observed import Floats, Integers, ObservedShot
from calibration.start import first_velocity, places_at_rest, stroke_for
from physics import Result, Shot, Status, Table, TableState, simulate, simulate_paths
from physics.constants import BALL_RADIUS, N_BALLS
from physics.events import EventKind

STROKE = ("v", "phi", "theta", "a", "b")
THETA = STROKE.index("theta")
SCALES = {"v": 0.1, "phi": 0.1, "theta": 0.5, "a": 1.0, "b": 1.0, "strike": 0.01, "place": 1e-3}
"""Natural sizes: m/s, deg, deg, mm, mm, s, m. Nuisances are counted in these."""
DIFFERENCE = 1e-4
"""Step of a finite difference, in natural sizes: 0.1 um of a place, which 30 collisions blow up to millimetres."""
INTENDED = {"v": 0.5, "phi": 2.0, "theta": 0.5, "a": 3.0, "b": 3.0}
"""Standard deviations of a stroke about what was intended: several times any player's, so that they decide nothing."""
UNKNOWN = {"v": 3.0, "phi": 30.0, "theta": 1.0, "a": 8.0, "b": 8.0}
"""The same about the first guess, where nothing is known; places and times of strikes have those below."""
PLACE_SIGMA, STRIKE_SIGMA = 0.05, 0.1
LEVEL = 0.1
"""deg: half of it is the elevation where its nuisance is 0; far above, elevation and nuisance are the same."""
TOUCHING_SQUARED = (2.0 * BALL_RADIUS) ** 2
MOST_PARTINGS = 50
"""Rounds that part overlapping balls: a rack of 15 needs several."""
MEETINGS = (
    *(EventKind.BALL_COLLISION, EventKind.RAIL_COLLISION, EventKind.POCKET_COLLISION, EventKind.JAW_COLLISION),
    *(EventKind.RAIL_TOP, EventKind.OFF_TABLE),
)
"""Events whose order must be found: a ball meets something."""


class ShotModel:
    """The residuals of one shot.

    Attributes:
        shot: as observed. sigma: m, noise of a coordinate.
        names: of the nuisances: those of ``STROKE``, perhaps ``strike``, then ``x0``, ``y0``, ... of the moving balls.
            That of ``theta`` is any number: ``elevation`` has the angle to it.
        scales, means, sigmas: (k,) natural size, prior mean and prior standard deviation of each, in its own unit.
        n_samples: rows of residuals that belong to samples; k rows of the priors follow them.
    """

    def __init__(self, shot: ObservedShot, table: Table, sigma: float, strike_known: bool) -> None:
        self.shot, self.sigma = shot, sigma
        lay = {ball: places_at_rest(shot, ball, sigma) for ball in shot.numbers}
        self._at_rest = {ball: place for ball, (place, _) in lay.items()}
        self._moving = [ball for ball in shot.numbers if ball == 0 or lay[ball][1] < len(shot.of_ball(ball))]
        self._numbers = list(shot.numbers)
        self._columns = np.searchsorted(shot.numbers, shot.balls)
        self._one, self._other = np.triu_indices(len(shot.numbers), 1)
        self._strike_known = strike_known
        self._unique, self._which = np.unique(shot.times, return_inverse=True)
        self._seen_high = np.flatnonzero(~np.isnan(shot.heights)) if table.flies else np.zeros(0, np.int64)
        n = len(shot.times)
        self.n_samples = 2 * n + len(self._seen_high)
        self.sample_of_row: Integers = np.concatenate((np.repeat(np.arange(n), 2), self._seen_high))
        self.names = (*STROKE, *(() if strike_known else ("strike",)), *self._place_names())
        self.scales = np.array([SCALES.get(name, SCALES["place"]) for name in self.names])
        self.means, self.sigmas = self._priors(table)

    def _place_names(self) -> list[str]:
        return [f"{axis}{ball}" for ball in self._moving for axis in "xy"]

    def _priors(self, table: Table) -> tuple[Floats, Floats]:
        strike, guess = self._first_guess(table)
        means, sigmas = [], []
        for name in STROKE:
            intended = getattr(self.shot.stroke, name)
            mean = guess[name] if intended is None else intended
            means.append(elevation_nuisance(mean) if name == "theta" else mean)
            sigmas.append((UNKNOWN if intended is None else INTENDED)[name])
        if not self._strike_known:
            means.append(strike)
            sigmas.append(STRIKE_SIGMA)
        for ball in self._moving:
            means += self._at_rest[ball].tolist()
            sigmas += [PLACE_SIGMA, PLACE_SIGMA]
        return np.array(means), np.array(sigmas)

    def _first_guess(self, table: Table) -> tuple[float, dict[str, float]]:
        """(time of the strike, stroke) from the first samples of the cue ball."""
        rows = self.shot.of_ball(0)
        times, places = self.shot.times[rows], self.shot.places[rows]
        _, before = places_at_rest(self.shot, 0, self.sigma)
        first = max(0, min(before - 1, len(rows) - 3))
        if self._strike_known:
            first = max(0, min(int((times <= 0.0).sum()) - 1, len(rows) - 3))
        velocity = first_velocity(times[first:] - times[first], places[first:], self.sigma)
        strike = 0.0 if self._strike_known else float(times[first])
        v, phi = stroke_for(table, velocity)
        if self._strike_known and times[first] > 0.0:  # the ball lay where it comes from
            self._at_rest[0] = places[first] - times[first] * velocity
        return strike, {"v": v, "phi": phi, "theta": 0.0, "a": 0.0, "b": 0.0}

    def run(self, table: Table, nuisances: Floats) -> Result | None:
        """The shot simulated; None if it cannot be played."""
        playable, positions, strokes = self._starts(table, nuisances[None])
        if not playable[0]:
            return None
        result = simulate(table, TableState.trusted(positions[0]), Shot(*strokes[0].tolist()))
        return result if result.status is Status.AT_REST else None

    def _starts(self, table: Table, nuisances: Floats) -> tuple[NDArray[np.bool_], Floats, Floats]:
        """Which rows (r, k) can be tried, and their positions (r, 16, 2) and strokes (r, 5)."""
        strokes = nuisances[:, : len(STROKE)].copy()
        strokes[:, THETA] = elevation(strokes[:, THETA])
        v, theta, a, b = strokes[:, 0], strokes[:, THETA], strokes[:, 3], strokes[:, 4]
        playable = (v > 0.0) & (v <= table.v_max) & (theta <= table.theta_max)
        playable &= a * a + b * b <= 0.9e6 * BALL_RADIUS * BALL_RADIUS
        positions = np.full((len(nuisances), N_BALLS, 2), np.nan)
        for ball, place in self._at_rest.items():
            positions[:, ball] = place
        positions[:, self._moving] = nuisances[:, -2 * len(self._moving) :].reshape(len(nuisances), -1, 2)
        here = positions[:, self._numbers]
        across = here[:, self._one] - here[:, self._other]
        squares = across[:, :, 0] ** 2 + across[:, :, 1] ** 2
        inside = table.contains(here[:, :, 0], here[:, :, 1]).all(axis=1)
        wrong = ((squares < TOUCHING_SQUARED) & (squares > 0.0)).any(axis=1) | ~inside
        if wrong.any():
            for row in np.flatnonzero(wrong).tolist():
                placed(table, positions[row])
            here = positions[:, self._numbers]
            playable &= table.contains(here[:, :, 0], here[:, :, 1]).all(axis=1)
        return playable, positions, strokes

    def stroke(self, nuisances: Floats) -> Shot:
        """The stroke that these stand for."""
        stroke = nuisances[: len(STROKE)].copy()
        stroke[THETA] = elevation(stroke[THETA])
        return Shot(*stroke.tolist())

    def strike_time(self, nuisances: Floats) -> float:
        """s, in the data's time."""
        return 0.0 if self._strike_known else float(nuisances[len(STROKE)])

    def residuals(self, table: Table, nuisances: Floats) -> Floats | None:
        """(n_samples + k,) in standard deviations: of the samples, then of the nuisances; None if unplayable."""
        (row,) = self.rows(table, nuisances[None])
        return None if row[0] != row[0] else row

    def rows(self, table: Table, nuisances: Floats) -> Floats:
        """The same of many nuisances (r, k) at once: (r, n_samples + k), NaN in the rows that are unplayable."""
        playable, positions, strokes = self._starts(table, nuisances)
        if playable.all():
            return self._rows(table, nuisances, positions, strokes)
        found = np.full((len(nuisances), self.n_samples + len(self.names)), np.nan)
        if playable.any():
            found[playable] = self._rows(table, nuisances[playable], positions[playable], strokes[playable])
        return found

    def rows_on(self, tables: Sequence[Table], nuisances: Floats) -> Floats:
        """The same of one shot's nuisances (k,) on many tables: (r, n_samples + k)."""
        playable, positions, strokes = self._starts(tables[0], nuisances[None])
        found = np.full((len(tables), self.n_samples + len(self.names)), np.nan)
        here = positions[0, self._numbers]
        x, y = here[:, 0], here[:, 1]
        fit = [row for row, table in enumerate(tables) if table.contains(x, y).all() and strokes[0, 0] <= table.v_max]
        if playable[0] and fit:
            one = (np.repeat(given, len(fit), axis=0) for given in (nuisances[None], positions, strokes))
            found[fit] = self._rows([tables[row] for row in fit], *one)
        return found

    def _rows(self, tables: Table | Sequence[Table], nuisances: Floats, positions: Floats, strokes: Floats) -> Floats:
        times = self._unique if self._strike_known else self._unique - nuisances[:, len(STROKE), None]
        paths = simulate_paths(tables, positions, strokes, times, self._numbers)
        seen = paths.positions[:, self._which, self._columns]
        gone = np.isnan(seen)
        if gone.any():
            seen = np.where(gone, paths.left[:, self._columns], seen)
        n, count = len(self.shot.times), len(nuisances)
        parts = [((seen - self.shot.places) / self.sigma).reshape(count, 2 * n)]
        rows = self._seen_high
        if len(rows):
            high = np.nan_to_num(paths.heights[:, self._which[rows], self._columns[rows]]) - self.shot.heights[rows]
            parts.append(high / self.sigma)
        found: Floats = np.concatenate((*parts, (nuisances - self.means) / self.sigmas), axis=1)
        found[paths.status != Status.AT_REST.value] = np.nan
        return found

    def meetings(self, result: Result) -> list[tuple[float, str]]:
        """(time since the strike, words) of every event of a seen ball whose order must be found."""
        found = [event for event in result.events if event.kind in MEETINGS]
        return [(event.time, str(event).split("s  ", 1)[1]) for event in found]

    def linearised(self, table: Table, nuisances: Floats) -> tuple[Floats, Floats]:
        """``residuals`` (n_samples + k,), NaN if unplayable, and their ``slopes``."""
        steps = np.vstack((np.zeros(len(nuisances)), DIFFERENCE * np.diag(self.scales)))
        plain, *stepped = self.rows(table, nuisances + steps)
        return plain, self._slopes(table, nuisances, plain, np.array(stepped))

    def slopes(self, table: Table, nuisances: Floats, residuals: Floats) -> Floats:
        """(n_samples + k, k) derivatives of the residuals by the nuisances, these in natural sizes."""
        stepped = self.rows(table, nuisances + DIFFERENCE * np.diag(self.scales))
        return self._slopes(table, nuisances, residuals, stepped)

    def _slopes(self, table: Table, nuisances: Floats, residuals: Floats, stepped: Floats) -> Floats:
        columns = (stepped - residuals) / DIFFERENCE
        lost = np.flatnonzero(np.isnan(columns[:, 0]))
        if len(lost):
            back = DIFFERENCE * np.diag(self.scales)[lost]
            columns[lost] = (self.rows(table, nuisances - back) - residuals) / -DIFFERENCE
        return np.nan_to_num(columns.T)


def elevation(nuisances: Floats) -> Floats:
    """deg, above 0 for every number: smooth, so that a level cue is no edge at which a fit stops."""
    raised: Floats = 0.5 * (nuisances + np.hypot(nuisances, LEVEL))
    return raised


def elevation_nuisance(theta: float) -> float:
    """The number that ``elevation`` gives this angle for; that of half of ``LEVEL`` for less."""
    above = max(theta, 0.5 * LEVEL)
    return above - 0.25 * LEVEL * LEVEL / above


def elevation_slope(nuisance: float) -> float:
    """Derivative of ``elevation``."""
    return 0.5 * (1.0 + nuisance / math.hypot(nuisance, LEVEL))


def placed(table: Table, positions: Floats) -> Floats:
    """The nearest places that can be: overlapping balls moved apart evenly, balls beyond a cushion put at it."""
    here = [(ball, x, y) for ball, (x, y) in enumerate(positions.tolist()) if x == x]
    for _ in range(MOST_PARTINGS):
        apart = True
        for first, (one, x1, y1) in enumerate(here):
            for second in range(first + 1, len(here)):
                two, x2, y2 = here[second]
                across, along = x2 - x1, y2 - y1
                square = across * across + along * along
                if 0.0 < square < TOUCHING_SQUARED:
                    shift = (1.0 + 1e-9) * BALL_RADIUS / square**0.5 - 0.5
                    x1, y1 = x1 - shift * across, y1 - shift * along
                    here[first], here[second] = (one, x1, y1), (two, x2 + shift * across, y2 + shift * along)
                    apart = False
        if apart:
            break
    reach = getattr(table, "contact_distance", BALL_RADIUS)
    for ball, x, y in here:
        if not table.contains(x, y):
            x, y = min(max(x, reach), table.width - reach), min(max(y, reach), table.length - reach)
        positions[ball] = x, y
    return positions
