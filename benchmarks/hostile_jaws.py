"""Scenes that break engines on tables with jaws, by class: rattles, hung balls, drop edges, horns and facings, noses.

Like ``hostile``: functions of (table, generator, n) that give states (n, 16, 2) and shots (n, 5), the same for a seed.
"""

from collections.abc import Callable

import numpy as np

import physics
from benchmarks import hostile
from benchmarks.hostile import PHI, THETA, A, B, Rng, Scenes, V, aimed, angles, directions, numbered_anew
from benchmarks.scenes import N_BALLS, Booleans, Floats, clear, mid_game, nobody, scatter

CORNERS = np.array([0, 2, 3, 5])
SIGNS = np.array([(-1, -1), (-1, 0), (-1, 1), (1, 1), (1, 0), (1, -1)])

HAIRS = np.array([0.0, 0.0, 1e-16, -1e-16, 1e-13, -1e-13, 1e-12, -9e-13, 1e-11, 1e-9, 1e-6])
"""m, off the place at which a ball touches a piece; what lies too deep for a start is left out."""

BEFORE_DROP = np.array([1e-16, 1e-15, 1e-13, 1e-12, 1e-9, 1e-6])
"""m, outside the drop edge."""


def fits(table: physics.Table, states: Floats, places: Floats) -> Booleans:
    """Whether a ball may start at each place (n, 2), clear of those already in states (n, 16, 2)."""
    return np.asarray(table.contains(places[:, 0], places[:, 1])) & clear(table, states, places)


def put(table: physics.Table, states: Floats, ball: int, places: Floats, rows: Booleans | bool = True) -> None:
    """Put a ball where it may lie."""
    able = fits(table, states, places) & rows
    states[able, ball] = places[able]


def from_jaw(table: physics.RealTable, pocket: Floats, other: Floats, s: Floats, d: Floats) -> Floats:
    """(n, 2): places (s, d) in the coordinates of one jaw of a pocket, or of its other one."""
    corner = np.isin(pocket, CORNERS)
    u = np.where(corner & other, d, np.where(corner, s, d))
    v = np.where(corner & other, s, np.where(corner, d, np.where(other, -s, s)))
    sign_x, sign_y = SIGNS[pocket].T
    x = np.where(sign_x < 0, u, table.width - u)
    y = np.select([sign_y < 0, sign_y > 0], [v, table.length - v], 0.5 * table.length + v)
    return np.stack([x, y], axis=1)


def at_pieces(table: physics.RealTable, rng: Rng, pocket: Floats) -> Floats:
    """(n, 2) centres at a facing, a horn, a drop edge, a nose's end, or anywhere in a mouth, a hair off."""
    n, rho = len(pocket), table.contact_distance
    s, d = np.empty(n), np.empty(n)
    kind, off, turn = rng.integers(0, 5, n), rng.choice(HAIRS, n), rng.uniform(0.0, 2.0 * np.pi, n)
    before, share, place = rng.choice(BEFORE_DROP, n), rng.uniform(0.0, 1.0, n), rng.uniform(-0.03, 0.12, (2, n))
    at_end = rng.choice([0.0, 0.0, 1e-15, -1e-15, 1e-9, 1e-6, 1e-3], n)
    for row in range(n):
        mouth = table.corner_shape if pocket[row] in CORNERS else table.side_shape
        s[row], d[row] = _at_piece(
            mouth, rho, kind[row], off[row], turn[row], before[row], share[row], place[:, row], at_end[row]
        )
    return from_jaw(table, pocket, rng.random(n) < 0.5, s, d)


def _at_piece(
    mouth: physics.mouths.Mouth,
    rho: float,
    kind: int,
    off: float,
    turn: float,
    before: float,
    share: float,
    place: Floats,
    at_end: float,
) -> tuple[float, float]:
    """One centre in jaw coordinates."""
    if kind == 0:  # facing
        (start_s, start_d), (normal_s, normal_d), foot = mouth.facing_start, mouth.facing_normal, share
        foot *= mouth.facing_length
        return start_s - foot * normal_d + (rho + off) * normal_s, start_d + foot * normal_s + (rho + off) * normal_d
    if kind == 1:  # horn
        reach = mouth.horn_radius + rho + off
        return mouth.nose_end + reach * np.cos(turn), reach * np.sin(turn) - mouth.horn_radius
    if kind == 2:  # drop edge
        reach = mouth.hole_radius + before
        return mouth.hole_centre[1] + reach * np.sin(turn), mouth.hole_centre[0] + reach * np.cos(turn)
    if kind == 3:
        return float(place[0]), float(place[1])
    return mouth.nose_end + at_end, rho + max(off, 0.0)


def into_mouths(table: physics.RealTable, rng: Rng, states: Floats, pocket: Floats, spread: Floats) -> Floats:
    """Azimuths from the cue balls at mouths: at points ``spread`` (m, one sigma) round their middles."""
    target = table.mouths[pocket] + rng.normal(0.0, 1.0, (len(states), 2)) * spread[:, None]
    way = target - states[:, 0]
    return np.nan_to_num(np.degrees(np.arctan2(way[:, 1], way[:, 0])))


def strokes_at_mouths(
    table: physics.RealTable, rng: Rng, states: Floats, pocket: Floats, v: tuple[float, float] = (0.05, 12.0)
) -> Floats:
    """Strokes at mouths, some at a ball, some anywhere; speeds log-uniform, english and elevation in all sizes."""
    n = len(states)
    shots = aimed(rng, states)
    shots[:, V] = np.exp(rng.uniform(*np.log(v), n))
    at_mouth = rng.random(n) < 0.7
    shots[at_mouth, PHI] = into_mouths(table, rng, states, pocket, rng.choice([0.0, 0.02, 0.06], n))[at_mouth]
    english = rng.random(n) < 0.5
    shots[np.ix_(english, [A, B])] = rng.uniform(-19.0, 19.0, (int(english.sum()), 2))
    shots[:, THETA] = rng.choice([0.0, 0.0, 5.0, 30.0, 85.0], n) * rng.choice([1.0, rng.random()], n)
    return shots


def filled(table: physics.Table, rng: Rng, states: Floats) -> Floats:
    """The states with a cue ball in every one, balls numbered anew."""
    missing = np.isnan(states[:, 0, 0])
    some = states[missing]
    scatter(table, rng, some, 0)
    states[missing] = some
    return numbered_anew(rng, states)


def rattles(table: physics.RealTable, rng: Rng, n: int) -> Scenes:
    """Fast balls into the jaws, from near and far, alone or with balls hanging there."""
    pocket, states = rng.integers(0, 6, n), nobody(n)
    away = table.mouths[pocket] + directions(angles(rng, n)) * rng.uniform(0.03, 0.7, n)[:, None]
    put(table, states, 0, away)
    for ball in range(1, 4):
        put(table, states, ball, at_pieces(table, rng, pocket), rng.random(n) < 0.4)
    states = filled(table, rng, states)
    return states, strokes_at_mouths(table, rng, states, pocket, v=(0.5, 12.0))


def hung(table: physics.RealTable, rng: Rng, n: int) -> Scenes:
    """Balls hung in one mouth with neighbours touching them; the cue ball one of them or apart."""
    pocket, states = rng.integers(0, 6, n), nobody(n)
    for ball in range(4):
        put(table, states, ball, at_pieces(table, rng, pocket), rng.random(n) < (0.5 if ball == 0 else 0.9))
    for ball in range(4, 9):
        neighbour(table, rng, states, ball, hostile.GAPS)
    states = filled(table, rng, states)
    return states, strokes_at_mouths(table, rng, states, pocket)


def neighbour(table: physics.RealTable, rng: Rng, states: Floats, ball: int, gaps: Floats) -> None:
    """Put ``ball`` at a gap from a random ball already there, where it may lie."""
    n = len(states)
    there = ~np.isnan(states[:, :, 0])
    parent = np.argmax(np.where(there, rng.random((n, N_BALLS)), -1.0), axis=1)
    reach = 2.0 * table.ball_radius + rng.choice(gaps, n)
    put(table, states, ball, states[np.arange(n), parent] + directions(angles(rng, n)) * reach[:, None])


def drop_edges(table: physics.RealTable, rng: Rng, n: int) -> Scenes:
    """Balls a hair before a drop edge, and balls that roll to a stop 1e-12 m before or behind it."""
    pocket, states = rng.integers(0, 6, n), nobody(n)
    corner = np.isin(pocket, CORNERS)
    holes = np.array([pocket.hole_centre for pocket in table.pockets])[pocket]
    radius = np.where(corner, table.corner_hole_radius, table.side_hole_radius)
    inward = table.mouths[pocket] - holes
    inward /= np.linalg.norm(inward, axis=1)[:, None]
    lean = rng.choice([0.0, 0.3, 1.0], n) * rng.normal(0.0, 0.3, n)
    way = np.stack(
        [
            inward[:, 0] * np.cos(lean) - inward[:, 1] * np.sin(lean),
            inward[:, 0] * np.sin(lean) + inward[:, 1] * np.cos(lean),
        ],
        axis=1,
    )
    far = rng.uniform(0.06, 0.4, n)
    put(table, states, 0, holes + way * (radius + far)[:, None])
    hanging = rng.random(n) < 0.5
    for ball in range(1, 4):
        turn = np.arctan2(inward[:, 1], inward[:, 0]) + rng.normal(0.0, 0.6, n)
        beyond = radius + rng.choice(BEFORE_DROP, n)
        put(table, states, ball, holes + np.stack([np.cos(turn), np.sin(turn)], axis=1) * beyond[:, None], hanging)
    placed = ~np.isnan(states[:, 0, 0])
    states = filled(table, rng, states)
    shots = strokes_at_mouths(table, rng, states, pocket, v=(0.01, 3.0))
    stops = placed & (rng.random(n) < 0.7)
    short = rng.choice([0.0, 1e-12, -1e-12, 1e-13, -1e-13, 1e-9, -1e-9, 1e-6], n)
    shots[stops] = 0.0
    shots[stops, PHI] = np.degrees(np.arctan2(-way[stops, 1], -way[stops, 0]))
    shots[stops, V] = speed_to_roll(table, far[stops] - short[stops])
    return states, shots


def speed_to_roll(table: physics.RealTable, distance: Floats) -> Floats:
    """m/s of a level, central stroke after which the cue ball stops at that distance (docs/physics.md, eq. 1, 5-8)."""
    slide, roll = table.mu_slide * table.gravity, table.mu_roll * table.gravity
    # It slides over 12 v^2 / (49 mu_s g), and rolls on from 5/7 of its speed.
    speed = np.sqrt(distance / (12.0 / (49.0 * slide) + 25.0 / (98.0 * roll)))
    return speed * (1.0 + table.ball_mass / table.cue_mass) / (1.0 + table.e_tip)


def frozen(table: physics.RealTable, rng: Rng, n: int) -> Scenes:
    """Balls frozen to horns and facings of all mouths, struck along them, across them and at one another."""
    states = nobody(n)
    for ball in range(rng.integers(2, 12)):
        put(table, states, ball, at_pieces(table, rng, rng.integers(0, 6, n)), rng.random(n) < 0.8)
    for ball in range(12, 15):
        neighbour(table, rng, states, ball, np.zeros(1))
    states = filled(table, rng, states)
    shots = strokes_at_mouths(table, rng, states, rng.integers(0, 6, n), v=(1e-3, 12.0))
    return states, shots


def along_noses(table: physics.RealTable, rng: Rng, n: int) -> Scenes:
    """Balls on the cushions' contact lines, rolled along them past side mouths and into corners."""
    states, rho = nobody(n), table.contact_distance
    size, long = np.array([table.width, table.length]), rng.random(n) < 0.7
    for ball in range(5):
        off = rho + rng.choice([0.0, 0.0, 1e-16, 1e-13, 1e-12, 1e-9], n)
        along = rng.uniform(0.03, 0.97, n)
        places = np.where(
            long[:, None],
            np.stack([off, along * table.length], axis=1),
            np.stack([along * table.width, off], axis=1),
        )
        far = rng.random(n) < (0.0 if ball == 0 else 0.3)
        put(table, states, ball, np.where(far[:, None], size - places, places), rng.random(n) < 0.7)
    states = filled(table, rng, states)
    shots = strokes_at_mouths(table, rng, states, rng.integers(0, 6, n))
    straight = rng.random(n) < 0.7
    shots[straight, PHI] = np.where(long, rng.choice([90.0, 270.0], n), rng.choice([0.0, 180.0], n))[straight]
    shots[straight & (rng.random(n) < 0.5), A] = 0.0
    return states, shots


Kind = Callable[[physics.RealTable, Rng, int], Scenes]


def in_turn(table: physics.RealTable, rng: Rng, n: int, kinds: tuple[Kind, ...]) -> Scenes:
    """As many scenes of each of several classes."""
    made = [kind(table, rng, len(range(first, n, len(kinds)))) for first, kind in enumerate(kinds[:n])]
    return np.concatenate([states for states, _ in made]), np.concatenate([shots for _, shots in made])


def creeping(table: physics.RealTable, rng: Rng, n: int) -> Scenes:
    """Any of the scenes at mouths, struck at 1e-15 to 1e-2 m/s."""
    states, shots = in_turn(table, rng, n, (rattles, hung, drop_edges, frozen, along_noses))
    shots[:, V] = 10.0 ** rng.uniform(-15.0, -2.0, n)
    shots[rng.random(n) < 0.02, V] = rng.choice([0.0, 5e-324])
    return states, shots


def touching(table: physics.RealTable, rng: Rng, n: int) -> Scenes:
    """The touching classes of the table with straight mouths, and breaks at 12 m/s."""
    kinds = (hostile.touching_break, hostile.cluster, hostile.lattice, hostile.hair, hostile.straight_line)
    states, shots = in_turn(table, rng, n, kinds)
    shots[rng.random(n) < 0.3, V] = table.v_max
    return states, shots


def limits(table: physics.RealTable, rng: Rng, n: int) -> Scenes:
    """Any scene, every parameter of the shot at one of the ends of its range."""
    states, shots = in_turn(table, rng, n, (rattles, hung, drop_edges, frozen, along_noses, touching))
    rim, turn = 1e3 * table.ball_radius, np.deg2rad(angles(rng, n))
    size = rng.choice([0.0, 1e-300, 1e-9, 0.5 * rim, rim * (1.0 - 1e-15)], n)
    shots[:, V] = rng.choice([0.0, 5e-324, 1e-12, 1e-6, table.v_max], n, p=[0.05, 0.05, 0.1, 0.1, 0.7])
    shots[:, THETA] = rng.choice([0.0, 1e-300, table.theta_max], n)
    shots[:, A], shots[:, B] = size * np.cos(turn), size * np.sin(turn)
    far = rng.choice([0.0, 360.0, -360.0, 3.6e17], n)
    shots[:, PHI] = np.where(rng.random(n) < 0.3, rng.choice(hostile.COMPASS, n), shots[:, PHI]) + far
    return states, shots


def ordinary(table: physics.RealTable, rng: Rng, n: int) -> Scenes:
    """Mid-game scenes of 16 balls, full strokes."""
    states = mid_game(table, rng, n, N_BALLS)
    return states, aimed(rng, states, v=(0.1, 12.0))


CLASSES: dict[str, Kind] = {
    "jaws: rattles": rattles,
    "jaws: hung with neighbours": hung,
    "jaws: drop edges": drop_edges,
    "jaws: frozen to horns and facings": frozen,
    "jaws: along the noses": along_noses,
    "jaws: creeping": creeping,
    "jaws: touching balls": touching,
    "jaws: limits of a shot": limits,
    "jaws: limits of the table": limits,
    "jaws: ordinary": ordinary,
}

LAWS = ("han", "han", "han", "mathavan", "factors")
"""Cushion laws of chunks, drawn."""

BALL_LAWS = ("alciatore", "consistent")
"""Laws of two balls, drawn at the limits of the table. Not ``fastfiz``: it gains energy, so that balls may not rest."""

EDGES = {
    "mu_slide": (0.01, 0.2, 1.0),
    "mu_roll": (0.001, 0.01, 1.0),
    "mu_spin": (0.001, 1.0),
    "mu_ball": (0.0, 1.0),
    "e_ball": (0.8, 1.0),
    "mu_cushion": (0.0, 1.0),
    "e_cushion": (0.0, 0.5, 1.0),
    "cushion_parallel": (0.0, 1.0),
    "cushion_perpendicular": (0.0, 1.0),
    "cushion_spin": (0.0, 1.0),
    "nose_height": (0.0286, 0.0414),
    "horn_radius": (0.001, 0.02),
    "corner_mouth": (0.11, 0.13),
    "side_mouth": (0.115, 0.14),
    "corner_cut": (138.0, 143.0),
    "side_cut": (95.0, 106.0),
    "cue_end_mass": (0.0, 0.05),
    "mu_tip": (0.3, 1.0),
    "e_tip": (0.5, 1.0),
    "ball_mass": (0.1, 0.25),
    "cue_mass": (0.3, 0.9),
    "v_max": (1.0, 20.0),
    "theta_max": (0.0, 89.0),
}
"""Ends of the table's ranges, and within them of the mouths that are possible; mu_roll is at most mu_slide."""


def table_for(kind: str, rng: Rng) -> physics.RealTable:
    """The table a class is played on, a nine-foot one: without the test of the cue, so that every stroke is played."""
    table = physics.RealTable.of_size("nine_foot").replace(cue_test=False, flight=False, cushion=str(rng.choice(LAWS)))
    if kind != "jaws: limits of the table":
        return table
    while True:
        values = {name: float(rng.choice(ends)) for name, ends in EDGES.items() if rng.random() < 0.7}
        values["mu_roll"] = min(values.get("mu_roll", 0.01), values.get("mu_slide", 0.2))
        try:
            return table.replace(**values, ball=str(rng.choice(BALL_LAWS)))
        except physics.InvalidTable:
            continue
