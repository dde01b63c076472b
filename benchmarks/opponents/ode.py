"""Simulation by a general solver of differential equations: scipy's ``solve_ivp``, one phase after another.

Within a phase every ball keeps its motion state; the phase ends at the first terminal event: two balls, a ball and a
side of the table, the end of a motion state. Paths within a phase are parabolas, which the solver's formulas follow
exactly: it would choose steps as long as the phase whatever its tolerances, and steps over collisions whose event
function has the same sign at both ends. Its accuracy is therefore set by ``max_step`` alone.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.opponents import laws
from benchmarks.scenes import Floats

WIDTH = 6
"""Numbers of a ball in the solver's vector: x y vx vy wx wy. w_z obeys a closed form of its own."""

Event = Callable[[float, Floats], float]


def simulate(balls: Floats, motion: Any, horizon: float, max_step: float, tolerance: float) -> None:
    """Carry ``balls`` (n, 7) and ``motion`` (n,) to ``horizon`` (s); both are overwritten. ``tolerance``: relative."""
    time = 0.0
    while time < horizon:
        moving = [i for i in range(len(balls)) if motion[i] in (laws.SLIDING, laws.ROLLING)]
        if not moving:
            return
        time += phase(balls, motion, moving, horizon - time, max_step, tolerance)


def phase(balls: Floats, motion: Any, moving: list[int], left: float, max_step: float, tolerance: float) -> float:
    """Integrate until the first event, act on it, and say how long that took."""
    rates = np.concatenate([rate(balls[i], motion[i]) for i in moving])
    velocity = np.concatenate([np.arange(2) + 2 + WIDTH * n for n in range(len(moving))])
    place = velocity - 2

    def slope(_time: float, y: Floats) -> Floats:
        out = rates.copy()
        out[place] = y[velocity]
        return out

    found = events(balls, motion, moving)
    start = balls[moving, :WIDTH].ravel()
    options = {"rtol": tolerance, "atol": 1e-3 * tolerance, "max_step": max_step}
    solution = solve_ivp(slope, (0.0, left), start, events=[event for event, _ in found], **options)
    elapsed = float(solution.t[-1])
    for n, i in enumerate(moving):
        balls[i, :WIDTH] = solution.y[WIDTH * n : WIDTH * (n + 1), -1]
    slower = np.maximum(0.0, np.abs(balls[:, 6]) - laws.SPIN * elapsed)
    balls[:, 6] = np.copysign(slower, balls[:, 6])
    if solution.status == 1:
        hit = min((t[0], n) for n, t in enumerate(solution.t_events) if len(t))[1]
        found[hit][1]()
    return elapsed


def rate(ball: Floats, motion: int) -> Floats:
    """What changes at a constant rate: the velocity, and the spin with it."""
    ax, ay, _ = laws.acceleration(ball, motion)
    if motion == laws.ROLLING:
        return np.array([0.0, 0.0, ax, ay, -ay / laws.RADIUS, ax / laws.RADIUS])
    turn = 2.5 / laws.RADIUS
    return np.array([0.0, 0.0, ax, ay, turn * ay, -turn * ax])


def events(balls: Floats, motion: Any, moving: list[int]) -> list[tuple[Event, Callable[[], None]]]:
    """Terminal events of a phase, each with what it does."""
    found = []
    for n, i in enumerate(moving):
        found.append((terminal(side_gap(n)), meet_side(balls, motion, i)))
        found.append((terminal(motion_left(balls[i], motion[i], n)), finish(balls, motion, i)))
        for j in range(len(balls)):
            if j != i and motion[j] != laws.POCKETED and (j not in moving or j > i):
                other = moving.index(j) if j in moving else None
                found.append((terminal(pair_gap(n, other, balls[j])), meet_ball(balls, motion, i, j)))
    return found


def terminal(event: Event) -> Event:
    """Mark an event function as one that ends the phase when it falls through 0."""
    event.terminal, event.direction = True, -1.0  # type: ignore[attr-defined]
    return event


def side_gap(n: int) -> Event:
    """Gap to the nearest side of the table, m."""
    return lambda _time, y: laws.boundary(y[WIDTH * n : WIDTH * n + 2])[0]


def pair_gap(n: int, other: int | None, resting: Floats) -> Event:
    """|d|^2 - 4R^2 of two balls, m^2."""
    place = resting[:2].copy()

    def gap(_time: float, y: Floats) -> float:
        there = place if other is None else y[WIDTH * other : WIDTH * other + 2]
        dx, dy = y[WIDTH * n] - there[0], y[WIDTH * n + 1] - there[1]
        return float(dx * dx + dy * dy - 4.0 * laws.RADIUS * laws.RADIUS)

    return gap


def motion_left(ball: Floats, motion: int, n: int) -> Event:
    """Slip (sliding) or velocity (rolling) along its first direction: falls through 0 when the state ends."""
    if motion == laws.ROLLING:
        vx, vy = ball[2:4].tolist()
        return lambda _time, y: float(vx * y[WIDTH * n + 2] + vy * y[WIDTH * n + 3])
    ux, uy = ball[2] - laws.RADIUS * ball[5], ball[3] + laws.RADIUS * ball[4]
    return lambda _time, y: float(
        ux * (y[WIDTH * n + 2] - laws.RADIUS * y[WIDTH * n + 5])
        + uy * (y[WIDTH * n + 3] + laws.RADIUS * y[WIDTH * n + 4])
    )


def meet_ball(balls: Floats, motion: Any, i: int, j: int) -> Callable[[], None]:
    """The collision of two balls."""

    def act() -> None:
        laws.collide(balls[i], balls[j])
        motion[i], motion[j] = laws.classify(balls[i]), laws.classify(balls[j])

    return act


def meet_side(balls: Floats, motion: Any, i: int) -> Callable[[], None]:
    """A rail collision, or a pocketed ball."""

    def act() -> None:
        _, nx, _, mouth = laws.boundary(balls[i])
        if mouth:
            motion[i] = laws.POCKETED
        else:
            laws.rebound(balls[i], nx)
            motion[i] = laws.classify(balls[i])

    return act


def finish(balls: Floats, motion: Any, i: int) -> Callable[[], None]:
    """The end of a motion state."""

    def act() -> None:
        motion[i] = laws.end_motion(balls[i], motion[i])

    return act
