"""Paths as a camera would see them of shots that were simulated: to plan a session, and to test a calibration.

The paths are simulated, not measured. Say so wherever you show them.
"""

import dataclasses

import numpy as np

from calibration.observed import IntendedStroke, Observations, ObservedShot
from physics import InvalidState, Shot, Status, Table, TableState, min_elevation, simulate
from physics.constants import BALL_RADIUS, N_BALLS


@dataclasses.dataclass(frozen=True, slots=True)
class Camera:
    """How shots are seen.

    Attributes:
        sigma: m, noise of one coordinate. rate: Hz. span: s, of each shot that is seen at most.
        missing: part of the samples that are lost. outliers: part that lies anywhere on the table instead.
    """

    sigma: float = 1e-3
    rate: float = 20.0
    span: float = 2.0
    missing: float = 0.0
    outliers: float = 0.0


@dataclasses.dataclass(frozen=True, slots=True)
class Player:
    """Standard deviations of a player's strokes about what was meant: m/s, deg, deg, mm, mm."""

    v: float = 0.05
    phi: float = 0.1
    theta: float = 0.1
    a: float = 0.5
    b: float = 0.5


def seen(
    table: Table, shots: int, rng: np.random.Generator, camera: Camera = Camera(), player: Player = Player()
) -> Observations:
    """Random shots of two balls, most of which meet.

    Returns the observations; a shot's intended stroke is known, what was played differs from it as the player errs.
    """
    found: list[ObservedShot] = []
    errors = np.array(dataclasses.astuple(player))
    while len(found) < shots:
        state = _placed(table, rng)
        if state is None:
            continue
        phi = _towards(state, rng)
        a, b = rng.uniform(-9.0, 9.0, 2).tolist()
        theta = min_elevation(table, state, phi, a, b)
        meant = np.array([rng.uniform(1.0, 4.0), phi, theta + 0.5, a, b])
        played = meant + errors * rng.standard_normal(5)
        if not 0.0 <= played[2] < 30.0:
            continue
        result = simulate(table, state, Shot(*played.tolist()))
        if result.status is not Status.AT_REST:
            continue
        times = np.arange(0.0, min(camera.span, result.duration) + 1e-9, 1.0 / camera.rate)
        places, heights = result.paths(np.minimum(times, result.duration))
        rows, balls = np.nonzero(~np.isnan(places[:, :, 0]) & (rng.random(places.shape[:2]) >= camera.missing))
        if np.count_nonzero(balls == 0) < 8:
            continue
        written = places[rows, balls] + camera.sigma * rng.standard_normal((len(rows), 2))
        wrong = rng.random(len(rows)) < camera.outliers
        written[wrong] = rng.uniform((0.0, 0.0), (table.width, table.length), (int(wrong.sum()), 2))
        heights_seen = np.full(len(rows), np.nan)
        if table.flies:
            heights_seen = heights[rows, balls] + camera.sigma * rng.standard_normal(len(rows))
        stroke = IntendedStroke(*meant.tolist())
        name = f"shot {len(found) + 1}"
        found.append(ObservedShot(name, times[rows], balls, written, heights_seen, stroke))
    return Observations(tuple(found), camera.sigma, strike_known=True)


def _placed(table: Table, rng: np.random.Generator) -> TableState | None:
    """A cue ball and an object ball, 15 cm apart or more."""
    positions = np.full((N_BALLS, 2), np.nan)
    positions[:2] = rng.uniform((0.15, 0.3), (table.width - 0.15, table.length - 0.3), (2, 2))
    if np.hypot(*(positions[1] - positions[0])) < 0.15:
        return None
    try:
        return TableState.from_positions(positions)
    except InvalidState:
        return None


def _towards(state: TableState, rng: np.random.Generator) -> float:
    """Azimuth, deg: four in five meet the object ball, not too thinly."""
    across = state.positions[1] - state.positions[0]
    if rng.random() >= 0.8:
        return float(rng.uniform(0.0, 360.0))
    thinness = rng.uniform(-0.7, 0.7) * 2.0 * BALL_RADIUS / float(np.hypot(*across))
    return float(np.degrees(np.arctan2(across[1], across[0]) + np.arcsin(thinness)))
