"""What each constant of the contact rule changes, most of them when ten times larger or smaller.

The same shots are simulated by engines that differ in one constant. The row "one ulp of v" moves nothing but the last
bit of the cue's speed: changes no larger than those are not the constant's doing.
"""

import importlib
from collections.abc import Iterator
from typing import Any

import numpy as np

import physics
from benchmarks import hostile, hostile_scenes, soundness, stress, variants
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from benchmarks.scenes import Floats

TENFOLD = (0.1, 10.0)
KERNELS, PARAMETERS = "physics.kernels.tolerances", "physics.parameters"
VARIED = (
    (KERNELS, "TOUCH", TENFOLD),
    (KERNELS, "SLOW_APPROACH", TENFOLD),
    (KERNELS, "SOFT_CUSHION", TENFOLD),
    (PARAMETERS, "REST_TIME", TENFOLD),
    (KERNELS, "PRESSING", TENFOLD),
    (KERNELS, "PARTING_SLACK", TENFOLD),
    (KERNELS, "PARTING_SHARE", (16.0 / 17.0, 2.0)),
    (KERNELS, "STOP_BELOW", (0.2, 1.8)),
    (KERNELS, "STILL", TENFOLD),
)
"""Where each constant is, its name, and what it is multiplied by."""
CLASSES = ("ordinary", "touching break", "frozen cluster", "cushions and corners", "straight lines")
SEED = 77

Outcome = dict[str, Any]


def measure(full: bool) -> Tables:
    """One row for each constant and factor."""
    shots, flights = (4_000, 200) if full else (400, 20)
    usual = variants.run(None, "benchmarks.constants:outcomes", None, 1.0, shots, flights)
    rows = [row("as it is", None, usual, usual)]
    ulp = variants.run(None, "benchmarks.constants:outcomes", "one ulp", 1.0, shots, flights)
    rows.append(row("one ulp of v", None, usual, ulp))
    rows.extend(varied(usual, shots, flights))
    return {"constants": rows}


def varied(usual: dict[str, Outcome], shots: int, flights: int) -> Iterator[Row]:
    """Rows of the constants, each in its own process."""
    for module, name, factors in VARIED:
        for factor in factors:
            found = variants.run(
                "benchmarks.constants:scale", "benchmarks.constants:outcomes", name, factor, shots, flights
            )
            value = getattr(importlib.import_module(module), name) * factor
            print(f"{name} = {value:g}", flush=True)
            yield row(name, value, usual, found)


def scale(name: str, factor: float, *_: object) -> None:
    """In a new process: multiply a constant before the kernels load."""
    module = next(module for module, varied, _ in VARIED if varied == name)
    variants.replace(module, name, getattr(importlib.import_module(module), name) * factor)


def outcomes(name: str | None, _factor: float, shots: int, flights: int) -> dict[str, Outcome]:
    """Simulate the fixed shots with the engine as it is in this process."""
    return {kind: outcome(kind, shots, flights, name == "one ulp") for kind in CLASSES}


def outcome(kind: str, n: int, flights: int, moved: bool) -> Outcome:
    """Ends, events and faults of one class."""
    table, states, shots = hostile_scenes.scene_of(kind, SEED, n)
    if moved:
        shots[:, hostile.V] = np.nextafter(shots[:, hostile.V], 0.0)
    batch = physics.simulate_batch(table, states, shots)
    verdict = soundness.judge(table, states, batch)
    followed = np.flatnonzero(batch.status == physics.Status.AT_REST)[:flights].tolist()
    depths = [flight_overlap(table, states[row], shots[row]) for row in followed]
    return {
        "positions": batch.positions,
        "events": int(batch.n_events.sum()),
        "unended": int((batch.status != physics.Status.AT_REST).sum()),
        "overlap": max(float(verdict.overlap.max()), *depths),
    }


def flight_overlap(table: physics.Table, state: Floats, shot: Floats) -> float:
    """Deepest overlap in the flight of one shot, m."""
    result = physics.simulate(table, physics.TableState.trusted(state.copy()), physics.Shot(*shot.tolist()))
    return soundness.judge_flight(table, result, stress.INSTANTS)[0]


def moves(one: Floats, two: Floats) -> Floats:
    """(n,) m: how far the ends of a shot lie apart, the furthest ball; infinite where a ball fell in one alone."""
    apart = np.isnan(one).any(axis=2) != np.isnan(two).any(axis=2)
    gap = np.nan_to_num(np.sqrt(((one - two) ** 2).sum(axis=2)))
    return np.where(apart.any(axis=1), np.inf, gap.max(axis=1))


def row(name: str, value: float | None, usual: dict[str, Outcome], found: dict[str, Outcome]) -> Row:
    """Shares of shots whose ends moved by more than a micrometre and a millimetre, events, faults."""
    cells: Row = {"constant": name, "value": value}
    for kind in CLASSES:
        far = moves(usual[kind]["positions"], found[kind]["positions"])
        cells[kind] = f"{(far > 1e-6).mean():.1%} / {(far > 1e-3).mean():.1%}"
    events = sum(each["events"] for each in usual.values())
    return cells | {
        "events": round(sum(each["events"] for each in found.values()) / events, 4),
        "unended": sum(each["unended"] for each in found.values()),
        "worst_overlap_m": max(each["overlap"] for each in found.values()),
    }


if __name__ == "__main__":
    main("constants", measure)
