"""How the step's kernels are compiled: entries kept in a cache, inner kernels into the entries that use them."""

import numba

compiled = numba.njit(error_model="numpy", nogil=True, cache=bool(numba.config.CACHE_DIR))
inner = numba.njit(error_model="numpy", nogil=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)
