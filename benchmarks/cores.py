"""Two threads against one, and what two cores give at all: one thread alone, and beside a process that does the same.

Two processes share nothing but the machine. What two threads lose beyond what they lose is the threads' own.
"""

import statistics
import subprocess
import sys

import numpy as np

import physics
from benchmarks import scenes, timing
from benchmarks.command import main
from benchmarks.recording import ROOT, Row, Tables
from benchmarks.speed import TABLE, threads

BUSY = "from benchmarks.cores import keep_busy; keep_busy()"


def measure(full: bool) -> Tables:
    """Both tables; on idle cores alone they say something."""
    shots, repeats = (80_000, 15) if full else (16_000, 5)
    return {"threads": list(threads(shots, repeats)), "processes": [beside(shots, repeats)]}


def beside(shots: int, repeats: int) -> Row:
    """Time on the wall of a batch alone, and beside a process that simulates all the time, in turn."""
    batch = some(shots)
    alone, with_another = [], []
    for _ in range(repeats):
        alone.append(timing.wall_seconds(lambda: physics.simulate_batch(TABLE, *batch, threads=1)))
        command = [sys.executable, "-c", BUSY]
        with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE) as other:
            assert other.stdout is not None
            other.stdout.readline()
            with_another.append(timing.wall_seconds(lambda: physics.simulate_batch(TABLE, *batch, threads=1)))
            other.kill()
    times = statistics.median(with_another) / statistics.median(alone)
    return {
        "shots": shots,
        "alone_s": round(statistics.median(alone), 4),
        "beside_another_s": round(statistics.median(with_another), 4),
        "two_of_one": round(2.0 / times, 2),
    }


def some(shots: int) -> tuple[scenes.Floats, scenes.Floats]:
    """States and shots of sixteen balls."""
    return scenes.playable_mid_game(TABLE, np.random.default_rng(2), shots, 16)


def keep_busy() -> None:
    """Simulate until this process is killed; a line is printed when it has begun."""
    batch = some(8_000)
    physics.simulate_batch(TABLE, *batch, threads=1)
    print("busy", flush=True)
    while True:
        physics.simulate_batch(TABLE, *batch, threads=1)


if __name__ == "__main__":
    main("cores", measure)
