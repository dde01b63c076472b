"""Random scenes and strokes as arrays: states (n, 16, 2) in metres, NaN where a ball is missing; shots (n, 5)."""

import numpy as np
from numpy.typing import NDArray

import physics

Floats = NDArray[np.float64]
Booleans = NDArray[np.bool_]

N_BALLS = 16
NEARLY_MOUTH = 1e-9
"""m. Random balls keep this far from the mouth lines, where rounding decides whether they may lie."""


def inside(table: physics.Table, places: Floats) -> Booleans:
    """Whether centres (..., 2) lie within the cushion lines and, by a hair, outside the mouths."""
    radius = table.ball_radius
    side = np.abs(places[..., 0] - 0.5 * table.width)
    end = np.abs(places[..., 1] - 0.5 * table.length)
    line_x, line_y = 0.5 * table.width - radius, 0.5 * table.length - radius
    corner = line_x + line_y + radius - table.corner_reach - NEARLY_MOUTH
    in_side_mouth = (side >= line_x - NEARLY_MOUTH) & (end < 0.5 * table.side_mouth)
    return (side <= line_x) & (end <= line_y) & (side + end < corner) & ~in_side_mouth


def clear(table: physics.Table, states: Floats, places: Floats) -> Booleans:
    """Whether centres (n, 2) overlap none of the balls already in states (n, 16, 2) by more than rounding."""
    least = 2.0 * table.ball_radius - 1e-15
    gap = states - places[:, None]
    with np.errstate(invalid="ignore"):
        return ~((gap * gap).sum(axis=2) < least * least).any(axis=1)


def anywhere(table: physics.Table, rng: np.random.Generator, n: int) -> Floats:
    """(n, 2) points within the cushion lines."""
    radius = table.ball_radius
    low, high = [radius, radius], [table.width - radius, table.length - radius]
    return rng.uniform(low, high, (n, 2))


def nobody(n: int) -> Floats:
    """States without balls."""
    return np.full((n, N_BALLS, 2), np.nan)


def scatter(table: physics.Table, rng: np.random.Generator, states: Floats, ball: int) -> None:
    """Put ``ball`` somewhere free in every state."""
    waiting = np.arange(len(states))
    while len(waiting):
        places = anywhere(table, rng, len(waiting))
        fits = inside(table, places) & clear(table, states[waiting], places)
        states[waiting[fits], ball] = places[fits]
        waiting = waiting[~fits]


def mid_game(table: physics.Table, rng: np.random.Generator, n: int, balls: int) -> Floats:
    """Balls 0 to ``balls`` - 1 anywhere on the table."""
    states = nobody(n)
    for ball in range(balls):
        scatter(table, rng, states, ball)
    return states


def strokes(
    rng: np.random.Generator, n: int, v: tuple[float, float] = (0.5, 6.0), theta: tuple[float, float] = (0.0, 20.0)
) -> Floats:
    """Strokes in any direction with tip offsets up to 10 mm."""
    low, high = [v[0], 0.0, theta[0], -10.0, -10.0], [v[1], 360.0, theta[1], 10.0, 10.0]
    return rng.uniform(low, high, (n, 5))


def racks(table: physics.Table, n: int, gap: float | None = None) -> Floats:
    """(n, 16, 2): at most 64 different racks, in turn."""
    few = np.array([physics.rack(table, "eight_ball", seed=seed, gap=gap).positions for seed in range(min(n, 64))])
    return few[np.arange(n) % len(few)]


def breaks(table: physics.Table, rng: np.random.Generator, n: int) -> tuple[Floats, Floats]:
    """Racks and break shots, every shot different."""
    return racks(table, n), rng.uniform([6, 265, 3, -5, -5], [10, 275, 10, 5, 5], (n, 5))


def played(table: physics.Table, states: Floats, shots: Floats) -> tuple[Floats, Floats]:
    """The shots that can be played, that is without those whose cue is blocked."""
    rows = physics.simulate_batch(table, states, shots).status == physics.Status.AT_REST
    return np.ascontiguousarray(states[rows]), np.ascontiguousarray(shots[rows])


def playable_mid_game(table: physics.Table, rng: np.random.Generator, n: int, balls: int) -> tuple[Floats, Floats]:
    """``n`` mid-game scenes and strokes, all of them playable."""
    drawn = int(n * 1.1) + 20
    while True:
        states, shots = played(table, mid_game(table, rng, drawn, balls), strokes(rng, drawn, theta=(5.0, 20.0)))
        if len(shots) >= n:
            return states[:n], shots[:n]
        drawn *= 2
