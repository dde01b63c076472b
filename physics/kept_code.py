"""Compiled code, kept on disk by numba and taken from there without what numba needs to compile."""

import contextlib
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

_SETTINGS = threading.RLock()
"""Held while numba's settings, which are the whole process's, are another's."""


@contextlib.contextmanager
def kept_in(folder: Path | None) -> Iterator[None]:
    """Within, numba keeps what it compiles in ``folder``, or nowhere, and takes what lies there as it is."""
    import numba
    from numba.core.caching import Cache

    with _SETTINGS:
        place, load = numba.config.CACHE_DIR, Cache.load_overload
        numba.config.CACHE_DIR, Cache.load_overload = str(folder or ""), _taken
        try:
            yield
        finally:
            numba.config.CACHE_DIR, Cache.load_overload = place, load


def _taken(cache: Any, signature: Any, target: Any) -> Any:
    """``Cache.load_overload`` without filling numba's registries, which takes as long as all that the kernels load.

    Machine code calls nothing but numba's runtime. The registries are filled when something is compiled; scipy, which
    numba then asks for a BLAS, is not imported before.
    """
    from numba.core.runtime import rtsys

    rtsys.initialize(target)
    with cache._guard_against_spurious_io_errors():
        return cache._load_overload(signature, target)
