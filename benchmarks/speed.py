"""Kernel time per event and per shot, overhead of one call, price of a trace, threads, import times."""

import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

import physics
from benchmarks import scenes, timing
from benchmarks.command import main
from benchmarks.recording import Row, Tables

TABLE = physics.Table.olympiad()
BALLS = (2, 4, 8, 16)


def measure(full: bool) -> Tables:
    """All tables of this benchmark."""
    shots, repeats = (20_000, 9) if full else (4_000, 5)
    return {
        "per_event": list(per_event(shots, repeats)),
        "single_call": list(single_call(shots // 8, repeats)),
        "trace": list(trace(shots // 8, repeats)),
        "threads": list(threads(4 * shots, repeats)),
        "imports": list(imports(5 if full else 3)),
    }


def workloads(shots: int) -> Iterator[tuple[str, scenes.Floats, scenes.Floats]]:
    """(name, states, shots): every shot different, all of them playable."""
    rng = np.random.default_rng(1)
    for balls in BALLS:
        yield f"{balls} balls", *scenes.playable_mid_game(TABLE, rng, shots, balls)
    yield "break", *scenes.played(TABLE, *scenes.breaks(TABLE, rng, shots // 4))


def per_event(n: int, repeats: int) -> Iterator[Row]:
    """CPU time of ``simulate_batch``, checks and outputs included, by event and by shot."""
    for name, states, shots in workloads(n):
        batch = physics.simulate_batch(TABLE, states, shots)
        events = int(batch.n_events.sum())

        def work(states: scenes.Floats = states, shots: scenes.Floats = shots) -> None:
            physics.simulate_batch(TABLE, states, shots)

        seconds, pairs = timing.in_pairs(work, repeats)
        yield {
            "scene": name,
            "shots": len(shots),
            "events_per_shot": round(events / len(shots), 2),
            "us_per_shot": round(seconds / len(shots) * 1e6, 3),
            "ns_per_event": round(seconds / events * 1e9, 1),
            "pairs_per_event": round(pairs / events, 2),
            "pair_ns": round(seconds / pairs * 1e9, 3),
        }


Prepared = list[tuple[physics.TableState, physics.Shot]]


def prepared(states: scenes.Floats, shots: scenes.Floats) -> Prepared:
    """The same scenes as values, as a caller of ``simulate`` holds them."""
    return [
        (physics.TableState.from_positions(state), physics.Shot(*shot))
        for state, shot in zip(states, shots.tolist(), strict=True)
    ]


def calls(pairs: Prepared, keep_events: bool) -> None:
    """One ``simulate`` call for each."""
    for state, shot in pairs:
        physics.simulate(TABLE, state, shot, trace=keep_events)


def best_of(works: dict[Any, Callable[[], float]], repeats: int) -> dict[Any, float]:
    """The least that each returns, all taking turns: differences of small times drown in a median's noise."""
    found = {name: work() for name, work in works.items()}
    for _ in range(repeats - 1):
        for name, work in works.items():
            found[name] = min(found[name], work())
    return found


def timed_calls(values: Callable[[], Prepared], keep_events: bool = False) -> Callable[[], float]:
    """CPU time of a call for each of the values, which are made before."""

    def work() -> float:
        made = values()
        return timing.cpu_seconds(lambda: calls(made, keep_events))

    return work


def single_call(n: int, repeats: int) -> Iterator[Row]:
    """One ``simulate`` call without trace against the same shot's share of a batch, best of several.

    A state's first call on a table also checks where its balls lie; later calls with it do not.
    """
    for name, states, shots in workloads(4 * n):
        states, shots = states[:n], shots[:n]
        known = prepared(states, shots)
        works: dict[str, Callable[[], float]] = {
            "batch": partial(timing.cpu_seconds, partial(physics.simulate_batch, TABLE, states, shots)),
            "new": timed_calls(partial(prepared, states, shots)),
            "known": timed_calls(partial(list, known)),
        }
        found = {kind: s / len(shots) * 1e6 for kind, s in best_of(works, 2 * repeats).items()}
        yield {
            "scene": name,
            "batch_us_per_shot": round(found["batch"], 2),
            "call_us": round(found["known"], 2),
            "overhead_us": round(found["known"] - found["batch"], 2),
            "overhead_us_new_state": round(found["new"] - found["batch"], 2),
        }


def trace(n: int, repeats: int) -> Iterator[Row]:
    """The kernel with and without trace: calls less what a call costs that plays nothing (no cue ball).

    Differences of calls: where the trace seems to take less than nothing, they are too small for a ratio.
    """
    for name, states, shots in workloads(4 * n):
        played = prepared(states[:n], shots[:n])
        idle = [(state.removed(0), shot) for state, shot in played]
        works = {
            (kind, keep): timed_calls(partial(list, values), keep)
            for kind, values in (("played", played), ("idle", idle))
            for keep in (False, True)
        }
        found = {kind: s / len(played) * 1e6 for kind, s in best_of(works, 2 * repeats).items()}
        without, traced = (found["played", keep] - found["idle", keep] for keep in (False, True))
        yield {
            "scene": name,
            "kernel_us": round(without, 2),
            "kernel_us_with_trace": round(traced, 2),
            "ratio": round(traced / without, 2) if traced >= without > 0.0 else None,
            "call_us_with_trace": round(found["played", True], 2),
        }


def threads(n: int, repeats: int) -> Iterator[Row]:
    """Time on the wall of one batch with one thread and with two. ``load`` tells whether the cores were idle."""
    rng = np.random.default_rng(2)
    states, shots = scenes.playable_mid_game(TABLE, rng, n, 16)
    found: dict[int, list[float]] = {1: [], 2: []}
    for _ in range(repeats):
        for number, seconds in found.items():
            seconds.append(
                timing.wall_seconds(lambda: physics.simulate_batch(TABLE, states, shots, threads=number))  # noqa: B023
            )
    for number, seconds in found.items():
        yield {
            "threads": number,
            "shots": n,
            "median_s": round(statistics.median(seconds), 4),
            "best_s": round(min(seconds), 4),
            "speed_up": round(statistics.median(found[1]) / statistics.median(seconds), 2),
            "speed_up_of_best": round(min(found[1]) / min(seconds), 2),
            "cores": len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count(),
            "load": round(os.getloadavg()[0], 2),
        }


FIRST_RESULT = """
import physics
table = physics.Table.olympiad()
state = physics.rack(table, 'eight_ball', seed=7)
assert physics.simulate(table, state, physics.Shot(9.0, 270.0, 5.0)).n_events > 1
"""
TIMED = """
import time
started = time.perf_counter()
{code}
print(time.perf_counter() - started)
"""
COMPILING = """
import time
started = time.perf_counter()
import numba.core.event
with numba.core.event.install_recorder('numba:compile') as recorder:
{code}
print(time.perf_counter() - started)
print(recorder.buffer[-1][0] - recorder.buffer[0][0] if recorder.buffer else 0.0)
"""


def imports(repeats: int) -> Iterator[Row]:
    """Time from import to first result in a new process, and the share numba's compiler takes of the first ever."""
    with tempfile.TemporaryDirectory() as folder:
        fresh(TIMED.format(code=FIRST_RESULT), folder)
        later = statistics.median(fresh(TIMED.format(code=FIRST_RESULT), folder) for _ in range(repeats))
        compiler = statistics.median(fresh(TIMED.format(code="import numba"), folder) for _ in range(repeats))
        alone = statistics.median(fresh(TIMED.format(code="import physics"), folder) for _ in range(repeats))
    with tempfile.TemporaryDirectory() as folder:
        indented = "\n".join("    " + text for text in FIRST_RESULT.splitlines())
        whole, compiling = seconds_told(COMPILING.format(code=indented), folder)
    yield {"what": "import numba", "seconds": round(compiler, 3)}
    yield {"what": "import physics", "seconds": round(alone, 3)}
    yield {"what": "later processes: import to first result", "seconds": round(later, 3)}
    yield {"what": "the same beyond import numba", "seconds": round(later - compiler, 3)}
    yield {"what": "first ever: import to first result", "seconds": round(whole, 1)}
    yield {"what": "of it between numba's first and last compile event", "seconds": round(compiling, 1)}


def fresh(code: str, cache: str) -> float:
    """The last of the seconds that code prints in a new process."""
    return seconds_told(code, cache)[-1]


def seconds_told(code: str, cache: str) -> list[float]:
    """Run code that prints seconds, a line each, in a new process with this kernel cache."""
    environment = os.environ | {"POOLIAD_CACHE_DIR": cache}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    return [float(text) for text in done.stdout.split()]


if __name__ == "__main__":
    main("speed", measure)
