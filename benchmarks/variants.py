"""Runs of the engine with a part of its kernels replaced, each in a process and with a kernel cache of its own.

numba freezes constants and inner functions when it compiles, so a replacement has to be in place before the kernels
load. ``python -m benchmarks.variants JOB`` is the child process.
"""

import importlib
import os
import pickle
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from benchmarks.recording import ROOT


def run(
    prepare: str | None, task: str, *arguments: Any, interpreted: bool = False, patience: float | None = None
) -> Any:
    """What ``task(*arguments)`` returns in a new process in which ``prepare(*arguments)`` ran first.

    Args:
        prepare, task: "module:function"; ``prepare`` may replace parts of the kernels, or be None.
        interpreted: whether the kernels run as plain Python.
        patience: s, after which the process is ended.

    Raises:
        RuntimeError: the process failed; with what it wrote.
        subprocess.TimeoutExpired: it took longer than ``patience``.
    """
    with tempfile.TemporaryDirectory() as folder:
        job = Path(folder) / "job"
        job.write_bytes(pickle.dumps((prepare, task, arguments)))
        environment = os.environ | {"POOLIAD_CACHE_DIR": folder, "NUMBA_DISABLE_JIT": "1" if interpreted else "0"}
        command = [sys.executable, "-m", "benchmarks.variants", str(job)]
        done = subprocess.run(
            command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=patience
        )
        if done.returncode != 0:
            raise RuntimeError(f"{prepare or 'as it is'}, {task}{arguments!r}: {done.stderr[-2000:]}")
        return pickle.loads(job.with_suffix(".result").read_bytes())


def replace(module: str, name: str, value: Any) -> None:
    """Set ``module.name``, which must be there and not yet in use by compiled kernels.

    Raises:
        RuntimeError: the kernels are loaded already.
        AttributeError: there is no such name.
    """
    if "physics.kernels.entries" in sys.modules:
        raise RuntimeError(f"{module}.{name} cannot be replaced: the kernels are loaded")
    home = importlib.import_module(module)
    getattr(home, name)
    setattr(home, name, value)


def _function(place: str) -> Any:
    module, _, name = place.partition(":")
    return getattr(importlib.import_module(module), name)


def _child(path: Path) -> None:
    prepare, task, arguments = pickle.loads(path.read_bytes())
    if prepare is not None:
        _function(prepare)(*arguments)
    path.with_suffix(".result").write_bytes(pickle.dumps(_function(task)(*arguments)))


if __name__ == "__main__":
    _child(Path(sys.argv[1]))
