"""CPU time of this thread, and its unit: a square root and a division that wait for each other."""

import functools
import math
import statistics
import time
from collections.abc import Callable
from typing import Any

import numba

PAIRS = 2_000_000
"""Pairs in one measurement of the unit: some 20 ms."""


@functools.cache
def chain() -> Any:
    """Compiled: n times x = c / sqrt(x), where every operation waits for the one before."""

    @numba.njit  # type: ignore[untyped-decorator]
    def compiled(n: int, x: float) -> float:
        for _ in range(n):
            x = 1.7 / math.sqrt(x)
        return x

    compiled(10, 2.0)
    return compiled


def pair_seconds() -> float:
    """CPU time of one dependent square-root-plus-division pair, s."""
    return cpu_seconds(lambda: chain()(PAIRS, 2.0)) / PAIRS


def cpu_seconds(work: Callable[[], object]) -> float:
    """CPU time of this thread, s."""
    started = time.thread_time()
    work()
    return time.thread_time() - started


def wall_seconds(work: Callable[[], object]) -> float:
    """Time on the wall, s."""
    started = time.perf_counter()
    work()
    return time.perf_counter() - started


def in_pairs(work: Callable[[], object], repeats: int) -> tuple[float, float]:
    """(CPU seconds, the same in pairs), the median by pairs of several runs.

    The unit is measured before and after each run, so that a processor that changes its clock changes both.
    """
    found = []
    before = pair_seconds()
    for _ in range(repeats):
        seconds = cpu_seconds(work)
        after = pair_seconds()
        found.append((2.0 * seconds / (before + after), seconds))
        before = after
    pairs, seconds = sorted(found)[len(found) // 2]
    return seconds, pairs


def median(work: Callable[[], float], repeats: int) -> float:
    """Median of what ``work`` returns."""
    return statistics.median(work() for _ in range(repeats))
