"""The rack: RULES R1 to R5 and PHYSICS.md, `rack`."""

import hashlib
import importlib
import math
from collections import Counter

import numpy as np
import pytest
from scipy import stats

from physics.errors import InvalidState
from physics.rack import JITTER, rack
from physics.table import Table

TABLE = Table.olympiad()
DIAMETER = 2.0 * TABLE.ball_radius
SOLIDS, STRIPES = set(range(1, 8)), set(range(9, 16))


def places(state):
    """Ball numbers from the apex row by row, west to east."""
    rows = sorted(range(1, 16), key=lambda ball: -state.position(ball)[1])
    order = []
    for row in range(5):
        start = row * (row + 1) // 2
        order += sorted(rows[start : start + row + 1], key=lambda ball: state.position(ball)[0])
    return order


def distances(state):
    positions = state.positions[1:]
    gaps = positions[:, None, :] - positions[None, :, :]
    return np.sqrt((gaps**2).sum(axis=2))[np.triu_indices(15, 1)]


@pytest.mark.parametrize("seed", range(50))
def test_rack_obeys_r1_to_r5(seed):
    state = rack(TABLE, "eight_ball", seed=seed)
    order = places(state)
    apex = state.position(order[0])
    assert math.dist(apex, TABLE.foot_spot) < 6 * JITTER  # R1
    assert order[4] == 8  # R2
    assert {order[10] in SOLIDS, order[14] in SOLIDS} == {True, False}  # R3
    assert 8 not in (order[10], order[14])
    assert sorted(order) == list(range(1, 16))
    assert distances(state).min() > DIAMETER  # R5: never overlapping
    assert (distances(state) < DIAMETER + 1e-5).sum() == 30  # every neighbour is near


def test_rack_lies_between_foot_spot_and_foot_cushion():
    state = rack(TABLE, seed=1)
    rows = sorted(state.positions[1:, 1])
    assert rows[-1] == pytest.approx(TABLE.foot_spot[1], abs=1e-5)
    depth = 4 * (DIAMETER + TABLE.rack_gap) * math.sqrt(0.75)
    assert rows[0] == pytest.approx(TABLE.foot_spot[1] - depth, abs=1e-5)


def test_cue_ball_lies_just_behind_the_head_string():
    """PHYSICS.md and the contract: (W/2, 3L/4 + R)."""
    state = rack(TABLE, seed=7)
    assert state.position(0) == (TABLE.width / 2, TABLE.head_string + TABLE.ball_radius)


@pytest.mark.parametrize(
    ("seed", "digest"),
    [
        (7, "346a220c2159b89efe59d801ed82ac8d18bbcd0436340d3e6c1c30cbf295495b"),
        (1067, "66adbaaeac4972a6f73fe4830c790019add5da35a830699af20be48a55a4a9fa"),
    ],
    ids=["drawn once", "drawn twice"],
)
def test_golden_racks(seed, digest):
    """Bits another implementation must reproduce: SHA-256 of the (16, 2) doubles, little-endian."""
    positions = rack(TABLE, "eight_ball", seed=seed).positions.astype("<f8")
    assert hashlib.sha256(positions.tobytes()).hexdigest() == digest


def test_jitter_that_makes_balls_overlap_is_drawn_again(monkeypatch):
    """Seed 1067 is the first whose first draw overlaps."""
    answers = []
    rack_module = importlib.import_module("physics.rack")  # ``physics.rack`` itself is the function
    real = rack_module._are_clear

    def spy(*arguments):
        answers.append(real(*arguments))
        return answers[-1]

    monkeypatch.setattr(rack_module, "_are_clear", spy)
    rack(TABLE, seed=1067)
    assert answers == [False, True]


def test_integer_seed_is_its_32_bytes():
    assert rack(TABLE, seed=7) == rack(TABLE, seed=(7).to_bytes(32, "big"))
    assert rack(TABLE, seed=7) != rack(TABLE, seed=8)


def test_gap_zero_is_the_exactly_touching_lattice():
    state = rack(TABLE, seed=3, gap=0.0)
    assert state == rack(TABLE.replace(rack_gap=0.0), seed=3)
    near = distances(state)
    near = near[near < DIAMETER + 1e-6]
    assert len(near) == 30
    assert abs(near - DIAMETER).max() < 1e-12
    assert places(state) == places(rack(TABLE, seed=3))


@pytest.mark.parametrize("gap", [1e-8, 1e-6, 1e-4, 1e-3])
def test_other_gaps_never_overlap_and_hold_on_average(gap):
    near = np.concatenate([np.sort(distances(rack(TABLE, seed=seed, gap=gap)))[:30] for seed in range(20)])
    assert near.min() > DIAMETER
    assert near.mean() == pytest.approx(DIAMETER + gap, abs=0.1 * min(gap, 1e-6))
    assert near.std() > 0.1 * min(gap, 2e-6)  # jittered, not the lattice of the last resort


def test_jitter_has_the_olympiads_sigma():
    """Offsets from the lattice over 300 racks are Gaussian of 4.8e-7 m."""
    spacing = DIAMETER + TABLE.rack_gap
    x, y = TABLE.foot_spot
    lattice = [
        (x + (column - row / 2) * spacing, y - row * spacing * math.sqrt(0.75))
        for row in range(5)
        for column in range(row + 1)
    ]
    offsets = []
    for seed in range(300):
        state = rack(TABLE, seed=seed)
        offsets += [np.subtract(state.position(b), at) for b, at in zip(places(state), lattice, strict=True)]
    assert stats.kstest(np.ravel(offsets) / 4.8e-7, "norm").pvalue > 0.001


def test_every_arrangement_is_equally_likely():
    """R4: each ball equally often at the apex, each solid in a corner, the solid corner on both sides."""
    racks = [places(rack(TABLE, seed=seed, gap=0.0)) for seed in range(2_800)]
    apex = Counter(order[0] for order in racks)
    assert set(apex) == SOLIDS | STRIPES
    assert stats.chisquare([apex[ball] for ball in sorted(apex)]).pvalue > 0.001
    solid = Counter(next(b for b in (order[10], order[14]) if b in SOLIDS) for order in racks)
    assert stats.chisquare([solid[ball] for ball in SOLIDS]).pvalue > 0.001
    west = sum(order[10] in SOLIDS for order in racks)
    assert stats.binomtest(west, len(racks)).pvalue > 0.001


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ({"seed": -1}, "seed"),
        ({"seed": 1 << 256}, "seed"),
        ({"seed": True}, "seed"),
        ({"seed": 1.5}, "seed"),
        ({"seed": 1, "gap": -1e-9}, "gap"),
        ({"seed": 1, "gap": math.nan}, "gap"),
        ({"seed": 1, "gap": 0.01}, "gap"),
        ({"seed": 1, "game": "snooker"}, "game"),
    ],
)
def test_bad_arguments_are_named(arguments, field):
    with pytest.raises(InvalidState) as caught:
        rack(TABLE, **arguments)
    assert caught.value.field == field


@pytest.mark.parametrize(
    ("game", "rows", "fixed"),
    [
        ("nine_ball", (1, 2, 3, 2, 1), {1: 0, 9: 4}),
        ("ten_ball", (1, 2, 3, 4), {1: 0, 10: 4}),
        ("straight_pool", (1, 2, 3, 4, 5), {}),
    ],
)
def test_racks_of_other_games(game, rows, fixed):
    """Rules of the WPA: the balls, the shape, the places that are laid down; the others are drawn."""
    seen = []
    for seed in range(40):
        state = rack(TABLE, game, seed=seed, gap=0.0)
        count = sum(rows)
        assert state.balls == tuple(range(count + 1))
        by_place = sorted(range(1, count + 1), key=lambda ball: (-state.position(ball)[1], state.position(ball)[0]))
        depths = sorted({round(state.position(ball)[1], 9) for ball in by_place}, reverse=True)
        assert [sum(round(state.position(ball)[1], 9) == depth for ball in by_place) for depth in depths] == list(rows)
        assert all(by_place[place] == ball for ball, place in fixed.items())
        assert state.position(by_place[0]) == pytest.approx(TABLE.foot_spot)
        assert np.nanmin(distances(state)) == pytest.approx(2.0 * TABLE.ball_radius)
        seen.append(tuple(by_place))
    assert len(set(seen)) > 30


def test_the_back_corners_of_ten_ball_are_the_two_and_the_three():
    for seed in range(20):
        state = rack(TABLE, "ten_ball", seed=seed, gap=0.0)
        back = min(state.position(ball)[1] for ball in range(1, 11))
        row = sorted((state.position(ball)[0], ball) for ball in range(1, 11) if state.position(ball)[1] < back + 1e-9)
        assert {row[0][1], row[-1][1]} == {2, 3}
