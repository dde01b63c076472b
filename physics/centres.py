"""Where a ball's centre may be on a table with jaws: clear of cushions and jaws, and not over a hole."""

import math
from typing import TYPE_CHECKING, Any

from physics import constants
from physics.mouths import Mouth

if TYPE_CHECKING:
    from physics.real_table import RealTable


def is_on_cloth(table: "RealTable", x: Any, y: Any, over_edge: float) -> Any:
    """Whether a centre may be at (x, y); ``over_edge``: by how much it may be beyond the drop edge, m."""
    half_x, half_y = 0.5 * table.width, 0.5 * table.length
    side, end = abs(x - half_x), abs(y - half_y)
    u, v, rho = half_x - side, half_y - end, table.contact_distance - constants.PLACEMENT_TOLERANCE
    corner, beside = table.corner_shape, table.side_shape
    in_rectangle = (u >= rho) & (v >= rho)
    in_corner = _clear_of_jaw(corner, rho, u, v) & _clear_of_jaw(corner, rho, v, u)
    in_corner = in_corner & _off_hole(corner, over_edge, u, v) & (u < corner.nose_end) & (v < corner.nose_end)
    in_side = _clear_of_jaw(beside, rho, end, u) & _off_hole(beside, over_edge, u, end) & (end < beside.nose_end)
    return in_rectangle | in_corner | (in_side & (v >= rho))


def is_clear_in_air(table: "RealTable", x: float, y: float, height: float) -> bool:
    """Whether a centre may be at (x, y), ``height`` above where it rests on the cloth, m."""
    u, v = 0.5 * table.width - abs(x - 0.5 * table.width), 0.5 * table.length - abs(y - 0.5 * table.length)
    if not (u >= -table.rail_width and v >= -table.rail_width):
        return False
    least = table.ball_radius - constants.PLACEMENT_TOLERANCE
    above_nose = height - (table.nose_height - table.ball_radius)
    if above_nose >= least:
        return True
    reach = math.sqrt(least * least - above_nose * above_nose)
    end = abs(y - 0.5 * table.length)
    corner, beside = table.corner_shape, table.side_shape
    if u >= reach and v >= reach:
        return True
    if u < corner.nose_end and v < corner.nose_end:
        return bool(_clear_of_jaw(corner, reach, u, v) and _clear_of_jaw(corner, reach, v, u))
    return end < beside.nose_end and v >= reach and bool(_clear_of_jaw(beside, reach, end, u))


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
