"""Execution noise: the shot that is played is not quite the shot that was meant."""

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final, Self

import numpy as np
from numpy.typing import NDArray

from physics.errors import FieldError
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


SIGMA_MAX: Final = {"v": 1.0, "phi": 10.0, "theta": 10.0, "a": 10.0, "b": 10.0}
"""Greatest standard deviations, in the units of a shot: far beyond any player's."""


@dataclass(frozen=True, slots=True)
class Sigmas:
    """Standard deviations of a shot's parameters at level 1; left out, the Olympiad's.

    Attributes:
        v: m/s. phi, theta: deg. a, b: mm.

    Raises:
        FieldError: one is no number from 0 to its greatest value (``SIGMA_MAX``).
    """

    v: float = SIGMA_V
    phi: float = SIGMA_PHI
    theta: float = SIGMA_THETA
    a: float = SIGMA_A
    b: float = SIGMA_B

    def __post_init__(self) -> None:
        for name, most in SIGMA_MAX.items():
            value = getattr(self, name)
            if isinstance(value, bool) or not isinstance(value, int | float) or not 0.0 <= value <= most:
                raise FieldError(name, value, f"must be a number from 0 to {most:g}")
            object.__setattr__(self, name, float(value))

    def row(self) -> NDArray[np.float64]:
        """(5,), in the order of a row of shots: v, phi, theta, a, b."""
        return np.array(dataclasses.astuple(self))

    def to_dict(self) -> dict[str, float]:
        """All five by name."""
        return dataclasses.asdict(self)

    @classmethod
    def from_dict(cls, values: Any) -> Self:
        """Read what ``to_dict`` wrote; those left out are the Olympiad's.

        Raises:
            FieldError: it is no mapping, a name is none of the five, or a value cannot be.
        """
        if not isinstance(values, Mapping):
            raise FieldError("", values, f"must be an object (a table) of {', '.join(SIGMA_MAX)}")
        for name in values:
            if name not in SIGMA_MAX:
                raise FieldError(str(name), values[name], f"must be left out; the fields are {', '.join(SIGMA_MAX)}")
        return cls(**values)


OLYMPIAD_SIGMAS: Final = Sigmas()


@dataclass(frozen=True, slots=True)
class NoiseModel:
    """Gaussian noise on the five parameters of a shot.

    Attributes:
        level: factor on the standard deviations, 0 to 5; 1 is the standard.
        told: whether the players are told the level.
        sigmas: the standard deviations.

    Raises:
        ValueError: a level outside [0, 5], or one of them is of another type.
    """

    level: float = 1.0
    told: bool = True
    sigmas: Sigmas = OLYMPIAD_SIGMAS

    def __post_init__(self) -> None:
        is_number = isinstance(self.level, int | float) and not isinstance(self.level, bool)
        if not is_number or not 0.0 <= self.level <= LEVEL_MAX:
            raise ValueError(f"level = {self.level!r}: must be in [0, {LEVEL_MAX}]")
        if not isinstance(self.told, bool):
            raise ValueError(f"told = {self.told!r}: must be True or False")
        if not isinstance(self.sigmas, Sigmas):
            raise ValueError(f"sigmas = {self.sigmas!r}: must be Sigmas")

    @classmethod
    def of(cls, noise: "float | NoiseModel") -> "NoiseModel":
        """The noise itself, or the Olympiad's at a level."""
        return noise if isinstance(noise, NoiseModel) else cls(noise)

    @property
    def others(self) -> Sigmas | None:
        """The standard deviations where they are not the Olympiad's, which nothing written names."""
        return None if self.sigmas == OLYMPIAD_SIGMAS else self.sigmas

    @property
    def by_direction(self) -> float:
        """The level at which the Olympiad's noise is as far off in direction, which decides what is potted."""
        return self.level * (self.sigmas.phi / SIGMA_PHI)

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {"level": self.level, "told": self.told} | ({"sigmas": self.others.to_dict()} if self.others else {})

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """Read what ``to_dict`` wrote.

        Raises:
            ValueError, TypeError: something is missing or cannot be.
        """
        sigmas = {"sigmas": Sigmas.from_dict(values["sigmas"])} if "sigmas" in values else {}
        return cls(**{**values, **sigmas})

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
        sigmas = self.sigmas
        a = shot.a + self.level * sigmas.a * stream.gaussian()
        b = shot.b + self.level * sigmas.b * stream.gaussian()
        theta = shot.theta + self.level * sigmas.theta * stream.gaussian()
        # phi is reduced first: at 10^16 degrees a double's spacing would swallow the noise
        phi = _mod_360(_mod_360(shot.phi) + self.level * sigmas.phi * stream.gaussian())
        v = shot.v + self.level * sigmas.v * stream.gaussian()
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
        dv, dphi, dtheta, da, db = (self.level * self.sigmas.row() * draws).T
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
