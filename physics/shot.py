"""A shot in Olympiad units."""

import contextlib
import dataclasses
import math
import numbers
from collections.abc import Mapping
from typing import Any, Self

from physics.errors import InvalidShot
from physics.table import Table

FIELDS = ("v", "phi", "theta", "a", "b")
"""Column order of shot arrays, and the positional order of ``Shot``."""


@dataclasses.dataclass(frozen=True, slots=True)
class Shot:
    """One stroke of the cue.

    Attributes:
        v: m/s, cue speed before impact, from 0 to the table's ``v_max``.
        phi: deg, azimuth of the stroke, counter-clockwise from +x; any finite number.
        theta: deg, elevation of the cue, from 0 to the table's ``theta_max``.
        a: mm, tip offset to the side; positive gives right english.
        b: mm, tip offset upwards; positive gives follow, negative draw.

    Any finite numbers can be written down: what a table allows, the table knows, and ``physics.check`` says whether
    a shot can be played on it. So does it of a tip off the ball (a^2 + b^2 > R^2), since noise can produce one.

    Raises:
        InvalidShot: a parameter is not a finite number.
    """

    v: float
    phi: float
    theta: float = 0.0
    a: float = 0.0
    b: float = 0.0

    def __post_init__(self) -> None:
        v, phi, theta, a, b = self.v, self.phi, self.theta, self.a, self.b
        are_floats = type(v) is type(phi) is type(theta) is type(a) is type(b) is float
        if are_floats and math.isfinite(v + phi + theta + a + b):
            return  # as nearly every shot is: what follows takes five times as long
        for name in FIELDS:
            object.__setattr__(self, name, _finite(name, getattr(self, name)))

    def refuse_beyond(self, table: Table) -> None:
        """Raise InvalidShot, naming field and range, if ``v`` or ``theta`` is not in the table's range."""
        if 0.0 <= self.v <= table.v_max and 0.0 <= self.theta <= table.theta_max:
            return
        for name, most, unit in (("v", table.v_max, "m/s"), ("theta", table.theta_max, "deg")):
            if not 0.0 <= getattr(self, name) <= most:
                raise InvalidShot(name, getattr(self, name), f"must be a number from 0 to {most:g} {unit}")

    def replace(self, **changes: float) -> Self:
        """Return a copy with some parameters changed.

        Raises:
            InvalidShot: an unknown parameter, or a bad value.
        """
        return self.from_dict(self.to_dict() | changes)

    def to_dict(self) -> dict[str, float]:
        """The five parameters by name."""
        return {"v": self.v, "phi": self.phi, "theta": self.theta, "a": self.a, "b": self.b}

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """Read what ``to_dict`` wrote; theta, a and b may be left out and are then 0.

        Raises:
            InvalidShot: a missing or unknown parameter, or a bad value.
        """
        if not isinstance(values, Mapping):
            raise InvalidShot("shot", values, f"must be a mapping with the parameters {FIELDS}")
        for name in values:
            if name not in FIELDS:
                raise InvalidShot(str(name), values[name], f"is not a parameter of a shot; these are: {FIELDS}")
        for name in ("v", "phi"):
            if name not in values:
                raise InvalidShot(name, None, "is required")
        return cls(**values)


def _finite(name: str, value: Any) -> float:
    """Return ``value`` as a float; raise InvalidShot unless it is a finite real number."""
    if type(value) is float and math.isfinite(value):
        return value
    number = math.nan
    if not isinstance(value, bool) and isinstance(value, numbers.Real):
        with contextlib.suppress(OverflowError):
            number = float(value)
    if not math.isfinite(number):
        raise InvalidShot(name, value, "must be a finite number")
    return number
