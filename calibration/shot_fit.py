"""The nuisances of one shot for given parameters of the table: damped least squares, and a search among orders of
events.
"""

import dataclasses

import numpy as np

from calibration.observed import Floats
from calibration.shot_model import ShotModel
from physics import Table

MOST_STEPS = 12
SETTLED = 1e-4
"""Relative fall of the cost below which steps end."""
DAMPING = (1e-3, 1e-1, 10.0, 1e3)
"""Tried in turn until a step lowers the cost."""
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


def fit_shot(model: ShotModel, table: Table, start: Floats, weights: Floats, steps: int = MOST_STEPS) -> ShotFit | None:
    """Lower the cost from a start; ``weights`` (n + k,). None if the start cannot be played."""
    found = model.residuals(table, start)
    if found is None:
        return None
    nuisances, plain = start, found
    for _ in range(steps):
        slopes = weights[:, None] * model.slopes(table, nuisances, plain)
        better = _step(model, table, nuisances, weights * plain, slopes, weights)
        if better is None:
            return ShotFit(nuisances, weights * plain, slopes)
        before, after = float(np.sum((weights * plain) ** 2)), float(np.sum((weights * better[1]) ** 2))
        nuisances, plain = better
        if before - after < SETTLED * before:
            break
    return ShotFit(nuisances, weights * plain, weights[:, None] * model.slopes(table, nuisances, plain))


def _step(
    model: ShotModel, table: Table, nuisances: Floats, residuals: Floats, slopes: Floats, weights: Floats
) -> tuple[Floats, Floats] | None:
    """A damped step that lowers the cost: nuisances and plain residuals there; None if there is none."""
    square, gradient = slopes.T @ slopes, slopes.T @ residuals
    cost = float(residuals @ residuals)
    for damping in DAMPING:
        moved = np.linalg.solve(square + damping * np.diag(np.diag(square) + 1e-9), -gradient)
        there = nuisances + model.scales * moved
        found = model.residuals(table, there)
        if found is not None and float(np.sum((weights * found) ** 2)) < cost:
            return there, found
    return None


def search_shot(
    model: ShotModel, table: Table, about: ShotFit, weights: Floats, spread: float, rng: np.random.Generator
) -> ShotFit | None:
    """The best fit from starts drawn about another fit, as its own covariance has it, ``spread`` times as wide.

    A shot whose events come in a wrong order cannot leave it by small steps; draws can.
    """
    root = np.linalg.cholesky(np.linalg.inv(about.slopes.T @ about.slopes + 1e-9 * np.eye(len(model.scales))))
    offsets = spread * rng.standard_normal((DRAWS, len(model.scales))) @ root.T
    starts = []
    for offset in offsets:
        there = about.nuisances + model.scales * offset
        there[2] = abs(there[2])
        found = model.residuals(table, there)
        if found is not None:
            starts.append((float(np.sum(np.log1p((weights * found) ** 2))), there))
    starts.sort(key=lambda pair: pair[0])
    fits = [fit_shot(model, table, there, weights) for _, there in starts[:BEST_DRAWS]]
    return min((fit for fit in fits if fit is not None), key=lambda fit: fit.cost, default=None)
