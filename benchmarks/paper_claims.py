"""The seed paper's own claims, measured again: operations of event prediction and time stepping; quartic solvers."""

import importlib
import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

import physics
from benchmarks import scenes, timing, variants
from benchmarks.command import main
from benchmarks.constants import moves
from benchmarks.harvest import Problems, harvest
from benchmarks.recording import ROOT, Row, Tables
from benchmarks.scenes import Floats

TABLE = physics.Table.olympiad()
HORIZON, STEP = 1.0, 1e-3
"""s: the paper's example is one second of three balls, in steps of 1 ms."""

CLAIMED = {"event prediction": 882, "time stepping": 87_000}
"""Operations the paper counts."""

CLOSE = 1e-9
"""m. A contact found this near to where it happens is right."""

SOLVERS = ("companion", "textbook")

PATIENCE = 900.0
"""s; whole shots with another solver that take longer are given up: one of them never ends."""


def measure(full: bool) -> Tables:
    """All tables of this benchmark."""
    return {
        "operations": list(operations(100 if full else 10)),
        "solvers": list(solvers(100_000 if full else 2_000)),
        "shots_ended_wrong": list(wrong_shots(20_000 if full else 500)),
    }


# --- operations ---------------------------------------------------------------------------------------


def operations(shots: int) -> Iterator[Row]:
    """Floating-point operations of one second of three balls, mean over random shots."""
    job = "benchmarks.paper_claims:"
    events, ours = variants.run(f"{job}prepare_counting", f"{job}count_events", shots, interpreted=True)
    theirs = variants.run(f"{job}prepare_counting", f"{job}count_steps", min(shots, 3), interpreted=True)
    for name, measured, steps in (("event prediction", ours, events), ("time stepping", theirs, HORIZON / STEP)):
        yield {
            "method": name,
            "paper": CLAIMED[name],
            "measured": round(measured),
            "events_or_steps": round(steps, 1),
            "by_event_or_step": round(measured / steps, 1),
        }


def three_balls(shots: int) -> tuple[Floats, Floats]:
    """Scenes and strokes of three balls."""
    rng = np.random.default_rng(21)
    states = scenes.mid_game(TABLE, rng, shots, 3)
    strokes = scenes.strokes(rng, shots, v=(1.0, 4.0), theta=(10.0, 20.0))
    way = states[:, 1] - states[:, 0]
    strokes[:, 1] = np.degrees(np.arctan2(way[:, 1], way[:, 0]))
    return states, strokes


NOTES: list[tuple[float, int]] = []
"""Time of each event recorded and the operations counted until then."""


def prepare_counting(*_: object) -> None:
    """In a new, interpreting process: kernels that count their operations and note them at every event."""
    from benchmarks import counting

    variants.replace("physics.kernels.compiling", "load", counting.counted_load)
    recording = importlib.import_module("physics.kernels.recording")
    record = recording.record

    def noted(s: Any, time: float, *rest: Any) -> Any:
        NOTES.append((float(time), counting.COUNT[0]))
        return record(s, time, *rest)

    variants.replace("physics.kernels.recording", "record", noted)
    importlib.import_module("physics.kernels.entries")
    counting.count_in("physics.kernels")


def count_events(shots: int) -> tuple[float, float]:
    """(events, operations) a shot within the horizon; what finds the first event beyond it counts."""
    from benchmarks import counting

    events, total = 0, 0
    for state, stroke in zip(*three_balls(shots), strict=True):
        NOTES.clear()
        counting.COUNT[0] = 0
        simulate_one(state, stroke)
        events += sum(time <= HORIZON for time, _ in NOTES)
        total += next((count for time, count in NOTES if time > HORIZON), counting.COUNT[0])
    return events / shots, total / shots


def simulate_one(state: Floats, stroke: Floats) -> physics.Result:
    """One shot with its trace."""
    table = TABLE.replace(cue_test=False)
    return physics.simulate(table, physics.TableState.trusted(state.copy()), physics.Shot(*stroke.tolist()))


def count_steps(shots: int) -> float:
    """Operations a shot of time stepping with backing up."""
    from benchmarks import counting
    from benchmarks.opponents import laws, time_stepping

    counting.count_in("benchmarks.opponents")
    counts = []
    for state, stroke in zip(*three_balls(shots), strict=True):
        cue = simulate_one(state, stroke).events[0].states[0]
        balls = np.zeros((3, 7))
        balls[:, :2] = state[:3]
        balls[0, 2:4], balls[0, 4:7] = cue.velocity, cue.spin
        motion = [laws.classify(ball) for ball in balls]
        counted = np.array([[counting.Counted(x) for x in ball] for ball in balls.tolist()], dtype=object)
        counting.COUNT[0] = 0
        time_stepping.simulate(counted, motion, HORIZON, STEP, True)
        counts.append(counting.COUNT[0])
    return float(np.mean(counts))


# --- solvers ------------------------------------------------------------------------------------------


def solvers(shots: int) -> Iterator[Row]:
    """Time and mistakes of each solver on the problems of random shots, against certified answers."""
    problems = harvest(np.random.default_rng(22), shots)
    print(f"{len(problems[3])} problems", flush=True)
    found = {name: (seconds, answers) for name, seconds, answers in answered(problems)}
    reference, decided = certified(problems, found["ours"][1])
    for name, (seconds, answers) in found.items():
        yield {
            "solver": name,
            "problems": len(answers),
            "contacts": int((~np.isnan(reference)).sum()),
            "ns_per_solve": round(seconds / len(answers) * 1e9, 1),
            **mistakes(problems, answers, reference, decided),
        }


def answered(problems: Problems) -> Iterator[tuple[str, float, Floats]]:
    """(solver, CPU seconds, answers)."""
    from benchmarks.opponents import quartics
    from physics.engine import kernels

    c, b, a, t_max = problems
    distance = 2.0 * TABLE.ball_radius
    kernels()
    ours = quartics.of_numbers(importlib.import_module("physics.kernels.detect.contact").contact)
    loops = {"ours": ours, "textbook closed form": quartics.textbook}
    for name, solve in loops.items():
        loop = in_a_loop(solve)
        answers = loop(c, b, a, t_max, distance)
        yield (
            name,
            timing.median(lambda loop=loop: timing.cpu_seconds(lambda: loop(c, b, a, t_max, distance)), 5),
            answers,
        )
    answers = quartics.companion_in_bulk(c, b, a, t_max, distance)
    work = lambda: quartics.companion_in_bulk(c, b, a, t_max, distance)  # noqa: E731
    yield "companion matrix", timing.median(lambda: timing.cpu_seconds(work), 3), answers


def in_a_loop(solve: Callable[..., float]) -> Any:
    """Compiled: ``solve`` for every problem."""
    import numba

    @numba.njit(error_model="numpy")  # type: ignore[untyped-decorator]
    def loop(c: Floats, b: Floats, a: Floats, t_max: Floats, distance: float) -> Floats:
        out = np.empty(len(t_max))
        for n in range(len(t_max)):
            t = t_max[n]
            out[n] = solve(c[n, 0], c[n, 1], b[n, 0], b[n, 1], a[n, 0], a[n, 1], t, t, distance)
        return out

    return loop


def certified(problems: Problems, answers: Floats) -> tuple[Floats, scenes.Booleans]:
    """(true answers, which are decided): proved by intervals, the rest at 50 digits.

    A contact shallower than 1e-12 m is not decided by the data.
    """
    tests = str(ROOT / "tests")
    if tests not in sys.path:
        sys.path.insert(0, tests)
    from support.contact import certify, precise
    from support.contact.cases import Cases

    kinds = np.full(len(answers), "harvested")
    proved = certify.certainly_right(Cases(*problems, kinds), answers)
    true, decided = answers.copy(), np.ones(len(answers), dtype=bool)
    for n in np.flatnonzero(~proved).tolist():
        c, b, a, t_max = (array[n] for array in problems)
        verdict = precise.agrees(c, b, a, float(t_max), float(answers[n]))
        decided[n] = verdict is not None
        if verdict is False:
            entry = precise.entry(c, b, a, float(t_max))
            true[n] = np.nan if entry is None else float(entry)
    return true, decided


def mistakes(problems: Problems, answers: Floats, true: Floats, decided: scenes.Booleans) -> Row:
    """Counts of missed, invented and misplaced contacts."""
    _, b, a, _ = problems
    hit, said = ~np.isnan(true), ~np.isnan(answers)
    t = np.nan_to_num(true)[:, None]
    speed = np.sqrt(((b + 2.0 * t * a) ** 2).sum(axis=1))
    off = np.abs(np.nan_to_num(answers) - t[:, 0]) * speed
    both = hit & said & decided
    return {
        "missed": int((hit & ~said & decided).sum()),
        "wrong_by_1e-9_m": int((both & (off > CLOSE)).sum()),
        "impossible": int((~hit & said & decided).sum()),
        "undecided": int((~decided).sum()),
        "worst_m": float(off[both].max(initial=0.0)),
    }


# --- whole shots --------------------------------------------------------------------------------------


def wrong_shots(n: int) -> Iterator[Row]:
    """Shots whose end moves by more than 1 mm when another solver takes the place of ours in the engine.

    With the filter every pair is proved harmless or solved; without it the solver sees every pair, as in the paper.
    The row "ours, one ulp of v" is what the last bit of the cue's speed changes.
    """
    job = "benchmarks.paper_claims:"
    usual = variants.run(None, f"{job}ends", "ours", True, n)
    yield wrong_row("ours, one ulp of v", True, usual, variants.run(None, f"{job}ends", "one ulp", True, n))
    for solver in ("ours", *SOLVERS):
        for filtered in (True, False):
            if (solver, filtered) != ("ours", True):
                print(f"{solver} in the engine, filter {'on' if filtered else 'off'}", flush=True)
                try:
                    found = variants.run(f"{job}exchange", f"{job}ends", solver, filtered, n, patience=PATIENCE)
                except subprocess.TimeoutExpired:
                    found = None
                yield wrong_row(solver, filtered, usual, found)


def exchange(solver: str, filtered: bool, _n: int) -> None:
    """In a new process: another solver in the engine, with or without the filter of pairs."""
    from benchmarks import savings
    from benchmarks.opponents import quartics

    if solver in SOLVERS:
        home = "physics.kernels.detect.contact"
        usual = importlib.import_module(home).contact
        variants.replace(home, "contact", quartics.in_the_engine(getattr(quartics, solver), usual))
    if not filtered:
        savings.let_all_pairs_pass()


def ends(solver: str, _filtered: bool, n: int) -> dict[str, Any]:
    """Ends of fixed mid-game shots and breaks by the engine as it is in this process."""
    rng = np.random.default_rng(23)
    table = TABLE.replace(cue_test=False)
    found = {}
    sets = {"mid-game": (scenes.mid_game(table, rng, n, 16), scenes.strokes(rng, n))}
    sets["break"] = scenes.breaks(table, rng, max(n // 10, 1))
    for name, (states, shots) in sets.items():
        if solver == "one ulp":
            shots[:, 0] = np.nextafter(shots[:, 0], 0.0)
        batch = physics.simulate_batch(table, states, shots)
        found[name] = batch.positions, batch.status
    return found


def wrong_row(name: str, filtered: bool, usual: dict[str, Any], found: dict[str, Any] | None) -> Row:
    """Shares of shots that end elsewhere; nothing where the run did not end."""
    row: Row = {"solver": name, "filter": filtered}
    for scene in usual:
        row |= {f"{scene}_shots": len(usual[scene][0]), f"{scene}_wrong": None, f"{scene}_endless": None}
    for scene, (positions, status) in (found or {}).items():
        row[f"{scene}_wrong"] = round(float((moves(usual[scene][0], positions) > 1e-3).mean()), 6)
        row[f"{scene}_endless"] = int((status == physics.Status.EVENT_LIMIT).sum())
    return row


if __name__ == "__main__":
    main("paper_claims", measure)
