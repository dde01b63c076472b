"""One shot as the model has it: residuals of its samples as a function of a table and of the shot's own unknowns.

Those unknowns, the *nuisances*, are the stroke, the time of the strike if the data do not know it, and where the balls
that moved lay at the start. Each has a prior: what was intended, or next to nothing.
"""

import numpy as np

from calibration.observed import Floats, Integers, ObservedShot
from calibration.start import first_velocity, places_at_rest, stroke_for
from physics import InvalidState, Result, Shot, Status, Table, TableState, simulate
from physics.constants import BALL_RADIUS, N_BALLS
from physics.events import EventKind

STROKE = ("v", "phi", "theta", "a", "b")
SCALES = {"v": 0.1, "phi": 0.1, "theta": 0.5, "a": 1.0, "b": 1.0, "strike": 0.01, "place": 1e-3}
"""Natural sizes: m/s, deg, deg, mm, mm, s, m. Nuisances are counted in these."""
DIFFERENCE = 1e-4
"""Step of a finite difference, in natural sizes: 0.1 um of a place, which 30 collisions blow up to millimetres."""
INTENDED = {"v": 0.5, "phi": 2.0, "theta": 0.5, "a": 3.0, "b": 3.0}
"""Standard deviations of a stroke about what was intended: several times any player's, so that they decide nothing."""
UNKNOWN = {"v": 3.0, "phi": 30.0, "theta": 1.0, "a": 8.0, "b": 8.0}
"""The same about the first guess, where nothing is known; places and times of strikes have those below."""
PLACE_SIGMA, STRIKE_SIGMA = 0.05, 0.1
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
        scales, means, sigmas: (k,) natural size, prior mean and prior standard deviation of each, in its own unit.
        n_samples: rows of residuals that belong to samples; k rows of the priors follow them.
    """

    def __init__(self, shot: ObservedShot, table: Table, sigma: float, strike_known: bool) -> None:
        self.shot, self.sigma = shot, sigma
        lay = {ball: places_at_rest(shot, ball, sigma) for ball in shot.numbers}
        self._at_rest = {ball: place for ball, (place, _) in lay.items()}
        self._moving = [ball for ball in shot.numbers if ball == 0 or lay[ball][1] < len(shot.of_ball(ball))]
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
            means.append(guess[name] if intended is None else intended)
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
        positions = np.full((N_BALLS, 2), np.nan)
        for ball, place in self._at_rest.items():
            positions[ball] = place
        positions[self._moving] = nuisances[-2 * len(self._moving) :].reshape(-1, 2)
        v, phi, theta, a, b = nuisances[:5].tolist()
        if not (0.0 < v <= table.v_max and 0.0 <= theta <= table.theta_max):
            return None
        if a * a + b * b > 0.9e6 * BALL_RADIUS * BALL_RADIUS:
            return None
        try:
            result = simulate(table, TableState.trusted(placed(table, positions)), Shot(v, phi, theta, a, b))
        except InvalidState:
            return None
        return result if result.status is Status.AT_REST else None

    def strike_time(self, nuisances: Floats) -> float:
        """s, in the data's time."""
        return 0.0 if self._strike_known else float(nuisances[len(STROKE)])

    def residuals(self, table: Table, nuisances: Floats) -> Floats | None:
        """(n_samples + k,) in standard deviations: of the samples, then of the nuisances; None if unplayable."""
        result = self.run(table, nuisances)
        return None if result is None else self.residuals_of(result, nuisances)

    def residuals_of(self, result: Result, nuisances: Floats) -> Floats:
        """The same of a simulated shot."""
        times = np.clip(self._unique - self.strike_time(nuisances), 0.0, result.duration)
        places, heights = result.paths(times)
        seen = places[self._which, self.shot.balls]
        if np.isnan(seen).any():
            seen = self._filled(result, seen)
        off = (seen - self.shot.places) / self.sigma
        prior = (nuisances - self.means) / self.sigmas
        rows = self._seen_high
        if len(rows) == 0:
            return np.concatenate((off.ravel(), prior))
        high = np.nan_to_num(heights[self._which[rows], self.shot.balls[rows]]) - self.shot.heights[rows]
        return np.concatenate((off.ravel(), high / self.sigma, prior))

    def _filled(self, result: Result, seen: Floats) -> Floats:
        """A ball that has left the table stays where it left it."""
        left = {event.ball: event.states[0].position for event in result.events.of(EventKind.POCKET_COLLISION)}
        left |= {event.ball: event.states[0].position for event in result.events.of(EventKind.OFF_TABLE)}
        for row in np.flatnonzero(np.isnan(seen[:, 0])).tolist():
            ball = int(self.shot.balls[row])
            seen[row] = left.get(ball, self._at_rest[ball])
        return seen

    def meetings(self, result: Result) -> list[tuple[float, str]]:
        """(time since the strike, words) of every event of a seen ball whose order must be found."""
        found = [event for event in result.events if event.kind in MEETINGS]
        return [(event.time, str(event).split("s  ", 1)[1]) for event in found]

    def slopes(self, table: Table, nuisances: Floats, residuals: Floats) -> Floats:
        """(n_samples + k, k) derivatives of the residuals by the nuisances, these in natural sizes."""
        columns = np.zeros((len(residuals), len(nuisances)))
        for column, scale in enumerate(self.scales.tolist()):
            for step in (DIFFERENCE, -DIFFERENCE):
                moved = nuisances.copy()
                moved[column] += step * scale
                stepped = self.residuals(table, moved)
                if stepped is not None:
                    columns[:, column] = (stepped - residuals) / step
                    break
        return columns


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
