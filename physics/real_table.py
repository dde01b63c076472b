"""Tables as they are built: rounded jaws, drop edges, cushions and balls that know spin and speed.

Sources of the numbers, by the names that docstrings use:
WPA: World Pool-Billiard Association, *Tables and equipment specifications*;
BCA: Billiard Congress of America, *Equipment specifications* (2008);
Alciatore: D. G. Alciatore, *Pool physical properties* and the technical proofs TP A-14, A-31;
Han: I. Han, *Dynamics in carom and three cushion billiards*, J. Mech. Sci. Technol. 19 (2005);
Mathavan: S. Mathavan, M. R. Jackson, R. M. Parkin, *A theoretical analysis of billiard ball-cushion dynamics under
cushion impacts*, Proc. IMechE C 224 (2010); choice: our own, measured nowhere.
"""

import dataclasses
import functools
import math
from typing import Any, ClassVar, Final, Literal, Self, get_args

import numpy as np
from numpy.typing import NDArray

from physics import constants
from physics.errors import InvalidTable
from physics.mouths import Mouth, corner_mouth, side_mouth
from physics.pockets import Pocket, pockets_with_jaws
from physics.table import NAMED, Table

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

SPARE_BETWEEN_JAWS: Final = 1e-3
"""m. Two jaws are farther apart than a ball is thick, by this: never does a ball touch both."""

SPARE_AT_DROP: Final = 1e-3
"""m. A centre that touches the end of a facing is over the hole by this: never does a ball get behind a facing."""


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


@dataclasses.dataclass(frozen=True, repr=False)
class RealTable(Table):
    """A pool table with jaws; ``Table.nine_foot()``, ``eight_foot()`` and ``seven_foot()`` are the named ones.

    Any parameter but name, width and length can be replaced. Those of ``Table`` mean the same here, but ``mu_ball`` is
    used by the law ``consistent`` alone, the three ``cushion_*`` factors by ``factors`` alone, and there is no
    ``collisions``.

    Attributes:
        corner_mouth: 0.1143 m (4.5 in, WPA), side_mouth: 0.127 m (5 in, WPA), each 0.09 to 0.16: between virtual tips.
        nose_height: 0.03629025 m (63.5 % of the ball, WPA), 0.0286 to 0.0414: of the cushion's nose over the cloth.
        corner_cut: 142 deg (WPA), 120 to 170. side_cut: 104 deg (WPA), 95 to 150: between nose and facing.
        corner_shelf: 0.041275 m (1 5/8 in, BCA), 0 to 0.07. side_shelf: 0.0047625 m (3/16 in, WPA), 0 to 0.03: from the
            mouth's line to the drop edge, in the middle of the mouth.
        corner_hole_radius, side_hole_radius: 0.0635 m (choice), 0.045 to 0.08: of the drop edge, a circle.
        horn_radius: 0.00635 m (choice), 0.001 to 0.03: rounding between nose and facing, in plan.
        cushion_width: 0.0508 m (2 in, WPA), 0.04 to 0.06. rail_width: 0.1397 m (5.5 in, WPA), 0.1 to 0.2: from the nose
            line outwards, to the end of the rubber and of the rail.
        mu_roll: 0.01 (Alciatore), 0.001 to mu_slide.
        v_max: 12 m/s (choice), 0.1 to 20. theta_max: 85 deg (choice), 0 to 89.
        ball_mass: 0.170097 kg (6 oz, WPA), 0.1 to 0.25. cue_mass: 0.567 kg (20 oz, Alciatore), 0.3 to 0.9.
        cue_length: 1.45 m, 0.5 to 2.
        cue_end_mass: 0.0056699 kg (1/30 of the ball's, Alciatore TP A-31), 0 to 0.05: what of the cue moves aside;
            with 0 there is no squirt and no miscue.
        mu_tip: 0.6 (Alciatore), 0.3 to 1: friction between tip and ball, beyond which the stroke is a miscue.
        e_tip: 1 (as Leckie & Greenspan have it), 0.5 to 1: restitution between tip and ball.
        cushion: the cushion law: ``han`` (Han), ``mathavan`` (Mathavan), ``factors`` (as on the Olympiad's table).
        e_cushion, mu_cushion: restitution and friction of the nose for ``han`` (0.85 and 0.2: choice) and ``mathavan``
            (0.98 and 0.14: Mathavan), each 0 to 1. Another law brings its own along.
        ball: the law of two balls: ``alciatore`` (friction falls with slip: TP A-14), ``consistent``, ``fastfiz``.
        flight: whether balls leave the cloth (True): jump shots, hops, balls off the table. What follows counts then.
        e_cloth: 0.5 (Alciatore), 0 to 0.9: restitution of a ball that lands. e_strike: 0.5 (choice: as e_cloth), 0 to
            0.9: of the cue ball that the strike drives into the cloth; the tip is still at it then.
        e_pressed: 0 (choice), 0 to e_cloth: of a ball that a cushion presses down; with 0 no rail hit lifts a ball.
        e_rail, mu_rail: 0.5 and 0.2 (choice), 0 to 0.9 and 0 to 1: restitution and friction of the rails' tops.
    """

    width: float = SIZES["nine_foot"][0]
    length: float = SIZES["nine_foot"][1]
    corner_mouth: float = 0.1143
    side_mouth: float = 0.127
    nose_height: float = 0.03629025
    cue_mass: float = 0.567
    mu_roll: float = 0.01
    mu_ball: float = 0.06
    e_ball: float = 0.95
    v_max: float = 12.0
    theta_max: float = 85.0
    corner_cut: float = 142.0
    side_cut: float = 104.0
    corner_shelf: float = 0.041275
    side_shelf: float = 0.0047625
    corner_hole_radius: float = 0.0635
    side_hole_radius: float = 0.0635
    horn_radius: float = 0.00635
    cushion_width: float = 0.0508
    rail_width: float = 0.1397
    ball_mass: float = 0.170097
    cue_end_mass: float = 0.0056699
    mu_tip: float = 0.6
    e_tip: float = 1.0
    cushion: Cushion = "han"
    e_cushion: float = 0.85
    mu_cushion: float = 0.2
    ball: BallLaw = "alciatore"
    flight: bool = True
    e_cloth: float = 0.5
    e_strike: float = 0.5
    e_pressed: float = 0.0
    e_rail: float = 0.5
    mu_rail: float = 0.2

    FIXED: ClassVar[tuple[str, ...]] = ("name", "width", "length")
    has_jaws: ClassVar[bool] = True

    @classmethod
    def of_size(cls, name: str) -> Self:
        """The table of a name in ``SIZES``."""
        width, length = SIZES[name]
        return cls(name, width, length)

    def replace(self, **changes: Any) -> Self:
        """See ``Table.replace``; a new cushion law brings its constants along unless they are given."""
        law = changes.get("cushion")
        if isinstance(law, str) and law != self.cushion:
            changes = LAW_CONSTANTS.get(law, {}) | changes
        return super().replace(**changes)

    def __post_init__(self) -> None:
        if self.name not in SIZES:
            raise InvalidTable("name", self.name, f"must be one of {tuple(NAMED)}")
        if (self.width, self.length) != SIZES[self.name]:
            raise InvalidTable("width, length", (self.width, self.length), f"are {SIZES[self.name]} m on this table")
        for name, limits in (RANGES | {"mu_roll": Range(0.001, 1.0)}).items():
            object.__setattr__(self, name, _number(name, getattr(self, name), limits))
        if self.mu_roll > self.mu_slide:
            raise InvalidTable("mu_roll", self.mu_roll, Range(0.001, self.mu_slide).allowed)
        _refuse_unless("cushion", self.cushion, get_args(Cushion))
        _refuse_unless("ball", self.ball, get_args(BallLaw))
        if not isinstance(self.cue_test, bool):
            raise InvalidTable("cue_test", self.cue_test, "must be True or False")
        if not isinstance(self.flight, bool):
            raise InvalidTable("flight", self.flight, "must be True or False")
        object.__setattr__(self, "e_pressed", _number("e_pressed", self.e_pressed, Range(0.0, self.e_cloth)))
        self._refuse_impossible_mouth("corner")
        self._refuse_impossible_mouth("side")

    def _refuse_impossible_mouth(self, kind: str) -> None:
        """Raise InvalidTable where two jaws could be touched at once, or a ball get behind them."""
        mouth: Mouth = getattr(self, f"{kind}_shape")
        least = 2.0 * self.ball_radius + SPARE_BETWEEN_JAWS
        if not mouth.clearance > least:
            allowed = (
                f"must leave more than {least:g} m between its jaws, so that a ball never touches both; "
                f"with this cut and cushion width there are {mouth.clearance:.6f} m"
            )
            raise InvalidTable(f"{kind}_mouth", getattr(self, f"{kind}_mouth"), allowed)
        if not self._drops_before_facing_ends(mouth):
            allowed = "must let a ball that touches the end of a facing drop; with this shelf and cut it would not"
            raise InvalidTable(f"{kind}_hole_radius", mouth.hole_radius, allowed)
        if max(-mouth.hole_centre[0], -mouth.hole_centre[1]) + mouth.hole_radius > self.rail_width:
            allowed = f"must not reach beyond the rail, which is {self.rail_width:g} m wide"
            raise InvalidTable(f"{kind}_hole_radius", mouth.hole_radius, allowed)
        if not self._is_apart_from_bed(mouth):
            raise InvalidTable(
                f"{kind}_shelf", getattr(self, f"{kind}_shelf"), "must keep the hole behind the nose lines"
            )

    def _drops_before_facing_ends(self, mouth: Mouth) -> bool:
        """Whether centres between the ends of the facings are over the hole: beyond them no piece is needed."""
        (u, v), reach = mouth.hole_centre, mouth.hole_radius - SPARE_AT_DROP
        hole = (v, u)  # in jaw coordinates: a corner's hole is on the diagonal, a side mouth's at s = 0
        return (
            math.dist(mouth.beside_end(self.contact_distance), hole) <= reach
            and math.dist(mouth.before_ends, hole) <= reach
        )

    def _is_apart_from_bed(self, mouth: Mouth) -> bool:
        """Whether the hole has no part at a distance of rho or more from the nose lines."""
        u, v = mouth.hole_centre
        rho = self.contact_distance
        return math.dist((u, v), (rho, rho if mouth.in_corner else v)) > mouth.hole_radius

    @property
    def flies(self) -> bool:
        """See ``Table.flies``."""
        return self.flight

    @functools.cached_property
    def corner_shape(self) -> Mouth:
        """The corner mouths."""
        return corner_mouth(
            *(self.corner_mouth, self.corner_cut, self.corner_shelf),
            *(self.corner_hole_radius, self.horn_radius, self.cushion_width),
        )

    @functools.cached_property
    def side_shape(self) -> Mouth:
        """The side mouths."""
        return side_mouth(
            *(self.side_mouth, self.side_cut, self.side_shelf),
            *(self.side_hole_radius, self.horn_radius, self.cushion_width),
        )

    @functools.cached_property
    def contact_distance(self) -> float:
        """rho = sqrt(R^2 - (h - R)^2), m: how near to a nose line a centre on the cloth comes."""
        above = self.nose_height - self.ball_radius
        return math.sqrt(self.ball_radius * self.ball_radius - above * above)

    @functools.cached_property
    def pockets(self) -> tuple[Pocket, ...]:
        """See ``Table.pockets``."""
        return pockets_with_jaws(self.width, self.length, self.corner_shape, self.side_shape)

    @functools.cached_property
    def mouths(self) -> NDArray[np.float64]:
        """(6, 2) m: middle of each mouth, between the virtual tips; pockets SW W NW NE E SE."""
        mouths = np.array([np.mean(pocket.mouth, axis=0) for pocket in self.pockets])
        mouths.flags.writeable = False
        return mouths

    def contains(self, x: Any, y: Any) -> Any:
        """See ``Table.contains``: in the rectangle of the cushions or in a mouth, clear of its jaws and its hole."""
        return self._admits(x, y, 0.0)

    def in_play(self, x: float, y: float) -> bool:
        """See ``Table.in_play``."""
        return bool(self._admits(x, y, constants.PLACEMENT_TOLERANCE))

    def in_air(self, x: float, y: float, height: float) -> bool:
        """See ``Table.in_air``: within the rails' outer edge, R from every edge, and above the top of the rails."""
        u, v = 0.5 * self.width - abs(x - 0.5 * self.width), 0.5 * self.length - abs(y - 0.5 * self.length)
        if not (u >= -self.rail_width and v >= -self.rail_width):
            return False
        least = self.ball_radius - constants.PLACEMENT_TOLERANCE
        above_nose = height - (self.nose_height - self.ball_radius)
        if above_nose >= least:
            return True
        reach = math.sqrt(least * least - above_nose * above_nose)
        end = abs(y - 0.5 * self.length)
        corner, beside = self.corner_shape, self.side_shape
        if u >= reach and v >= reach:
            return True
        if u < corner.nose_end and v < corner.nose_end:
            return bool(_clear_of_jaw(corner, reach, u, v) and _clear_of_jaw(corner, reach, v, u))
        return end < beside.nose_end and v >= reach and bool(_clear_of_jaw(beside, reach, end, u))

    def _admits(self, x: Any, y: Any, over_edge: float) -> Any:
        """Whether a centre may be at (x, y); ``over_edge``: by how much it may be beyond the drop edge, m."""
        half_x, half_y = 0.5 * self.width, 0.5 * self.length
        side, end = abs(x - half_x), abs(y - half_y)
        u, v, rho = half_x - side, half_y - end, self.contact_distance - constants.PLACEMENT_TOLERANCE
        corner, beside = self.corner_shape, self.side_shape
        in_rectangle = (u >= rho) & (v >= rho)
        in_corner = _clear_of_jaw(corner, rho, u, v) & _clear_of_jaw(corner, rho, v, u)
        in_corner = in_corner & _off_hole(corner, over_edge, u, v) & (u < corner.nose_end) & (v < corner.nose_end)
        in_side = _clear_of_jaw(beside, rho, end, u) & _off_hole(beside, over_edge, u, end) & (end < beside.nose_end)
        return in_rectangle | in_corner | (in_side & (v >= rho))

    def to_dict(self) -> dict[str, Any]:
        """See ``Table.to_dict``."""
        values = super().to_dict()
        del values["collisions"]
        return values


def _clear_of_jaw(mouth: Mouth, rho: float, s: Any, d: Any) -> Any:
    """Whether a centre in jaw coordinates is no nearer than ``rho`` to the jaw, nor beyond its facing's end."""
    (start_s, start_d), (normal_s, normal_d) = mouth.facing_start, mouth.facing_normal
    at_s, at_d = s - start_s, d - start_d
    gap, foot = at_s * normal_s + at_d * normal_d, at_d * normal_s - at_s * normal_d
    horn_s, horn_d = s - mouth.nose_end, d + mouth.horn_radius
    reach = mouth.horn_radius + rho
    off_nose = (s < mouth.nose_end) | (d >= rho)
    off_facing = (foot < 0.0) | ((gap >= rho) & (foot <= mouth.facing_length))
    return off_nose & off_facing & (horn_s * horn_s + horn_d * horn_d >= reach * reach)


def _off_hole(mouth: Mouth, over_edge: float, u: Any, v: Any) -> Any:
    """Whether a centre is outside the drop edge: (u, v) as ``Mouth.hole_centre``."""
    at_u, at_v, radius = u - mouth.hole_centre[0], v - mouth.hole_centre[1], mouth.hole_radius - over_edge
    return at_u * at_u + at_v * at_v > radius * radius


def _number(name: str, value: Any, limits: Range) -> float:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if not is_number or not limits.low <= value <= limits.high:
        raise InvalidTable(name, value, limits.allowed)
    return float(value)


def _refuse_unless(name: str, value: Any, names: tuple[str, ...]) -> None:
    if not isinstance(value, str) or value not in names:
        raise InvalidTable(name, value, f"must be one of {names}")


for _name in SIZES:
    NAMED[_name] = functools.partial(RealTable.of_size, _name)
