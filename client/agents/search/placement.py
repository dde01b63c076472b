"""Where to put a cue ball in hand: behind every pot there is, straight and at an angle, near and far."""

import math

import numpy as np
from numpy.typing import NDArray

from client.agents.search.shots import Floats, Tables
from client.agents.search.sight import Sight
from client.geometry import lattice
from physics import Table, TableState

TURNS = (0.0, 12.0, -12.0, 28.0, -28.0, 45.0, -45.0)
"""Degrees of the cut."""
REACHES = (0.12, 0.25, 0.45, 0.8)
"""m between the cue ball and where it strikes: near is precise, further leaves room for the cue."""


ALIKE = 2
"""Decimals of a chance that matter in the choice of places."""


def places(table: Table, positions: Floats, targets: NDArray[np.bool_], kitchen: bool) -> Floats:
    """Free places from which some target can be cut towards some pocket, (n, 2) m; a lattice if there is none."""
    state = TableState.from_positions(
        {ball: (float(x), float(y)) for ball, (x, y) in enumerate(positions) if ball and not math.isnan(x)}
    )
    radius = table.ball_radius
    found = []
    for ball in np.flatnonzero(targets):
        to_pocket = table.mouths - positions[ball]
        direction = np.arctan2(to_pocket[:, 1], to_pocket[:, 0])
        ghost = positions[ball] - 2.0 * radius * np.stack((np.cos(direction), np.sin(direction)), axis=1)
        angle = direction[:, None] + np.radians(TURNS)[None, :]
        back = np.stack((np.cos(angle), np.sin(angle)), axis=-1)
        found.append((ghost[:, None, None] - np.array(REACHES)[:, None] * back[:, :, None]).reshape(-1, 2))
    near = np.concatenate(found) if found else np.empty((0, 2))
    inside = free(table, positions, near, table.head_string if kitchen else 0.0)
    return near[inside] if inside.any() else np.array(lattice(table, state, 7, 9 if not kitchen else 4, kitchen))


def free(table: Table, positions: Floats, points: Floats, least_y: float) -> NDArray[np.bool_]:
    """(n,): whether the cue ball may be put there."""
    radius = table.ball_radius
    x, y = points.T
    inside = (x >= radius) & (x <= table.width - radius) & (y > least_y) & (y >= radius) & (y <= table.length - radius)
    gap = points[:, None, :] - positions[None, 1:, :]
    near = ((gap * gap).sum(axis=2) < (2.0 * radius + 1e-6) ** 2).any(axis=1)
    mouths = ((points[:, None, :] - table.mouths[None]) ** 2).sum(axis=2).min(axis=1) < (3.0 * radius) ** 2
    found: NDArray[np.bool_] = inside & ~near & ~mouths
    return found


def best_places(
    sight: Sight, positions: Floats, group: int, targets: NDArray[np.bool_], points: Floats, most: int
) -> Tables:
    """The tables with the cue ball at the `most` places with the likeliest pots.

    Of places that are as good, some of all kinds: they come in an order that has nothing to do with where they lie.
    """
    mixed = points[np.random.default_rng(len(points)).permutation(len(points))]
    tables = np.repeat(positions[None], len(mixed), axis=0)
    tables[:, 0] = mixed
    every = Tables(tables, np.full(len(mixed), group, np.int8))
    chance = sight.pots(every, 1, np.repeat(targets[None], len(mixed), axis=0)).chance[:, 0]
    return every[np.argsort(-np.round(chance, ALIKE), kind="stable")[:most]]
