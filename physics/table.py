"""The table: its dimensions, its friction and the names of its collision laws.

A ``Table`` is a frozen value. The constructors are named tables; ``replace`` changes single parameters within
validated ranges. Lengths in metres, origin at the south-west corner of the cushion noses (Olympiad frame). This class
is the Olympiad's table, with straight pocket mouths; tables with jaws are ``physics.real_table``.
"""

import dataclasses
import hashlib
import json
import math
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Self, get_args, overload

import numpy as np
from numpy.typing import NDArray

from physics import constants, notebook
from physics.errors import InvalidTable
from physics.pockets import Pocket, straight_pockets

if TYPE_CHECKING:
    from physics.real_table import RealTable

Collisions = Literal["consistent", "fastfiz"]
"""Named sets of collision laws; ``docs/physics.md`` gives each with its source."""

RANGES: dict[str, tuple[float, float]] = {
    "mu_slide": (0.01, 1.0),
    "mu_spin": (0.001, 1.0),
    "mu_ball": (0.0, 1.0),
    "e_ball": (0.8, 1.0),
    "cushion_parallel": (0.0, 1.0),
    "cushion_perpendicular": (0.0, 1.0),
    "cushion_spin": (0.0, 1.0),
    "rack_gap": (0.0, 1e-3),
}
NAMED: dict[str, Callable[[], "Table"]] = {}
"""Every named table: what makes it, by its name."""


@dataclasses.dataclass(frozen=True)
class Table:
    """A pool table with its balls and cue.

    Attributes:
        name: which named table this started from.
        width, length: m, nose to nose.
        corner_mouth, side_mouth: m, width of the pocket mouths.
        nose_height: m, height of the cushion nose above the cloth.
        cue_length: m; cue_mass: kg.
        mu_slide, mu_roll, mu_spin: cloth friction of a sliding, rolling and spinning ball.
        mu_ball, e_ball: friction and restitution between two balls.
        cushion_parallel, cushion_perpendicular, cushion_spin: factors a rail collision applies to the
            velocity along and across the cushion (the latter also reverses) and to the spin.
        v_max: m/s, theta_max: deg, the greatest cue speed and elevation.
        rack_gap: m, gap between neighbouring balls of the rack.
        collisions: the set of collision laws.
        cue_test: whether a cue blocked by a ball or a cushion makes a shot unplayable.
    """

    name: str
    width: float = 1.116
    length: float = 2.236
    corner_mouth: float = 0.11
    side_mouth: float = 0.12
    nose_height: float = 0.040005
    cue_length: float = 1.45
    cue_mass: float = constants.CUE_MASS
    mu_slide: float = 0.2
    mu_roll: float = 0.015
    mu_spin: float = 0.044
    mu_ball: float = 0.01
    e_ball: float = 1.0
    cushion_parallel: float = 0.9
    cushion_perpendicular: float = 0.6
    cushion_spin: float = 0.1
    v_max: float = constants.V_MAX
    theta_max: float = constants.THETA_MAX
    rack_gap: float = 2.0 * constants.BALL_RADIUS * 5e-5
    collisions: Collisions = "consistent"
    cue_test: bool = True

    FIXED: ClassVar[tuple[str, ...]] = (
        *("name", "width", "length", "corner_mouth", "side_mouth", "nose_height"),
        *("cue_length", "cue_mass", "v_max", "theta_max"),
    )
    """Parameters that ``replace`` does not change."""

    has_jaws: ClassVar[bool] = False
    """Whether pocket mouths have jaws, or are straight lines."""

    @classmethod
    def olympiad(cls) -> "Table":
        """The Computational Pool Olympiad's table with consistent collision physics: the default."""
        return Table("olympiad")

    @classmethod
    def fastfiz(cls) -> "Table":
        """The same table with the historical engine's formulas, faults included, and no test of the cue."""
        return Table("fastfiz", collisions="fastfiz", cue_test=False)

    @classmethod
    def nine_foot(cls) -> "RealTable":
        """A nine-foot pool table, 2.54 m by 1.27 m, with jaws: see ``physics.real_table.RealTable``."""
        return _real_table("nine_foot")

    @classmethod
    def eight_foot(cls) -> "RealTable":
        """An eight-foot pool table, 92 in by 46 in (2.3368 m by 1.1684 m), with the pockets of the nine-foot one."""
        return _real_table("eight_foot")

    @classmethod
    def seven_foot(cls) -> "RealTable":
        """A seven-foot pool table, 78 in by 39 in (1.9812 m by 0.9906 m), with the pockets of the nine-foot one."""
        return _real_table("seven_foot")

    @classmethod
    def named(cls, name: str) -> "Table":
        """The named table.

        Raises:
            InvalidTable: there is none of this name.
        """
        if not isinstance(name, str) or name not in NAMED:
            raise InvalidTable("name", name, f"must be one of {tuple(NAMED)}")
        return NAMED[name]()

    def replace(self, **changes: Any) -> Self:
        """Return a copy with some parameters changed.

        Raises:
            InvalidTable: an unknown or fixed parameter, or a value outside its range.
        """
        names = [name for name in self.to_dict() if name not in self.FIXED]
        for name, value in changes.items():
            if name not in names:
                raise InvalidTable(name, value, f"is not a parameter that can be replaced; these can: {names}")
        return dataclasses.replace(self, **changes)

    def __post_init__(self) -> None:
        if self.name not in ("olympiad", "fastfiz"):
            raise InvalidTable("name", self.name, f"must be one of {tuple(NAMED)}")
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if field.name not in self.FIXED:
                _check_parameter(field.name, value, mu_slide=self.mu_slide)
            elif field.name != "name" and value != field.default:
                raise InvalidTable(field.name, value, f"is {field.default} on this table")

    @property
    def flies(self) -> bool:
        """Whether balls leave the cloth."""
        return False

    @property
    def ball_radius(self) -> float:
        """Radius of a ball, m."""
        return constants.BALL_RADIUS

    @property
    def ball_mass(self) -> float:
        """Mass of a ball, kg."""
        return constants.BALL_MASS

    @property
    def gravity(self) -> float:
        """m/s^2."""
        return constants.GRAVITY

    @property
    def head_string(self) -> float:
        """The y of the head string, m; the kitchen lies beyond it (y greater)."""
        return 0.75 * self.length

    @property
    def foot_spot(self) -> tuple[float, float]:
        """Where the apex ball of the rack stands, m."""
        return 0.5 * self.width, 0.25 * self.length

    @property
    def corner_reach(self) -> float:
        """Length of a corner mouth measured along each of its cushions, m."""
        return self.corner_mouth / math.sqrt(2.0)

    @cached_property
    def pockets(self) -> tuple[Pocket, ...]:
        """The six pockets SW W NW NE E SE, for whoever draws them; m, in the table's frame."""
        return straight_pockets(self.width, self.length, self.corner_reach, self.side_mouth)

    @cached_property
    def mouths(self) -> NDArray[np.float64]:
        """(6, 2) m: middle of each mouth line for the ball's centre, pockets SW W NW NE E SE."""
        radius = self.ball_radius
        near = 0.5 * (self.corner_reach + radius)
        east, north = self.width - near, self.length - near
        west_side, east_side, middle = radius, self.width - radius, 0.5 * self.length
        mouths = np.array(
            [[near, near], [west_side, middle], [near, north], [east, north], [east_side, middle], [east, near]]
        )
        mouths.flags.writeable = False
        return mouths

    @overload
    def contains(self, x: float, y: float) -> bool: ...
    @overload
    def contains(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.bool_]: ...
    def contains(self, x: Any, y: Any) -> Any:
        """Whether a ball's centre may lie at (x, y), m: on a cushion line it may, on a mouth line it may not.

        ``PLACEMENT_TOLERANCE`` off a cushion line counts as on it. Of arrays each pair is answered.
        """
        half_x, half_y = 0.5 * self.width, 0.5 * self.length
        side, end = abs(x - half_x), abs(y - half_y)
        radius, slack = self.ball_radius, constants.PLACEMENT_TOLERANCE
        inside = (side <= half_x - radius + slack) & (end <= half_y - radius + slack)
        beside_side_mouth = (side < half_x - radius) | (end >= 0.5 * self.side_mouth)
        return inside & beside_side_mouth & (side + end < half_x + half_y - self.corner_reach - radius)

    def in_air(self, _x: float, _y: float, _height: float) -> bool:
        """Whether a flying ball may be at (x, y) m, its centre ``height`` m above where it rests on the cloth."""
        return False

    def in_play(self, x: float, y: float) -> bool:
        """Whether a ball may pass (x, y), m: within cushion and mouth lines, to ``PLACEMENT_TOLERANCE``."""
        half_x, half_y = 0.5 * self.width, 0.5 * self.length
        side, end, reach = abs(x - half_x), abs(y - half_y), constants.PLACEMENT_TOLERANCE - self.ball_radius
        inside = side <= half_x + reach and end <= half_y + reach
        return inside and side + end <= half_x + half_y - self.corner_reach + reach

    def __repr__(self) -> str:
        named = self.named(self.name).to_dict()
        changes = [f"{name}={value!r}" for name, value in self.to_dict().items() if value != named[name]]
        return f"Table.{self.name}()" + (f".replace({', '.join(changes)})" if changes else "")

    def _repr_svg_(self) -> str:
        return notebook.picture(self)

    def to_dict(self) -> dict[str, Any]:
        """Plain values by parameter name; ``from_dict`` reads them back."""
        return dataclasses.asdict(self)

    @classmethod
    def of(cls, table: "str | Mapping[str, Any]") -> "Table":
        """A table by its name, or read as ``from_dict`` does; raises InvalidTable as that does."""
        return cls.from_dict({"name": table} if isinstance(table, str) else table)

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> "Table":
        """Read a table written by ``to_dict``; parameters left out have the named table's value.

        Raises:
            InvalidTable: unknown table name or parameter, a fixed parameter changed, a value out of range.
        """
        if not isinstance(values, Mapping):
            raise InvalidTable("table", values, "must be a mapping of parameters by name")
        base = cls.named(values.get("name"))  # type: ignore[arg-type]  # whatever came is refused
        known = base.to_dict()
        same = {key: known[key] for key, value in values.items() if key in known and _same(known[key], value)}
        changes = {
            key: same.get(key, value) for key, value in values.items() if key not in same or key not in base.FIXED
        }
        return base.replace(**changes)

    @cached_property
    def digest(self) -> str:
        """SHA-256 over every parameter, hex: names this table in records and commitments."""
        text = json.dumps(self.to_dict(), sort_keys=True, separators=(",", ":"))
        return hashlib.sha256(text.encode()).hexdigest()


def _same(known: Any, value: Any) -> bool:
    """Whether a value is the known number, text or truth value, and of its kind."""
    return (
        isinstance(value, bool) == isinstance(known, bool) and isinstance(value, float | int | str) and value == known
    )


def _check_parameter(name: str, value: Any, *, mu_slide: Any) -> None:
    """Raise InvalidTable unless ``value`` is allowed for the replaceable parameter ``name``."""
    if name == "collisions":
        if not isinstance(value, str) or value not in get_args(Collisions):
            raise InvalidTable(name, value, f"must be one of {get_args(Collisions)}")
        return
    if name == "cue_test":
        if not isinstance(value, bool):
            raise InvalidTable(name, value, "must be True or False")
        return
    ranges = RANGES | {"mu_roll": (0.001, mu_slide)}
    low, high = ranges[name]
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    if not is_number or not low <= value <= high:
        raise InvalidTable(name, value, f"must be a number in [{low}, {high}]")


def _real_table(name: str) -> "RealTable":
    from physics.real_table import RealTable  # which is a kind of Table

    return RealTable.of_size(name)


NAMED.update(olympiad=Table.olympiad, fastfiz=Table.fastfiz)
