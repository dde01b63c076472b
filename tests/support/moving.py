"""Balls set in motion by hand, for tests of one law at a time."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

import physics
from physics.constants import EVENT_LIMIT

STILL = (0.0, 0.0)


@dataclass(frozen=True)
class Launch:
    """A ball with a velocity (m/s) and a spin (rad/s), on the cloth or over it; its motion state follows from them."""

    position: tuple[float, float]
    velocity: tuple[float, float] = STILL
    spin: tuple[float, float, float] = (0.0, 0.0, 0.0)
    height: float = 0.0
    velocity_z: float = 0.0

    @property
    def motion(self) -> physics.Motion:
        if self.height != 0.0 or self.velocity_z != 0.0:
            return physics.Motion.FLYING
        radius = physics.Table.olympiad().ball_radius
        (vx, vy), (wx, wy, wz) = self.velocity, self.spin
        if np.hypot(vx - radius * wy, vy + radius * wx) > 1e-12:
            return physics.Motion.SLIDING
        if (vx, vy) != STILL:
            return physics.Motion.ROLLING
        return physics.Motion.SPINNING if wz else physics.Motion.STATIONARY


def rolling(position: tuple[float, float], velocity: tuple[float, float], w_z: float = 0.0) -> Launch:
    """Natural roll: w = k x v / R."""
    radius = physics.Table.olympiad().ball_radius
    return Launch(position, velocity, (-velocity[1] / radius, velocity[0] / radius, w_z))


def let_go(table: physics.Table, launches: Mapping[int, Launch], event_limit: int = EVENT_LIMIT) -> physics.Result:
    """What happens from there."""
    positions, velocities = np.full((16, 2), np.nan), np.zeros((16, 2))
    heights, rising = np.zeros(16), np.zeros(16)
    spins, motion = np.zeros((16, 3)), np.full(16, physics.Motion.ABSENT, dtype=np.int8)
    for ball, launch in launches.items():
        positions[ball], velocities[ball], spins[ball] = launch.position, launch.velocity, launch.spin
        motion[ball] = launch.motion
        heights[ball], rising[ball] = launch.height, launch.velocity_z
    return physics.resume(
        table, physics.Snapshot(0.0, positions, velocities, spins, motion, heights, rising), event_limit=event_limit
    )


def first(result: physics.Result, kind: str) -> physics.Event:
    """The first event of a kind."""
    return next(event for event in result.events if event.kind.value == kind)


def after(event: physics.Event, ball: int) -> physics.BallState:
    """The state of a ball after an event it took part in."""
    return next(state for state in event.states if state.ball == ball)
