"""Loading the compiled geometry at its first use, and tables as it takes them."""

import functools
import importlib
import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from client.agents.search import shots as at
from client.geometry.openings import SIDES, entrance_of
from physics import RealTable, Table
from physics.constants import N_POCKETS
from physics.engine import cache_folder, digest_of
from physics.engine import kernels as physics_kernels
from physics.kept_code import kept_in


@functools.cache
def geometry(jaws: bool = False) -> Any:
    """The module of compiled geometry, ready, and the physics of tables with straight mouths or with jaws.

    Compiled once for a processor (some 10 s) and kept beside the physics.
    """
    physics_kernels(jaws)
    folder = cache_folder()
    own = None if folder is None else folder / f"search-{digest_of(Path(__file__).parent / 'compiled')[:16]}"
    with kept_in(own):
        module = importlib.import_module("client.agents.search.compiled.entries")
        _call_once(module)
    return module


def _call_once(module: Any) -> None:
    """Call every entry as `Sight` does: that is when it is compiled, or taken from the cache."""
    row, positions = table_row(Table.olympiad()), np.full((1, 16, 2), np.nan)
    positions[0, :2] = (0.5, 1.0), (0.3, 0.5)
    one, flag, number = np.zeros(1), np.zeros(1, bool), np.zeros(1, np.int64)
    memory = module.new_memory()
    module.survey(row, positions, 1e-3, flag, 0.0, memory, np.empty((1, 2, 5)))
    shooters, race = (np.zeros(1, np.int8), flag), np.zeros((4, 2, 2))
    module.worths(row, positions, positions, shooters, (1e-3, 0.0, 1.0, True), race, memory, np.empty(1))
    floats, integers = [np.zeros((1, 1)) for _ in range(3)], [np.zeros((1, 1), np.int64) for _ in range(2)]
    module.list_pots(row, positions, np.ones((1, 16), bool), 1e-3, (*integers, *floats))
    module.elevations(row, positions, number, (one, one, one), 0.1, one.copy())


@functools.lru_cache(maxsize=16)
def table_row(table: Table) -> NDArray[np.float64]:
    """A table as the geometry takes it: see WIDTH and its fellows."""
    row = np.zeros(at.MOUTHS + at.PER_POCKET * N_POCKETS)
    row[[at.WIDTH, at.LENGTH, at.RADIUS]] = table.width, table.length, table.ball_radius
    row[[at.NOSE, at.CUE_LENGTH]] = table.nose_height, table.cue_length
    mouths = row[at.MOUTHS :].reshape(N_POCKETS, at.PER_POCKET)
    mouths[:, [at.MOUTH_X, at.MOUTH_Y]] = table.mouths
    for mouth, pocket, (x, y) in zip(mouths, range(N_POCKETS), table.mouths.tolist(), strict=True):
        right, up = math.copysign(1.0, 0.5 * table.width - x), math.copysign(1.0, 0.5 * table.length - y)
        if pocket in SIDES:
            mouth[[at.INWARD_X, at.INWARD_Y, at.HALF_MOUTH]] = right, 0.0, 0.5 * table.side_mouth
        else:
            mouth[[at.INWARD_X, at.INWARD_Y]] = right / math.sqrt(2.0), up / math.sqrt(2.0)
            mouth[at.HALF_MOUTH] = (table.corner_reach - table.ball_radius) / math.sqrt(2.0)
    return _with_entrances(table, row) if isinstance(table, RealTable) else row


def _with_entrances(table: RealTable, row: NDArray[np.float64]) -> NDArray[np.float64]:
    """The row with the holes, and behind it what the corners and the side pockets let in."""
    corner, side = (
        np.concatenate(([math.radians(known.first), math.radians(known.step), known.reach, len(known.low)], *known[3:]))
        for known in (entrance_of(table, pocket) for pocket in (0, SIDES[0]))
    )
    mouths = row[at.MOUTHS :].reshape(N_POCKETS, at.PER_POCKET)
    for mouth, pocket in zip(mouths, table.pockets, strict=True):
        mouth[[at.HOLE_X, at.HOLE_Y]] = pocket.hole_centre
        mouth[at.ENTRANCE] = len(row) + (len(corner) if pocket.number in SIDES else 0)
    return np.concatenate((row, corner, side))
