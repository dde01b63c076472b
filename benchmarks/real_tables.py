"""The nine-foot table beside the Olympiad's: what an event costs away from the mouths, what jaws cost, errors.

CPU time is the median of ratios of neighbouring runs in one process, so that a loaded machine slows both; instructions
are counted by callgrind, as in ``against``.
"""

import itertools
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import physics
from benchmarks import against, hostile_jaws, pieces, scenes, timing
from benchmarks.command import main
from benchmarks.recording import ROOT, Row, Tables

OLYMPIAD = physics.Table.olympiad()
NINE = physics.RealTable.of_size("nine_foot").replace(flight=False)
SAME_LAWS = NINE.replace(
    cushion="factors", ball="consistent", cue_end_mass=0.0, mu_roll=0.015, mu_ball=0.01, e_ball=1.0
)
"""Jaws alone: the laws and the friction of the Olympiad's table."""

BALLS = (2, 4, 8, 16)

Carry = Callable[[scenes.Floats, float, float, bool], scenes.Floats]
"""Carries a ball by time steps, overwriting it."""
Workload = tuple[physics.Table, scenes.Floats, scenes.Floats]


def measure(full: bool) -> Tables:
    """All tables of this benchmark."""
    shots, pairs = (8_000, 31) if full else (2_000, 15)
    works = {
        (balls, name): apart_from_mouths(table, shots, balls)
        for balls in BALLS
        for name, table in (("olympiad", OLYMPIAD), ("nine_foot", NINE), ("same laws", SAME_LAWS))
    }
    return {
        "no_mouth": list(beside(works, pairs, counted(works, shots // 8))),
        "jaws_used": list(jaws_used(shots, pairs)),
        "error_vs_time": list(error_vs_time(24 if full else 6, [10.0**-k for k in range(2, 7 if full else 5)])),
    }


def apart_from_mouths(table: physics.Table, n: int, balls: int) -> Workload:
    """Mid-game shots in which no ball drops, meets a jaw, or has an event beyond the nose lines."""
    rng = np.random.default_rng(1)
    states, shots = scenes.playable_mid_game(table, rng, n, balls)
    batch = physics.simulate_batch(table, states, shots)
    kept = [
        row for row in np.flatnonzero((batch.pocket < 0).all(axis=1)).tolist() if stays(table, states[row], shots[row])
    ]
    return table, np.ascontiguousarray(states[kept]), np.ascontiguousarray(shots[kept])


def stays(table: physics.Table, state: scenes.Floats, shot: scenes.Floats) -> bool:
    """Whether every event happens within the nose lines, and none at a jaw."""
    result = played(table, state, shot)
    near = table.contact_distance if isinstance(table, physics.RealTable) else table.ball_radius
    for event in result.events:
        if event.kind == physics.EventKind.JAW_COLLISION:
            return False
        x, y = event.states[0].position
        if min(x, table.width - x) < near - 1e-9 or min(y, table.length - y) < near - 1e-9:
            return False
    return True


def beside(
    works: dict[tuple[int, str], Workload], pairs: int, instructions: dict[tuple[int, str], float]
) -> Iterator[Row]:
    """Each table beside the Olympiad's, per event and per shot."""
    for balls, name in works:
        if name == "olympiad":
            continue
        base, now = works[balls, "olympiad"], works[balls, name]
        (base_us, base_events), (now_us, now_events), ratio = alternated(base, now, pairs)
        row: Row = {
            "balls": balls,
            "table": name,
            "shots": len(now[2]),
            "olympiad_events_per_shot": round(base_events, 2),
            "events_per_shot": round(now_events, 2),
            "olympiad_us": round(base_us, 3),
            "us": round(now_us, 3),
            "ratio_per_shot": round(ratio, 3),
            "ratio_per_event": round(ratio * base_events / now_events, 3),
            "instructions_per_event": None,
            "instructions_ratio_per_event": None,
        }
        if instructions:
            here, there = instructions[balls, name] / now_events, instructions[balls, "olympiad"] / base_events
            row |= {
                "instructions_per_event": round(here),
                "instructions_ratio_per_event": round(here / there, 3),
            }
        yield row


def alternated(base: Workload, now: Workload, pairs: int) -> tuple[tuple[float, float], tuple[float, float], float]:
    """((us, events) a shot of one, of the other, median ratio of the times a shot of neighbouring runs)."""
    seconds = [[seconds_of(work) for work in (base, now)] for _ in range(pairs)]
    found = []
    for place, work in enumerate((base, now)):
        events = physics.simulate_batch(*work).n_events.mean()
        found.append((statistics.median(row[place] for row in seconds) / len(work[2]) * 1e6, float(events)))
    ratio = statistics.median(row[1] / row[0] for row in seconds) * len(base[2]) / len(now[2])
    return found[0], found[1], ratio


def seconds_of(work: Workload) -> float:
    """CPU time of one run."""
    return timing.cpu_seconds(lambda: physics.simulate_batch(*work))


def counted(works: dict[tuple[int, str], Workload], most: int) -> dict[tuple[int, str], float]:
    """Instructions a shot, of the first ``most`` shots of each; nothing where there is no valgrind."""
    given = {f"{balls} {name}": against.scene(t, s[:most], x[:most]) for (balls, name), (t, s, x) in works.items()}
    with tempfile.TemporaryDirectory() as folder:
        counts = against.counted(against.Side(Path(folder), ROOT), given)
    return {key: counts[f"{key[0]} {key[1]}"] / len(given[f"{key[0]} {key[1]}"]["shots"]) for key in works if counts}


def jaws_used(n: int, pairs: int) -> Iterator[Row]:
    """Shots of one ball on the nine-foot table: into the open, and into the jaws."""
    rng = np.random.default_rng(3)
    states, shots = hostile_jaws.rattles(NINE.replace(cue_test=False), rng, n)
    states[:, 1:] = np.nan
    table = NINE.replace(cue_test=False)
    met = [jaw_hits(table, state, shot) for state, shot in zip(states, shots, strict=True)]
    works = {
        name: (table, np.ascontiguousarray(states[rows]), np.ascontiguousarray(shots[rows]))
        for name, rows in (("no jaw", np.equal(met, 0)), ("one jaw", np.equal(met, 1)), ("more", np.greater(met, 1)))
    }
    for name, work in works.items():
        (_, base_events), (us, events), ratio = alternated(works["no jaw"], work, pairs)
        yield {
            "jaws_met": name,
            "shots": len(work[2]),
            "events_per_shot": round(events, 2),
            "us_per_shot": round(us, 3),
            "ns_per_event": round(us / events * 1e3, 1),
            "ratio_per_event": round(ratio * base_events / events, 3),
        }


def jaw_hits(table: physics.Table, state: Any, shot: Any) -> int:
    """Jaw collisions of a shot."""
    result = played(table, state, shot)
    return len(result.events.of(physics.EventKind.JAW_COLLISION))


HORIZON = 1.0
"""s into a rattle at which places are compared."""


def error_vs_time(n: int, steps: list[float]) -> Iterator[Row]:
    """Run time against error one second into rattles of one ball: this engine, and time stepping.

    The truth is the arbitrary-precision engine of the tests at 30 digits; all start from the strike's exact state.
    """
    from benchmarks.opponents import jaw_stepping

    table, shape = NINE.replace(cue_test=False), pieces.pieces_of(NINE)
    rattles = list(itertools.islice(rattling(table), n))
    states, shots = (np.array([rattle[k] for rattle in rattles]) for k in range(2))
    truths = [truth(table, state, shot) for state, shot in rattles]
    many = 200
    seconds = timing.cpu_seconds(
        lambda: physics.simulate_batch(table, np.tile(states, (many, 1, 1)), np.tile(shots, (many, 1)))
    )
    results = [played(table, state, shot) for state, shot in rattles]
    ends = [result.at(min(HORIZON, result.duration)).positions[0] for result in results]
    yield errors("this engine", None, seconds / many / n, ends, truths)

    def carry(ball: scenes.Floats, horizon: float, step: float, back_up: bool) -> scenes.Floats:
        pocketed = jaw_stepping.simulate(table, shape, ball, horizon, step, back_up) == jaw_stepping.POCKETED
        return np.full(2, np.nan) if pocketed else ball[:2]

    starts = [cue_ball_of(result)[:7] for result in results]
    yield from stepped(starts, truths, steps, carry)


def cue_ball_of(result: physics.Result) -> scenes.Floats:
    """(9,) the cue ball after the strike: x y vx vy wx wy wz, then its height and how fast it rises."""
    cue = result.events[0].states[0]
    return np.array([*cue.position, *cue.velocity, *cue.spin, cue.height, cue.velocity_z])


def stepped(starts: list[scenes.Floats], truths: list[Any], steps: list[float], carry: Carry) -> Iterator[Row]:
    """Errors and run times of time stepping from each start; ``carry(ball, horizon, step, back_up)``: where it ends."""
    for back_up in (False, True):
        for step in steps:
            ends, seconds = [], 0.0
            for start in starts:
                carry(start.copy(), step, step, back_up)  # compiled before
                ball, began = start.copy(), time.thread_time()
                ends.append(carry(ball, HORIZON, step, back_up))
                seconds += time.thread_time() - began
            name = "time stepping, backing up" if back_up else "time stepping"
            yield errors(name, step, seconds / len(starts), ends, truths)


def played(table: physics.Table, state: Any, shot: Any) -> physics.Result:
    """One shot with its trace."""
    return physics.simulate(table, physics.TableState.trusted(state.copy()), physics.Shot(*shot.tolist()))


def rattling(table: physics.RealTable) -> Iterator[tuple[scenes.Floats, scenes.Floats]]:
    """Strokes of a lone ball that meets a jaw within the horizon."""
    rng = np.random.default_rng(21)
    while True:
        states, shots = hostile_jaws.rattles(table, rng, 50)
        states[:, 1:] = np.nan
        for state, shot in zip(states, shots, strict=True):
            jaws = played(table, state, shot).events.of(physics.EventKind.JAW_COLLISION)
            if jaws and jaws[0].time < HORIZON:
                yield state, shot


def truth(table: physics.Table, state: scenes.Floats, shot: scenes.Floats) -> scenes.Floats:
    """(2,) place of the cue ball at the horizon by the arbitrary-precision engine, NaN if it is in a pocket."""
    tests = str(ROOT / "tests")
    if tests not in sys.path:
        sys.path.insert(0, tests)
    from mpmath import mp, mpf
    from support.truth import engine, motion, strike
    from support.worlds import world_of

    with mp.workdps(30):
        told = engine.start(world_of(table), {0: tuple(state[0].tolist())}, strike.Stroke(*shot.tolist()))
        while (event := told.next_event()) is not None and event.time <= HORIZON:
            told.step()
        for ball in told.on_table():
            motion.advance(told.world, ball, mpf(HORIZON))
            return np.array([float(ball.position.real), float(ball.position.imag)])
    return np.full(2, np.nan)


def errors(name: str, step: float | None, seconds: float, ends: list[Any], truths: list[Any]) -> Row:
    """Errors of one way to simulate, infinite where the ball is in a pocket, or not, by mistake; medians of those on
    the table.
    """
    found = np.array(
        [
            (np.inf if np.isnan(end).any() != np.isnan(true).any() else float(np.nan_to_num(np.abs(end - true)).max()))
            for end, true in zip(ends, truths, strict=True)
        ]
    )
    stays = ~np.isnan(np.array(truths)).any(axis=1)
    median = float(np.median(found[stays]))
    return {
        "method": name,
        "step_s": step,
        "shots": len(found),
        "on_table": int(stays.sum()),
        "seconds_per_shot": seconds,
        "median_error_m": median if np.isfinite(median) else None,
        "pocketed_or_not_by_mistake": int(np.isinf(found).sum()),
        "worst_finite_m": float(found[np.isfinite(found)].max(initial=0.0)),
    }


if __name__ == "__main__":
    main("real_tables", measure)
