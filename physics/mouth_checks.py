"""Which pocket mouths can be: no ball touches both jaws at once, and none gets behind them."""

import math
from typing import Final

from physics.errors import InvalidTable
from physics.mouths import Mouth
from physics.table import Table

SPARE_BETWEEN_JAWS: Final = 1e-3
"""m. Two jaws are farther apart than a ball is thick, by this: never does a ball touch both."""

SPARE_AT_DROP: Final = 1e-3
"""m. A centre that touches the end of a facing is over the hole by this: never does a ball get behind a facing."""


def refuse_impossible_mouth(table: Table, kind: str, mouth: Mouth, rho: float, rail_width: float) -> None:
    """Raise InvalidTable where two jaws could be touched at once, or a ball get behind them.

    Args:
        table: whose mouths they are. kind: ``corner`` or ``side``.
        rho: m, how near to a nose line a centre on the cloth comes. rail_width: m.
    """
    least = 2.0 * table.ball_radius + SPARE_BETWEEN_JAWS
    if not mouth.clearance > least:
        allowed = (
            f"must leave more than {least:g} m between its jaws, so that a ball never touches both; "
            f"with this cut and cushion width there are {mouth.clearance:.6f} m"
        )
        raise InvalidTable(f"{kind}_mouth", getattr(table, f"{kind}_mouth"), allowed)
    if not _drops_before_facing_ends(mouth, rho):
        allowed = "must let a ball that touches the end of a facing drop; with this shelf and cut it would not"
        raise InvalidTable(f"{kind}_hole_radius", mouth.hole_radius, allowed)
    if max(-mouth.hole_centre[0], -mouth.hole_centre[1]) + mouth.hole_radius > rail_width:
        allowed = f"must not reach beyond the rail, which is {rail_width:g} m wide"
        raise InvalidTable(f"{kind}_hole_radius", mouth.hole_radius, allowed)
    if not _is_apart_from_bed(mouth, rho):
        raise InvalidTable(f"{kind}_shelf", getattr(table, f"{kind}_shelf"), "must keep the hole behind the nose lines")


def _drops_before_facing_ends(mouth: Mouth, rho: float) -> bool:
    """Whether centres between the ends of the facings are over the hole: beyond them no piece is needed."""
    (u, v), reach = mouth.hole_centre, mouth.hole_radius - SPARE_AT_DROP
    hole = (v, u)  # in jaw coordinates: a corner's hole is on the diagonal, a side mouth's at s = 0
    return math.dist(mouth.beside_end(rho), hole) <= reach and math.dist(mouth.before_ends, hole) <= reach


def _is_apart_from_bed(mouth: Mouth, rho: float) -> bool:
    """Whether the hole has no part at a distance of rho or more from the nose lines."""
    u, v = mouth.hole_centre
    return math.dist((u, v), (rho, rho if mouth.in_corner else v)) > mouth.hole_radius
