"""Where a ball's centre may be on a table with jaws: clear of cushions and jaws, and not over a hole.

A centre is given by its distances, m, from the nearest long nose line (u) and short nose line (v), and by its distance
along the table from the middle (end); ``mouths`` are the table's corner mouth and its side mouth.
"""

import math
from typing import Any

from physics.mouths import Mouth


def is_on_cloth(u: Any, v: Any, end: Any, mouths: tuple[Mouth, Mouth], rho: float, over_edge: float) -> Any:
    """Whether a centre on the cloth may be there.

    Args:
        rho: m, least distance from a nose line. over_edge: m, by how much it may be beyond the drop edge.
    """
    corner, beside = mouths
    in_rectangle = (u >= rho) & (v >= rho)
    in_corner = _clear_of_jaw(corner, rho, u, v) & _clear_of_jaw(corner, rho, v, u)
    in_corner = in_corner & _off_hole(corner, over_edge, u, v) & (u < corner.nose_end) & (v < corner.nose_end)
    in_side = _clear_of_jaw(beside, rho, end, u) & _off_hole(beside, over_edge, u, end) & (end < beside.nose_end)
    return in_rectangle | in_corner | (in_side & (v >= rho))


def is_clear_in_air(u: float, v: float, end: float, mouths: tuple[Mouth, Mouth], least: float, height: float) -> bool:
    """Whether a centre over the rails' rectangle is clear of them.

    Args:
        least: m, least distance from an edge. height: m, over the noses.
    """
    if height >= least:
        return True
    reach = math.sqrt(least * least - height * height)
    corner, beside = mouths
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
