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
import threading
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from physics.kept_code import kept_in
from physics.kernels.layout import K_SIZE, W_SIZE

_THREAD = threading.local()

CACHE_LINE = 64
"""Bytes."""

CACHE_VARIABLE = "POOLIAD_CACHE_DIR"
"""Environment variable naming the folder for compiled kernels; else the user's cache folder."""


@functools.cache
def digest() -> str:
    """SHA-256 over the sources of the kernels, hex: names the folder of their compiled code."""
    return digest_of(Path(__file__).with_name("kernels"))


def digest_of(sources: Path) -> str:
    """SHA-256 over the names and bytes of the Python files in a folder, hex."""
    total = hashlib.sha256()
    for path in sorted(sources.rglob("*.py")):
        total.update(path.relative_to(sources).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return total.hexdigest()


def cache_folder() -> Path | None:
    """The folder for this engine's compiled kernels, made if need be; None if no place can be written."""
    places = [Path(place) / "pooliad" for name in (CACHE_VARIABLE, "XDG_CACHE_HOME") if (place := os.environ.get(name))]
    with contextlib.suppress(RuntimeError):  # there may be no home
        places.append(Path.home() / ".cache" / "pooliad")
    with contextlib.suppress(OSError):  # nor a place for temporary files
        places.append(Path(tempfile.gettempdir()) / f"pooliad-{_user()}")
    return next((folder for place in places if (folder := _usable(place))), None)


def _user() -> int:
    return os.getuid() if hasattr(os, "getuid") else 0


def _usable(place: Path) -> Path | None:
    """The kernels' folder in ``place``, if it can be written and is nobody else's: what lies there is executed."""
    folder = place / f"kernels-{digest()[:16]}"
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        with tempfile.TemporaryFile(dir=folder):
            return folder if folder.stat().st_uid == _user() else None
    except OSError:
        return None


def _aligned(count: int) -> NDArray[np.float64]:
    """Memory of (1, count) float64 that begins at a cache line: the rows of sixteen balls fill whole lines."""
    memory = np.empty(count + CACHE_LINE // 8)
    first = -memory.ctypes.data % CACHE_LINE // 8
    return memory[first : first + count].reshape(1, count)


def workspace() -> NDArray[np.float64]:
    """This thread's memory for the kernels to work out one shot at a time in, (1, n) float64."""
    memory: NDArray[np.float64] | None = getattr(_THREAD, "memory", None)
    if memory is None:
        memory = _THREAD.memory = _aligned(W_SIZE + K_SIZE)
    return memory


@functools.cache
def kernels(jaws: bool = False) -> Any:
    """The module of compiled entry points: for tables with straight mouths, or with jaws."""
    return _load(_module(jaws))


def is_compiled(jaws: bool = False) -> bool:
    """Whether ``kernels(jaws)`` finds compiled code in the cache folder: then it takes a second, else minutes."""
    return _has_compiled(cache_folder(), _module(jaws))


def _module(jaws: bool) -> str:
    return "entries_real" if jaws else "entries"


def _has_compiled(folder: Path | None, module: str) -> bool:
    return folder is not None and any(folder.rglob(f"{module}.*.nbi"))


@functools.cache
def _load(module: str) -> Any:
    folder = cache_folder()
    with kept_in(folder):
        say_if_compiled_now(folder, module, "the physics" if module == "entries" else "the physics of tables with jaws")
        return importlib.import_module(f"physics.kernels.{module}")


def say_if_compiled_now(folder: Path | None, module: str, what: str) -> None:
    """A line on standard error where loading a module compiles it: nothing of it is in the folder yet."""
    import numba

    if not numba.config.DISABLE_JIT and not _has_compiled(folder, module):
        sys.stderr.write(f"pooliad: compiling {what} for this processor, once; this takes a minute or more ...\n")
