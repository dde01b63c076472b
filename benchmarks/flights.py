"""Hostile random shots on tables that fly, by class: does every one end, does energy fall, is nothing in anything?
And what flight costs (``flight_costs``).

Batches are judged by their ends and replayed by kernels without filter and broad phase (the same bits must come out);
some shots are followed event by event. The stacked class starts from snapshots, for no shot begins so.
"""

import math
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np

import physics
from benchmarks import flight_costs, soundness, unfiltered, variants
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from benchmarks.scenes import Floats

Rng = np.random.Generator
Place = tuple[float, float]
Scene = tuple[list[Place], tuple[float, float, float, float, float]]

EVENTS = 20_000
"""Limit of events, as in a game: a shot that reaches it is a fault."""

MOST_FAILURES = 12

TABLES: dict[str, dict[str, Any]] = {
    "jumps": {},
    "70 degrees into touching balls": {},
    "over the rails": {},
    "mouths from the air": {},
    "frozen to noses": {"e_pressed": 0.4},
    "bouncing cloth": {"e_cloth": 0.9, "e_strike": 0.9, "e_rail": 0.9},
    "dead cloth": {"e_cloth": 0.0, "e_ball": 1.0},
    "stacked": {},
}
"""Classes, and the parameters of their tables."""


def table_of(kind: str) -> physics.RealTable:
    """The table that a class is played on."""
    return physics.RealTable.of_size("nine_foot").replace(flight=True, cue_test=False, **TABLES[kind])


def balls(kind: str, table: physics.RealTable, rng: Rng) -> list[Place]:
    """Up to seven balls, the cue ball first; half of them touch another."""
    places: list[Place] = []
    wanted, reach = int(rng.integers(1, 8)), 2.0 * table.ball_radius
    for _ in range(200):
        x, y = float(rng.uniform(0.0, table.width)), float(rng.uniform(0.0, table.length))
        if kind == "mouths from the air" or (kind == "over the rails" and not places):
            x = float(rng.uniform(-0.01, 0.3))
            y = float(rng.choice([0.15, 0.5 * table.length]) + rng.uniform(-0.15, 0.15))
        if kind == "frozen to noses" and rng.random() < 0.6:
            x = table.contact_distance + float(rng.choice([0.0, 1e-13, 1e-12]))
        if places and rng.random() < 0.5:
            angle = math.radians(float(rng.choice([0.0, 60.0, 90.0, 120.0, rng.uniform(0.0, 360.0)])))
            x, y = places[-1][0] + reach * math.cos(angle), places[-1][1] + reach * math.sin(angle)
        if table.contains(x, y) and all(math.dist((x, y), place) >= reach - 5e-16 for place in places):
            places.append((x, y))
        if len(places) == wanted:
            break
    return places or [(0.6, 1.2)]


def scene(kind: str, table: physics.RealTable, rng: Rng) -> Scene:
    """Balls and a stroke: at another ball, at a mouth, or anywhere."""
    places = balls(kind, table, rng)
    x, y = places[0]
    to_x, to_y = (float(value) for value in rng.uniform((0.0, 0.0), (table.width, table.length)))
    if kind == "mouths from the air":
        to_x, to_y = table.mouths[int(rng.integers(6))].tolist()
    elif kind == "over the rails":
        to_x, to_y = -0.2, y
    elif len(places) > 1 and rng.random() < 0.8:
        to_x, to_y = places[int(rng.integers(1, len(places)))]
    phi = math.degrees(math.atan2(to_y - y, to_x - x)) + float(rng.normal(0.0, 5.0))
    theta = 70.0 if kind.startswith("70") else float(rng.choice([3.0, 15.0, 35.0, 55.0, 85.0]))
    side, high = (float(value) for value in rng.uniform((-12.0, -12.0), (12.0, 22.0)))
    return places, (float(rng.choice([0.3, 2.0, 4.0, 7.0, 12.0])), phi, theta, side, min(high, 20.0))


def chunk(kind: str, seed: int, n: int) -> tuple[physics.RealTable, Floats, Floats]:
    """Table, states and shots: the same for the same seed."""
    rng, table = np.random.default_rng([seed, *kind.encode()]), table_of(kind)
    states, shots = np.full((n, 16, 2), np.nan), np.empty((n, 5))
    for state, shot in zip(states, shots, strict=True):
        places, stroke = scene(kind, table, rng)
        state[: len(places)], shot[:] = places, stroke
    return table, states, shots


def stacked(seed: int, n: int) -> Iterator[tuple[physics.RealTable, physics.Snapshot]]:
    """Balls dropped on one, two or three touching ones, dead centre or by a hair beside."""
    rng, table = np.random.default_rng(seed), table_of("stacked")
    reach = 2.0 * table.ball_radius
    pit = np.array([(0.6, 1.0), (0.6 + reach, 1.0), (0.6 + 0.5 * reach, 1.0 + reach * math.sqrt(0.75) + 1e-16)])
    for _ in range(n):
        below = pit[: int(rng.integers(1, 4))]
        positions, motion = np.full((16, 2), np.nan), np.full(16, physics.Motion.ABSENT, np.int8)
        heights = np.zeros(16)
        positions[1 : 1 + len(below)], motion[1 : 1 + len(below)] = below, physics.Motion.STATIONARY
        beside = float(rng.choice([0.0, 1e-12, 1e-6, 1e-3, 0.01])) * rng.normal(size=2)
        positions[9], motion[9] = below.mean(axis=0) + beside, physics.Motion.FLYING
        heights[9] = reach + float(rng.choice([1e-9, 1e-3, 0.05, 0.3]))
        yield table, physics.Snapshot(0.0, positions, np.zeros((16, 2)), np.zeros((16, 3)), motion, heights)


def energy(table: physics.RealTable, there: physics.Snapshot) -> float:
    """Of all balls, per ball mass: motion, spin and height."""
    squares = float((there.velocities**2).sum() + (there.vertical_velocities**2).sum())
    spins = 0.4 * table.ball_radius**2 * float((there.spins**2).sum())
    return 0.5 * (squares + spins) + table.gravity * float(there.heights.sum())


def overlap(table: physics.RealTable, there: physics.Snapshot) -> float:
    """Deepest, m; negative where none touch."""
    here = ~np.isnan(there.positions[:, 0])
    places = np.column_stack([there.positions, there.heights])[here]
    gaps = np.sqrt(((places[:, None] - places[None]) ** 2).sum(axis=-1))
    return 2.0 * table.ball_radius - float(gaps[~np.eye(len(places), dtype=bool)].min(initial=1.0))


def followed(table: physics.RealTable, result: physics.Result) -> dict[str, bool]:
    """Faults at the instants of a shot's events, at most 400 of them."""
    instants = sorted({event.time for event in result.events})[:400]
    snapshots = [result.at(time) for time in instants]
    energies = [energy(table, there) for there in snapshots]
    return {
        "energy gains": any(b > a + 1e-11 * energies[0] for a, b in pairwise(energies)),
        "overlaps in space": max((overlap(table, there) for there in snapshots), default=0.0) > soundness.PERMITTED,
        "below the cloth": any((there.heights < 0.0).any() for there in snapshots),
    }


def attempt(kind: str, n: int, traced: int) -> tuple[Row, list[Row]]:
    """A class played, judged and, in part, followed."""
    table, states, shots = chunk(kind, 1, n)
    batch = physics.simulate_batch(table, states, shots, event_limit=EVENTS)
    faults: Counter[str] = Counter()
    failures: list[Row] = []
    for fault, found in soundness.judge(table, states, batch).faults.items():
        faults[fault] += int(found.sum())
        failures += [{"class": kind, "row": int(row), "fault": fault} for row in np.flatnonzero(found)[:2]]
    for row in range(min(traced, n)):
        state = physics.TableState.trusted(states[row].copy())
        result = physics.simulate(table, state, physics.Shot(*shots[row].tolist()), event_limit=EVENTS)
        count(followed(table, result), kind, row, faults, failures)
    line = {"class": kind, "shots": n, "followed": traced, "events": int(batch.n_events.sum())}
    line |= {"most_events": int(batch.n_events.max()), "off_table": int((batch.facts["off_table"] >= 0).sum())}
    return line | {"faults": dict(+faults)}, failures


def attempt_stacked(n: int) -> tuple[Row, list[Row]]:
    """The class of balls upon balls."""
    faults: Counter[str] = Counter()
    failures: list[Row] = []
    events: list[int] = []
    off = 0
    for row, (table, snapshot) in enumerate(stacked(1, n)):
        result = physics.resume(table, snapshot, event_limit=EVENTS)
        found = followed(table, result) | {"event limit": result.status is not physics.Status.AT_REST}
        count(found, "stacked", row, faults, failures)
        events.append(result.n_events)
        off += sum(event >= 0 for event in result.facts.off_table)
    line = {"class": "stacked", "shots": n, "followed": n, "events": sum(events), "most_events": max(events)}
    return line | {"off_table": off, "faults": dict(+faults), "other_bits_without_filter": None}, failures


def count(found: dict[str, bool], kind: str, row: int, faults: Counter[str], failures: list[Row]) -> None:
    """Add the faults of one shot."""
    for fault, there in found.items():
        faults[fault] += there
        if there:
            failures.append({"class": kind, "row": row, "fault": fault})


def replayed(jobs: list[tuple[str, int, int]]) -> list[unfiltered.Hashes]:
    """Hashes of chunks, in a process whose kernels look at everything."""
    return [unfiltered.hashes_of(physics.simulate_batch(*chunk(*job), event_limit=EVENTS)) for job in jobs]


def measure(full: bool) -> Tables:
    """Every class, a million shots in all when ``full``; what flight costs, and what its parameters change."""
    shots, traced = (143_000, 1_000) if full else (2_000, 60)
    kinds = [kind for kind in TABLES if kind != "stacked"]
    rows, failures = [], []
    for line, failed in [*(attempt(kind, shots, traced) for kind in kinds), attempt_stacked(traced)]:
        rows.append(line)
        failures += failed
    jobs = [(kind, 2, min(shots, 2_000)) for kind in kinds]
    prepare: Callable[..., None] = unfiltered.look_at_everything
    without = variants.run(f"{prepare.__module__}:{prepare.__name__}", "benchmarks.flights:replayed", jobs)
    for (kind, *_), one, other in zip(jobs, replayed(jobs), without, strict=True):
        differ = int((one != other).sum())
        rows[kinds.index(kind)]["other_bits_without_filter"] = differ
        if differ:
            failures.append({"class": kind, "row": -1, "fault": f"{differ} shots differ without the filter"})
    return {
        "by_class": rows,
        "cost": list(flight_costs.costs(8_000 if full else 2_000, 31 if full else 15)),
        "savings": list(flight_costs.savings(8_000 if full else 2_000)),
        "choices": list(flight_costs.choices(8_000 if full else 2_000)),
        "failures": failures[:MOST_FAILURES],
    }


if __name__ == "__main__":
    main("flights", measure)
