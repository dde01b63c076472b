"""Tables as they are built: rounded jaws, drop edges, cushions and balls that know spin and speed."""

import dataclasses
import functools
import math
from typing import Any, ClassVar, Self, get_args

import numpy as np
from numpy.typing import NDArray

from physics import constants
from physics.centres import is_clear_in_air, is_on_cloth
from physics.errors import InvalidTable
from physics.mouth_checks import refuse_impossible_mouth
from physics.mouths import Mouth, corner_mouth, side_mouth
from physics.pockets import Pocket, pockets_with_jaws
from physics.specifications import LAW_CONSTANTS, RANGES, SIZES, BallLaw, Cushion, Range, number_of, refuse_unless
from physics.table import NAMED, Table


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
            object.__setattr__(self, name, number_of(name, getattr(self, name), limits))
        if self.mu_roll > self.mu_slide:
            raise InvalidTable("mu_roll", self.mu_roll, Range(0.001, self.mu_slide).allowed)
        refuse_unless("cushion", self.cushion, get_args(Cushion))
        refuse_unless("ball", self.ball, get_args(BallLaw))
        if not isinstance(self.cue_test, bool):
            raise InvalidTable("cue_test", self.cue_test, "must be True or False")
        if not isinstance(self.flight, bool):
            raise InvalidTable("flight", self.flight, "must be True or False")
        object.__setattr__(self, "e_pressed", number_of("e_pressed", self.e_pressed, Range(0.0, self.e_cloth)))
        for kind, mouth in (("corner", self.corner_shape), ("side", self.side_shape)):
            refuse_impossible_mouth(self, kind, mouth, self.contact_distance, self.rail_width)

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
        side, end = abs(x - 0.5 * self.width), abs(y - 0.5 * self.length)
        u, v = 0.5 * self.width - side, 0.5 * self.length - end
        if not (u >= -self.rail_width and v >= -self.rail_width):
            return False
        least = self.ball_radius - constants.PLACEMENT_TOLERANCE
        above_nose = height - (self.nose_height - self.ball_radius)
        return is_clear_in_air(u, v, end, (self.corner_shape, self.side_shape), least, above_nose)

    def _admits(self, x: Any, y: Any, over_edge: float) -> Any:
        """Whether a centre may be at (x, y); ``over_edge``: by how much it may be beyond the drop edge, m."""
        side, end = abs(x - 0.5 * self.width), abs(y - 0.5 * self.length)
        u, v, rho = (
            0.5 * self.width - side,
            0.5 * self.length - end,
            self.contact_distance - constants.PLACEMENT_TOLERANCE,
        )
        return is_on_cloth(u, v, end, (self.corner_shape, self.side_shape), rho, over_edge)

    def to_dict(self) -> dict[str, Any]:
        """See ``Table.to_dict``."""
        values = super().to_dict()
        del values["collisions"]
        return values


for _name in SIZES:
    NAMED[_name] = functools.partial(RealTable.of_size, _name)
