"""Local play, events and environments beside those of an earlier commit, in one run: units a second of CPU time.

Two processes, one a commit, do the same work in turn; each ratio is the median over pairs of neighbouring runs, so that
a loaded machine slows both.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benchmarks.command import main
from benchmarks.recording import ROOT, Row, Tables

BASE = "687740a"
"""Before views, rulings and records were made for their readers alone, and the environments' step compiled."""

CHILD = ROOT / "benchmarks" / "beside_child.py"
UNITS = {
    "play random": (10, 40),
    "play greedy": (1, 1),
    "event random": (1, 4),
    "steps, 1024 games": (1, 8),
    "steps, 1 game": (150, 600),
}
"""Of every work, what is done at a time: games, pairs of games, rounds or steps; before, and now."""


def measure(full: bool) -> Tables:
    """A row for each work."""
    with tempfile.TemporaryDirectory() as name:
        base = Path(name) / "base"
        subprocess.run(["git", "worktree", "add", "--detach", base, BASE], cwd=ROOT, check=True)
        try:
            return {"beside": list(rows(base, tuple(UNITS), 15 if full else 3))}
        finally:
            subprocess.run(["git", "worktree", "remove", "--force", base], cwd=ROOT, check=True)


def rows(base: Path, works: tuple[str, ...], pairs: int) -> Iterator[Row]:
    """Each work done in turn."""
    before, now = Side(base, works), Side(ROOT, works)
    for work in works:
        before_units, now_units = UNITS[work]
        rates = [(before.rate(work, before_units), now.rate(work, now_units)) for _ in range(pairs)]
        yield {
            "work": work,
            "pairs": pairs,
            "before_per_s": round(statistics.median(rate for rate, _ in rates), 2),
            "now_per_s": round(statistics.median(rate for _, rate in rates), 2),
            "ratio": round(statistics.median(after / first for first, after in rates), 2),
        }
    before.end()
    now.end()


class Side:
    """A process that does the works in one checkout."""

    def __init__(self, tree: Path, works: tuple[str, ...]) -> None:
        command = [sys.executable, "-P", str(CHILD), *works]
        places, pipe = os.environ | {"PYTHONPATH": str(tree)}, subprocess.PIPE
        self._process = subprocess.Popen(command, env=places, cwd=tree, stdin=pipe, stdout=pipe, text=True)
        file = Path(self._read()["file"])
        if file.parents[1] != tree.resolve():
            raise RuntimeError(f"physics of {tree} was asked for, {file} was loaded")

    def rate(self, work: str, units: int) -> float:
        """Units of a work a second of CPU time."""
        assert self._process.stdin is not None
        self._process.stdin.write(f"{work}\t{units}\n")
        self._process.stdin.flush()
        seconds, done = self._read()
        return float(done / seconds)

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


if __name__ == "__main__":
    main("beside", measure)
