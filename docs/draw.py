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


TURN = {
    0: (0.62, 1.45), 1: (0.25, 0.55), 2: (1.05, 0.45), 6: (0.9, 1.5), 8: (0.75, 0.9), 9: (0.5, 1.0), 12: (0.95, 2.1),
    14: (0.3, 2.0),
}  # fmt: skip
"""The position of how_search_thinks.md; solids shoot."""
FENCE = {
    9 + number: (0.35 * float(np.cos(np.radians(angle))), 0.35 * float(np.sin(np.radians(angle))))
    for number, angle in enumerate((9.0, 27.0, 45.0, 63.0, 81.0))
} | {0: (0.2983, 0.426), 1: (0.07, 0.07), 8: (0.9, 2.2)}
"""Another: nothing on the cloth reaches ball 1."""


def chosen(balls: dict[int, tuple[float, float]], shot: physics.Shot, call: tuple[int, int], noise: float) -> str:
    """A stroke that `search` chose on a nine-foot table, and where noise of a level leaves the balls."""
    table, state = physics.Table.nine_foot(), physics.TableState.from_positions(balls)
    draws = np.random.default_rng(1).normal(size=(150, 5)) * (0.075, 0.125, 0.1, 0.5, 0.5)
    rows = np.array([shot.v, shot.phi, shot.theta, shot.a, shot.b]) + noise * draws
    batch = physics.simulate_batch(table, state, np.clip(rows, (0, -1e9, 0, -99, -99), (12, 1e9, 85, 99, 99)))
    return pictures.svg(physics.simulate(table, state, shot), shot=shot, call=call, variants=batch)


def a_turn() -> str:
    """The choice of `pooliad agent explain` in the position of the page."""
    return chosen(TURN, physics.Shot(1.90, 20.28, 0.9, -10.7, 6.2), (6, 4), noise=2.0)


def over_a_fence() -> str:
    """The jump that it finds where nothing else reaches the ball."""
    return chosen(FENCE, physics.Shot(3.78, 236.56, 30.0, 0.0, -3.0), (1, 0), noise=1.0)


Scene = tuple[dict[int, tuple[float, float]], physics.Shot]
FLIGHTS: dict[str, Scene] = {
    "masse": ({0: (0.5, 0.9), 1: (0.5, 1.25)}, physics.Shot(4.0, 80.0, 55.0, -14.0, 6.0)),
    "jump_15_cm": ({0: (0.635, 0.6), 1: (0.635, 0.75), 2: (0.635, 1.7)}, physics.Shot(2.5, 90.0, 50.0, 0.0, 15.0)),
    "jump_30_cm": ({0: (0.635, 0.6), 1: (0.635, 0.9), 2: (0.635, 1.7)}, physics.Shot(3.0, 90.0, 45.0, 0.0, 15.0)),
    "jump_into_a_rack": ({0: (0.635, 1.1)}, physics.Shot(3.0, 270.0, 30.0, 0.0, 8.0)),
    "hop_into_a_rail": ({0: (0.7, 1.2)}, physics.Shot(3.0, 0.0, 30.0, 0.0, 6.0)),
}
"""The named scenes of physics.md, "Flight": balls, and the stroke; a whole rack stands in one of them."""

SIDE_SCALE, SIDE_STRIP = 1000.0, 260.0
"""Of the side views: picture units a metre, and the height of each."""


def flight(name: str) -> physics.Result:
    """A named scene played on a nine-foot table."""
    table = physics.Table.nine_foot()
    positions, shot = FLIGHTS[name]
    if name == "jump_into_a_rack":
        rack = physics.rack(table, "eight_ball", seed=3)
        positions = {ball: (float(x), float(y)) for ball, (x, y) in enumerate(rack.positions)} | positions
    return physics.simulate(table, physics.TableState.from_positions(positions), shot)


def seen_from_above(name: str) -> Callable[[], str]:
    """Draws a named scene."""
    return lambda: pictures.svg(flight(name), shot=FLIGHTS[name][1])


def heights() -> str:
    """The cue ball of every named scene from the side, to scale: its height over the way it has gone in plan."""
    strips = []
    for place, name in enumerate(FLIGHTS):
        base = (place + 1) * SIDE_STRIP - 30.0
        strips.append(f'<path d="M0 {base:.0f}H1200" stroke="#2c6e49" stroke-width="4"/>')
        strips.append(f'<text x="8" y="{base - SIDE_STRIP + 60:.0f}" font-size="26">{name.replace("_", " ")}</text>')
        strips.extend(_ball_from_the_side(x, height, base, look) for x, height, look in _side_view(name))
    view = f'viewBox="0 0 1200 {SIDE_STRIP * len(FLIGHTS):.0f}"'
    background = '<rect width="100%" height="100%" fill="#fff"/>'
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" {view} font-family="sans-serif">{background}{"".join(strips)}</svg>'
    )


def _side_view(name: str) -> list[tuple[float, float, str]]:
    """Balls from the side: way in plan, height (m) and look; the cue ball at moments, and the ball that it jumps."""
    result = flight(name)
    times = np.arange(0.0, min(0.6, result.duration), 0.02)
    positions, high = result.paths(times)
    there = positions[:, 0][~np.isnan(positions[:, 0, 0])]
    steps = np.linalg.norm(np.diff(there, axis=0), axis=1)
    ways = np.concatenate([[0.0], np.cumsum(steps)])
    looks = [
        (0.07 + float(way), float(z), 'fill="none" stroke="#555"') for way, z in zip(ways, high[:, 0], strict=False)
    ]
    positions_at_first = FLIGHTS[name][0]
    if name.startswith("jump") and 1 in positions_at_first:
        looks.append((0.07 + positions_at_first[1][1] - positions_at_first[0][1], 0.0, 'fill="#e8b21e"'))
    return [look for look in looks if look[0] < 1.15]


def _ball_from_the_side(way: float, height: float, base: float, look: str) -> str:
    radius = physics.Table.nine_foot().ball_radius
    middle = base - SIDE_SCALE * (height + radius)
    return (
        f'<circle cx="{SIDE_SCALE * way:.1f}" cy="{middle:.1f}" r="{SIDE_SCALE * radius:.1f}" stroke-width="2" {look}/>'
    )


PICTURES: dict[str, Callable[[], str]] = {
    "shot.svg": shot_on_a_real_table,
    "rack.svg": rack_on_the_olympiads_table,
    "heights.svg": heights,
    "turn.svg": a_turn,
    "over_a_fence.svg": over_a_fence,
    **{f"{name}.svg": seen_from_above(name) for name in FLIGHTS},
}
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
