"""A shot in Olympiad units."""

import contextlib
import dataclasses
import math
import numbers
from collections.abc import Mapping
from typing import Any, Self

from physics.constants import THETA_MAX, V_MAX
from physics.errors import InvalidShot

FIELDS = ("v", "phi", "theta", "a", "b")
"""Column order of shot arrays, and the positional order of ``Shot``."""


@dataclasses.dataclass(frozen=True, slots=True)
class Shot:
    """One stroke of the cue.

    Attributes:
        v: m/s, cue speed before impact, in [0, 10].
        phi: deg, azimuth of the stroke, counter-clockwise from +x; any finite number.
        theta: deg, elevation of the cue, in [0, 70].
        a: mm, tip offset to the side; positive gives right english.
        b: mm, tip offset upwards; positive gives follow, negative draw.

    A tip off the ball (a^2 + b^2 > R^2) can be written down, since noise can produce it; ``physics.check``
    says that it cannot be played.

    Raises:
        InvalidShot: a parameter is not a finite number, or ``v`` or ``theta`` is out of range.
    """

    v: float
    phi: float
    theta: float = 0.0
    a: float = 0.0
    b: float = 0.0

    def __post_init__(self) -> None:
        for name in FIELDS:
            object.__setattr__(self, name, _finite(name, getattr(self, name)))
        if not 0.0 <= self.v <= V_MAX:
            raise InvalidShot("v", self.v, f"must be in [0, {V_MAX}] m/s")
        if not 0.0 <= self.theta <= THETA_MAX:
            raise InvalidShot("theta", self.theta, f"must be in [0, {THETA_MAX}] deg")

    def replace(self, **changes: float) -> Self:
        """Return a copy with some parameters changed.

        Raises:
            InvalidShot: an unknown parameter, or a bad value.
        """
        return self.from_dict(self.to_dict() | changes)

    def to_dict(self) -> dict[str, float]:
        """The five parameters by name."""
        return {name: getattr(self, name) for name in FIELDS}

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
