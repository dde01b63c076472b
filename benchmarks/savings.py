"""What a scene does not need and the engine skips: work done, counted, and the cost with a saving switched off."""

import importlib
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

import physics
from benchmarks import scenes, speed, timing, variants
from benchmarks.command import main
from benchmarks.recording import Row, Tables

TABLE = physics.Table.olympiad()
TRACE_BYTES = 160
"""Bytes of an event in the trace: 20 numbers."""

PREDICTION = "physics.kernels.detect.prediction"


def measure(full: bool) -> Tables:
    """Counters by scene, and the cost of each saving's absence by scene."""
    shots, repeats = (20_000, 9) if full else (2_000, 5)
    return {"counters": list(counters(shots)), "switched_off": list(switched_off(shots, repeats))}


def workloads(n: int) -> Iterator[tuple[str, scenes.Floats, scenes.Floats]]:
    """The scenes of ``speed``, and one in which nothing is near."""
    from benchmarks.scaling import lonely

    yield "16 balls, none near", *lonely(np.random.default_rng(8), n)
    yield from speed.workloads(n)


def counters(n: int) -> Iterator[Row]:
    """Work per event. A prediction looks for the next event of one ball; it sees every other ball on the table."""
    for name, states, shots in workloads(n):
        counts = np.zeros((len(shots), 4), np.int64)
        batch = physics.simulate_batch(TABLE, states, shots, counters=counts)
        events = int(batch.n_events.sum())
        predictions, left, solved, boundary = (counts.sum(axis=0) / events).tolist()
        others = (~np.isnan(states[:, :, 0])).sum(axis=1) - 1
        yield {
            "scene": name,
            "events_per_shot": round(events / len(shots), 1),
            "predictions": round(predictions, 3),
            "pairs_seen": round(float((counts[:, 0] * others).sum() / events), 2),
            "left_by_filter": round(left, 3),
            "solved": round(solved, 3),
            "boundary_looks": round(boundary, 3),
            "trace_bytes_per_shot": round(TRACE_BYTES * events / len(shots)),
        }


def switched_off(n: int, repeats: int) -> Iterator[Row]:
    """Cost of an event as it is, and how many times that it is with one saving switched off, each in its own process.

    What a trace costs is in ``speed``.
    """
    usual = costs_of(None, n, repeats)
    found = {name: costs_of(function, n, repeats) for name, function in SAVINGS.items()}
    for scene in usual:
        row: Row = {"scene": scene, "pairs_per_event": round(usual[scene], 2)}
        for name, costs in found.items():
            row[f"without {name}"] = round(costs[scene] / usual[scene], 2)
        yield row


def costs_of(function: Callable[[], None] | None, n: int, repeats: int) -> dict[str, float]:
    """Cost of an event by scene in a process in which ``function`` has run before the kernels load."""
    prepare = f"benchmarks.savings:{function.__name__}" if function else None
    found: dict[str, float] = variants.run(prepare, "benchmarks.savings:costs", n, repeats)
    print(f"{function.__name__ if function else 'as it is'}: {found}", flush=True)
    return found


def costs(n: int, repeats: int) -> dict[str, float]:
    """Pairs per event by scene."""
    found = {}
    for name, states, shots in workloads(n):
        events = int(physics.simulate_batch(TABLE, states, shots).n_events.sum())
        work = _batch(states, shots)
        found[name] = timing.in_pairs(work, repeats)[1] / events
    return found


def _batch(states: scenes.Floats, shots: scenes.Floats) -> Callable[[], Any]:
    return lambda: physics.simulate_batch(TABLE, states, shots)


def let_all_pairs_pass(*_: object) -> None:
    """In a new process: the filter still runs, but every pair is solved whatever it says."""
    import numba

    usual = importlib.import_module(PREDICTION).partners

    @numba.njit(error_model="numpy", nogil=True)  # type: ignore[untyped-decorator]
    def everyone(*arguments: Any) -> int:
        found: int = usual(*arguments) | 0xFFFF
        return found

    variants.replace(PREDICTION, "partners", everyone)


def solve_to_the_end(*_: object) -> None:
    """In a new process: a contact is looked for up to the end of both motions, though something happens earlier."""
    import numba

    detect = importlib.import_module("physics.kernels.detect.contact")
    usual, later, root = detect.contact, detect.LATER, detect.Root

    @numba.njit(error_model="numpy", nogil=True)  # type: ignore[untyped-decorator]
    def unlimited(path: Any, t_max: float, limit: float, diameter: float) -> Any:
        found = usual(path, t_max, t_max, diameter)
        return found if found.time <= limit else root(np.nan, later)

    variants.replace(detect.__name__, "contact", unlimited)


def cross_every_line(*_: object) -> None:
    """In a new process: every cushion and mouth line is solved for, though the ball cannot reach it in time."""
    import numba

    @numba.njit(error_model="numpy", nogil=True)  # type: ignore[untyped-decorator]
    def always(_gap: float, _speed: float, _half: float, _lasts: float) -> bool:
        return True

    variants.replace("physics.kernels.detect.line", "reaches", always)


SAVINGS: dict[str, Callable[[], None]] = {
    "filter of pairs": let_all_pairs_pass,
    "limit of the solver": solve_to_the_end,
    "bound before a line": cross_every_line,
}


if __name__ == "__main__":
    main("savings", measure)
