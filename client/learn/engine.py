"""Loading the compiled step at its first use, and a table as it takes it."""

import functools
import importlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from client.geometry.placement import CLEARANCE
from client.learn import codec
from client.learn.compiled import layout as to
from physics import Table
from physics.constants import PLACEMENT_TOLERANCE
from physics.engine import cache_folder, digest_of, say_if_compiled_now
from physics.kept_code import kept_in


@functools.cache
def step() -> Any:
    """The entries of the compiled step, ready to be called; kept beside the physics' own compiled kernels."""
    folder = cache_folder()
    own = None if folder is None else folder / f"learn-{digest_of(Path(__file__).parent / 'compiled')[:16]}"
    with kept_in(own):
        say_if_compiled_now(own, "aiming", "the learning environments")  # which takes longest
        return importlib.import_module("client.learn.compiled.entries")


def table_row(table: Table) -> NDArray[np.float64]:
    """(T_SIZE,): see `layout`."""
    numbers = np.empty(to.T_SIZE)
    numbers[[to.T_WIDTH, to.T_LENGTH, to.T_HEAD]] = table.width, table.length, table.head_string
    numbers[to.T_RADIUS], numbers[to.T_CLEAR] = table.ball_radius, 2.0 * table.ball_radius + CLEARANCE
    numbers[[to.T_SPEED, to.T_ELEVATION, to.T_OFFSET]] = table.v_max, table.theta_max, codec.OFFSET
    numbers[[to.T_CLEARANCE, to.T_MARGIN, to.T_SLACK]] = CLEARANCE, codec.MARGIN, PLACEMENT_TOLERANCE
    return numbers


def lattice_of(table: Table) -> NDArray[np.float64]:
    """(3, m) m, NaN behind the end of each: x of the columns, y of the rows, y of the rows in the kitchen."""
    (columns, rows), radius = codec.LATTICE, table.ball_radius
    lines = np.full((3, max(columns, rows)), np.nan)
    lines[0, :columns] = np.linspace(radius, table.width - radius, columns)
    lines[1, :rows] = np.linspace(radius, table.length - radius, rows)
    lines[2, :rows] = np.linspace(table.head_string + CLEARANCE, table.length - radius, rows)
    return lines
