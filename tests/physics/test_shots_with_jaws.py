"""Shots on tables with jaws: against the arbitrary-precision engine, hostile scenes, symmetry, facts, the cue."""

import math
from collections.abc import Iterator

import numpy as np
import pytest
from support.compare import from_truth, partners
from support.moving import Launch, after, first, let_go, rolling
from support.truth.engine import play
from support.truth.strike import Stroke
from support.worlds import from_kernel, shot_of, world_of

import physics
from physics.status import Status

NINE = physics.RealTable.of_size("nine_foot").replace(cue_test=False, flight=False)
R, RHO = 0.028575, NINE.contact_distance
Position = tuple[float, float]
LAWS = [("han", "alciatore"), ("mathavan", "alciatore"), ("factors", "consistent")]


def clear(places: list[Position], x: float, y: float) -> bool:
    return all(math.dist((x, y), place) >= 2 * R + 1e-4 for place in places)


def near_a_mouth(rng: np.random.Generator, n: int) -> dict[int, Position]:
    """Balls in and before the south-west or the west mouth."""
    places: list[Position] = []
    while len(places) < n:
        x, y = rng.uniform(0.0, 0.18), rng.uniform(0.0, 0.18)
        if rng.random() < 0.4:
            x, y = rng.uniform(-0.005, 0.15), NINE.length / 2 + rng.uniform(-0.12, 0.12)
        if NINE.contains(float(x), float(y)) and clear(places, x, y):
            places.append((float(x), float(y)))
    return dict(enumerate(places))


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law[0])
def test_shots_in_the_jaws_tell_the_true_story(law):
    """Up to 14 events at 30 digits, without filter or broad phase: the same events, times to 1e-9 s."""
    rng, jaws, compared = np.random.default_rng(17), 0, 0
    table = NINE.replace(cushion=law[0], ball=law[1])
    for _ in range(14):
        positions = near_a_mouth(rng, int(rng.integers(1, 4)))
        out = math.degrees(
            math.atan2((-0.03, NINE.length / 2)[positions[0][1] > 1] - positions[0][1], -0.03 - positions[0][0])
        )
        stroke = Stroke(
            float(rng.uniform(0.3, 7)), out + float(rng.normal(0, 40)), float(rng.uniform(0, 20)), 2.0, -3.0
        )
        truth = from_truth(play(positions, stroke, world_of(table), digits=30, max_events=14).records)
        state = physics.TableState.from_positions(positions)
        found = partners(truth, from_kernel(physics.simulate(table, state, shot_of(stroke))))
        assert len(found) == len(truth), (positions, stroke)
        assert max(abs(float(a.time - b.time)) for a, b in zip(truth, found, strict=True)) < 1e-9, (positions, stroke)
        jaws += sum(event.kind == "jaw_collision" for event in truth)
        compared += len(found)
    assert jaws >= 8
    assert compared > 80


def touching_a_piece(rng: np.random.Generator) -> Position:
    """A centre at a facing, a horn, a drop edge, a nose's end, or anywhere in a mouth: at it, or within TOUCH of it."""
    corner = rng.random() < 0.6
    mouth = NINE.corner_shape if corner else NINE.side_shape
    off, angle = float(rng.choice([0.0, 1e-13, -1e-13, 1e-12, 1e-10])), float(rng.uniform(0, 2 * math.pi))
    kind = int(rng.integers(5))
    if kind == 0:
        foot, (ns, nd) = float(rng.uniform(0, mouth.facing_length)), mouth.facing_normal
        s = mouth.facing_start[0] - foot * nd + (RHO + off) * ns
        d = mouth.facing_start[1] + foot * ns + (RHO + off) * nd
    elif kind == 1:
        reach = mouth.horn_radius + RHO + off
        s, d = mouth.nose_end + reach * math.cos(angle), -mouth.horn_radius + reach * math.sin(angle)
    elif kind == 2:
        reach = mouth.hole_radius + float(rng.choice([1e-16, 1e-13, 1e-12, 1e-9]))
        d, s = mouth.hole_centre[0] + reach * math.cos(angle), mouth.hole_centre[1] + reach * math.sin(angle)
    elif kind == 3:
        s, d = (float(x) for x in rng.uniform(-0.03, 0.12, 2))
    else:
        s, d = mouth.nose_end + float(rng.choice([0.0, 1e-15, -1e-15, 1e-6])), RHO
    if not corner:
        return d, NINE.length / 2 + s * float(rng.choice([-1.0, 1.0]))
    u, v = (s, d) if rng.random() < 0.5 else (d, s)
    return u if rng.random() < 0.5 else NINE.width - u, v if rng.random() < 0.5 else NINE.length - v


def hostile(rng: np.random.Generator, n: int) -> Iterator[tuple[list[Position], list[float]]]:
    """Balls at pieces of mouths, neighbours touching them; strokes from creeping to full, along and across."""
    for _ in range(n):
        places: list[Position] = []
        for _ in range(60):
            x, y = touching_a_piece(rng)
            if places and rng.random() < 0.3:
                angle, reach = rng.uniform(0, 2 * math.pi), 2 * R * (1 + float(rng.choice([0.0, 1e-16, 1e-13, 1e-9])))
                other = places[int(rng.integers(len(places)))]
                x, y = other[0] + reach * math.cos(angle), other[1] + reach * math.sin(angle)
            apart = all(math.dist((x, y), place) >= 2 * R - 5e-16 for place in places)
            if NINE.contains(float(x), float(y)) and apart and len(places) < 6:
                places.append((float(x), float(y)))
        places = places or [(0.6, 1.2)]
        to_x, to_y = NINE.mouths[int(rng.integers(6))].tolist()
        aim = math.degrees(math.atan2(to_y - places[0][1], to_x - places[0][0])) + float(rng.normal(0, 20))
        speed, theta = float(rng.choice([1e-6, 0.01, 0.5, 5.0, 12.0])), float(rng.choice([0.0, 5.0, 30.0, 85.0]))
        yield places, [speed, aim, theta, *(float(x) for x in rng.uniform(-18.0, 18.0, 2))]


@pytest.mark.parametrize("law", ["han", "mathavan"])
def test_hostile_shots_leave_legal_tables(law):
    """None endless, none in the wood, no NaN, no overlap above 1e-12 m; each final is a legal start."""
    scenes = list(hostile(np.random.default_rng(3), 2_000 if law == "han" else 500))
    positions, shots = np.full((len(scenes), 16, 2), np.nan), np.array([shot for _, shot in scenes])
    for row, (places, _) in zip(positions, scenes, strict=True):
        row[: len(places)] = places
    table = NINE.replace(cushion=law)
    batch = physics.simulate_batch(table, positions, shots)
    assert set(batch.status.tolist()) == {Status.AT_REST}
    here = batch.pocket == -1
    assert np.array_equal(np.isnan(batch.positions[:, :, 0]), ~here)
    assert table.contains(*np.moveaxis(batch.positions[here], -1, 0)).all()
    gaps = batch.positions[:, :, None] - batch.positions[:, None]
    distances = np.sqrt((gaps**2).sum(axis=-1))[:, ~np.eye(16, dtype=bool)]
    assert np.nanmin(distances) >= 2 * R - 1e-12
    again = physics.simulate_batch(table, batch.positions, shots)  # every end is a legal start
    assert set(again.status.tolist()) <= {Status.AT_REST, Status.NO_CUE_BALL}
    assert (batch.pocket >= 0).sum() > 50


SIZES = [physics.Table.nine_foot(), physics.Table.eight_foot(), physics.Table.seven_foot()]


@pytest.mark.parametrize("table", [size.replace(cue_test=False) for size in SIZES], ids=lambda table: table.name)
@pytest.mark.parametrize("law", LAWS, ids=lambda law: law[0])
def test_mirror_images_and_half_turns_have_the_same_bits(table, law):
    """Balls in and before the mouths, sent into the jaws; velocities, spins and times bit for bit.

    Places are multiples of the last place of the table's size: their mirror images are exact, seen from its middle.
    """
    table = table.replace(cushion=law[0], ball=law[1])
    rng, compared, jaws = np.random.default_rng(8), 0, 0
    middle = np.array([0.5 * table.width, 0.5 * table.length])
    unit = np.spacing(2.0 * middle)
    for number in range(40):
        corner = middle - rng.uniform(0.0, 0.2, (3, 2))
        side = np.array([middle[0], 0.0]) - rng.uniform([-0.004, -0.15], [0.2, 0.15], (3, 2))
        offsets = corner if number % 2 else side
        offsets[0] = rng.uniform(0.1, 0.6, 2) * middle
        offsets = np.round((middle + offsets) / unit) * unit - middle
        target = middle if number % 2 else np.array([middle[0], 0.0])
        out = target - offsets[0]
        phi = round((math.degrees(math.atan2(out[1], out[0])) + float(rng.normal(0, 2))) * 2**20) / 2**20
        told = []
        for sx, sy, turned in ((1, 1, phi), (-1, 1, 180.0 - phi), (1, -1, -phi), (-1, -1, 180.0 + phi)):
            places = middle + offsets * (sx, sy)
            exact = np.array_equal(places - middle, offsets * (sx, sy))
            fits = exact and table.contains(*places.T).all()
            if not fits or min(math.dist(a, b) for a, b in zip(places, np.roll(places, 1, 0), strict=True)) < 0.06:
                break
            state = physics.TableState.from_positions(dict(enumerate(map(tuple, places.tolist()))))
            result = physics.simulate(table, state, physics.Shot(6.0, turned, 0.0, 3.0 * sx * sy, -2.0))
            told.append([(e.time, e.kind, e.ball, *moved(e, sx, sy)) for e in result.events])
        if len(told) == 4:
            assert told[0] == told[1] == told[2] == told[3]
            compared += 1
            jaws += sum(kind == "jaw_collision" for _, kind, *_ in told[0])
    assert compared >= 8
    assert jaws >= 8


def moved(event: physics.Event, sx: int, sy: int) -> list[tuple[float, ...]]:
    return [
        (sx * s.velocity[0], sy * s.velocity[1], sy * s.spin[0], sx * s.spin[1], sx * sy * s.spin[2])
        for s in event.states
    ]


def test_a_jaw_counts_as_a_cushion_for_the_rules():
    """A ball that meets nothing but a jaw is driven to a cushion."""
    result = let_go(NINE, {0: rolling((0.9, 0.06), (-3.0, -0.12))})
    jaw = first(result, "jaw_collision")
    assert jaw.other in range(12)
    assert result.facts.cushion[0] == min(
        e.index for e in result.events if e.kind in ("jaw_collision", "rail_collision")
    )


@pytest.mark.parametrize("side", [True, False], ids=["side", "corner"])
def test_a_ball_frozen_to_a_jaw_is_frozen_to_its_cushion(side):
    """At rest against a facing: it is noted, and rolling along it is no collision."""
    shape = NINE.side_shape if side else NINE.corner_shape
    (ns, nd), foot = shape.facing_normal, 0.01
    s = shape.facing_start[0] - foot * nd + RHO * ns
    d = shape.facing_start[1] + foot * ns + RHO * nd
    place = (d, NINE.length / 2 + s) if side else (s, d)
    state = physics.TableState.from_positions({0: (0.6, 1.0), 1: place})
    assert physics.simulate(NINE, state, physics.Shot(0.01, 0.0)).facts.frozen_to_cushion[1] == 1


def test_a_soft_ball_is_held_by_a_facing_and_rolls_along_it():
    shape = NINE.corner_shape
    (ns, nd), foot = shape.facing_normal, 0.005
    s = shape.facing_start[0] - foot * nd + RHO * ns
    d = shape.facing_start[1] + foot * ns + RHO * nd
    into = (-nd, ns)
    velocity = 0.05 * into[0] - 5e-4 * ns, 0.05 * into[1] - 5e-4 * nd
    result = let_go(NINE, {1: rolling((s, d), velocity)})
    assert "jaw_collision" not in [event.kind.value for event in result.events]
    end = result.final.position(1)
    assert end is not None
    gap = (end[0] - shape.facing_start[0]) * ns + (end[1] - shape.facing_start[1]) * nd - RHO
    assert abs(gap) < 1e-9


@pytest.mark.parametrize("corner", [True, False], ids=["corner", "side"])
@pytest.mark.parametrize("piece", ["horn", "facing"])
def test_a_ball_frozen_in_the_jaws_tells_the_true_story(corner, piece):
    """Struck along the piece both ways, off it and into it, softly and hard: as the truth engine has it."""
    shape = NINE.corner_shape if corner else NINE.side_shape
    if piece == "horn":
        (ns, nd), reach = (-0.28, 0.96), shape.horn_radius + RHO
        s, d = shape.nose_end + reach * ns, reach * nd - shape.horn_radius
    else:
        (ns, nd), foot = shape.facing_normal, 0.004
        s = shape.facing_start[0] - foot * nd + RHO * ns
        d = shape.facing_start[1] + foot * ns + RHO * nd
    place, normal = ((s, d), (ns, nd)) if corner else ((d, NINE.length / 2 + s), (nd, ns))
    away, told = math.degrees(math.atan2(normal[1], normal[0])), 0
    for turn in (0.0, 60.0, 89.9, 90.0, -90.0, -90.1, 120.0, 180.0):
        along = 80.0 < abs(turn) < 100.0  # slow, the piece would hold it event after event
        for speed, a, b in ((1.5, 6.0, -4.0), (0.3 if along else 0.02, 0.0, 0.0)):
            stroke = Stroke(speed, away + turn, 0.0, a, b)
            truth = from_truth(play({0: place}, stroke, world_of(NINE), digits=30, max_events=8).records)
            state = physics.TableState.from_positions({0: place})
            found = partners(truth, from_kernel(physics.simulate(NINE, state, shot_of(stroke))))
            assert len(found) == len(truth), (turn, speed)
            assert max(abs(float(x.time - y.time)) for x, y in zip(truth, found, strict=True)) < 1e-9, (turn, speed)
            told += len(found)
    assert told > 60


def test_a_ball_that_runs_round_a_horn_parts_from_it():
    """|v|^2 / (2 (r + rho)) parts it, against mu_slide g / 2 of friction that draws it in (FLIGHT 11.7).

    Fast, both act. Slow, friction would bring it back: it is held, which takes the spin that makes the friction.
    """
    shape, (ns, nd), gaps = NINE.corner_shape, (-0.28, 0.96), []
    reach = shape.horn_radius + RHO
    place = shape.nose_end + reach * ns, reach * nd - shape.horn_radius
    for speed in (0.05, 0.5):  # 0.04 m/s^2 against 0.97, 3.7 against 0.5
        slipping_off = (0.3 * nd / R, -0.3 * ns / R, 0.0)  # R k x w = 0.3 m/s along the normal
        result = let_go(NINE, {1: Launch(place, (speed * nd, -speed * ns), slipping_off)})
        centre = result.at(0.002).positions[1].tolist()
        gaps.append(math.dist(centre, (shape.nose_end, -shape.horn_radius)) - reach)
    slow, fast = (speed * speed / (2.0 * reach) for speed in (0.05, 0.5))
    assert gaps[0] == pytest.approx(slow * 0.002**2, rel=0.1)
    drawn_in = 0.5 * NINE.mu_slide * NINE.gravity * 0.3 / math.hypot(0.3, 0.5)  # the slip's share along the normal
    assert gaps[1] == pytest.approx((fast - drawn_in) * 0.002**2, rel=0.03)


def test_masses_of_ball_and_cue_make_the_speed():
    """(1) of docs/physics.md: v = 2 V / (1 + m/M) for a level stroke through the middle."""
    state = physics.TableState.from_positions({0: (0.6, 1.0)})
    for ball, cue in ((0.1, 0.9), (0.170097, 0.567), (0.25, 0.3)):
        table = NINE.replace(ball_mass=ball, cue_mass=cue)
        struck = first(physics.simulate(table, state, physics.Shot(2.0, 0.0)), "cue_strike")
        assert after(struck, 0).velocity[0] == pytest.approx(4.0 / (1.0 + ball / cue), rel=1e-15)


@pytest.mark.parametrize("cushion", ["han", "mathavan"])
def test_a_fast_bank_is_shorter_than_a_slow_one(cushion):
    """The speed effect on banks: struck at half height it rolls before a cushion 0.4 m off when slow, slides when fast.

    Both laws are homogeneous, so the cloth alone does it; 45 degrees off, measured 0.3 m from the cushion.
    """
    table, outs = NINE.replace(cushion=cushion), []
    for speed in (0.6, 1.5, 5.0):
        state = physics.TableState.from_positions({0: (0.4 + RHO, 1.9)})
        shot = physics.simulate(table, state, physics.Shot(speed, 225.0))
        hit = first(shot, "rail_collision")
        x0, y0 = hit.states[0].position
        times = np.linspace(hit.time, min(shot.duration, hit.time + 2.0), 400)
        x, y = next(p for t in times if (p := shot.at(float(t)).positions[0])[0] > 0.3 + RHO or t == times[-1])
        outs.append(math.degrees(math.atan2(abs(y - y0), x - x0)))
    assert outs[0] > outs[1] > outs[2]
    assert outs[0] - outs[2] > 8.0


@pytest.mark.parametrize(("short", "drops"), [(1e-12, False), (-1e-12, True)])
def test_the_drop_edge_decides_within_a_picometre(short, drops):
    """Rolled straight at the side pocket to stop that far before the edge."""
    edge = -NINE.side_shelf  # x of the drop edge in the middle of the west mouth
    distance = 0.2
    speed = math.sqrt(2.0 * NINE.mu_roll * NINE.gravity * (distance - short))
    result = let_go(NINE, {1: rolling((edge + distance, NINE.length / 2), (-speed, 0.0))})
    assert (result.final.position(1) is None) is drops


def test_a_break_on_every_size():
    for table in (physics.Table.nine_foot(), physics.Table.eight_foot(), physics.Table.seven_foot()):
        state = physics.rack(table, "eight_ball", seed=4)
        theta = physics.min_elevation(table, state, 270.0)
        result = physics.simulate(table, state, physics.Shot(9.0, 270.0, theta))
        assert result.status is Status.AT_REST
        assert result.n_events > 60
        batch = physics.simulate_batch(table, state, [[9.0, 270.0, theta, 0.0, 0.0]])
        assert batch.state(0) == result.final


def test_a_miscue_is_a_fact_and_no_foul_of_its_own():
    state = physics.TableState.from_positions({0: (0.6, 1.0)})
    held, slipped = (physics.simulate(NINE, state, physics.Shot(2.0, 0.0, a=share * 1e3 * R)) for share in (0.53, 0.56))
    assert (held.facts.miscue, slipped.facts.miscue) == (0, 1)
    assert slipped.status is Status.AT_REST
    stiff = physics.simulate(NINE.replace(cue_end_mass=0.0), state, physics.Shot(2.0, 0.0, a=0.9e3 * R))
    assert stiff.facts.miscue == 0


def test_the_strike_squirts():
    state = physics.TableState.from_positions({0: (0.6, 1.0)})
    event = first(physics.simulate(NINE, state, physics.Shot(2.0, 0.0, a=0.5e3 * R)), "cue_strike")
    vx, vy = after(event, 0).velocity
    assert math.degrees(math.atan2(vy, vx)) == pytest.approx(1.89, abs=0.01)


def test_the_cue_goes_over_nose_and_rail():
    """Frozen to a long cushion it needs elevation; in a side mouth the cue must clear the rail behind the hole."""
    table = physics.Table.nine_foot()
    free = physics.min_elevation(table, physics.TableState.from_positions({0: (0.6, 1.9)}), 90.0)
    frozen = physics.TableState.from_positions({0: (RHO, 0.6)})
    in_mouth = physics.min_elevation(table, physics.TableState.from_positions({0: (-0.004, 1.27)}), 0.0)
    assert free == 0.0
    # Below the nose's height, 7.715 mm above the centre, the tip would be in the rubber.
    assert math.isnan(physics.min_elevation(table, frozen, 0.0, b=7.7))
    assert physics.min_elevation(table, frozen, 0.0, b=7.8) < 60.0
    assert 0.0 < physics.min_elevation(table, physics.TableState.from_positions({0: (0.2, 0.6)}), 0.0) < 3.0
    # (h - R) over the way from the tip to the far edge of the hole
    way = NINE.side_shelf + 2 * NINE.side_hole_radius - 0.004 - R
    assert in_mouth == pytest.approx(math.degrees(math.atan((NINE.nose_height - R) / way)), abs=1e-9)
    shallow = physics.check(table, physics.TableState.from_positions({0: (-0.004, 1.27)}), physics.Shot(1.0, 0.0, 0.0))
    assert shallow is not None
    assert "W cushion" in str(shallow)


def test_throw_and_banks_as_simulated():
    """The laws are at work: a half-ball stun hit throws more slow than fast; english turns a bank."""
    throws = []
    for speed in (0.5, 3.0):
        lean = math.radians(30.0)
        places = (0.6, 0.6), (0.6 + 2 * R * math.cos(lean) + 1e-4, 0.6 + 2 * R * math.sin(lean))
        hit = first(let_go(NINE, {0: Launch(places[0], (speed, 0.0)), 1: Launch(places[1])}), "ball_collision")
        vx, vy = after(hit, 1).velocity
        throws.append(lean - math.atan2(vy, vx))
    assert math.degrees(throws[0]) > math.degrees(throws[1]) + 1.0
    outs = []
    for side in (-40.0, 0.0, 40.0):
        hit = first(let_go(NINE, {0: rolling((1.1, 0.9), (1.0, 1.0), side)}), "rail_collision")
        vx, vy = after(hit, 0).velocity
        outs.append(math.degrees(math.atan2(vy, -vx)))
    assert max(outs) - min(outs) > 5.0
    assert outs[1] == pytest.approx(43.7, abs=0.1)


def test_balls_that_start_deep_in_a_jaw_are_not_pushed_into_each_other():
    """Seen: placed by a horn, 2e-12 m deep in its facing; put right at one stroke, it overlapped its neighbour so."""
    balls = {0: (1.207840106396312, 0.020334755384854228), 7: (1.2482512589411232, 0.060745907929665416)}
    shot = physics.Shot(0.000574827075517724, -176.5030140872976, 5.0, -16.2636204940389, 12.527145170201848)
    final = physics.simulate(NINE, physics.TableState.from_positions(balls), shot).final.positions
    assert math.dist(final[0], final[7]) > 2 * R - 1e-12


def test_a_ball_that_a_denormal_number_presses_at_a_nose_comes_to_rest():
    """Seen: 1e-316 m/s across the nose, gone before its acceleration was: the same contact for ever, EVENT_LIMIT."""
    state = physics.TableState.from_positions({0: (0.08400878543401175, 2.5124862662941307)})
    shot = physics.Shot(12.0, 360.0, 85.0, -1.8369702e-316, -1e-300)
    result = physics.simulate(NINE, state, shot)
    assert result.status is Status.AT_REST
    assert result.n_events < 6


AT_A_SEAM = {
    "pressed at the end of a nose": (
        NINE.replace(
            side_mouth=0.14,
            nose_height=0.0414,
            mu_slide=1.0,
            mu_spin=0.001,
            e_ball=1.0,
            v_max=20.0,
            theta_max=89.0,
            side_cut=95.0,
            cue_end_mass=0.0,
            mu_tip=1.0,
            e_tip=0.5,
            cushion="mathavan",
            e_cushion=0.0,
            mu_cushion=1.0,
            ball="consistent",
        ),
        {0: (1.2444647302735001, 2.4569912145659893), 9: (1.1288412145659874, 2.4563147302735002)},
        physics.Shot(20.0, -45.0, 0.0, 1.749714114281779e-15, 28.57499999999997),
    ),
    "1e-12 m/s out of a side mouth": (
        NINE.replace(cushion="factors"),
        {0: (0.02751373370596951, 0.2391776243459796), 9: (0.02751373370586951, 1.2758951620759125)},
        physics.Shot(2.19669508558424, 90.0, 0.0, 0.0, -17.17305110446029),
    ),
}


@pytest.mark.parametrize("name", AT_A_SEAM)
def test_what_sinks_at_the_seam_of_horn_and_nose_meets_the_horn(name):
    """Tried: the horn left to the nose for whatever touches the nose line; one ball of a million went through."""
    table, balls, shot = AT_A_SEAM[name]
    final = physics.simulate(table, physics.TableState.from_positions(balls), shot).final
    assert all(place is None or bool(table.contains(*place)) for place in map(final.position, range(16)))
