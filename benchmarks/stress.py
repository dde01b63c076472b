"""Hostile random shots by class. Every one has to end at rest or be refused by name: no NaN, escape, overlap, loop.

A failure is reported with its class, seed and row, and as a scene that can be pasted into a test. On tables with jaws
a quarter is played again by kernels without filter and broad phase, which must leave the same bits (``unfiltered``),
and some are looked over between their events, everything against everything (``everything``).
"""

import concurrent.futures
import dataclasses
import multiprocessing
import os
import time
from collections import Counter
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np

import physics
from benchmarks import everything, hostile, hostile_jaws, hostile_scenes, pieces, soundness, unfiltered, variants
from benchmarks.command import main
from benchmarks.recording import Row, Tables

CHUNK = {"limits of the table": 200, "jaws: limits of the table": 200}
"""Shots simulated together, by class: one table each."""
USUAL_CHUNK = 2_000

PATIENCE = 300.0
"""s. When no chunk ends for so long, those at work are reported as endless loops. Usual: one second."""

INSTANTS = 120
"""Instants looked at in the flight of a traced shot."""

STRETCHES = 40
"""Stretches between events that the oracle looks at in a shot on a table with jaws."""

REPLAYED = 4
"""One chunk in so many is played again by kernels that filter nothing."""


MOST_FAILURES = 24
"""Failures kept in the data line; the table counts all."""

SHOWN = 3
"""Failures of a kind written out for each chunk."""


@dataclasses.dataclass
class Tally:
    """Sums over shots of one class."""

    shots: int = 0
    events: int = 0
    most_events: int = 0
    seconds: float = 0.0
    flights: int = 0
    overlap: float = 0.0
    flight_overlap: float = 0.0
    beyond: float = 0.0
    contacts: int = 0
    apart: float = 0.0
    replayed: int = 0
    status: Counter[str] = dataclasses.field(default_factory=Counter)
    faults: Counter[str] = dataclasses.field(default_factory=Counter)
    failures: list[Row] = dataclasses.field(default_factory=list)
    hashes: dict[int, unfiltered.Hashes] = dataclasses.field(default_factory=dict)

    def add(self, other: "Tally") -> None:
        """Take in another tally of the class."""
        for name in ("shots", "events", "seconds", "flights", "contacts"):
            setattr(self, name, getattr(self, name) + getattr(other, name))
        for name in ("most_events", "overlap", "flight_overlap", "beyond", "apart"):
            setattr(self, name, max(getattr(self, name), getattr(other, name)))
        self.status += other.status
        self.faults += other.faults
        self.failures += other.failures
        self.hashes |= other.hashes

    def row(self, kind: str) -> Row:
        """One line of the table."""
        return {
            "class": kind,
            "shots": self.shots,
            "at_rest": self.status["AT_REST"],
            "refused": self.shots - self.status["AT_REST"] - self.status["EVENT_LIMIT"],
            "event_limit": self.status["EVENT_LIMIT"],
            "nan": self.faults["nan"],
            "escapes": self.faults["escape"],
            "overlaps": self.faults["overlap"],
            "endless": self.faults["endless"],
            "events_per_shot": round(self.events / max(self.shots, 1), 1),
            "most_events": self.most_events,
            "worst_overlap_m": self.overlap,
            "flights": self.flights,
            "worst_overlap_in_flight_m": self.flight_overlap,
            "worst_beyond_line_m": self.beyond,
            "us_per_shot": round(self.seconds / max(self.shots, 1) * 1e6, 1),
        }

    def jaws_row(self, kind: str) -> Row:
        """The same for a class on tables with jaws."""
        more = {
            "contacts_looked_at": self.contacts,
            "worst_gap_at_contact_m": self.apart,
            "invented": self.faults["invented contact"],
            "without_filter": self.replayed,
            "other_bits_without_filter": self.faults["other bits"],
        }
        return self.row(kind.removeprefix("jaws: ")) | more


def measure(full: bool) -> Tables:
    """Run every class; a million shots on either kind of table when ``full``."""
    straight, jaws = on_straight_mouths(full), on_jaws(full)
    return straight | jaws | {"failures": (straight["failures"] + jaws["failures"])[:MOST_FAILURES]}


def on_straight_mouths(full: bool) -> Tables:
    """The classes of ``hostile``."""
    tallies = run(hostile.CLASSES, *((92_000, 2_000) if full else (4_000, 200)))
    return {"by_class": [tally.row(kind) for kind, tally in tallies.items()], "failures": failures_of(tallies)}


def on_jaws(full: bool) -> Tables:
    """The classes of ``hostile_jaws``, compared with kernels that filter nothing."""
    tallies = run(hostile_jaws.CLASSES, *((102_000, 100) if full else (4_000, 40)))
    compare(tallies)
    return {"jaws": [tally.jaws_row(kind) for kind, tally in tallies.items()], "failures": failures_of(tallies)}


def failures_of(tallies: dict[str, Tally]) -> list[Row]:
    """The first of all failures."""
    return [failure for tally in tallies.values() for failure in tally.failures][:MOST_FAILURES]


def run(classes: Iterable[str], shots: int, flights: int) -> dict[str, Tally]:
    """``shots`` of each class, ``flights`` of them followed instant by instant, in a process for each core allowed."""
    processes = len(os.sched_getaffinity(0))
    tallies = {kind: Tally() for kind in classes}
    physics.simulate_batch(*nothing(classes))  # compiles before there are several processes to do it
    pool = concurrent.futures.ProcessPoolExecutor(processes, mp_context=multiprocessing.get_context("spawn"))
    jobs = [job for kind in classes for job in chunks(kind, shots, flights)]
    waiting = {pool.submit(attempt, *job): job for job in jobs}
    while waiting:
        finished, _ = concurrent.futures.wait(waiting, PATIENCE, return_when=concurrent.futures.FIRST_COMPLETED)
        if not finished:
            give_up(pool, tallies, list(waiting.values())[:processes])
            break
        for future in finished:
            tallies[waiting.pop(future)[0]].add(future.result())
        if len(waiting) % 10 == 0:
            print(f"{len(jobs) - len(waiting)} of {len(jobs)} chunks", flush=True)
    pool.shutdown(wait=False, cancel_futures=True)
    return tallies


def give_up(
    pool: concurrent.futures.ProcessPoolExecutor, tallies: dict[str, Tally], stuck: list[tuple[str, int, int, int]]
) -> None:
    """Report the chunks that do not end and stop their processes."""
    for kind, seed, n, _ in stuck:
        tallies[kind].faults["endless"] += 1
        tallies[kind].failures.append(
            {"class": kind, "seed": seed, "row": -1, "fault": "endless", "scene": f"one of {n} of this seed"}
        )
    for process in list(pool._processes.values()):  # type: ignore[union-attr]
        process.kill()


def nothing(classes: Iterable[str]) -> tuple[physics.Table, physics.TableState, list[list[float]]]:
    """A shot without balls on a table of the first class."""
    table = hostile_scenes.table_of(next(iter(classes)), np.random.default_rng(0))
    return table, physics.TableState.from_positions({}), [[1.0, 0.0, 0.0, 0.0, 0.0]]


def chunks(kind: str, shots: int, flights: int) -> Iterator[tuple[str, int, int, int]]:
    """(class, seed, shots, flights) of each chunk of a class."""
    size = min(CHUNK.get(kind, USUAL_CHUNK), shots)
    number = -(-shots // size)
    for index in range(number):
        yield kind, 1000 + index, size, -(-flights // number)


def attempt(kind: str, seed: int, n: int, flights: int) -> Tally:
    """Simulate one chunk and judge it."""
    table, states, shots = hostile_scenes.scene_of(kind, seed, n)
    physics.simulate_batch(*nothing([kind]))  # loads the kernels: not part of the time
    started = time.thread_time()
    batch = physics.simulate_batch(table, states, shots)
    seconds = time.thread_time() - started
    verdict = soundness.judge(table, states, batch)
    tally = Tally(
        shots=n,
        events=int(batch.n_events.sum()),
        most_events=int(batch.n_events.max()),
        seconds=seconds,
        overlap=float(verdict.overlap.max()),
        beyond=float(verdict.beyond.max()),
        status=Counter({physics.Status(s).name: int((batch.status == s).sum()) for s in set(batch.status.tolist())}),
    )
    for fault, found in verdict.faults.items():
        tally.faults[fault] += int(found.sum())
        for row in soundness.first_rows(found, SHOWN).tolist():
            tally.failures.append(failure(kind, seed, row, fault, table, states[row], shots[row]))
    if table.has_jaws:
        tally.hashes[seed] = unfiltered.hashes_of(batch)
    for row in soundness.first_rows(batch.status == physics.Status.AT_REST, flights).tolist():
        follow(tally, kind, seed, row, table, states[row], shots[row], batch)
    return tally


def follow(
    tally: Tally, kind: str, seed: int, row: int, table: physics.Table, state: Any, shot: Any, batch: physics.Batch
) -> None:
    """Simulate one shot again with its trace and look at instants of its flight."""
    result = physics.simulate(table, physics.TableState.trusted(state.copy()), physics.Shot(*shot.tolist()))
    deep, out, finite = soundness.judge_flight(table, result, INSTANTS)
    tally.flights += 1
    tally.flight_overlap = max(tally.flight_overlap, deep)
    tally.beyond = max(tally.beyond, out)
    permitted = max(float(soundness.overlap(table, state[None])[0]), soundness.PERMITTED)
    apart = 0.0
    if isinstance(table, physics.RealTable):
        found = everything.look_over(result, pieces.pieces_of(table), STRETCHES)
        deep, out, apart = max(deep, found.overlap), max(out, found.beyond), found.apart
        tally.contacts += found.contacts
        tally.apart = max(tally.apart, apart)
        tally.flight_overlap, tally.beyond = max(tally.flight_overlap, deep), max(tally.beyond, out)
    faults = {
        "nan": not finite,
        "overlap": deep > permitted,
        "escape": out > max(float(soundness.beyond(table, state[None])[0]) + soundness.ROUNDING, soundness.PERMITTED),
        "invented contact": apart > soundness.PERMITTED,
        "batch differs": result.final.positions.tobytes() != batch.positions[row].tobytes(),
    }
    for fault, happened in faults.items():
        if happened:
            tally.faults[fault] += 1
            tally.failures.append(failure(kind, seed, row, f"{fault} in flight", table, state, shot))


def compare(tallies: dict[str, Tally]) -> None:
    """Play one chunk in four again without filter and broad phase, and count the shots with other bits."""
    jobs = [
        (kind, seed, len(hashes))
        for kind, tally in tallies.items()
        for seed, hashes in sorted(tally.hashes.items())[::REPLAYED]
    ]
    for kind, _, n in jobs:
        tallies[kind].replayed += n
    answers = variants.run("benchmarks.unfiltered:look_at_everything", "benchmarks.unfiltered:replayed", jobs)
    for (kind, seed, n), hashes in zip(jobs, answers, strict=True):
        other = hashes != tallies[kind].hashes[seed]
        tallies[kind].faults["other bits"] += int(other.sum())
        for row in soundness.first_rows(other, SHOWN).tolist():
            table, states, shots = hostile_scenes.scene_of(kind, seed, n)
            fault = "other bits without filter"
            tallies[kind].failures.append(failure(kind, seed, row, fault, table, states[row], shots[row]))


def failure(kind: str, seed: int, row: int, fault: str, table: physics.Table, state: Any, shot: Any) -> Row:
    """A failed shot with all it takes to repeat it."""
    balls = {ball: place for ball, place in enumerate(state.tolist()) if place[0] == place[0]}
    base = physics.Table.named(table.name).to_dict()
    changes = {name: value for name, value in table.to_dict().items() if value != base[name]}
    scene = f"table.replace(**{changes!r}), TableState.from_positions({balls!r}), Shot(*{shot.tolist()!r})"
    return {"class": kind, "seed": seed, "row": row, "fault": fault, "scene": scene}


if __name__ == "__main__":
    main("stress", measure)
