"""How an entry point is compiled, and the types of its arguments."""

from typing import Any

import numba
from numba import types

READ = types.Array(types.float64, 2, "C", readonly=True)
WRITTEN = types.Array(types.float64, 2, "C")
COUNTERS, FACTS = types.Array(types.int64, 2, "C"), types.Array(types.int32, 2, "C")
POCKETS = types.Array(types.int8, 2, "C")
FLOAT, INTEGER, NONE = types.float64, types.int64, types.void


def entry(result: Any, *arguments: Any) -> Any:
    """Decorator: compiled when loaded, for these types alone, and kept where ``physics.engine`` says, if anywhere.

    What a kernel only reads may be a read-only array or another: both are taken as they are.
    """
    kept = bool(numba.config.CACHE_DIR)
    return numba.njit(result(*arguments), error_model="numpy", nogil=True, cache=kept)
