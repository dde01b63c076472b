"""Cushions and mouths: where they are, what the law does, what counts (PHYSICS "Olympiad table", "Collisions")."""

import math

import pytest
from support.moving import Launch, after, first, let_go, rolling

import physics

TABLE = physics.Table.olympiad()
R, W, L = 0.028575, 1.116, 2.236
WEST, EAST, SOUTH, NORTH = range(4)


@pytest.mark.parametrize(
    ("cushion", "start", "velocity", "line"),
    [
        (WEST, (0.3, 0.8), (-2.0, 0.5), (R, None)),
        (EAST, (0.8, 0.8), (2.0, 0.5), (W - R, None)),
        (SOUTH, (0.4, 0.3), (0.5, -2.0), (None, R)),
        (NORTH, (0.4, 1.9), (0.5, 2.0), (None, L - R)),
    ],
)
def test_the_cushion_law(cushion, start, velocity, line):
    """Parallel 0.9, perpendicular -0.6, all spin x 0.1, at the line moved inward by R."""
    result = let_go(TABLE, {1: rolling(start, velocity, w_z=50.0)})
    event = first(result, "rail_collision")
    assert (event.ball, event.other) == (1, cushion)
    state, before = after(event, 1), result.at(math.nextafter(event.time, 0.0))
    across = 0 if cushion in (WEST, EAST) else 1
    assert state.position[across] == pytest.approx(line[across], abs=1e-15)
    vx, vy = before.velocities[1]
    expected = (-0.6 * vx, 0.9 * vy) if across == 0 else (0.9 * vx, -0.6 * vy)
    assert state.velocity == pytest.approx(expected, rel=1e-12)
    assert state.spin == pytest.approx(tuple(0.1 * w for w in before.spins[1]), rel=1e-12)


def test_a_slow_touch_stops_at_the_cushion():
    """Approach <= 1 mm/s: no velocity across, no spin along, the rest is kept; not driven to a cushion."""
    result = let_go(TABLE, {1: rolling((R + 1e-7, 0.8), (-5e-4, 0.1))})
    assert first(result, "contact").ball == 1
    state = result.at(result.duration / 2)
    assert state.velocities[1][0] == 0.0
    assert state.velocities[1][1] > 0.0
    assert not [event for event in result.events if event.kind.value == "rail_collision"]
    assert result.facts.cushion[1] == -1


@pytest.mark.parametrize(
    ("pocket", "start", "aim"),
    [
        (0, (0.4, 0.4), (0.05, 0.05)),
        (1, (0.4, 1.1), (0.0, L / 2)),
        (2, (0.4, 1.8), (0.05, L - 0.05)),
        (3, (0.8, 1.8), (W - 0.05, L - 0.05)),
        (4, (0.8, 1.1), (W, L / 2)),
        (5, (0.8, 0.4), (W - 0.05, 0.05)),
    ],
)
def test_pockets_by_number(pocket, start, aim):
    """SW W NW NE E SE; a ball that reaches a mouth line is out of play, its crossing point recorded."""
    way = (2.0 * (aim[0] - start[0]), 2.0 * (aim[1] - start[1]))
    result = let_go(TABLE, {1: rolling(start, way)})
    event = first(result, "pocket_collision")
    assert (event.ball, event.other) == (1, pocket)
    x, y = after(event, 1).position
    side, end = abs(x - W / 2), abs(y - L / 2)
    reach = 0.11 / math.sqrt(2) + R
    on_line = side - (W / 2 - R) if pocket in (1, 4) else side + end - (W / 2 + L / 2 - reach)
    assert abs(on_line) < 1e-15
    assert result.final.position(1) is None
    assert result.facts.pocketed[1] == event.index
    assert result.facts.pocket[1] == pocket
    assert after(event, 1).motion is physics.Motion.POCKETED


@pytest.mark.parametrize("side", [-1, 1])
def test_the_side_mouth_ends_at_its_horns(side):
    """|y - L/2| < 0.06 on the moved line is the mouth; at 0.06 and beyond the cushion."""
    for y, kind in ((0.06 - 1e-9, "pocket_collision"), (0.06, "rail_collision"), (0.06 + 1e-9, "rail_collision")):
        result = let_go(TABLE, {1: rolling((0.3, L / 2 + side * y), (-1.0, 0.0))})
        assert result.events[0].kind.value == kind, y


def test_the_corner_mouth_meets_the_cushion_line_above_the_horn():
    """x + y = cp + R: straight down the line y > cp a ball meets the west cushion, below it the pocket."""
    cp = 0.11 / math.sqrt(2)
    for y, kind in ((cp - 1e-9, "pocket_collision"), (cp + 1e-9, "rail_collision")):
        result = let_go(TABLE, {1: rolling((0.3, y), (-1.0, 0.0))})
        assert result.events[0].kind.value == kind, y


def test_a_ball_rolling_along_a_cushion_falls_at_the_horn():
    """Its centre is on the mouth's line as soon as the mouth begins."""
    result = let_go(TABLE, {1: rolling((R, 0.8), (0.0, 0.8))})
    event = first(result, "pocket_collision")
    assert event.other == 1
    assert after(event, 1).position == pytest.approx((R, L / 2 - 0.06), abs=1e-15)


def test_a_ball_rolling_along_a_cushion_reaches_the_corner():
    result = let_go(TABLE, {1: rolling((R, 0.5), (0.0, -0.8))})
    event = result.events[0]
    assert (event.kind.value, event.other) == ("pocket_collision", 0)
    assert after(event, 1).position[1] == pytest.approx(0.11 / math.sqrt(2), abs=1e-15)


def test_a_frozen_ball_sliding_into_its_cushion_stays_there():
    """Its own acceleration presses it: v and spin across are taken, it does not bounce for ever."""
    result = let_go(TABLE, {1: Launch((R, 0.8), (0.0, 0.3), (0.0, -40.0, 0.0))})
    assert result.n_events < 10
    assert abs(result.final.position(1)[0] - R) < 1e-15


@pytest.mark.parametrize(("factor", "value"), [("cushion_parallel", 0.5), ("cushion_perpendicular", 0.3)])
def test_cushion_factors_of_the_table(factor, value):
    result = let_go(TABLE.replace(**{factor: value}), {1: Launch((R + 0.01, 0.8), (-1.0, 1.0))})
    before = result.at(math.nextafter(result.events[0].time, 0.0)).velocities[1]
    now = after(result.events[0], 1).velocity
    axis, sign = (1, 1) if factor == "cushion_parallel" else (0, -1)
    assert now[axis] == pytest.approx(sign * value * before[axis], rel=1e-12)
