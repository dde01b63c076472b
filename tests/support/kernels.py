"""Inner kernels called by tests: they have no wrapper of their own for callers in Python."""

from collections.abc import Callable
from typing import Any

import numba

from physics.kernels.compiling import INTERPRETED


def from_python(kernel: Any) -> Callable[..., Any]:
    """The kernel as a function of Python, compiled as it is within an entry point; interpreted, itself."""
    return kernel if INTERPRETED else numba.njit(error_model="numpy", nogil=True)(kernel.py_func)
