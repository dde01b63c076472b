"""Laws compared by the same data: each is fitted by itself."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from calibration.errors import InvalidFit
from calibration.fit import calibrate
from calibration.matching import Observer
from calibration.observed import Observations
from calibration.result import Calibration
from physics import InvalidTable, Table


@dataclasses.dataclass(frozen=True, slots=True)
class FittedLaw:
    """One law and its fit.

    Attributes:
        law: its name. calibration: the table under it.
        worse: by how much more than under the best law a shot's mean square is, on average, in squares of the noise;
            error: of that mean, over shots. 0 for the best.
        followed: part of the shots that it explains.
    """

    law: str
    calibration: Calibration
    worse: float
    error: float
    followed: float

    @property
    def is_refuted(self) -> bool:
        """Whether another law is better by more than chance: three standard errors."""
        return self.worse > 3.0 * self.error > 0.0


def compare_laws(
    table: Table,
    observations: Observations,
    fit: Sequence[str],
    laws: Sequence[str],
    kind: str = "cushion",
    observer: Observer = lambda _words, _part: None,
) -> tuple[FittedLaw, ...]:
    """The laws in the order of how well they explain the data, the best first.

    Args:
        kind: which law of the table is exchanged: ``cushion`` or ``ball``.

    Raises:
        InvalidFit: the table has no such law.
    """
    found = []
    for law in laws:
        try:
            changed = table.replace(**{kind: law})
        except InvalidTable as error:
            raise InvalidFit(kind, law, error.allowed) from None
        found.append((law, calibrate(changed, observations, fit, observer=observer)))
    squares = [np.array([min(shot.rms, 30.0) ** 2 for shot in one.shots]) for _, one in found]
    followed = [float(np.mean([shot.is_explained for shot in one.shots])) for _, one in found]
    order = sorted(range(len(found)), key=lambda number: (float(squares[number].mean()), -followed[number]))
    best = squares[order[0]]
    return tuple(_fitted(*found[number], squares[number] - best, followed[number]) for number in order)


def _fitted(law: str, one: Calibration, more: np.ndarray, followed: float) -> FittedLaw:
    error = float(more.std(ddof=1) / np.sqrt(len(more))) if len(more) > 1 else 0.0
    return FittedLaw(law, one, float(more.mean()), error, followed)
