"""How the geometry is compiled: kernels called from Python, and those that only kernels call."""

import numba

BARE = {"error_model": "numpy", "nogil": True, "_nrt": False}
"""Nothing is allocated here, so nobody has to count who holds an array: counting took more time than the geometry."""
compiled = numba.njit(cache=bool(numba.config.CACHE_DIR), **BARE)
inner = numba.njit(no_cpython_wrapper=True, no_cfunc_wrapper=True, **BARE)
