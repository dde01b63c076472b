"""The order of events found: each shot is matched up to its first meeting, then one meeting further, and so on.

A shot's residuals are smooth only as long as its events keep their order, so a fit of whole paths stays in whatever
order it begins in. Here a shot gets its next meeting only when the model follows the paths up to there; where it does
not, other starts are drawn; and a shot that no start explains is kept up to the meeting where it parts.
"""

from collections.abc import Callable

import numpy as np

from calibration.joint import JointFit, Member
from calibration.observed import Floats, ObservedShot
from calibration.outliers import outliers
from calibration.parameters import Parameter
from calibration.shot_fit import ShotFit, fit_shot, search_shot
from calibration.shot_model import ShotModel
from physics import Table

FOLLOWED = 5.0
"""Root mean square of residuals, in standard deviations, up to which the model follows the paths."""
FOLLOWED_METRES = 3e-3
"""The same where the noise is smaller: parameters are not known yet."""
MILD = 4.0
"""A shot whose root mean square is above this counts less in a stage, so that one in a wrong order moves nobody."""
MOST_ROUNDS = 14
PATIENCE = 2
"""Rounds without progress before a shot is given up."""
SPREADS = (2.0, 6.0)
"""How far starts are drawn, in standard deviations of the nuisances; every second time the second."""
COARSE, COARSE_EVALUATIONS = 1e-3, 4
FINE, FINE_EVALUATIONS = 1e-8, 30

Observer = Callable[[str, float], None]
"""Told what is being done, and which part of all is done, 0 to 1."""


class StagedShot:
    """One shot on its way to its last sample.

    Attributes:
        member: its place in the joint fit. horizon: s of the data, up to where it is matched; infinite at the end.
        given_up: no order of events was found that goes further.
    """

    def __init__(self, model: ShotModel, shot: ObservedShot, table: Table) -> None:
        self.model = model
        self.horizon = -np.inf
        self.given_up = False
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
        times = np.unique(self._row_times[self._row_times >= model.strike_time(model.means)])
        least = float(times[min(len(times) - 1, 3)])
        self.horizon = max(least, self._meeting_after(table, model.means, -np.inf))
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
        return float(np.sqrt(np.sum(fit.residuals[:n] ** 2) / max(1.0, np.sum(weights[:n] > 0.0))))

    def follows(self, fit: ShotFit, weights: Floats) -> bool:
        """Whether the model follows the paths."""
        return self.root_mean_square(fit, weights) < max(FOLLOWED, FOLLOWED_METRES / self.model.sigma)

    def extend(self, table: Table) -> None:
        """Match everything if the model follows, else up to one meeting further."""
        self._before = self.member.fit, self.horizon
        whole = self.weights(np.inf)
        fit = fit_shot(self.model, table, self.member.fit.nuisances, whole, steps=6)
        if fit is not None and self.follows(fit, whole):
            self._take(fit, np.inf)
            return
        horizon = self._meeting_after(table, self.member.fit.nuisances, self.horizon)
        weights = self.weights(horizon)
        fit = fit_shot(self.model, table, self.member.fit.nuisances, weights, steps=6)
        if fit is not None:
            self._take(fit, horizon)

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
        fit = fit_shot(self.model, table, self.member.fit.nuisances, weights, steps=4)
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

    def settle(self, table: Table) -> None:
        """Full weight up to the horizon, for the last fit."""
        weights = self.weights(self.horizon)
        fit = fit_shot(self.model, table, self.member.fit.nuisances, weights, steps=2)
        if fit is not None:
            self.member.weights, self.member.fit = weights, fit


def match(
    table: Table,
    parameters: tuple[Parameter, ...],
    staged: list[StagedShot],
    rng: np.random.Generator,
    observer: Observer,
) -> JointFit:
    """All shots matched as far as they can be, and the parameters fitted to that."""
    joint = JointFit(table, parameters, [shot.member for shot in staged])
    for number in range(MOST_ROUNDS):
        waiting = [shot for shot in staged if not shot.is_whole and not shot.given_up]
        if not waiting:
            break
        done = sum(shot.is_whole for shot in staged)
        observer(f"{done} of {len(staged)} shots followed to their end", number / MOST_ROUNDS)
        for shot in waiting:
            shot.extend(joint.table)
        joint.solve(COARSE_EVALUATIONS, COARSE)
        for shot in waiting:
            shot.judge(joint.table, rng)
    observer("all shots together", 0.9)
    for shot in staged:
        shot.settle(joint.table)
    joint.solve(FINE_EVALUATIONS, FINE)
    return joint
