"""What a calibration found: parameters with intervals, and how well each shot is explained."""

import dataclasses

import numpy as np

from calibration.observed import Floats
from calibration.shot_model import STROKE, THETA, elevation_slope
from calibration.staged import StagedShot
from physics import Result, Shot, Table

COVERED = 1.959964
"""Standard deviations on either side of a 95 % interval."""
UNEXPLAINED = 5.0
"""Standard deviations of a shot's cost above what noise alone gives: what is beyond is not explained."""
PARTS_AT = 6.0
"""Standard deviations at which a path is said to part from the model's."""


@dataclasses.dataclass(frozen=True, slots=True)
class FittedParameter:
    """One parameter.

    Attributes:
        name: of the table. value: fitted. before: what the table had.
        sigma: standard error, from the covariance. low, high: 95 % interval within the parameter's range.
        bootstrap: (low, high), the same from shots drawn again and again.
        is_determined: whether the data say anything of it.
    """

    name: str
    value: float
    before: float
    sigma: float
    low: float
    high: float
    bootstrap: tuple[float, float]
    is_determined: bool


@dataclasses.dataclass(frozen=True, eq=False)
class ExplainedShot:
    """How the model explains one shot.

    Attributes:
        name: of the shot. rms: of its residuals, in standard deviations. outliers: samples left out.
        is_explained: whether all of it is. why: if not, in words.
        stroke: as estimated. result: the shot simulated with it; None if it cannot be played.
        strike: s, the time of the strike in the data.
        residuals: (n, 2) m, model minus data, of all samples, in the order of the data.
        information: (5, 5) inverse covariance of the stroke's error in natural sizes, from the samples alone.
        pull: (5,) the gradient of half the cost of the samples there, by the stroke in natural sizes.
    """

    name: str
    rms: float
    outliers: int
    is_explained: bool
    why: str
    stroke: Shot
    result: Result | None
    strike: float
    residuals: Floats
    information: Floats
    pull: Floats


@dataclasses.dataclass(frozen=True, eq=False)
class Calibration:
    """A table fitted to observed paths.

    Attributes:
        table: with the fitted parameters. estimates: of each. correlations: (p, p) of their errors.
        shots: in the order of the data.
        noise: m, of one coordinate, as told or from the scatter of the paths. misfit: mean square of all residuals
            that count, in squares of it: about 1 where table and laws are right. excess: the same in its own standard
            deviations above 1.
        cost: sum of squares; freedom: samples less what was fitted.
    """

    table: Table
    estimates: tuple[FittedParameter, ...]
    correlations: Floats
    shots: tuple[ExplainedShot, ...]
    noise: float
    misfit: float
    excess: float
    cost: float
    freedom: float

    @property
    def unexplained(self) -> tuple[ExplainedShot, ...]:
        """The shots that the model does not explain."""
        return tuple(shot for shot in self.shots if not shot.is_explained)

    @property
    def is_trusted(self) -> bool:
        """Whether the model explains the data: else some law or parameter that was not fitted is wrong."""
        return self.excess < UNEXPLAINED and len(self.unexplained) <= 0.2 * len(self.shots)

    def to_dict(self) -> dict[str, object]:
        """Plain values, for JSON."""
        return {
            "table": self.table.to_dict(),
            "estimates": [dataclasses.asdict(one) for one in self.estimates],
            "correlations": self.correlations.tolist(),
            "noise": self.noise,
            "misfit": self.misfit,
            "is_trusted": self.is_trusted,
            "shots": [
                {
                    "name": shot.name,
                    "rms": shot.rms,
                    "outliers": shot.outliers,
                    "is_explained": shot.is_explained,
                    "why": shot.why,
                    "stroke": shot.stroke.to_dict(),
                }
                for shot in self.shots
            ],
        }


def explained(staged: StagedShot, table: Table, scale: float) -> ExplainedShot:
    """A shot after the fit; ``scale``: mean square that noise alone is taken to give."""
    model, fit = staged.model, staged.member.fit
    nuisances = fit.nuisances
    stroke = model.stroke(nuisances)
    result = model.run(table, nuisances)
    (plain,) = model.rows(table, nuisances[None])
    n = len(model.shot.times)
    off = model.sigma * plain[: 2 * n].reshape(n, 2)
    weights = staged.weights(staged.horizon)
    rms = staged.root_mean_square(fit, weights)
    excess = (rms * rms / scale - 1.0) * float(np.sqrt(max(1, staged.counted) / 2.0))
    why = ""
    if not staged.is_whole:
        why = "another order of events: " + _parting(staged, result, plain)
    elif excess > UNEXPLAINED:
        why = "residuals too large: " + _parting(staged, result, plain)
    information, pull = _stroke_information(staged)
    return ExplainedShot(
        *(model.shot.name, rms, int(staged.outliers.sum()), not why, why, stroke, result),
        *(model.strike_time(nuisances), off, information, pull),
    )


def _parting(staged: StagedShot, result: Result | None, plain: Floats) -> str:
    """Where the paths part from the model's, and after what."""
    if result is None:
        return "no stroke was found"
    model = staged.model
    rows = np.abs(plain[: model.n_samples]) > PARTS_AT
    bad = np.flatnonzero(rows & ~staged.outliers[model.sample_of_row])
    if len(bad) == 0:
        return "everywhere a little"
    sample = int(model.sample_of_row[bad[0]])
    time, ball = float(model.shot.times[sample]), int(model.shot.balls[sample])
    strike = model.strike_time(staged.member.fit.nuisances)
    earlier = [words for at, words in model.meetings(result) if at + strike <= time]
    after = f", after {earlier[-1]}" if earlier else ""
    return f"ball {ball} parts from the model at {time:.3f} s{after}"


def _stroke_information(staged: StagedShot) -> tuple[Floats, Floats]:
    """What the samples say of the stroke, the other nuisances eliminated, its own priors left out."""
    model, fit = staged.model, staged.member.fit
    n, k = model.n_samples, len(STROKE)
    slopes, residuals = fit.slopes.copy(), fit.residuals.copy()
    slopes[n : n + k], residuals[n : n + k] = 0.0, 0.0
    slopes[:, THETA] /= elevation_slope(float(fit.nuisances[THETA]))
    stroke, others = slopes[:, :k], slopes[:, k:]
    space = np.linalg.qr(others)[0]
    projected = stroke - space @ (space.T @ stroke)
    return projected.T @ projected, projected.T @ (residuals - space @ (space.T @ residuals))
