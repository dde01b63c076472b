"""Contact problems as they come up in play: at an event of a random shot, its balls against every other."""

import numpy as np

import physics
from benchmarks import scenes
from benchmarks.scenes import Floats

TABLE = physics.Table.olympiad()

Problems = tuple[Floats, Floats, Floats, Floats]
"""c, b, a (n, 2) and t_max (n,): relative path, and how long both motion states last."""


def harvest(rng: np.random.Generator, shots: int) -> Problems:
    """The problems of one random event of each of ``shots`` shots: nine mid-game shots to a break."""
    broken = max(shots // 10, 1)
    parts = [scenes.playable_mid_game(TABLE, rng, shots - broken, 16)]
    states, strokes = scenes.breaks(TABLE, rng, 2 * broken + 20)
    states, strokes = scenes.played(TABLE, states, strokes)
    parts.append((states[:broken], strokes[:broken]))
    found = [
        at_an_event(rng, state, stroke)
        for states, strokes in parts
        for state, stroke in zip(states, strokes, strict=True)
    ]
    c, b, a, t_max = (np.concatenate(arrays) for arrays in zip(*found, strict=True))
    return c, b, a, t_max


def at_an_event(rng: np.random.Generator, state: Floats, stroke: Floats) -> Problems:
    """The problems an engine that solves every pair faces after one event of a shot."""
    shot = physics.Shot(*stroke.tolist())
    result = physics.simulate(TABLE, physics.TableState.trusted(state.copy()), shot)
    event = result.events[int(rng.integers(len(result.events)))]
    now = result.at(event.time)
    half, lasts = motions(now)
    on_table = np.flatnonzero(~np.isnan(now.positions[:, 0]))
    involved = {event.ball, event.other} if event.kind == "ball_collision" else {event.ball}
    pairs = np.array(
        [
            (i, j)
            for i in on_table.tolist()
            for j in on_table.tolist()
            if i in involved and j != i and not (j in involved and j < i)
        ],
        dtype=np.int64,
    ).reshape(-1, 2)
    i, j = pairs[:, 0], pairs[:, 1]
    t_max = np.minimum(lasts[i], lasts[j])
    moving = np.isfinite(t_max)
    i, j = i[moving], j[moving]
    return (
        now.positions[j] - now.positions[i],
        now.velocities[j] - now.velocities[i],
        half[j] - half[i],
        t_max[moving],
    )


def motions(now: physics.Snapshot) -> tuple[Floats, Floats]:
    """(16, 2) half accelerations and (16,) lifetimes of motion states; a resting ball's is infinite."""
    radius, g = TABLE.ball_radius, TABLE.gravity
    v, w = now.velocities, now.spins
    slip = np.stack([v[:, 0] - radius * w[:, 1], v[:, 1] + radius * w[:, 0]], axis=1)
    sliding, rolling = now.motion == physics.Motion.SLIDING, now.motion == physics.Motion.ROLLING
    along = np.where(sliding[:, None], slip, v)
    size = np.sqrt((along * along).sum(axis=1))
    pull = np.where(sliding, TABLE.mu_slide, np.where(rolling, TABLE.mu_roll, 0.0)) * g
    with np.errstate(divide="ignore", invalid="ignore"):
        half = np.where((pull > 0.0)[:, None], -0.5 * pull[:, None] * along / size[:, None], 0.0)
        lasts = np.where(sliding, 2.0 * size / (7.0 * pull), np.where(rolling, size / pull, np.inf))
    return half, lasts
