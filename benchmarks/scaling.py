"""How cost grows: with the balls on the table, with balls never near, with threads, with the size of a batch."""

import os
import statistics
from collections.abc import Iterator

import numpy as np

import physics
from benchmarks import scenes, timing
from benchmarks.command import main
from benchmarks.recording import Row, Tables

TABLE = physics.Table.olympiad()
THREADS = (1, 2, 4, 8, 16)


def measure(full: bool) -> Tables:
    """All tables of this benchmark."""
    shots, repeats = (20_000, 9) if full else (2_000, 3)
    return {
        "balls": list(by_balls(shots, repeats)),
        "far_balls": list(by_far_balls(shots, repeats)),
        "threads": list(by_threads(4 * shots, repeats)),
        "batch_size": list(by_batch_size(shots, repeats)),
    }


def cost(states: scenes.Floats, shots: scenes.Floats, repeats: int) -> Row:
    """Cost of a batch by shot and by event."""
    events = int(physics.simulate_batch(TABLE, states, shots).n_events.sum())
    seconds, pairs = timing.in_pairs(lambda: physics.simulate_batch(TABLE, states, shots), repeats)
    return {
        "events_per_shot": round(events / len(shots), 2),
        "us_per_shot": round(seconds / len(shots) * 1e6, 3),
        "ns_per_event": round(seconds / events * 1e9, 1),
        "pairs_per_event": round(pairs / events, 2),
    }


def by_balls(n: int, repeats: int) -> Iterator[Row]:
    """Mid-game shots with 1 to 16 balls."""
    rng = np.random.default_rng(3)
    for balls in range(1, 17):
        yield {"balls": balls, **cost(*scenes.playable_mid_game(TABLE, rng, n, balls), repeats)}


def by_far_balls(n: int, repeats: int) -> Iterator[Row]:
    """The cue ball's shot is the same whatever lies on the table: the other balls are out of its way."""
    rng = np.random.default_rng(4)
    states, shots = lonely(rng, n)
    for balls in range(1, 17):
        here = states.copy()
        here[:, balls:] = np.nan
        yield {"balls": balls, **cost(np.ascontiguousarray(here), shots, repeats)}


def lonely(rng: np.random.Generator, n: int) -> tuple[scenes.Floats, scenes.Floats]:
    """Cue balls that travel across the north half; fifteen balls in the south, at least 0.3 m away."""
    states = scenes.nobody(n)
    states[:, 0] = rng.uniform([0.2, 1.5], [0.9, 1.9], (n, 2))
    columns, rows = np.meshgrid(np.linspace(0.15, 0.95, 5), np.linspace(0.2, 0.8, 3))
    states[:, 1:] = np.stack([columns.ravel(), rows.ravel()], axis=1)
    sideways = rng.choice([0.0, 180.0], n) + rng.uniform(-8.0, 8.0, n)
    shots = scenes.strokes(rng, n, v=(0.3, 1.2), theta=(12.0, 20.0))
    shots[:, 1] = sideways
    batch = physics.simulate_batch(TABLE, states, shots)
    still = (batch.positions[:, 1:] == states[:, 1:]).all(axis=(1, 2))
    chosen = still & (batch.status == physics.Status.AT_REST)
    return np.ascontiguousarray(states[chosen]), np.ascontiguousarray(shots[chosen])


def by_threads(n: int, repeats: int) -> Iterator[Row]:
    """Time on the wall with more threads, up to twice the cores."""
    states, shots = scenes.playable_mid_game(TABLE, np.random.default_rng(5), n, 16)
    one = 0.0
    for threads in THREADS:
        if threads > 2 * (os.cpu_count() or 1):
            break
        seconds = statistics.median(
            timing.wall_seconds(lambda: physics.simulate_batch(TABLE, states, shots, threads=threads))  # noqa: B023
            for _ in range(repeats)
        )
        one = one or seconds
        yield {
            "threads": threads,
            "shots_per_second": round(n / seconds),
            "speed_up": round(one / seconds, 2),
            "load": round(os.getloadavg()[0], 2),
        }


def by_batch_size(n: int, repeats: int) -> Iterator[Row]:
    """Cost of a shot in batches of 1 to ``n``: always the same shots."""
    states, shots = scenes.playable_mid_game(TABLE, np.random.default_rng(6), n, 16)
    size = 1
    while size <= n:
        seconds, _ = timing.in_pairs(lambda: in_batches(states, shots, size), repeats)  # noqa: B023
        done = n // size * size
        yield {"batch": size, "us_per_shot": round(seconds / done * 1e6, 3)}
        size *= 10


def in_batches(states: scenes.Floats, shots: scenes.Floats, size: int) -> None:
    """Simulate all shots in batches of ``size``."""
    for start in range(0, len(shots) - size + 1, size):
        physics.simulate_batch(TABLE, states[start : start + size], shots[start : start + size])


if __name__ == "__main__":
    main("scaling", measure)
