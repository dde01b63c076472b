"""Paths of balls as a camera saw them, in the table's frame: metres, seconds."""

import dataclasses
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from physics import Table

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

ROUGH_SIGMA = 1e-5
"""m, the least noise that is ever assumed: below it, rounding of written places counts."""
SMOOTH_SPREAD = 20.0
"""Variance of a third difference of equally spaced samples, in variances of a sample: 1 + 9 + 9 + 1."""
NORMAL_MEDIAN = 0.6745
"""Median of the absolute value of a standard normal number."""


@dataclasses.dataclass(frozen=True, slots=True)
class IntendedStroke:
    """What a player meant to play; None where it is not known.

    Attributes:
        v: m/s. phi, theta: deg. a, b: mm. As in ``physics.Shot``, in the table's frame.
    """

    v: float | None = None
    phi: float | None = None
    theta: float | None = None
    a: float | None = None
    b: float | None = None

    @property
    def is_whole(self) -> bool:
        """Whether all five are known."""
        return None not in (self.v, self.phi, self.theta, self.a, self.b)


@dataclasses.dataclass(frozen=True, eq=False)
class ObservedShot:
    """One shot as it was seen: n samples in the order of their times.

    Attributes:
        name: as the data call it.
        times: (n,) s. balls: (n,) ball numbers. places: (n, 2) m, of the centres.
        heights: (n,) m, of the centres above where they rest on the cloth; NaN where not seen.
        stroke: what the player meant.
    """

    name: str
    times: Floats
    balls: Integers
    places: Floats
    heights: Floats
    stroke: IntendedStroke = IntendedStroke()

    @cached_property
    def numbers(self) -> tuple[int, ...]:
        """The balls that were seen, ascending."""
        return tuple(np.unique(self.balls).tolist())

    def of_ball(self, ball: int) -> Integers:
        """Which samples are of a ball, in the order of their times."""
        return np.flatnonzero(self.balls == ball)


@dataclasses.dataclass(frozen=True, eq=False)
class Observations:
    """A data set.

    Attributes:
        shots: at least one.
        sigma: m, standard deviation of one coordinate of a place; None: estimated.
        strike_known: whether time 0 is the strike of every shot; else each shot's is estimated.
    """

    shots: tuple[ObservedShot, ...]
    sigma: float | None = None
    strike_known: bool = True

    @cached_property
    def noise(self) -> float:
        """m, of one coordinate: as told, or from the scatter of the paths about smooth ones."""
        return self.sigma if self.sigma is not None else estimated_noise(self.shots)

    def of(self, names: tuple[str, ...]) -> "Observations":
        """The shots of these names only."""
        return dataclasses.replace(self, shots=tuple(shot for shot in self.shots if shot.name in names))


def estimated_noise(shots: tuple[ObservedShot, ...]) -> float:
    """Standard deviation of one coordinate, m, from third differences of equally spaced samples.

    Constant acceleration gives none, and the few differences that span a collision do not move a median.
    """
    found = []
    for shot in shots:
        for ball in shot.numbers:
            rows = shot.of_ball(ball)
            steps = np.diff(shot.times[rows])
            third = np.diff(shot.places[rows], n=3, axis=0)
            if len(third):
                even = np.ptp(np.column_stack((steps[:-2], steps[1:-1], steps[2:])), axis=1) <= 0.01 * steps[:-2]
                found.append(np.abs(third[even]).ravel())
    differences = np.concatenate(found) if found else np.zeros(0)
    if len(differences) == 0:
        return 1e-3
    spread: float = NORMAL_MEDIAN * SMOOTH_SPREAD**0.5
    return max(ROUGH_SIGMA, float(np.median(differences)) / spread)


def share_off(table: Table, shots: tuple[ObservedShot, ...], margin: float = 0.1) -> float:
    """Which part of all samples lies more than ``margin`` (m) beyond the noses: wrong units or frames have much."""
    places = np.concatenate([shot.places for shot in shots])
    size = np.array([table.width, table.length])
    return float(((places < -margin) | (places > size + margin)).any(axis=1).mean())
