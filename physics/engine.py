"""Loading the compiled kernels, once, at the first use.

numba's own cache does not notice an edit in another file, or an upgrade of this package: here every hash of the
kernel sources has a cache folder of its own, so a stale one cannot be found. Where no folder can be written the
kernels are compiled for this process alone.
"""

import contextlib
import functools
import hashlib
import importlib
import os
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

WORK_FLOATS, WORK_INTEGERS = 392, 216
"""Size of the kernels' memory: W_SIZE and K_SIZE of ``physics.kernels.layout``, which a test compares."""

CACHE_VARIABLE = "POOLIAD_CACHE_DIR"
"""Environment variable naming the folder for compiled kernels; else the user's cache folder."""


@functools.cache
def digest() -> str:
    """SHA-256 over the sources of the kernels, hex: names this engine in records and caches."""
    return digest_of(Path(__file__).with_name("kernels"))


def digest_of(sources: Path) -> str:
    """SHA-256 over the names and bytes of the Python files in a folder, hex."""
    total = hashlib.sha256()
    for path in sorted(sources.rglob("*.py")):
        total.update(path.relative_to(sources).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return total.hexdigest()


def cache_folder() -> Path | None:
    """The folder for this engine's compiled kernels, made if need be; None if no place can be written."""
    places = [os.environ.get(CACHE_VARIABLE), os.environ.get("XDG_CACHE_HOME")]
    named = [Path(place) / "pooliad" for place in places if place]
    with contextlib.suppress(RuntimeError):  # there may be no home
        named.append(Path.home() / ".cache" / "pooliad")
    for place in [*named, Path(tempfile.gettempdir()) / f"pooliad-{os.getuid() if hasattr(os, 'getuid') else 0}"]:
        folder = place / f"kernels-{digest()[:16]}"
        try:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
            with tempfile.TemporaryFile(dir=folder):
                return folder
        except OSError:
            continue
    return None


def workspace() -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Fresh memory for the kernels to work out one shot at a time in; not to be shared between threads."""
    return np.empty((1, WORK_FLOATS)), np.empty((1, WORK_INTEGERS), np.int64)


@functools.cache
def kernels() -> Any:
    """The module of compiled entry points."""
    import numba

    folder = cache_folder()
    if folder is not None and not any(folder.iterdir()) and not numba.config.DISABLE_JIT:
        sys.stderr.write("pooliad: compiling the physics for this processor, once (10 to 20 s) ...\n")
    before = numba.config.CACHE_DIR
    try:
        numba.config.CACHE_DIR = str(folder or tempfile.mkdtemp(prefix="pooliad-"))
        return importlib.import_module("physics.kernels.entries")
    finally:
        numba.config.CACHE_DIR = before
