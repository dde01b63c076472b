"""A table calibrated from observed paths: the one call."""

from collections.abc import Sequence

import numpy as np

from calibration.errors import InvalidFit
from calibration.joint import JointFit
from calibration.matching import Observer, match
from calibration.observed import Floats, Observations
from calibration.parameters import Parameter, fitted_parameters, replaced
from calibration.result import COVERED, Calibration, FittedParameter, explained
from calibration.shot_model import ShotModel
from calibration.staged import StagedShot
from physics import Table

REPEATS = 1000
"""Draws of a bootstrap."""
DETERMINED = 0.2
"""Standard error, in widths of the parameter's range, from which on the data say nothing: a flat spread has 0.29."""


def calibrate(
    table: Table,
    observations: Observations,
    fit: Sequence[str],
    *,
    seed: int = 0,
    observer: Observer = lambda _words, _part: None,
) -> Calibration:
    """Fit parameters of a table to observed paths.

    Least squares over the parameters, and over each shot's stroke and start, which are eliminated shot by shot
    (``calibration.joint``); the order of events is found meeting by meeting (``calibration.staged``). Where residuals
    are larger than the noise, standard errors grow with them.

    Args:
        table: whose laws and other parameters hold, and where the fit begins.
        fit: names of parameters that ``table.replace`` changes.
        seed: of the starts that are drawn, and of the bootstrap.
        observer: told what is being done.

    Raises:
        InvalidFit: no such parameter; fewer shots than two.
    """
    parameters = fitted_parameters(table, fit)
    if len(observations.shots) < 2:
        raise InvalidFit("shots", len(observations.shots), "must be at least 2")
    rng = np.random.default_rng(seed)
    free = table.replace(cue_test=False)  # starts are uncertain, and what was played could be
    noise = observations.noise
    staged = [
        StagedShot(ShotModel(shot, free, noise, observations.strike_known), shot, free) for shot in observations.shots
    ]
    joint = match(free, parameters, staged, rng, observer)
    return _told(table, observations, parameters, joint, staged, rng)


def _told(
    table: Table,
    observations: Observations,
    parameters: tuple[Parameter, ...],
    joint: JointFit,
    staged: list[StagedShot],
    rng: np.random.Generator,
) -> Calibration:
    counted = sum(shot.counted for shot in staged)
    fitted = len(parameters) + sum(_fitted_to_samples(shot) for shot in staged)
    freedom = max(1.0, counted - fitted)
    cost = sum(
        float(np.sum(shot.member.fit.residuals[: shot.model.n_samples] ** 2)) for shot in staged if shot.counted > 0
    )
    misfit = cost / freedom
    excess = (misfit - 1.0) * float(np.sqrt(freedom / 2.0))
    scale = misfit if observations.sigma is None else max(1.0, misfit)
    covariance = scale * np.linalg.inv(joint.information())
    sigmas = np.sqrt(np.diag(covariance))
    draws = _bootstrap(joint, rng)
    estimates = tuple(
        _estimate(parameter, float(value), float(sigma), column)
        for parameter, value, sigma, column in zip(parameters, joint.values, sigmas, draws.T, strict=True)
    )
    found = replaced(table, [one.name for one in parameters], joint.values.tolist())
    shots = tuple(explained(shot, joint.table, 1.0) for shot in staged)
    correlations = covariance / np.outer(sigmas, sigmas)
    return Calibration(found, estimates, correlations, shots, observations.noise, misfit, excess, cost, freedom)


def _fitted_to_samples(shot: StagedShot) -> float:
    """How many of a shot's nuisances its samples determine: the others are held by their priors."""
    space = np.linalg.qr(shot.member.fit.slopes)[0]
    return float(np.sum(space[: shot.model.n_samples] ** 2))


def _bootstrap(joint: JointFit, rng: np.random.Generator) -> Floats:
    """(REPEATS, p) parameters from shots drawn with replacement, each one step of Newton's from the solution."""
    normals = np.array([part.normal for part in joint.parts])
    gradients = np.array([part.gradient for part in joint.parts])
    held = joint.information() - normals.sum(axis=0)
    n = len(normals)
    drawn = rng.multinomial(n, np.full(n, 1.0 / n), size=REPEATS).astype(float)
    matrices = np.einsum("rs,sij->rij", drawn, normals) + held
    pulls = drawn @ gradients - gradients.sum(axis=0)
    shifts: Floats = np.linalg.solve(matrices, pulls[:, :, None])[:, :, 0]
    drawn_values: Floats = joint.values - shifts
    return drawn_values


def _estimate(parameter: Parameter, value: float, sigma: float, draws: Floats) -> FittedParameter:
    low, high = (float(np.clip(value + sign * COVERED * sigma, parameter.low, parameter.high)) for sign in (-1.0, 1.0))
    again = np.clip(np.percentile(draws, [2.5, 97.5]), parameter.low, parameter.high).tolist()
    is_determined = sigma < DETERMINED * (parameter.high - parameter.low)
    return FittedParameter(
        parameter.name, value, parameter.start, sigma, low, high, (again[0], again[1]), is_determined
    )
