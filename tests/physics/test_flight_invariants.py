"""What holds in every shot that flies: symmetry to the bit, energy, no overlap, nothing in the wood, an end.

Hostile scenes: perched and stacked balls, 70 degrees into frozen clusters, rails and mouths from the air, e_cloth at
its bounds, a ball a hair before a drop edge.
"""

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest
from support.moving import Launch, let_go

import physics
from physics.status import Status

FLYING = physics.Table.nine_foot().replace(flight=True, cue_test=False)
R, G = FLYING.ball_radius, 9.81
HALF = np.array([0.5 * FLYING.width, 0.5 * FLYING.length])
Position = tuple[float, float]


def test_mirror_images_and_half_turns_have_the_same_bits():
    """On a grid on which the table's middle is exact; velocities, heights and times bit for bit."""
    rng, grid, compared, flown = np.random.default_rng(12), 2.0**-40, 0, 0
    for _ in range(40):
        offsets = np.round(rng.uniform(-1, 1, (3, 2)) * (0.6, 1.2) / grid) * grid
        phi = round(float(rng.uniform(0, 360)) * 2**20) / 2**20
        theta = float(rng.choice([20.0, 45.0, 60.0]))
        told = []
        for sx, sy, turned in ((1, 1, phi), (-1, 1, 180.0 - phi), (1, -1, -phi), (-1, -1, 180.0 + phi)):
            places = HALF + offsets * (sx, sy)
            fits = all(FLYING.contains(*place) for place in places.tolist())
            if not fits or not np.array_equal(places - HALF, offsets * (sx, sy)):
                break
            if min(math.dist(a, b) for a, b in zip(places, np.roll(places, 1, 0), strict=True)) < 0.06:
                break
            state = physics.TableState.from_positions(dict(enumerate(map(tuple, places.tolist()))))
            result = physics.simulate(FLYING, state, physics.Shot(4.0, turned, theta, 3.0 * sx * sy, 15.0))
            told.append([(e.time, e.kind, e.ball, *moved(e, sx, sy)) for e in result.events])
            flown += "landing" in [e.kind.value for e in result.events]
        if len(told) == 4:
            assert told[0] == told[1] == told[2] == told[3]
            compared += 1
    assert compared > 5
    assert flown > 20


def moved(event: physics.Event, sx: int, sy: int) -> list[tuple[float, ...]]:
    return [
        (
            *(sx * s.velocity[0] + 0.0, sy * s.velocity[1] + 0.0, s.velocity_z, s.height),
            *(sy * s.spin[0] + 0.0, sx * s.spin[1] + 0.0, sx * sy * s.spin[2] + 0.0),
        )
        for s in event.states
    ]


def scattered(rng: np.random.Generator, n: int) -> list[Position]:
    """Balls anywhere, half of them touching another, a quarter at the rails and mouths."""
    places: list[Position] = []
    while len(places) < n:
        x, y = rng.uniform(0.0, FLYING.width), rng.uniform(0.0, FLYING.length)
        if places and rng.random() < 0.5:
            angle = float(rng.choice([0.0, 60.0, 90.0, 120.0, rng.uniform(0, 360)]))
            x = places[-1][0] + 2 * R * math.cos(math.radians(angle))
            y = places[-1][1] + 2 * R * math.sin(math.radians(angle))
        elif rng.random() < 0.4:
            x = FLYING.contact_distance + float(rng.choice([0.0, 1e-12, 0.03]))
        apart = all(math.dist((x, y), place) >= 2 * R - 5e-16 for place in places)
        if FLYING.contains(float(x), float(y)) and apart:
            places.append((float(x), float(y)))
    return places


def hostile(rng: np.random.Generator, shots: int) -> Iterator[tuple[list[Position], list[float]]]:
    """Strokes at balls and anywhere, from 5 to 85 degrees, from hardly moving to full."""
    for _ in range(shots):
        places = scattered(rng, int(rng.integers(1, 8)))
        aim = float(rng.uniform(0, 360))
        if len(places) > 1 and rng.random() < 0.7:
            x, y = places[int(rng.integers(1, len(places)))]
            aim = math.degrees(math.atan2(y - places[0][1], x - places[0][0])) + float(rng.normal(0, 4))
        theta = float(rng.choice([5.0, 20.0, 45.0, 70.0, 85.0]))
        yield places, [float(rng.choice([0.3, 2.0, 5.0, 12.0])), aim, theta, *rng.uniform((-10.0, -10.0), (10.0, 20.0))]


def kinetic_and_height(snapshot: physics.Snapshot) -> float:
    squares = (snapshot.velocities**2).sum() + (snapshot.vertical_velocities**2).sum()
    return float(0.5 * (squares + 0.4 * R * R * (snapshot.spins**2).sum()) + G * snapshot.heights.sum())


def nearest(snapshot: physics.Snapshot) -> float:
    """Least distance of two centres, m."""
    here = ~np.isnan(snapshot.positions[:, 0])
    places = np.column_stack([snapshot.positions, snapshot.heights])[here]
    gaps = np.sqrt(((places[:, None] - places[None]) ** 2).sum(axis=-1))
    return float(gaps[~np.eye(len(places), dtype=bool)].min(initial=1.0))


BOUNDS = [{"e_cloth": 0.9, "e_strike": 0.9}, {"e_cloth": 0.0}, {"e_pressed": 0.5}, {"e_ball": 1.0}]


@pytest.mark.parametrize("changes", BOUNDS, ids=str)
def test_every_shot_ends_with_falling_energy_and_nothing_in_anything(changes):
    """No NaN, no rise of energy, z >= 0, no overlap above 1e-12 m, a legal end; at events and between them."""
    table, flown = FLYING.replace(**changes), 0
    for places, stroke in hostile(np.random.default_rng(31), 12):
        state = physics.TableState.from_positions(dict(enumerate(places)))
        result = physics.simulate(table, state, physics.Shot(*stroke))
        assert result.status is Status.AT_REST, (places, stroke)
        instants = sorted({event.time for event in result.events})[:300]
        energies = [kinetic_and_height(result.at(time)) for time in instants]
        assert all(b <= a + 1e-11 * energies[0] for a, b in pairwise(energies)), (places, stroke)
        for time in [*instants, *np.linspace(0.0, result.duration, 20).tolist()]:
            there = result.at(time)
            assert (there.heights >= 0.0).all()
            assert nearest(there) >= 2 * R - 1e-12, (places, stroke, time)
        lying = list(result.final.balls)
        assert table.contains(*result.final.positions[lying].T).all()
        flown += "landing" in {event.kind.value for event in result.events}
    assert flown >= 5


def test_a_hundred_bounces_and_a_batch_have_the_same_bits():
    """A table on which balls bounce long; the batch is the single shots, byte for byte."""
    table = FLYING.replace(e_cloth=0.9, e_strike=0.9)
    scenes = list(hostile(np.random.default_rng(5), 6))
    positions = np.full((len(scenes), 16, 2), np.nan)
    for row, (places, _) in zip(positions, scenes, strict=True):
        row[: len(places)] = places
    shots = np.array([stroke for _, stroke in scenes])
    batch = physics.simulate_batch(table, positions, shots, threads=2)
    for n, (places, stroke) in enumerate(scenes):
        one = physics.simulate(table, physics.TableState.from_positions(dict(enumerate(places))), physics.Shot(*stroke))
        assert one.final.positions.tobytes() == batch.positions[n].tobytes()
        assert one.n_events == batch.n_events[n]


def test_balls_perched_on_two_come_down_or_are_told():
    """A ball over the gap of two touching balls falls beside them; one that stays up is told to be off the table."""
    side = 2 * R * (1 + 1e-9)
    pair = {1: Launch((0.6, 1.0)), 2: Launch((0.6 + side, 1.0))}
    above = Launch((0.6 + 0.5 * side, 1.0 + 1e-4), height=0.08)
    result = let_go(FLYING, pair | {3: above})
    assert result.status is Status.AT_REST
    assert nearest(result.at(result.duration)) >= 2 * R - 1e-12
    assert result.facts.off_table[3] >= 0 or result.final.position(3) is not None


def test_a_ball_hanging_a_hair_before_the_drop_edge_is_knocked_in_from_the_air():
    """1e-12 m short of the edge it lies; a ball that lands on it sends it in."""
    hole = np.array(FLYING.pockets[0].hole_centre)
    inward = np.array([1.0, 1.0]) / math.sqrt(2.0)
    hanging = hole + inward * (FLYING.corner_shape.hole_radius + 1e-12)
    start = hanging + inward * 0.10
    launches = {1: Launch(tuple(hanging)), 2: Launch(tuple(start), tuple(-inward * 0.8), height=0.03)}
    result = let_go(FLYING, launches)
    assert result.facts.pocket[1] == 0
    assert result.status is Status.AT_REST
