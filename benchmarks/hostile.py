"""Scenes that break engines, by class: touching racks, clusters, cushions, corners, lines, slow contacts, limits.

Every class is a function of (table, generator, n) that gives states (n, 16, 2) and shots (n, 5). The same seed gives
the same scenes.
"""

from collections.abc import Callable

import numpy as np

import physics
from benchmarks.scenes import (
    N_BALLS,
    Floats,
    anywhere,
    clear,
    inside,
    mid_game,
    nobody,
    racks,
    scatter,
    strokes,
)

Rng = np.random.Generator
Scenes = tuple[Floats, Floats]

V, PHI, THETA, A, B = range(5)
"""Columns of a shot."""

COMPASS = 45.0 * np.arange(8)
LATTICE = 30.0 * np.arange(12)
GAPS = np.array([0.0, 0.0, 0.0, 1e-15, 1e-13, 1e-12, 2e-12, 1e-11, 1e-9, 1e-6, 1e-3, 0.05])
"""m, between neighbours in a line."""


def directions(degrees: Floats) -> Floats:
    """(n, 2) unit vectors, exact at multiples of 90 degrees."""
    turn = np.deg2rad(degrees)
    vectors = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    right = np.mod(degrees, 90.0) == 0.0
    vectors[right] = np.round(vectors[right])
    return vectors


def angles(rng: Rng, n: int) -> Floats:
    """Degrees: a third multiples of 45, a third of 30, a third any."""
    kinds = np.stack([rng.choice(COMPASS, n), rng.choice(LATTICE, n), rng.uniform(0.0, 360.0, n)])
    return kinds[rng.integers(0, 3, n), np.arange(n)]


def towards(states: Floats, ball: Floats) -> Floats:
    """Azimuth from the cue ball to another ball of each state; 0 where it is missing."""
    way = states[np.arange(len(states)), ball] - states[:, 0]
    return np.nan_to_num(np.degrees(np.arctan2(way[:, 1], way[:, 0])))


def aimed(rng: Rng, states: Floats, v: tuple[float, float] = (0.1, 10.0)) -> Floats:
    """Strokes: half at a random ball, full or thin, half along a compass direction or anywhere."""
    n = len(states)
    shots = strokes(rng, n, v=v, theta=(0.0, 30.0))
    at_ball = towards(states, rng.integers(1, N_BALLS, n)) + rng.choice([0.0, 1.0], n) * rng.normal(0.0, 5.0, n)
    shots[:, PHI] = np.where(rng.random(n) < 0.5, at_ball, angles(rng, n))
    plain = rng.random(n) < 0.3
    shots[np.ix_(plain, [THETA, A, B])] = 0.0
    return shots


def attach(table: physics.Table, rng: Rng, states: Floats, ball: int, degrees: Floats, gap: Floats) -> None:
    """Put ``ball`` at a gap from a random ball already there, in the given direction, where it fits."""
    n = len(states)
    there = ~np.isnan(states[:, :, 0])
    parent = np.argmax(np.where(there, rng.random((n, N_BALLS)), -1.0), axis=1)
    reach = 2.0 * table.ball_radius + gap
    places = states[np.arange(n), parent] + directions(degrees) * reach[:, None]
    fits = there.any(axis=1) & inside(table, places) & clear(table, states, places)
    states[fits, ball] = places[fits]


def numbered_anew(rng: Rng, states: Floats) -> Floats:
    """The same balls with shuffled numbers; the cue ball stays where there is one."""
    shuffled = rng.permuted(np.tile(np.arange(N_BALLS), (len(states), 1)), axis=1)
    moved = np.take_along_axis(states, shuffled[:, :, None], axis=1)
    rows = np.arange(len(states))
    first = np.argmax(~np.isnan(moved[:, :, 0]), axis=1)
    cue, other = moved[rows, 0].copy(), moved[rows, first].copy()
    moved[rows, first], moved[rows, 0] = cue, other
    return moved


def touching_break(table: physics.Table, rng: Rng, n: int) -> Scenes:
    """Exactly touching racks at full speed; half dead straight from the middle."""
    states = racks(table, n, gap=0.0).copy()
    shots = rng.uniform([8.0, 0.0, 2.0, -12.0, -12.0], [10.0, 0.0, 12.0, 12.0, 12.0], (n, 5))
    straight = rng.random(n) < 0.5
    kitchen = rng.uniform([0.05, 1.68], [table.width - 0.05, 2.15], (n, 2))
    states[~straight, 0] = kitchen[~straight]
    apex = np.array(table.foot_spot) - states[:, 0]
    shots[:, PHI] = np.degrees(np.arctan2(apex[:, 1], apex[:, 0])) + rng.normal(0.0, 1.0, n)
    shots[straight, PHI] = 270.0
    shots[straight & (rng.random(n) < 0.5), A] = 0.0
    shots[rng.random(n) < 0.5, V] = 10.0
    return states, shots


def cluster(table: physics.Table, rng: Rng, n: int) -> Scenes:
    """Trees of up to 16 touching balls; the cue ball in them or apart."""
    states = nobody(n)
    scatter(table, rng, states, 1)
    for ball in range(2, N_BALLS):
        attach(table, rng, states, ball, angles(rng, n), np.zeros(n))
    apart = rng.random(n) < 0.5
    alone = states[apart]
    scatter(table, rng, alone, 0)
    states[apart] = alone
    states = numbered_anew(rng, states)
    return states, aimed(rng, states)


def hair(table: physics.Table, rng: Rng, n: int) -> Scenes:
    """Clusters whose neighbours are 1e-5 to 1e-16 m apart."""
    states = nobody(n)
    scatter(table, rng, states, 0)
    for ball in range(1, N_BALLS):
        attach(table, rng, states, ball, angles(rng, n), 10.0 ** rng.uniform(-16.0, -5.0, n))
    states = numbered_anew(rng, states)
    return states, aimed(rng, states)


def lattice(table: physics.Table, rng: Rng, n: int) -> Scenes:
    """Patches of the touching rack, turned and moved anywhere: many contacts close rings."""
    rack = racks(table, 1, gap=0.0)[0]
    middle = np.nanmean(rack[1:], axis=0)
    turn = directions(angles(rng, n))
    out = rack[None, 1:] - middle
    x = turn[:, None, 0] * out[..., 0] - turn[:, None, 1] * out[..., 1]
    y = turn[:, None, 1] * out[..., 0] + turn[:, None, 0] * out[..., 1]
    states = nobody(n)
    states[:, 1:] = anywhere(table, rng, n)[:, None] + np.stack([x, y], axis=2)
    states[~inside(table, states) | (rng.random((n, N_BALLS)) < 0.25)] = np.nan
    scatter(table, rng, states, 0)
    among = rng.random(n) < 0.3
    states[among, 0] = np.nan
    states = numbered_anew(rng, states)
    return states, aimed(rng, states)


def on_cushion(table: physics.Table, rng: Rng, n: int) -> Floats:
    """(n, 2) centres exactly on a cushion line, a third of them where it ends at a mouth."""
    radius, reach = table.ball_radius, table.corner_reach
    near_corner = reach + rng.choice([1e-8, 1e-6, 1e-3], n)
    near_side = 0.5 * table.length - 0.5 * table.side_mouth - rng.choice([0.0, 1e-12, 1e-6, 1e-3], n)
    x = np.stack([near_corner, near_corner, rng.uniform(reach, 0.5 * table.width, n)])
    y = np.stack([near_corner, near_side, rng.uniform(reach, near_side, n)])
    which, rows = rng.integers(0, 3, n), np.arange(n)
    long = rng.random(n) < 0.5
    places = np.where(
        long[:, None],
        np.stack([np.full(n, radius), y[which, rows]], axis=1),
        np.stack([x[which, rows], np.full(n, radius)], axis=1),
    )
    size = np.array([table.width, table.length])
    return np.where(rng.random((n, 2)) < 0.5, places, size - places)


def frozen(table: physics.Table, rng: Rng, n: int) -> Scenes:
    """Balls frozen to cushions and in corners, with balls frozen to them; the cue ball among them or apart."""
    states = nobody(n)
    for ball in range(1, N_BALLS):
        places = on_cushion(table, rng, n)
        fits = inside(table, places) & clear(table, states, places) & (rng.random(n) < 0.5)
        states[fits, ball] = places[fits]
        free = np.isnan(states[:, ball, 0]) & (rng.random(n) < 0.7)
        some = states[free]
        attach(table, rng, some, ball, rng.choice(COMPASS, len(some)), np.zeros(len(some)))
        states[free] = some
    apart = rng.random(n) < 0.5
    alone = states[apart]
    scatter(table, rng, alone, 0)
    states[apart] = alone
    states = numbered_anew(rng, states)
    return states, aimed(rng, states)


def straight_line(table: physics.Table, rng: Rng, n: int) -> Scenes:
    """Rows of balls along a multiple of 45 degrees, touching or apart, struck along it; half from dyadic places."""
    states = nobody(n)
    start = anywhere(table, rng, n)
    start = np.where(rng.random(n)[:, None] < 0.5, np.round(start * 64.0) / 64.0, start)
    heading = rng.choice(COMPASS, n)
    ahead = np.zeros(n)
    for ball in range(rng.integers(2, 9)):
        places = start + directions(heading) * ahead[:, None]
        fits = inside(table, places) & clear(table, states, places)
        states[fits, ball] = places[fits]
        ahead = ahead + 2.0 * table.ball_radius + rng.choice(GAPS, n)
    missing = np.isnan(states[:, 0, 0])
    some = states[missing]
    scatter(table, rng, some, 0)
    states[missing] = some
    states = numbered_anew(rng, states)
    shots = aimed(rng, states, v=(0.01, 10.0))
    along = rng.random(n) < 0.8
    shots[along, PHI] = (heading + rng.choice([0.0, 0.0, 180.0, 45.0], n))[along]
    return states, shots


def creeping(table: physics.Table, rng: Rng, n: int) -> Scenes:
    """Any of the touching scenes, struck at 1e-15 to 1e-2 m/s."""
    states, shots = one_of(table, rng, n, (cluster, frozen, straight_line, hair, lattice))
    shots[:, V] = 10.0 ** rng.uniform(-15.0, -2.0, n)
    shots[rng.random(n) < 0.02, V] = 5e-324
    shots[rng.random(n) < 0.02, V] = 0.0
    return states, shots


def spinning(table: physics.Table, rng: Rng, n: int) -> Scenes:
    """Full hits with the most side and height: balls that stop and spin, masse strokes that turn back."""
    states = mid_game(table, rng, n, 1)
    attach(table, rng, states, 1, angles(rng, n), rng.choice(GAPS, n))
    for ball in range(2, 5):
        attach(table, rng, states, ball, angles(rng, n), rng.choice(GAPS, n))
    shots = strokes(rng, n, v=(0.01, 10.0))
    shots[:, PHI] = towards(states, np.ones(n, dtype=np.int64))
    shots[:, THETA] = rng.choice([0.0, 5.0, 45.0, 70.0], n)
    rim = 1e3 * table.ball_radius * rng.choice([0.5, 0.99, 1.0 - 1e-12], n)
    side = np.deg2rad(angles(rng, n))
    shots[:, A], shots[:, B] = rim * np.cos(side), rim * np.sin(side)
    return states, shots


def limits(table: physics.Table, rng: Rng, n: int) -> Scenes:
    """Any scene, every parameter of the shot at one of the ends of its range."""
    states, shots = one_of(table, rng, n, (touching_break, cluster, frozen, straight_line, ordinary))
    rim = 1e3 * table.ball_radius
    turn = np.deg2rad(angles(rng, n))
    size = rng.choice([0.0, 1e-300, 1e-9, rim * (1.0 - 1e-15)], n)
    shots[:, V] = rng.choice([0.0, 5e-324, 1e-12, 1e-6, table.v_max], n, p=[0.05, 0.05, 0.1, 0.1, 0.7])
    shots[:, THETA] = rng.choice([0.0, 1e-300, table.theta_max], n)
    shots[:, A], shots[:, B] = size * np.cos(turn), size * np.sin(turn)
    far = rng.choice([0.0, 360.0, -360.0, 3.6e17], n)
    shots[:, PHI] = np.where(rng.random(n) < 0.5, rng.choice(COMPASS, n), shots[:, PHI]) + far
    return states, shots


def ordinary(table: physics.Table, rng: Rng, n: int) -> Scenes:
    """Mid-game scenes of 16 balls, full strokes."""
    states = mid_game(table, rng, n, N_BALLS)
    return states, aimed(rng, states)


def one_of(
    table: physics.Table, rng: Rng, n: int, kinds: tuple[Callable[[physics.Table, Rng, int], Scenes], ...]
) -> Scenes:
    """Each scene from one of several classes."""
    made = [kind(table, rng, n) for kind in kinds]
    chosen, rows = rng.integers(0, len(kinds), n), np.arange(n)
    return np.stack([m[0] for m in made])[chosen, rows], np.stack([m[1] for m in made])[chosen, rows]


CLASSES: dict[str, Callable[[physics.Table, Rng, int], Scenes]] = {
    "touching break": touching_break,
    "frozen cluster": cluster,
    "touching lattice": lattice,
    "gaps of a hair": hair,
    "cushions and corners": frozen,
    "straight lines": straight_line,
    "creeping contacts": creeping,
    "spinning in place": spinning,
    "limits of a shot": limits,
    "limits of the table": limits,
    "ordinary": ordinary,
}

EDGES = {
    "mu_slide": (0.01, 1.0),
    "mu_roll": (0.001, 0.01, 1.0),
    "mu_spin": (0.001, 1.0),
    "mu_ball": (0.0, 1.0),
    "e_ball": (0.8, 1.0),
    "cushion_parallel": (0.0, 1.0),
    "cushion_perpendicular": (0.0, 1.0),
    "cushion_spin": (0.0, 1.0),
}
"""Ends of the table's ranges; mu_roll is at most mu_slide."""


def table_for(kind: str, rng: Rng) -> physics.Table:
    """The table a class is played on: without the test of the cue, so that every stroke is played."""
    table = physics.Table.olympiad().replace(cue_test=False)
    if kind != "limits of the table":
        return table
    values = {name: float(rng.choice(ends)) for name, ends in EDGES.items()}
    values["mu_roll"] = min(values["mu_roll"], values["mu_slide"])
    return table.replace(**values, cue_test=bool(rng.random() < 0.2))
