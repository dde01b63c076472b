"""Which parameters of a table can be fitted, and within which ranges."""

import dataclasses
from collections.abc import Sequence

from calibration.errors import InvalidFit
from physics import RealTable, Table
from physics.specifications import RANGES as REAL_RANGES
from physics.table import RANGES

LEAST_ROLL = 0.001
MOST_E_CLOTH = 0.9


@dataclasses.dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter to be fitted: its name, range and value before the fit."""

    name: str
    low: float
    high: float
    start: float


def fitted_parameters(table: Table, names: Sequence[str]) -> tuple[Parameter, ...]:
    """The parameters of these names.

    Raises:
        InvalidFit: the list is empty, names a parameter twice, or names something other than a number that
            ``table.replace`` changes.
    """
    ranges = _ranges(table)
    if not names:
        raise InvalidFit("fit", "", f"must name parameters: {', '.join(ranges)}")
    for name in names:
        if name not in ranges or list(names).count(name) > 1:
            raise InvalidFit("fit", name, f"must be different ones of {', '.join(ranges)}")
    return tuple(Parameter(name, *ranges[name], getattr(table, name)) for name in names)


def replaced(table: Table, names: Sequence[str], values: Sequence[float]) -> Table:
    """The table with these values, each kept within its range; ``mu_roll`` within that of ``mu_slide`` too."""
    ranges = _ranges(table)
    changes = {
        name: min(max(float(value), ranges[name][0]), ranges[name][1])
        for name, value in zip(names, values, strict=True)
    }
    slide, roll = changes.get("mu_slide", table.mu_slide), changes.get("mu_roll", table.mu_roll)
    if roll > slide:
        changes["mu_roll" if "mu_roll" in changes else "mu_slide"] = slide if "mu_roll" in changes else roll
    return table.replace(**changes)


def _ranges(table: Table) -> dict[str, tuple[float, float]]:
    if isinstance(table, RealTable):
        real = {name: (limits.low, limits.high) for name, limits in REAL_RANGES.items()}
        most = table.e_cloth
        return real | {"mu_roll": (LEAST_ROLL, real["mu_slide"][1]), "e_pressed": (0.0, most)}
    return RANGES | {"mu_roll": (LEAST_ROLL, RANGES["mu_slide"][1])}
