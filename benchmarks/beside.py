"""Local play, events and environments beside those of an earlier commit, in one run: units a second of CPU time.

Two processes, one a commit, do the same work in turn; each ratio is the median over pairs of neighbouring runs, so that
a loaded machine slows both.
"""

import statistics
from collections.abc import Iterator
from pathlib import Path

from benchmarks.checkouts import Child, checkout
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
    with checkout(BASE) as base:
        return {"beside": list(rows(base, tuple(UNITS), 15 if full else 3))}


def rows(base: Path, works: tuple[str, ...], pairs: int) -> Iterator[Row]:
    """Each work done in turn."""
    before, now = (Child(tree, (str(CHILD), *works)) for tree in (base, ROOT))
    for work in works:
        before_units, now_units = UNITS[work]
        rates = [(rate(before, work, before_units), rate(now, work, now_units)) for _ in range(pairs)]
        yield {
            "work": work,
            "pairs": pairs,
            "before_per_s": round(statistics.median(first for first, _ in rates), 2),
            "now_per_s": round(statistics.median(after for _, after in rates), 2),
            "ratio": round(statistics.median(after / first for first, after in rates), 2),
        }
    before.end()
    now.end()


def rate(side: Child, work: str, units: int) -> float:
    """Units of a work that a side does in a second of CPU time."""
    seconds, done = side.ask(f"{work}\t{units}")
    return float(done / seconds)


if __name__ == "__main__":
    main("beside", measure)
