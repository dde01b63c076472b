"""The pictures of these documents: `python docs/draw.py` writes them anew; a test compares."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

import physics
import pictures

FOLDER = Path(__file__).parent / "pictures"


def shot_on_a_real_table() -> str:
    """A pot with draw and a bank of the cue ball on a nine-foot table, and where noise leaves the balls."""
    table = physics.Table.nine_foot()
    state = physics.TableState.from_positions({0: (0.45, 1.62), 3: (0.82, 0.92), 11: (0.3, 0.66), 8: (1.02, 1.9)})
    x, y = table.mouths[5].tolist()
    shot = _towards(table, state, 3, (x, y), v=2.6, b=-6.0)
    noise = np.random.default_rng(1).normal(size=(200, 5)) * (0.075, 0.125, 0.1, 0.5, 0.5)
    rows = np.array([shot.v, shot.phi, shot.theta, shot.a, shot.b]) + noise
    batch = physics.simulate_batch(table, state, np.clip(rows, (0, -1e9, 0, -99, -99), (12, 1e9, 85, 99, 99)))
    return pictures.svg(physics.simulate(table, state, shot), shot=shot, call=(3, 5), variants=batch)


def rack_on_the_olympiads_table() -> str:
    """A rack before its break, for paper."""
    table = physics.Table.olympiad()
    return pictures.svg(physics.rack(table, seed=7), table=table, shot=physics.Shot(9.0, 270.0, 5.0), theme="light")


PICTURES: dict[str, Callable[[], str]] = {"shot.svg": shot_on_a_real_table, "rack.svg": rack_on_the_olympiads_table}
"""Every picture, by its file's name."""


def _towards(
    table: physics.Table, state: physics.TableState, ball: int, goal: tuple[float, float], **changes: float
) -> physics.Shot:
    """The shot that sends `ball` towards `goal` if nothing throws it, as flat as the cue may lie."""
    from client import geometry

    place = state.position(ball)
    assert place is not None
    way = np.array(goal) - place
    ghost = np.array(place) - 2.0 * table.ball_radius * way / np.linalg.norm(way)
    phi = geometry.azimuth(state.position(0), (float(ghost[0]), float(ghost[1])))
    theta = physics.min_elevation(table, state, phi, b=changes.get("b", 0.0))
    return physics.Shot(phi=phi, theta=theta, **changes)


if __name__ == "__main__":
    FOLDER.mkdir(exist_ok=True)
    for name, draw in PICTURES.items():
        (FOLDER / name).write_text(draw(), encoding="utf-8")
