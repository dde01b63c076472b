"""A trace checked event by event with a second copy of the closed-form motions, in doubles.

Walks through the recorded events, carries every ball to the next one by the formulas of [I], and measures what must
not happen: jumps in place, energy that rises, balls that overlap or leave the table.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from support.scenes import LENGTH, RADIUS, SIDE, WIDTH

import physics

GRAVITY = 9.81
STOPPED = ("POCKETED", "ABSENT")

SPEED_ROUNDING = 2e-14
"""m/s; a speed carries the rounding of the time since the strike: acceleration times 1e-15 s."""


@dataclass
class Worst:
    """The largest of each over a trace: jump m, relative energy rise, overlap m, way outside the octagon m."""

    jump: float = 0.0
    rise: float = 0.0
    overlap: float = 0.0
    outside: float = 0.0


def moved(table: physics.Table, state: physics.BallState, t: float) -> physics.BallState:
    """The ball t seconds later in its motion state."""
    (x, y), (vx, vy), (wx, wy, wz) = state.position, state.velocity, state.spin
    ax = ay = 0.0
    if state.motion.name == "SLIDING":
        ux, uy = vx - RADIUS * wy, vy + RADIUS * wx
        pull = table.mu_slide * GRAVITY / math.hypot(ux, uy)
        ax, ay = -pull * ux, -pull * uy
        wx, wy = wx + 2.5 / RADIUS * t * ay, wy - 2.5 / RADIUS * t * ax
    elif state.motion.name == "ROLLING" and (vx, vy) != (0.0, 0.0):  # 0 just before its own end, at another's event
        pull = table.mu_roll * GRAVITY / math.hypot(vx, vy)
        ax, ay = -pull * vx, -pull * vy
        wx, wy = -(vy + ay * t) / RADIUS, (vx + ax * t) / RADIUS
    decay = 2.5 * table.mu_spin * GRAVITY / RADIUS * t
    place = x + vx * t + ax * t * t / 2, y + vy * t + ay * t * t / 2
    spin = wx, wy, math.copysign(max(0.0, abs(wz) - decay), wz)
    return physics.BallState(state.ball, place, (vx + ax * t, vy + ay * t), spin, state.motion)


def energy(states: Sequence[physics.BallState]) -> float:
    """Kinetic energy over mass of the balls in play, J/kg."""
    playing = [s for s in states if s.motion.name not in STOPPED]
    return math.fsum(
        0.5 * math.fsum(v * v for v in s.velocity) + 0.2 * RADIUS**2 * math.fsum(w * w for w in s.spin) for s in playing
    )


def outside(x: float, y: float) -> float:
    """How far a centre is beyond the octagon (m), negative inside; the side mouths' lines count."""
    side, end = abs(x - WIDTH / 2), abs(y - LENGTH / 2)
    corner = (side + end - WIDTH / 2 - LENGTH / 2 + 0.11 / math.sqrt(2) + RADIUS) / math.sqrt(2)
    return max(side - WIDTH / 2 + RADIUS, end - LENGTH / 2 + RADIUS, corner)


def at_side_mouth(y: float) -> bool:
    return abs(y - LENGTH / 2) < SIDE


def overlap(states: Sequence[physics.BallState]) -> float:
    """The deepest overlap of two balls in play (m); 0 if none."""
    places = [s.position for s in states if s.motion.name not in STOPPED]
    return max((2 * RADIUS - math.dist(p, q) for i, p in enumerate(places) for q in places[i + 1 :]), default=0.0)


def resting(ball: int, position: tuple[float, float]) -> physics.BallState:
    return physics.BallState(ball, position, (0.0, 0.0), (0.0, 0.0, 0.0), physics.Motion.STATIONARY)


def instants(result: physics.Result) -> Iterator[tuple[float, list[physics.Event]]]:
    """The events grouped by equal time."""
    for time, events in groupby(result.events, key=lambda event: event.time):
        yield time, list(events)


def audit(table: physics.Table, start: physics.TableState, result: physics.Result) -> Worst:
    """Walk the trace; the strike itself adds energy and is not judged."""
    last = {ball: resting(ball, place) for ball in start.balls if (place := start.position(ball))}
    since, worst = 0.0, Worst()
    for time, events in instants(result):
        now = {ball: moved(table, state, time - since) for ball, state in last.items()}
        before, struck = energy(tuple(now.values())), events[0].kind.value == "cue_strike"
        for event in events:
            for state in event.states:
                worst.jump = max(worst.jump, math.dist(state.position, now[state.ball].position))
                now[state.ball] = state
        states = tuple(now.values())
        if not struck and before > 0.0:
            rounding = SPEED_ROUNDING * math.sqrt(2.0 * before)
            worst.rise = max(worst.rise, (energy(states) - before - rounding) / before)
        worst.overlap = max(worst.overlap, overlap(states))
        inside = [outside(*s.position) for s in states if s.motion.name not in STOPPED]
        worst.outside = max(worst.outside, *inside) if inside else worst.outside
        last, since = now, time
    return worst
