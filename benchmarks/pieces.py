"""The pieces of a table with jaws as arrays, and how far centres lie beyond them: straight from ``table.pockets``.

Written anew, in the table's frame and without a broad phase, to judge the kernels by.
"""

import dataclasses

import numpy as np

import physics
from benchmarks.scenes import Floats


@dataclasses.dataclass(frozen=True)
class Pieces:
    """Noses and facings, horns, holes.

    Attributes:
        starts, ways, normals: (18, 2) of the 6 noses and then the 12 facings: m; unit vector along; unit vector into
            the table. lengths: (18,) m. strip_numbers: (18,) cushion, or 4 + jaw.
        horns: (12, 2) m. horn_radius: m. holes: (6, 2) m. hole_radii: (6,) m. rho: m, the contact distance in plan.
    """

    starts: Floats
    ways: Floats
    normals: Floats
    lengths: Floats
    strip_numbers: Floats
    horns: Floats
    horn_radius: float
    holes: Floats
    hole_radii: Floats
    rho: float


FIRST_JAW = 4
"""Numbers of walls: cushions W E S N = 0..3, then jaws."""

NOSES = ((1, 2, 0), (3, 4, 0), (5, 6, 3), (7, 8, 1), (9, 10, 1), (11, 0, 2))
"""(jaw at one end, jaw at the other, cushion)."""

INWARD = {0: (1.0, 0.0), 1: (-1.0, 0.0), 2: (0.0, 1.0), 3: (0.0, -1.0)}


def pieces_of(table: physics.RealTable) -> Pieces:
    """The pieces of a table."""
    jaws = {jaw.number: jaw for pocket in table.pockets for jaw in pocket.jaws}
    strips = [(jaws[a].nose_end, jaws[b].nose_end, INWARD[cushion], cushion) for a, b, cushion in NOSES]
    strips += [(jaw.facing_start, jaw.facing_end, jaw.facing_normal, FIRST_JAW + n) for n, jaw in sorted(jaws.items())]
    starts, ends, normals = (np.array([strip[k] for strip in strips]) for k in range(3))
    lengths = np.linalg.norm(ends - starts, axis=1)
    return Pieces(
        starts,
        (ends - starts) / lengths[:, None],
        normals,
        lengths,
        np.array([strip[3] for strip in strips]),
        np.array([jaw.horn_centre for _, jaw in sorted(jaws.items())]),
        table.horn_radius,
        np.array([pocket.hole_centre for pocket in table.pockets]),
        np.array([pocket.hole_radius for pocket in table.pockets]),
        table.contact_distance,
    )


def beyond(pieces: Pieces, places: Floats) -> Floats:
    """(...,) m: how deep centres (..., 2) lie in the piece they are deepest in; negative: clear of all; NaN for NaN."""
    from_start = places[..., None, :] - pieces.starts
    along = (from_start * pieces.ways).sum(axis=-1)
    depth = pieces.rho - (from_start * pieces.normals).sum(axis=-1)
    depth = np.where((along >= 0.0) & (along <= pieces.lengths), depth, -np.inf).max(axis=-1)
    to_horn = np.linalg.norm(places[..., None, :] - pieces.horns, axis=-1).min(axis=-1)
    to_hole = (pieces.hole_radii - np.linalg.norm(places[..., None, :] - pieces.holes, axis=-1)).max(axis=-1)
    return np.asarray(np.maximum(np.maximum(depth, pieces.horn_radius + pieces.rho - to_horn), to_hole))
