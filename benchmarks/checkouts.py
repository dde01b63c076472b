"""Code of other commits beside ours: checkouts, and processes in them that answer line by line."""

import contextlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Self

from benchmarks.recording import ROOT


@contextlib.contextmanager
def checkout(commit: str) -> Iterator[Path]:
    """A checkout of a commit, there as long as it is used."""
    with tempfile.TemporaryDirectory() as name:
        tree = Path(name) / "tree"
        subprocess.run(["git", "worktree", "add", "--detach", tree, commit], cwd=ROOT, check=True, capture_output=True)
        try:
            yield tree
        finally:
            subprocess.run(["git", "worktree", "remove", "--force", tree], cwd=ROOT, check=True)


class Child:
    """A script that runs on the code of a checkout, and answers each line with a line of JSON.

    Args:
        tree: the checkout. script: the file and its arguments. environment: variables beside those of this process.
        under: a command that runs the interpreter.

    Attributes:
        first: what it said at its start; ``file`` is where it found the physics.

    Raises:
        RuntimeError: it ended, or loaded another checkout's code.
    """

    def __init__(
        self,
        tree: Path,
        script: tuple[str, ...],
        *,
        environment: Mapping[str, str] | None = None,
        under: tuple[str, ...] = (),
    ) -> None:
        command = [*under, sys.executable, "-P", *script]
        places, pipe = os.environ | {"PYTHONPATH": str(tree)} | dict(environment or {}), subprocess.PIPE
        self._process = subprocess.Popen(command, env=places, cwd=tree, stdin=pipe, stdout=pipe, text=True)
        self.first: dict[str, Any] = self._read()
        if Path(self.first["file"]).parents[1] != tree.resolve():
            raise RuntimeError(f"physics of {tree} was asked for, {self.first['file']} was loaded")

    def ask(self, line: str) -> Any:
        """The answer to a line."""
        assert self._process.stdin is not None
        self._process.stdin.write(f"{line}\n")
        self._process.stdin.flush()
        return self._read()

    def _read(self) -> Any:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise RuntimeError(f"{self._process.args}: ended with {self._process.wait()}")
        return json.loads(line)

    def end(self) -> None:
        """Let the process end."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.end()
