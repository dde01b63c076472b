"""Data lines: what a run measured, on which machine, from which commit, with which libraries.

A run appends one JSON object to ``benchmarks/results/NAME.jsonl``. Its ``id`` is what documents cite.
"""

import datetime
import json
import os
import platform
import subprocess
import time
from collections.abc import Callable
from importlib import metadata
from pathlib import Path
from typing import Any

from physics.engine import digest

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "benchmarks" / "results"
LIBRARIES = ("numpy", "numba", "llvmlite", "scipy", "mpmath")

MEASURED = ("physics", "calibration", "referee", "client", "server", "tournament", "benchmarks/*.py")
"""What a line's commit is meant to say; the lines themselves change with every run."""
WIDEST = 60
"""Letters in a printed cell; the data line holds all."""

Row = dict[str, Any]
Tables = dict[str, list[Row]]
"""What a benchmark measures: named tables, each a list of rows with the same keys."""


def run(name: str, measure: Callable[[bool], Tables], full: bool) -> dict[str, Any]:
    """Run one benchmark, print its tables and append its line; the line.

    A line made with changes that are not committed, or while the checkout changed, says so in ``uncommitted``.
    """
    started, load, before = time.perf_counter(), os.getloadavg()[0], describe(name, full)
    tables = measure(full)
    line = before | {
        "uncommitted": before["uncommitted"] or _source(before) != _source(describe(name, full)),
        "seconds": round(time.perf_counter() - started, 1),
        "load_before": round(load, 2),
        "tables": tables,
    }
    append(line)
    for title, rows in tables.items():
        print(f"\n{title}\n{as_text(rows)}")
    print(f"\n{line['id']} -> {path_of(name).relative_to(ROOT)}")
    return line


def describe(name: str, full: bool) -> dict[str, Any]:
    """Who measured: machine, commit, kernels, libraries."""
    now = datetime.datetime.now(datetime.UTC)
    commit = _git("rev-parse", "--short", "HEAD")
    return {
        "id": f"{name}-{now:%Y%m%dT%H%M%S}",
        "benchmark": name,
        "full": full,
        "commit": commit,
        "uncommitted": bool(_git("status", "--porcelain", "--", *MEASURED)),
        "kernels": digest()[:16],
        "machine": _machine(),
        "versions": {"python": platform.python_version(), **_versions()},
    }


def _source(line: dict[str, Any]) -> tuple[Any, ...]:
    """What was measured."""
    return line["commit"], line["kernels"], line["uncommitted"]


def path_of(name: str) -> Path:
    """Where the lines of a benchmark are kept."""
    return RESULTS / f"{name}.jsonl"


def append(line: dict[str, Any]) -> None:
    """Add one line to the benchmark's file."""
    RESULTS.mkdir(exist_ok=True)
    with path_of(line["benchmark"]).open("a", encoding="utf-8") as file:
        file.write(json.dumps(line, allow_nan=False) + "\n")


def lines(name: str) -> list[dict[str, Any]]:
    """All lines of a benchmark, oldest first."""
    path = path_of(name)
    return [json.loads(text) for text in path.read_text().splitlines()] if path.exists() else []


def best_line(name: str, title: str) -> dict[str, Any] | None:
    """The line to cite for a table: the latest full run that has it, else the latest of all."""
    found = [line for line in lines(name) if title in line["tables"]]
    return next((line for line in reversed(found) if line["full"]), found[-1] if found else None)


def as_text(rows: list[Row]) -> str:
    """Rows in aligned columns."""
    if not rows:
        return "  (none)"
    cells = [list(rows[0]), *([shortened(value) for value in row.values()] for row in rows)]
    widths = [max(len(row[n]) for row in cells) for n in range(len(cells[0]))]
    return "\n".join("  " + "  ".join(c.rjust(w) for c, w in zip(row, widths, strict=True)) for row in cells)


def shortened(value: Any) -> str:
    """A value no wider than a column should be."""
    text = show(value)
    return text if len(text) <= WIDEST else text[: WIDEST - 3] + "..."


def show(value: Any) -> str:
    """A value as short as it is useful."""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.3g}" if abs(value) < 1000.0 else f"{value:,.0f}"
    return f"{value:,}" if isinstance(value, int) else str(value)


def _git(*arguments: str) -> str:
    done = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False)
    return done.stdout.strip()


def _machine() -> dict[str, Any]:
    model = platform.processor() or platform.machine()
    try:
        found = [text for text in Path("/proc/cpuinfo").read_text().splitlines() if text.startswith("model name")]
        model = found[0].partition(":")[2].strip() if found else model
    except OSError:
        pass
    return {"processor": model, "cores": os.cpu_count(), "system": f"{platform.system()} {platform.machine()}"}


def _versions() -> dict[str, str]:
    found = {}
    for name in LIBRARIES:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return found
