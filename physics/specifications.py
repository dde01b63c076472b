"""Numbers of tables as they are built: sizes, the range of every parameter, the constants of cushion laws.

Sources, by the names that docstrings use:
WPA: World Pool-Billiard Association, *Tables and equipment specifications*;
BCA: Billiard Congress of America, *Equipment specifications* (2008);
Alciatore: D. G. Alciatore, *Pool physical properties* and the technical proofs TP A-14, A-31;
Han: I. Han, *Dynamics in carom and three cushion billiards*, J. Mech. Sci. Technol. 19 (2005);
Mathavan: S. Mathavan, M. R. Jackson, R. M. Parkin, *A theoretical analysis of billiard ball-cushion dynamics under
cushion impacts*, Proc. IMechE C 224 (2010); choice: our own, measured nowhere.
"""

import dataclasses
from typing import Any, Final, Literal

from physics.errors import InvalidTable

Cushion = Literal["han", "mathavan", "factors"]
"""Cushion laws by name."""

BallLaw = Literal["alciatore", "consistent", "fastfiz"]
"""Laws of two balls by name."""

SIZES: Final[dict[str, tuple[float, float]]] = {
    "nine_foot": (1.27, 2.54),
    "eight_foot": (1.1684, 2.3368),
    "seven_foot": (0.9906, 1.9812),
}
"""m, width and length between the noses: 50 by 100, 46 by 92 and 39 by 78 inches (WPA; BCA)."""

LAW_CONSTANTS: Final[dict[str, dict[str, float]]] = {
    "han": {"e_cushion": 0.85, "mu_cushion": 0.2},
    "mathavan": {"e_cushion": 0.98, "mu_cushion": 0.14},
    "factors": {},
}
"""What a cushion law is published with: a change of law brings them along unless they are given."""


@dataclasses.dataclass(frozen=True, slots=True)
class Range:
    """The values a parameter may have, in its unit."""

    low: float
    high: float
    unit: str = ""

    @property
    def allowed(self) -> str:
        """In words."""
        return f"must be a number from {self.low:g} to {self.high:g} {self.unit}".rstrip()


RANGES: Final[dict[str, Range]] = {
    "corner_mouth": Range(0.09, 0.16, "m"),
    "side_mouth": Range(0.09, 0.16, "m"),
    "corner_cut": Range(120.0, 170.0, "deg"),
    "side_cut": Range(95.0, 150.0, "deg"),
    "corner_shelf": Range(0.0, 0.07, "m"),
    "side_shelf": Range(0.0, 0.03, "m"),
    "corner_hole_radius": Range(0.045, 0.08, "m"),
    "side_hole_radius": Range(0.045, 0.08, "m"),
    "horn_radius": Range(0.001, 0.03, "m"),
    "cushion_width": Range(0.04, 0.06, "m"),
    "rail_width": Range(0.1, 0.2, "m"),
    "nose_height": Range(0.0286, 0.0414, "m"),
    "ball_mass": Range(0.1, 0.25, "kg"),
    "cue_mass": Range(0.3, 0.9, "kg"),
    "cue_end_mass": Range(0.0, 0.05, "kg"),
    "cue_length": Range(0.5, 2.0, "m"),
    "mu_tip": Range(0.3, 1.0),
    "e_tip": Range(0.5, 1.0),
    "mu_slide": Range(0.01, 1.0),
    "mu_spin": Range(0.001, 1.0),
    "mu_ball": Range(0.0, 1.0),
    "e_ball": Range(0.8, 1.0),
    "mu_cushion": Range(0.0, 1.0),
    "e_cushion": Range(0.0, 1.0),
    "cushion_parallel": Range(0.0, 1.0),
    "cushion_perpendicular": Range(0.0, 1.0),
    "cushion_spin": Range(0.0, 1.0),
    "v_max": Range(0.1, 20.0, "m/s"),
    "theta_max": Range(0.0, 89.0, "deg"),
    "e_cloth": Range(0.0, 0.9),
    "e_strike": Range(0.0, 0.9),
    "e_rail": Range(0.0, 0.9),
    "mu_rail": Range(0.0, 1.0),
    "rack_gap": Range(0.0, 1e-3, "m"),
}


def number_of(name: str, value: Any, limits: Range) -> float:
    """The value of a parameter; InvalidTable if it is no number in its range."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if not is_number or not limits.low <= value <= limits.high:
        raise InvalidTable(name, value, limits.allowed)
    return float(value)


def refuse_unless(name: str, value: Any, names: tuple[str, ...]) -> None:
    """Raise InvalidTable unless a value is one of these names."""
    if not isinstance(value, str) or value not in names:
        raise InvalidTable(name, value, f"must be one of {names}")
