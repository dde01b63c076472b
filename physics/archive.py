"""Results in files: NumPy archives, every bit kept."""

import json
from os import PathLike
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from physics.constants import N_BALLS
from physics.errors import InvalidTable
from physics.facts import FACTS_WORDS
from physics.kernels.layout import REAL_STATE_WIDTH, REAL_TRACE_WIDTH, STATE_WIDTH, TRACE_WIDTH
from physics.table import Table

File = str | PathLike[str]
Arrays = dict[str, NDArray[Any]]

Shapes = dict[str, tuple[type[np.generic], tuple[tuple[int, ...], ...]]]


def shapes(jaws: bool) -> Shapes:
    """Type and possible shapes of each array, with jaws or without; -1: any number. ``trace`` may be missing."""
    state, event = (REAL_STATE_WIDTH, REAL_TRACE_WIDTH) if jaws else (STATE_WIDTH, TRACE_WIDTH)
    return {
        "start": (np.float64, ((1, 2 * N_BALLS), (1, N_BALLS * state))),
        "final": (np.float64, ((1, 2 * N_BALLS),)),
        "facts": (np.int32, ((1, FACTS_WORDS),)),
        "trace": (np.float64, ((-1, event),)),
    }


def write(file: File, table: Table, arrays: Arrays) -> None:
    """Write a result's table and arrays."""
    described = np.array(json.dumps(table.to_dict()))
    with Path(file).open("wb") as out:  # by name, NumPy would add an ending
        np.savez(out, table=described, **arrays)  # type: ignore[arg-type]  # names of arrays alone


def read(file: File) -> tuple[Table, Arrays]:
    """Read what ``write`` wrote; see ``physics.Result.load``."""
    try:
        with Path(file).open("rb") as source, np.load(source, allow_pickle=False) as saved:
            arrays = dict(saved)
        table = Table.from_dict(json.loads(str(arrays.pop("table"))))
        for name, (kind, allowed) in shapes(table.has_jaws).items():
            if name in arrays or name != "trace":
                _refuse(name, arrays[name], kind, allowed)
    except (KeyError, ValueError, TypeError, AttributeError, EOFError, BadZipFile, InvalidTable) as error:
        raise ValueError(f"file = {str(file)!r}: must be what Result.save wrote ({error})") from error
    return table, arrays


def _refuse(name: str, array: NDArray[np.generic], kind: type[np.generic], shapes: tuple[tuple[int, ...], ...]) -> None:
    """Raise ValueError unless an array has its type and one of its shapes."""
    shape = array.shape if shapes[0][0] > 0 else (-1, *array.shape[1:])
    if array.dtype != kind or shape not in shapes:
        raise ValueError(f"{name} = {array.dtype} of shape {array.shape}: must be {kind.__name__} of {shapes}")
