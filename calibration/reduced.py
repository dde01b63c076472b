"""The normal equations of all shots with their nuisances eliminated: the Schur complement, a sum over shots."""

import dataclasses

import numpy as np

from calibration.observed import Floats
from calibration.shot_fit import ShotFit
from calibration.shot_model import ShotModel


@dataclasses.dataclass(eq=False)
class Member:
    """One shot in the joint fit.

    Attributes:
        model: its model. fit: at the present parameters. weights: (n + k,) of its rows.
    """

    model: ShotModel
    fit: ShotFit
    weights: Floats


@dataclasses.dataclass(frozen=True, eq=False)
class Curvature:
    """What one shot says of the parameters near the solution.

    Attributes:
        normal: (p, p), its part of the normal matrix, nuisances eliminated. gradient: (p,), of half its cost.
        by_parameters: (n + k, p) weighted slopes, not projected.
    """

    normal: Floats
    gradient: Floats
    by_parameters: Floats


class Reduced:
    """The damped normal equations of all shots with the nuisances eliminated: solved for any residuals."""

    def __init__(self, members: list[Member], parts: list[Curvature], held: Floats, damping: float) -> None:
        self._members, self._parts = members, parts
        self._inverses, self._mixed = [], []
        matrix = held.copy()
        diagonal = np.zeros(len(held))
        for member, part in zip(members, parts, strict=True):
            slopes, by_parameters = member.fit.slopes, part.by_parameters
            square = slopes.T @ slopes
            inverse = np.linalg.inv(square + damping * np.diag(np.diag(square) + 1e-9))
            mixed = slopes.T @ by_parameters
            plain = by_parameters.T @ by_parameters
            matrix += plain - mixed.T @ inverse @ mixed
            diagonal += np.diag(part.normal)
            self._inverses.append(inverse)
            self._mixed.append(mixed)
        self._inverse = np.linalg.inv(matrix + damping * np.diag(diagonal + np.diag(held)))

    def solve(self, residuals: list[Floats], held: Floats) -> tuple[Floats, list[Floats]]:
        """(shift of the parameters, moves of each shot's nuisances in natural sizes)."""
        right = held.copy()
        pulls = []
        for member, part, inverse, mixed, row in zip(
            self._members, self._parts, self._inverses, self._mixed, residuals, strict=True
        ):
            pull = inverse @ (member.fit.slopes.T @ row)
            right += part.by_parameters.T @ row - mixed.T @ pull
            pulls.append(pull)
        shift = -self._inverse @ right
        moves = [
            -pull - inverse @ (mixed @ shift)
            for pull, inverse, mixed in zip(pulls, self._inverses, self._mixed, strict=True)
        ]
        return shift, moves
