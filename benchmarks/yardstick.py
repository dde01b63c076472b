"""The player of an earlier commit as an opponent: a process in a checkout of its own, views in and actions out."""

import contextlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benchmarks.recording import ROOT
from protocol import View
from referee import Action

CHILD = ROOT / "benchmarks" / "yardstick_child.py"


class Yardstick:
    """A process that plays as an agent of another checkout does.

    Args:
        tree: the checkout. name: of the agent. seed: of its choices.

    Raises:
        RuntimeError: it ended, or loaded another checkout's code.
    """

    def __init__(self, tree: Path, name: str, seed: int) -> None:
        command = [sys.executable, "-P", str(CHILD), name, str(seed)]
        places, pipe = os.environ | {"PYTHONPATH": str(tree)}, subprocess.PIPE
        self._process = subprocess.Popen(command, env=places, cwd=tree, stdin=pipe, stdout=pipe, text=True)
        file = Path(self._read()["file"])
        if file.parents[1] != tree.resolve():
            raise RuntimeError(f"physics of {tree} was asked for, {file} was loaded")

    def ask(self, game: str, view: View) -> tuple[Action, float, int]:
        """Its action, the processor time it took, s, and the shots it simulated."""
        assert self._process.stdin is not None
        self._process.stdin.write(json.dumps({"game": game, "view": view.model_dump_json()}) + "\n")
        self._process.stdin.flush()
        said = self._read()
        return Action.from_dict(said["action"]), float(said["seconds"]), int(said["simulated"])

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
