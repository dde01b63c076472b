"""Tournaments of in-process agents: games per second in one process, and with one and two worker processes.

Wall time of a whole event without clocks, journal, records and results included; starting the workers is timed apart.
"""

import tempfile
import time
from pathlib import Path

from benchmarks.command import main
from benchmarks.recording import Row, Tables
from client.arena.directory import EventDirectory
from client.arena.executors import InProcess, Pool, pool_of
from client.arena.runner import Runner
from client.arena.terms import Terms

SEED = 5
WORKERS = (1, 2)


def measure(full: bool) -> Tables:
    """One event of `random` against itself and one of `greedy` against `random`, in every kind of pool."""
    sizes = {"random": 60 if full else 5, "greedy": 6 if full else 1}
    return {"events": [row for agent, pairs in sizes.items() for row in of_agent(agent, pairs)]}


def of_agent(agent: str, pairs: int) -> list[Row]:
    """One event in this process, and in one and two worker processes."""
    event(agent, 1, InProcess())  # kernels loaded
    rows = [_row(agent, "inline", 1, pairs, 0.0, event(agent, pairs, InProcess()))]
    for workers in WORKERS:
        with pool_of("processes", workers) as pool:
            started = time.perf_counter()
            event(agent, workers, pool)  # workers started, kernels loaded
            starting = time.perf_counter() - started
            rows.append(_row(agent, "processes", workers, pairs, starting, event(agent, pairs, pool)))
    return rows


def event(agent: str, pairs: int, pool: Pool) -> float:
    """Wall seconds of an event of so many pairs."""
    entrants = [{"name": "one", "agent": agent}, {"name": "other", "agent": "random"}]
    values = {"name": "benchmark", "entrants": entrants, "pairs": pairs, "seconds": None, "seed": SEED}
    with tempfile.TemporaryDirectory() as folder:
        directory = EventDirectory.create(Path(folder) / "event", Terms.from_dict(values).to_dict())
        started = time.perf_counter()
        ledger = Runner(directory, pool).run()
        seconds = time.perf_counter() - started
    assert len(ledger.event.counted) == 2 * pairs
    return seconds


def _row(agent: str, executor: str, workers: int, pairs: int, starting: float, seconds: float) -> Row:
    games = 2 * pairs
    return {
        "agent": agent,
        "opponent": "random",
        "executor": executor,
        "workers": workers,
        "games": games,
        "seconds": round(seconds, 2),
        "games_per_second": round(games / seconds, 3),
        "first_games_s": round(starting, 2),
    }


if __name__ == "__main__":
    main("tournaments", measure)
