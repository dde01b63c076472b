"""Execution noise: the shot that is played is not quite the shot that was meant."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from physics.generator import SeededStream
from physics.shot import Shot
from physics.table import Table

SIGMA_A = 0.5
SIGMA_B = 0.5
"""mm, standard deviations of the tip offset at level 1, as at the Computational Pool Olympiad."""
SIGMA_THETA = 0.1
"""deg."""
SIGMA_PHI = 0.125
"""deg: about 2 mm at 1 m."""
SIGMA_V = 0.075
"""m/s."""

OLYMPIAD = Table.olympiad()

LEVEL_MAX = 5.0
"""The greatest level: five times the Olympiad's standard deviations."""


@dataclass(frozen=True, slots=True)
class NoiseModel:
    """Gaussian noise on the five parameters of a shot.

    Attributes:
        level: factor on the Olympiad's standard deviations, 0 to 5; 1 is the standard.
        told: whether the players are told the level.

    Raises:
        ValueError: a level outside [0, 5], or either is of another type.
    """

    level: float = 1.0
    told: bool = True

    def __post_init__(self) -> None:
        is_number = isinstance(self.level, int | float) and not isinstance(self.level, bool)
        if not is_number or not 0.0 <= self.level <= LEVEL_MAX:
            raise ValueError(f"level = {self.level!r}: must be in [0, {LEVEL_MAX}]")
        if not isinstance(self.told, bool):
            raise ValueError(f"told = {self.told!r}: must be True or False")

    def perturb(self, shot: Shot, seed: bytes, stroke: int, table: Table = OLYMPIAD) -> Shot:
        """The shot as played.

        It depends on the intended shot, the game's noise seed and the stroke's index alone, so that nobody
        gets a second draw. Noise is added in the order a, b, theta, phi, v; phi is taken mod 360, theta and v
        are clamped to their ranges. At level 0 the shot comes back bit for bit. A tip off the ball can
        result.

        Args:
            shot: as intended.
            seed: the game's noise seed.
            stroke: index of the stroke in its game.
            table: whose greatest speed and elevation bound the noise.
        """
        if self.level == 0.0:
            return shot
        stream = SeededStream(seed, f"pooliad/1 stroke {stroke}")
        a = shot.a + self.level * SIGMA_A * stream.gaussian()
        b = shot.b + self.level * SIGMA_B * stream.gaussian()
        theta = shot.theta + self.level * SIGMA_THETA * stream.gaussian()
        # phi is reduced first: at 10^16 degrees a double's spacing would swallow the noise
        phi = _mod_360(_mod_360(shot.phi) + self.level * SIGMA_PHI * stream.gaussian())
        v = shot.v + self.level * SIGMA_V * stream.gaussian()
        return Shot(v=_clamp(v, table.v_max), phi=phi, theta=_clamp(theta, table.theta_max), a=a, b=b)

    def perturb_rows(
        self, shots: NDArray[np.float64], draws: NDArray[np.float64], table: Table = OLYMPIAD
    ) -> NDArray[np.float64]:
        """Many shots as played, (n, 5), bit for bit what ``perturb`` makes of them with the same normal numbers.

        Args:
            shots: (n, 5) as intended, columns v, phi, theta, a, b.
            draws: (n, 5) standard normal numbers for the same columns.
            table: as for ``perturb``.
        """
        if self.level == 0.0:
            return shots
        v, phi, theta, a, b = shots.T
        sigmas = self.level * np.array([SIGMA_V, SIGMA_PHI, SIGMA_THETA, SIGMA_A, SIGMA_B])
        dv, dphi, dtheta, da, db = (sigmas * draws).T
        phi = _mod_360_rows(_mod_360_rows(phi) + dphi)
        v, theta = np.clip(v + dv, 0.0, table.v_max), np.clip(theta + dtheta, 0.0, table.theta_max)
        return np.column_stack((v, phi, theta, a + da, b + db))


def _mod_360_rows(phi: NDArray[np.float64]) -> NDArray[np.float64]:
    """``_mod_360`` of each."""
    rest = np.fmod(phi, 360.0)
    rest = np.where(rest < 0.0, rest + 360.0, rest)
    return np.where(rest < 360.0, rest, 0.0)


def _mod_360(phi: float) -> float:
    """The angle in [0, 360): ``fmod`` is exact, and a negative so small that adding 360 rounds up gives 0."""
    rest = math.fmod(phi, 360.0)
    if rest < 0.0:
        rest += 360.0
    return rest if rest < 360.0 else 0.0


def _clamp(value: float, greatest: float) -> float:
    return min(max(value, 0.0), greatest)
