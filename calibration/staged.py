"""One shot staged: it is matched up to its first meeting, then one meeting further, and so on.

A shot's residuals are smooth only as long as its events keep their order, so a fit of whole paths stays in whatever
order it begins in. Here a shot gets its next meeting only when the model follows the paths up to there; where it does
not, other starts are drawn; and a shot that no start explains is kept up to the meeting where it parts.
"""

import numpy as np

from calibration.observed import Floats, ObservedShot
from calibration.outliers import outliers
from calibration.reduced import Member
from calibration.shot_fit import ShotFit, fit_shot, search_shot
from calibration.shot_model import ShotModel
from physics import Table

FOLLOWED = 5.0
"""Root mean square of residuals, in standard deviations, up to which the model follows the paths."""
FOLLOWED_METRES = 3e-3
"""The same where the noise is smaller: parameters are not known yet."""
NEAR, NEAR_METRES = 25.0, 0.025
"""The same of a whole path that the model comes so near to that it is matched at once."""
STRAY, NO_STRAY = 6.0, 4.5
"""Standard deviations of a sample that is left out after the fit, and of those beside it at most."""
SAMPLES_PER_STRAY = 100
"""A shot may lose one sample, and one more for every hundred it has."""
MILD = 4.0
"""A shot whose root mean square is above this counts less in a stage, so that one in a wrong order moves nobody."""
PATIENCE = 2
"""Rounds without progress before a shot is given up."""
SPREADS = (2.0, 6.0)
"""How far starts are drawn, in standard deviations of the nuisances; every second time the second."""
WALKED, WALK_SPREADS, MOST_WALKED = 1.5, (1.0, 2.0), 40
"""Root mean square above which starts are drawn for a shot that is begun anew at parameters near the right ones, how
far, and over how many meetings: a ball that rattles in a jaw has many more."""
CAUGHT = 0.5
"""Fall of the cost, in standard deviations squared, that slopes may promise at a smooth minimum."""
BADLY = 2.5
"""Standard deviations of a shot's cost above what noise alone gives, beyond which another order is looked for."""


class StagedShot:
    """One shot on its way to its last sample.

    Attributes:
        member: its place in the joint fit. horizon: s of the data, up to where it is matched; infinite at the end.
        given_up: no order of events was found that goes further.
        is_searched: other orders were looked for in vain, with the other shots' parameters.
    """

    def __init__(self, model: ShotModel, shot: ObservedShot, table: Table) -> None:
        self.model = model
        self.horizon = -np.inf
        self.given_up = False
        self.is_searched = False
        self._failed = 0
        bad = outliers(shot, model.sigma)
        self.outliers = bad
        self._base = np.concatenate(((~bad[model.sample_of_row]).astype(float), np.ones(len(model.names))))
        self._row_times = shot.times[model.sample_of_row]
        self.member = self._begun(table)

    @property
    def is_whole(self) -> bool:
        """Whether all of it is matched."""
        return bool(np.isinf(self.horizon) and self.horizon > 0.0)

    def weights(self, horizon: float) -> Floats:
        """(n + k,) of the rows: 0 for outliers and for what lies beyond the horizon."""
        weights = self._base.copy()
        weights[: self.model.n_samples][self._row_times > horizon] = 0.0
        return weights

    def _begun(self, table: Table) -> Member:
        """The samples before the first meeting; at least those of the first guess."""
        model = self.model
        self.horizon = self._first_horizon(table)
        weights = self.weights(self.horizon)
        fit = fit_shot(model, table, model.means, weights)
        if fit is None:  # not playable as guessed: balls in the cue's way do not count, so the speed is out of range
            means = np.where(np.arange(len(model.means)) == 0, 0.5 * table.v_max, model.means)
            fit = fit_shot(model, table, means, weights)
        if fit is None:
            rows = len(weights)
            fit = ShotFit(model.means, np.full(rows, 1e3), np.zeros((rows, len(model.names))))
            self.given_up = True
        return Member(model, fit, weights)

    def _first_horizon(self, table: Table) -> float:
        model = self.model
        times = np.unique(self._row_times[self._row_times >= model.strike_time(model.means)])
        least = float(times[min(len(times) - 1, 3)])
        return max(least, self._meeting_after(table, model.means, -np.inf))

    def _meeting_after(self, table: Table, nuisances: Floats, time: float) -> float:
        """s of the data: the first meeting after a time; infinite if no sample comes after it."""
        result = self.model.run(table, nuisances)
        if result is None:
            return np.inf
        strike = self.model.strike_time(nuisances)
        later = [strike + at for at, _ in self.model.meetings(result) if strike + at > time + 1e-9]
        return later[0] if later and later[0] < self._row_times.max() else np.inf

    def root_mean_square(self, fit: ShotFit, weights: Floats) -> float:
        """Of the samples that count, in standard deviations."""
        n = self.model.n_samples
        return float(np.sqrt(np.sum(fit.residuals[:n] ** 2) / max(1, int(np.count_nonzero(weights[:n])))))

    def follows(self, fit: ShotFit, weights: Floats) -> bool:
        """Whether the model follows the paths."""
        return self.root_mean_square(fit, weights) < max(FOLLOWED, FOLLOWED_METRES / self.model.sigma)

    def extend(self, table: Table) -> None:
        """Match everything if the model is near, else up to one meeting further."""
        self._before = self.member.fit, self.horizon
        whole = self.weights(np.inf)
        nuisances = self.member.fit.nuisances
        found = self.model.residuals(table, nuisances)
        if found is None:
            return
        fit = ShotFit(nuisances, whole * found, self.member.fit.slopes)
        if self.root_mean_square(fit, whole) < max(NEAR, NEAR_METRES / self.model.sigma):
            self._take(fit, np.inf)
            return
        horizon = self._meeting_after(table, nuisances, self.horizon)
        self._take(ShotFit(nuisances, self.weights(horizon) * found, self.member.fit.slopes), horizon)

    def _take(self, fit: ShotFit, horizon: float) -> None:
        """The weight of a shot that is off is lowered for all its rows."""
        self.horizon = horizon
        weights = self.weights(horizon)
        mild = min(1.0, MILD / self.root_mean_square(fit, weights)) if np.any(fit.residuals) else 1.0
        self.member.weights = mild * weights
        self.member.fit = ShotFit(fit.nuisances, mild * fit.residuals, mild * fit.slopes)

    def judge(self, table: Table, rng: np.random.Generator) -> None:
        """After the parameters moved: is it followed up to the horizon? If not, search; else step back."""
        weights = self.weights(self.horizon)
        fit = fit_shot(self.model, table, self.member.fit.nuisances, weights, steps=3)
        if fit is None or not self.follows(fit, weights):
            about, horizon = self._before
            found = search_shot(self.model, table, about, weights, SPREADS[self._failed % len(SPREADS)], rng)
            if found is not None and (fit is None or found.cost < fit.cost):
                fit = found
            if fit is None or not self.follows(fit, weights):
                self._failed += 1
                self.given_up = self._failed > PATIENCE
                self._take(about, horizon)
                return
        self._failed = 0
        self._take(fit, self.horizon)

    def silence(self) -> None:
        """Let none of its samples count."""
        weights = self.member.weights.copy()
        weights[: self.model.n_samples] = 0.0
        fit = self.member.fit
        still = (weights > 0.0).astype(float)
        self.member.weights = weights
        self.member.fit = ShotFit(fit.nuisances, still * fit.residuals, still[:, None] * fit.slopes)

    def look_again(self, table: Table, before: ShotFit, weights: Floats, rng: np.random.Generator) -> None:
        """Count again, from the best of several starts at these parameters; the whole if the model follows it."""
        whole = self.weights(np.inf)
        best = self._best(table, before, whole, rng)
        if not self.follows(best, whole) or self.excess_of(best, whole) > BADLY:
            walked = self._walked(table, rng)
            if walked is not None and walked.cost < best.cost:
                best = walked
        if self.follows(best, whole):
            self.horizon, self.member.weights, self.member.fit = np.inf, whole, best
        else:
            self.member.weights, self.member.fit = weights, self._best(table, before, weights, rng)

    def _best(self, table: Table, before: ShotFit, weights: Floats, rng: np.random.Generator) -> ShotFit:
        found = [fit_shot(self.model, table, before.nuisances, weights)]
        found += [search_shot(self.model, table, before, weights, spread, rng) for spread in SPREADS]
        residuals = np.full(len(weights), 1e3)
        worst = ShotFit(before.nuisances, residuals, before.slopes)
        return min((fit for fit in found if fit is not None), key=lambda fit: fit.cost, default=worst)

    def _walked(self, table: Table, rng: np.random.Generator) -> ShotFit | None:
        """Begun anew at these parameters, and matched meeting by meeting to its end; None where no start follows one.

        Starts are drawn from what the samples before a meeting say, which is wide enough for every order after it.
        """
        horizon = self._first_horizon(table)
        fit = fit_shot(self.model, table, self.model.means, self.weights(horizon))
        for _ in range(MOST_WALKED):
            if fit is None:
                break
            horizon = self._meeting_after(table, fit.nuisances, horizon)
            weights = self.weights(horizon)
            found = [fit_shot(self.model, table, fit.nuisances, weights)]
            if found[0] is None or self.root_mean_square(found[0], weights) > WALKED:
                found += [search_shot(self.model, table, fit, weights, spread, rng) for spread in WALK_SPREADS]
            fit = min((one for one in found if one is not None), key=lambda one: one.cost, default=None)
            if fit is None or not self.follows(fit, weights):
                break
            if np.isinf(horizon):
                return fit
        return None

    @property
    def counted(self) -> int:
        """Rows of samples that count."""
        return int(np.sum(self.member.weights[: self.model.n_samples] > 0.0))

    @property
    def excess(self) -> float:
        """By how many of its own standard deviations the cost is above what noise alone gives."""
        return self.excess_of(self.member.fit, self.member.weights)

    def excess_of(self, fit: ShotFit, weights: Floats) -> float:
        """The same of another fit."""
        counted = int(np.count_nonzero(weights[: self.model.n_samples]))
        return (self.root_mean_square(fit, weights) ** 2 - 1.0) * float(np.sqrt(counted / 2.0))

    def badness(self, promised: float) -> float:
        """Above 1 for a shot whose order of events is to be looked for; ``promised``: the fall that its slopes say."""
        if self.is_searched:
            return 0.0
        return max(self.excess / BADLY, promised / CAUGHT) if self.is_whole else np.inf

    def judge_samples(self, table: Table) -> bool:
        """Leave out single samples far off a path that is otherwise followed, and take back those that lie on it.

        Where several are off, it is the path that is wrong: about collisions in the wrong order every second sample may
        be. True if there was anything to do.
        """
        off = self.model.residuals(table, self.member.fit.nuisances) if self.is_whole else None
        if off is None:
            return False
        rows = np.abs(off[: self.model.n_samples])
        worst = np.zeros(len(self.outliers))
        np.maximum.at(worst, self.model.sample_of_row, rows)
        strays = np.zeros(len(worst), bool)
        for ball in self.model.shot.numbers:
            mine = self.model.shot.of_ball(ball)
            beside = np.pad(worst[mine], 1)
            strays[mine] = (worst[mine] > STRAY) & (np.maximum(beside[:-2], beside[2:]) < NO_STRAY)
        if strays.sum() > 1 + len(strays) // SAMPLES_PER_STRAY:
            strays[:] = False
        changed = (self.outliers & (worst < NO_STRAY)) | (strays & ~self.outliers)
        self.outliers ^= changed
        self.is_searched &= not changed.any()
        self._base[: self.model.n_samples] = ~self.outliers[self.model.sample_of_row]
        return bool(changed.any())

    def settle(self, table: Table) -> None:
        """Full weight up to the horizon, for the last fit."""
        weights = self.weights(self.horizon)
        fit = fit_shot(self.model, table, self.member.fit.nuisances, weights, steps=2)
        if fit is not None:
            self.member.weights, self.member.fit = weights, fit
