"""Run time against error at one second into a shot: this engine, time stepping, scipy's ``solve_ivp``.

The truth is the arbitrary-precision engine of the tests (50 digits). Everyone starts from the cue ball's exact state
after the strike. The engine's time is that of the whole shot, to rest; the others stop after one second.
"""

import sys
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

import physics
from benchmarks import scenes, timing
from benchmarks.command import main
from benchmarks.recording import ROOT, Row, Tables
from benchmarks.scenes import Floats

HORIZON = 1.0
"""s."""

BALLS = 3
DIGITS = 50
WRONG = 1e-3
"""m. A shot is wrong when a ball is further than this from where it should be, or in a pocket or not by mistake."""

TABLE = physics.Table.olympiad()
PICTURE = ROOT / "docs" / "error_vs_time.svg"

Shots = list[tuple[Floats, Floats]]
"""Positions (16, 2) and stroke (5,) of each."""


def measure(full: bool) -> Tables:
    """The table behind the picture, and the picture."""
    shots, truths = chosen(24 if full else 8)
    steps = [10.0**-k for k in range(2, 8 if full else 6)]
    max_steps = [1e-2, 1e-3, 1e-4, 1e-5] if full else [1e-2, 1e-3]
    rows = [row("this engine", None, *ours(shots), truths)]
    for back_up in (False, True):
        name = "time stepping, backing up" if back_up else "time stepping"
        rows += [row(name, dt, *stepped(shots, dt, back_up), truths) for dt in steps]
    rows += [row("solve_ivp", step, *integrated(shots, step), truths) for step in max_steps]
    for tolerance in (1e-3, 1e-12):
        name = f"solve_ivp, rtol {tolerance:g} alone"
        rows.append(row(name, None, *integrated(shots, np.inf, tolerance), truths))
    draw(rows)
    return {"error_vs_time": rows}


def chosen(n: int) -> tuple[Shots, list[Floats]]:
    """Random three-ball shots with a ball collision in the first second, and where their balls truly are after it."""
    rng = np.random.default_rng(11)
    shots: Shots = []
    truths = []
    while len(shots) < n:
        states, strokes = scenes.playable_mid_game(TABLE, rng, 1, BALLS)
        way = states[0, 1] - states[0, 0]
        strokes[0, :2] = rng.uniform(1.0, 4.0), np.degrees(np.arctan2(way[1], way[0])) + rng.normal(0.0, 2.0)
        result = physics.simulate(TABLE, physics.TableState.trusted(states[0].copy()), physics.Shot(*strokes[0]))
        if any(e.kind == "ball_collision" and e.time < HORIZON for e in result.events):
            shots.append((states[0], strokes[0]))
            truths.append(truth(states[0], strokes[0]))
    return shots, truths


def truth(state: Floats, stroke: Floats) -> Floats:
    """(16, 2) positions at the horizon by the arbitrary-precision engine; NaN where not on the table."""
    tests = str(ROOT / "tests")
    if tests not in sys.path:
        sys.path.insert(0, tests)
    from mpmath import mp, mpf
    from support.truth import engine, motion, strike

    balls = {i: tuple(place) for i, place in enumerate(state.tolist()) if place[0] == place[0]}
    places = np.full((scenes.N_BALLS, 2), np.nan)
    with mp.workdps(DIGITS):
        shot = engine.start(engine.World(), balls, strike.Stroke(*stroke.tolist()))
        while (event := shot.next_event()) is not None and event.time <= HORIZON:
            shot.step()
        for ball in shot.on_table():
            motion.advance(shot.world, ball, mpf(HORIZON))
            places[ball.number] = float(ball.position.real), float(ball.position.imag)
    return places


def ours(shots: Shots) -> tuple[float, list[Floats]]:
    """Seconds a shot and positions at the horizon by this engine."""
    states = np.array([state for state, _ in shots])
    strokes = np.array([stroke for _, stroke in shots])
    many = 500
    states_many, strokes_many = np.tile(states, (many, 1, 1)), np.tile(strokes, (many, 1))
    strokes_many[:, 0] *= np.linspace(0.99, 1.01, len(strokes_many))  # not the same shots over and over
    seconds = timing.median(
        lambda: timing.cpu_seconds(lambda: physics.simulate_batch(TABLE, states_many, strokes_many)), 5
    )
    ends = []
    for state, stroke in shots:
        result = physics.simulate(TABLE, physics.TableState.trusted(state.copy()), physics.Shot(*stroke))
        ends.append(result.at(min(HORIZON, result.duration)).positions)
    return seconds / len(strokes_many), ends


def starts(shots: Shots) -> list[tuple[Floats, Any]]:
    """Balls (3, 7) and motion states after the strike of each shot."""
    from benchmarks.opponents import laws

    found = []
    for state, stroke in shots:
        cue = (
            physics.simulate(TABLE, physics.TableState.trusted(state.copy()), physics.Shot(*stroke)).events[0].states[0]
        )
        balls = np.zeros((BALLS, 7))
        balls[:, :2] = state[:BALLS]
        balls[0, 2:4], balls[0, 4:7] = cue.velocity, cue.spin
        found.append((balls, np.array([laws.classify(ball) for ball in balls])))
    return found


def timed(shots: Shots, simulate: Callable[[Floats, Any], None]) -> tuple[float, list[Floats]]:
    """Seconds a shot and positions at the horizon by an opponent that overwrites its start."""
    from benchmarks.opponents import laws

    simulate(*starts(shots[:1])[0])  # compile
    balls = starts(shots)
    seconds = timing.cpu_seconds(lambda: [simulate(*each) for each in balls])
    ends = []
    for each, motion in balls:
        places = np.full((scenes.N_BALLS, 2), np.nan)
        places[:BALLS] = np.where((motion == laws.POCKETED)[:, None], np.nan, each[:, :2])
        ends.append(places)
    return seconds / len(shots), ends


def stepped(shots: Shots, dt: float, back_up: bool) -> tuple[float, list[Floats]]:
    """Time stepping."""
    from benchmarks.opponents import time_stepping

    return timed(shots, lambda balls, motion: time_stepping.simulate(balls, motion, HORIZON, dt, back_up))


def integrated(shots: Shots, max_step: float, tolerance: float = 1e-10) -> tuple[float, list[Floats]]:
    """scipy's solver with a longest step and a relative tolerance."""
    from benchmarks.opponents import ode

    print(f"solve_ivp with max_step {max_step:g} s", flush=True)
    return timed(shots, lambda balls, motion: ode.simulate(balls, motion, HORIZON, max_step, tolerance))


def error(found: Floats, true: Floats) -> float:
    """m: the ball furthest from where it should be; infinite if one is in a pocket or on the table by mistake."""
    if (np.isnan(found) != np.isnan(true)).any():
        return float("inf")
    return float(np.nanmax(np.sqrt(((found - true) ** 2).sum(axis=1))))


def row(name: str, step: float | None, seconds: float, ends: list[Floats], truths: list[Floats]) -> Row:
    """Errors of one way to simulate."""
    errors = np.array([error(found, true) for found, true in zip(ends, truths, strict=True)])
    median = float(np.median(errors))
    return {
        "method": name,
        "step_s": step,
        "shots": len(errors),
        "seconds_per_shot": seconds,
        "median_error_m": median if np.isfinite(median) else None,
        "best_error_m": float(errors.min()) if np.isfinite(errors.min()) else None,
        "wrong": int((errors > WRONG).sum()),
    }


def draw(rows: list[Row]) -> None:
    """One log-log picture, written to ``docs``; without matplotlib there is only the table."""
    try:
        import matplotlib as mpl
    except ImportError:
        print("matplotlib is not installed: no picture")
        return
    mpl.use("svg")
    mpl.rcParams["svg.hashsalt"] = "pooliad"
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(7.0, 4.5))
    for name, points in by_method(rows):
        axes.loglog(*zip(*points, strict=True), "o-", label=name)
    axes.set_xlabel("CPU seconds a shot")
    axes.set_ylabel("median error after 1 s of play, m")
    axes.grid(visible=True, which="major", alpha=0.3)
    axes.legend()
    figure.tight_layout()
    PICTURE.parent.mkdir(exist_ok=True)
    figure.savefig(PICTURE, metadata={"Date": None})
    plt.close(figure)


def by_method(rows: list[Row]) -> Iterator[tuple[str, list[tuple[float, float]]]]:
    """(method, points of seconds and error)."""
    for name in dict.fromkeys(row["method"] for row in rows):
        points = [
            (row["seconds_per_shot"], max(row["median_error_m"], 1e-17))
            for row in rows
            if row["method"] == name and row["median_error_m"] is not None
        ]
        if points:
            yield name, points


if __name__ == "__main__":
    main("error_vs_time", measure)
