"""The nuisances of one shot for given parameters of the table: damped least squares, and a search among orders of
events.
"""

import dataclasses

import numpy as np

from calibration.observed import Floats
from calibration.shot_model import ShotModel
from physics import Table

MOST_STEPS = 20
SETTLED = 0.02
"""Fall of the cost that the slopes promise, in standard deviations squared, below which steps end."""
FIRST_DAMPING, MOST_DAMPINGS = 1e-3, 12
"""Of steps, relative to the diagonal; raised fivefold until a step lowers the cost."""
PROBE = 0.1
"""Part of a step at which its bend is measured."""
MOST_BEND = 0.4
"""Of a step, relative to its length; beyond it the step is too long."""
DRAWS, BEST_DRAWS = 48, 3
"""Starts of a search: drawn, and followed."""


@dataclasses.dataclass(frozen=True, eq=False)
class ShotFit:
    """A shot's nuisances at the least cost found.

    Attributes:
        nuisances: (k,). residuals: (n + k,) weighted. slopes: (n + k, k) weighted, of the residuals by the nuisances in
            natural sizes.
    """

    nuisances: Floats
    residuals: Floats
    slopes: Floats

    @property
    def cost(self) -> float:
        """Sum of the squares of the weighted residuals."""
        return float(self.residuals @ self.residuals)

    @property
    def promised(self) -> float:
        """By how much the cost would fall if the residuals were linear: next to nothing at a minimum."""
        along = np.linalg.qr(self.slopes)[0].T @ self.residuals
        return float(along @ along)


def fit_shot(model: ShotModel, table: Table, start: Floats, weights: Floats, steps: int = MOST_STEPS) -> ShotFit | None:
    """Lower the cost from a start; ``weights`` (n + k,). None if the start cannot be played.

    Levenberg and Marquardt's method with geodesic acceleration (Transtrum & Sethna 2012): tip offset and speed trade
    against one another along curved valleys, which straight steps follow badly.
    """
    plain = model.residuals(table, start)
    if plain is None:
        return None
    nuisances, damping = start, FIRST_DAMPING
    slopes = model.slopes(table, nuisances, plain)
    for _ in range(steps):
        here = ShotFit(nuisances, weights * plain, weights[:, None] * slopes)
        if here.promised < SETTLED:
            break
        step = _step(model, table, here, weights, damping)
        if step is None:
            break
        nuisances, plain, damping = step
        slopes = model.slopes(table, nuisances, plain)
    return ShotFit(nuisances, weights * plain, weights[:, None] * slopes)


def _step(
    model: ShotModel, table: Table, here: ShotFit, weights: Floats, damping: float
) -> tuple[Floats, Floats, float] | None:
    """A damped step that lowers the cost: nuisances and plain residuals there, and the next damping; else None."""
    square, gradient = here.slopes.T @ here.slopes, here.slopes.T @ here.residuals
    sizes = np.diag(np.diag(square) + 1e-9)
    for _ in range(MOST_DAMPINGS):
        inverse = np.linalg.inv(square + damping * sizes)
        velocity = -inverse @ gradient
        ahead = model.residuals(table, here.nuisances + PROBE * model.scales * velocity)
        bend = np.zeros_like(velocity)
        if ahead is not None:
            second = 2.0 / PROBE * ((weights * ahead - here.residuals) / PROBE - here.slopes @ velocity)
            bend = -0.5 * inverse @ (here.slopes.T @ second)
        if np.linalg.norm(bend) <= MOST_BEND * np.linalg.norm(velocity):
            there = here.nuisances + model.scales * (velocity + bend)
            found = model.residuals(table, there)
            if found is not None and float(np.sum((weights * found) ** 2)) < here.cost:
                return there, found, 0.1 * damping
        damping *= 5.0
    return None


def search_shot(
    model: ShotModel, table: Table, about: ShotFit, weights: Floats, spread: float, rng: np.random.Generator
) -> ShotFit | None:
    """The best fit from starts drawn about another fit, as its own covariance has it, ``spread`` times as wide.

    A shot whose events come in a wrong order cannot leave it by small steps; draws can.
    """
    _, sizes, across = np.linalg.svd(about.slopes, full_matrices=False)
    root = across / np.sqrt(sizes * sizes + 1e-9)[:, None]
    offsets = spread * rng.standard_normal((DRAWS, len(sizes))) @ root
    starts = about.nuisances + model.scales * offsets
    off = np.log1p((weights * model.rows(table, starts)) ** 2).sum(axis=1)
    best = np.argsort(np.where(np.isnan(off), np.inf, off))[:BEST_DRAWS]
    fits = [fit_shot(model, table, start, weights) for start in starts[best]]
    return min((fit for fit in fits if fit is not None), key=lambda fit: fit.cost, default=None)
