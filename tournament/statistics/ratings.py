"""What a fit says: everybody's rating, its intervals, and who is stronger than whom."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tournament.statistics.student import student_cdf

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Rating:
    """An entrant's rating, in Elo points above the mean of the table.

    Attributes:
        name: of the entrant; elo: rating; games: counted.
        low, high: marginal interval of 95 % confidence: for this rating by itself.
        simultaneous_low, simultaneous_high: intervals that hold all true ratings of the table at once with 95 %.
        best_rank, worst_rank: intervals that hold all true ranks of the table at once with 95 %; 1 is the strongest.
    """

    name: str
    elo: float
    low: float
    high: float
    games: int
    simultaneous_low: float
    simultaneous_high: float
    best_rank: int
    worst_rank: int

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {name: getattr(self, name) for name in self.__slots__}


@dataclass(frozen=True)
class Ratings:
    """All ratings of a table.

    Attributes:
        table: by rating, the highest first.
        names: in the order of ``elo`` and ``covariance``.
        elo: (n,), mean 0. covariance: (n, n), Elo^2.
        dispersion: variance of a pair's points relative to two independent games.
        bootstrap_dispersion: the same from a bootstrap over pairs, as a check; None for fewer pairs than entrants.
        dof: degrees of freedom of the intervals.
    """

    table: tuple[Rating, ...]
    names: tuple[str, ...]
    elo: Floats
    covariance: Floats
    dispersion: float
    bootstrap_dispersion: float | None
    dof: float

    def superiority(self, one: str, other: str) -> float:
        """Likelihood that ``one`` is stronger than ``other``; ``ValueError`` for an unknown name."""
        i, j = self.names.index(one), self.names.index(other)
        return float(self.superiorities()[i, j])

    def superiorities(self) -> Floats:
        """(n, n): likelihood that the entrant of the row is stronger than that of the column; 1/2 on the diagonal."""
        likelihoods: Floats = student_cdf(gaps(self.elo, self.covariance), self.dof)
        return likelihoods


def gaps(elo: Floats, covariance: Floats) -> Floats:
    """(n, n): differences of ratings, row less column, in standard deviations; 0 on the diagonal."""
    own = np.diag(covariance)
    variance = own[:, None] + own - 2.0 * covariance
    np.fill_diagonal(variance, 1.0)
    apart: Floats = (elo[:, None] - elo) / np.sqrt(variance)
    return apart
