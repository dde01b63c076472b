"""Balls in the air on tables that fly: launches, landings, noses, rails, holes (docs/physics.md, eq. 43-50).

Numbers named FLIGHT are from the design's tables, worked out apart from this engine.
"""

import json
import math
from typing import Any

import numpy as np
import pytest
from support.moving import Launch, after, first, let_go
from support.require import reference_data

import physics
from physics.status import Status

FLYING = physics.Table.nine_foot().replace(flight=True, cue_test=False)
FLAT = FLYING.replace(flight=False)
R, G = FLYING.ball_radius, 9.81
HALF_X, HALF_Y = 0.5 * FLYING.width, 0.5 * FLYING.length


def jumps() -> dict[str, Any]:
    return dict(json.loads(reference_data("flight/jumps.json").read_text()))


@pytest.fixture(scope="module")
def jump_table() -> physics.RealTable:
    """With the mass ratio and the laws that jumps.json names, and a cue without end mass."""
    wanted = jumps()["parameters"]
    table = FLYING.replace(ball_mass=0.18, cue_mass=0.6, cue_end_mass=0.0, e_strike=0.5, e_cloth=0.5, mu_slide=0.2)
    assert abs(table.ball_mass / table.cue_mass - float(wanted["mass_ratio"])) < 1e-15
    assert (str(table.e_strike), str(table.mu_slide)) == (wanted["e_strike"], wanted["mu_cloth"])
    return table


def jump(table: physics.Table, v: float, theta: float, balls: dict[int, tuple[float, float]], **options: Any) -> Any:
    """A stroke up the table, along +y, through the ball's centre."""
    state = physics.TableState.from_positions({0: (0.6, 0.3)} | balls)
    high = 1e3 * R * math.sin(math.radians(theta))
    return physics.simulate(table, state, physics.Shot(v, 90.0, theta, 0.0, high), **options)


def along_x(vector: tuple[float, ...]) -> tuple[float, ...]:
    """Turned from +y to +x."""
    return vector[1], -vector[0], *vector[2:]


def test_launches_and_first_landings(jump_table):
    """jumps.json, to 1e-13 of 25 digits: velocity and spin, flight time, apex, range, after the first landing."""
    launches = jumps()["launches"]
    for case in launches:
        result = jump(jump_table, float(case["V"]), float(case["theta_deg"]), {}, event_limit=2)
        strike, landing = result.events[:2]
        up, down = strike.states[0], landing.states[0]
        assert landing.kind == "landing"
        assert (*along_x(up.velocity), up.velocity_z) == pytest.approx([float(x) for x in case["v"]], abs=1e-13)
        assert along_x(up.spin) == pytest.approx([float(x) for x in case["w"]], abs=1e-11)
        assert landing.time == pytest.approx(float(case["flight_time"]), abs=1e-14)
        assert down.position[1] - up.position[1] == pytest.approx(float(case["range"]), abs=1e-14)
        apex = result.at(up.velocity_z / G).heights[0]
        assert apex == pytest.approx(float(case["apex_above_cloth"]), abs=1e-14)
        assert (*along_x(down.velocity), down.velocity_z) == pytest.approx(
            [float(x) for x in case["v_after_first_landing"]], abs=1e-13
        )
        assert along_x(down.spin) == pytest.approx([float(x) for x in case["w_after_first_landing"]], abs=1e-11)
    assert len(launches) >= 8


def clears(table: physics.Table, v: float, theta: float, distance: float) -> bool:
    """Whether the first flight goes over a ball so far off."""
    result = jump(table, v, theta, {1: (0.6, 0.3 + distance)}, event_limit=2)
    down = result.events[1]
    return down.kind == "landing" and down.states[0].position[1] > 0.3 + distance


def test_least_cue_speeds_that_clear_a_ball(jump_table):
    """jumps.json, to 1e-9 m/s; where it says that no speed does, none of 40 does."""
    for case in jumps()["clearing"]:
        theta, distance = float(case["theta_deg"]), float(case["blocker_distance"])
        if case["least_cue_speed"] is None:
            assert not any(clears(jump_table, float(v), theta, distance) for v in np.linspace(0.1, 4.0, 40))
            continue
        low, high = 0.5, 3.5
        assert clears(jump_table, high, theta, distance)
        while high - low > 1e-11:
            middle = 0.5 * (low + high)
            low, high = (low, middle) if clears(jump_table, middle, theta, distance) else (middle, high)
        assert abs(high - float(case["least_cue_speed"])) < 1e-9, case


def airborne(position: tuple[float, float], velocity: tuple[float, float, float], height: float = 0.0) -> Launch:
    return Launch(position, velocity[:2], height=height, velocity_z=velocity[2])


def test_a_flight_is_a_parabola():
    """Straight in plan, a parabola upwards, the spin as it is; and ``at`` says so at any time."""
    spin = (3.0, -40.0, 12.0)
    launch = Launch((0.4, 0.7), (0.5, 0.3), spin, height=0.02, velocity_z=1.5)
    result = let_go(FLYING, {0: launch})
    lasts = (1.5 + math.sqrt(1.5**2 + 2 * G * 0.02)) / G
    assert first(result, "landing").time == pytest.approx(lasts, abs=1e-15)
    for t in np.linspace(0.0, 0.999 * lasts, 7):
        there = result.at(float(t))
        assert there.positions[0] == pytest.approx([0.4 + 0.5 * t, 0.7 + 0.3 * t], abs=1e-15)
        assert there.heights[0] == pytest.approx(0.02 + 1.5 * t - 0.5 * G * t * t, abs=1e-15)
        assert there.vertical_velocities[0] == pytest.approx(1.5 - G * t, abs=1e-14)
        assert there.spins[0].tolist() == list(spin)
        assert there.motion[0] == physics.Motion.FLYING


def test_paths_are_the_numbers_of_at():
    result = jump(FLYING, 4.0, 50.0, {1: (0.61, 0.9)})
    times = np.linspace(0.0, result.duration, 40)[::-1]
    positions, heights = result.paths(times)
    for n, t in enumerate(times.tolist()):
        there = result.at(t)
        here = ~np.isnan(there.positions[:, 0])
        assert np.array_equal(positions[n], there.positions, equal_nan=True)
        assert np.array_equal(heights[n][here], there.heights[here])
        assert np.isnan(heights[n][~here]).all()
    assert (heights[:, 0] > 0.02).sum() > 3
    with pytest.raises(ValueError, match="must be in"):
        result.paths([result.duration + 1.0])


def test_the_last_hops_do_not_matter():
    """The plastic last landing leaves the friction of the hops that are left out: the place stays to 1e-9 m.

    One ball lands with 2 m/s upon e_cloth 0.5 and slips all the while; the hops of a LIFT of 0.05 m/s and those down to
    1e-6 m/s, done here by hand with the same law, end in the same place at the same speed.
    """
    table = FLYING.replace(mu_slide=0.1)
    start = Launch((0.2, 0.5), (0.8, 0.0), (0.0, -150.0, 0.0), height=0.0, velocity_z=2.0)
    result = let_go(table, {0: start})
    time, x, vx, wy, vz = 0.0, 0.2, 0.8, -150.0, 2.0
    while vz > 1e-12:
        flight = 2.0 * vz / G
        time, x = time + flight, x + vx * flight
        push = 0.1 * 1.5 * vz
        vx, wy, vz = vx - push, wy + 2.5 / R * push, 0.5 * vz
    slip = vx - R * wy
    assert slip > 0.5
    until = time + 0.2
    there = result.at(until)
    assert there.motion[0] == physics.Motion.SLIDING
    expected = x + vx * 0.2 - 0.5 * 0.1 * G * 0.04
    assert abs(there.positions[0, 0] - expected) < 1e-9
    assert abs(there.velocities[0, 0] - (vx - 0.1 * G * 0.2)) < 1e-9
    assert len([e for e in result.events if e.kind == "landing"]) == 6


@pytest.mark.parametrize(
    ("height", "v_z", "v_x"),
    [
        (0.0, -1.220, -2.208),
        (0.005, -0.444, -2.508),
        (0.00771525, 0.0, -2.550),
        (0.012, 0.696, -2.444),
        (0.020, 1.822, -1.683),
    ],
)
def test_a_nose_throws_up_or_down_by_the_height_at_which_it_is_met(height, v_z, v_x):
    """FLIGHT Part II, 8: 3 m/s without spin, e 0.85, mu 0.2."""
    up = max(math.sqrt(2 * G * 1e-6), 1e-3)  # so as to be in the air, hardly rising
    launch = airborne((FLYING.width - R - 1e-5, 0.8), (3.0, 0.0, up if height == 0.0 else 0.0), height)
    state = after(first(let_go(FLYING, {0: launch}), "rail_collision"), 0)
    assert (state.velocity[0], state.velocity_z) == pytest.approx((v_x, v_z), abs=6e-3)


def test_a_ball_just_above_the_cloth_rebounds_as_one_on_it():
    """A pressed landing is frictionless: a hop of 0.1 mm into the rail ends as a ball on the cloth does, to 1e-3 m/s.

    By an unpressed landing the stun ball of 3 m/s would have 1.964 m/s left of 2.208 (FLIGHT Part II, 2.6).
    """
    for spin in (0.0, 3.0 / R):
        on_cloth = let_go(FLAT, {0: Launch((FLYING.width - 0.0276, 0.8), (3.0, 0.0), (0.0, spin, 0.0))})
        hop = let_go(FLYING, {0: Launch((FLYING.width - 0.0276, 0.8), (3.0, 0.0), (0.0, spin, 0.0), height=1e-4)})
        assert [e.kind.value for e in hop.events[:2]] == ["rail_collision", "landing"]
        landed = hop.events[1].states[0]
        assert landed.velocity_z == 0.0
        assert landed.velocity == pytest.approx(after(first(on_cloth, "rail_collision"), 0).velocity, abs=1e-2)


def test_a_flat_shot_on_a_flying_table_has_the_bits_of_a_flat_table():
    """Rolling and sliding balls, cushions, jaws, balls hit with friction: the same trace, byte for byte."""
    rng, compared = np.random.default_rng(6), 0
    for _ in range(12):
        places = {0: (0.6, 1.9)}
        for ball in range(1, 6):
            places[ball] = (float(rng.uniform(0.1, 1.1)), 0.2 + 0.25 * ball)
        state = physics.TableState.from_positions(places)
        shot = physics.Shot(float(rng.uniform(1, 6)), float(rng.uniform(240, 300)), 0.0, float(rng.uniform(-8, 8)), 0.0)
        one, two = (physics.simulate(table.replace(cue_end_mass=0.0), state, shot) for table in (FLAT, FLYING))
        if "landing" in [event.kind.value for event in two.events]:
            continue  # the side spin of a level cue does not lift; a draw would
        assert one._trace.tobytes() == two._trace.tobytes()
        assert one.final == two.final
        compared += len(one.events)
    assert compared > 100


@pytest.mark.parametrize("offset", [0.0, 1e-12, 0.01, 2 * R - 1e-12])
@pytest.mark.parametrize("speed", [0.0, 0.01, -0.01])
def test_a_ball_that_falls_on_another_meets_it(offset, speed):
    """Plan projections overlap and do not approach: the filter of the cloth would drop the pair (FLIGHT Part II, 0)."""
    above = 0.12
    launch = airborne((0.6 + offset, 1.0), (speed, 0.0, 0.0), above)
    result = let_go(FLYING, {1: Launch((0.6, 1.0)), 2: launch}, event_limit=2)
    hits = result.events.of("ball_collision")
    if offset + speed * 0.11 > 2 * R:  # it falls past
        assert not hits
        return
    x, z = offset + speed * hits[0].time, above - 0.5 * G * hits[0].time ** 2
    assert abs(math.hypot(x, z) - 2 * R) < 1e-15


def test_into_the_side_pocket_from_the_air():
    """FLIGHT Part II: 5 m/s, 5 mm up, through the west mouth: pocketed by the liner, not over the rail's outer edge."""
    result = let_go(FLYING, {0: airborne((0.1, HALF_Y), (-5.0, 0.0, 0.0), 0.005)})
    assert result.facts.pocket[0] == 1
    assert result.facts.off_table[0] == -1


def test_nothing_gets_behind_a_facing():
    """FLIGHT Part II, 2.10: from (-44, -24) mm along (-14, 86), past the upper facing's end: the liner catches it."""
    start = (-0.044, HALF_Y - 0.024)
    way = np.array([-14.0, 86.0]) / math.hypot(14.0, 86.0)
    result = let_go(FLYING, {0: airborne(start, (2.0 * way[0], 2.0 * way[1], 0.0), 0.02)})
    assert result.facts.pocket[0] == 1


def test_a_hole_is_entered_from_above():
    """A ball that comes down over the hole drops at the instant it would land; one that clips its front flies on."""
    hole = FLYING.pockets[0].hole_centre
    down = let_go(FLYING, {0: airborne((hole[0] + 0.01, hole[1]), (0.0, 0.0, 0.0), 0.05)})
    event = first(down, "pocket_collision")
    assert event.time == pytest.approx(math.sqrt(2 * 0.05 / G), abs=1e-15)
    assert event.other == 0
    over = let_go(FLYING, {0: airborne((0.3, 0.3), (-2.0, -2.0, 1.2), 0.3)})
    assert over.facts.off_table[0] >= 0 or over.facts.pocket[0] == 0


def test_a_ball_over_the_rail_bounces_on_its_top_and_may_come_back():
    """Slow over the east nose, high: it falls on the rail's top, bounces, and its event names the rail; no foul yet."""
    launch = Launch((FLYING.width - 0.02, 0.8), (0.3, 0.0), (0.0, 80.0, 0.0), height=0.12)
    result = let_go(FLYING, {1: launch})
    top = first(result, "rail_top")
    assert top.other == 1
    assert after(top, 1).height == FLYING.nose_height
    assert result.facts.cushion[1] == top.index
    back = Launch((FLYING.width + 0.06, 0.8), (-0.35, 0.0), height=0.1)
    returned = let_go(FLYING, {1: back})
    kinds = [event.kind.value for event in returned.events]
    assert "rail_top" in kinds
    assert returned.facts.off_table[1] == -1
    assert returned.final.position(1) is not None


def test_a_ball_driven_over_the_outer_edge_is_off_the_table():
    result = let_go(FLYING, {3: airborne((1.1, 0.8), (4.0, 0.0, 1.0), 0.1)})
    event = first(result, "off_table")
    assert event.states[0].position[0] == pytest.approx(FLYING.width + FLYING.rail_width, abs=1e-12)
    assert event.states[0].motion is physics.Motion.DRIVEN_OFF
    assert result.facts.off_table[3] == event.index
    assert result.final.position(3) is None
    assert result.facts.pocket[3] == -1
    assert result.status is Status.AT_REST


def test_a_shot_that_is_cut_short_leaves_no_ball_in_the_air():
    """At the limit of events a flying ball is off the table, with an event that says so: the rest is a legal start."""
    result = jump(FLYING, 4.0, 60.0, {1: (0.9, 0.9)}, event_limit=1)
    assert result.status is Status.EVENT_LIMIT
    assert result.events[-1].kind == "off_table"
    assert result.facts.off_table[0] == result.events[-1].index
    assert result.final.balls == (1,)


def test_a_frozen_ball_struck_down_along_the_rail_leaves_it():
    """Cloth first, then, now rising, the nose in the same instant: it is turned outward (FLIGHT Part II, 2.1)."""
    rho = FLYING.contact_distance
    state = physics.TableState.from_positions({0: (rho, 0.8)})
    result = physics.simulate(FLYING, state, physics.Shot(3.0, 90.0, 60.0, 0.0, 20.0))
    kinds = [event.kind.value for event in result.events[:2]]
    assert kinds == ["cue_strike", "rail_collision"]
    out = result.events[1].states[0]
    assert out.velocity[0] > 0.0
    assert result.facts.cushion[0] == -1  # it was frozen to that cushion


def test_by_default_no_rail_hit_lifts_a_ball_and_e_pressed_does():
    launch = {0: Launch((0.9, 0.8), (6.0, 0.0))}
    assert not let_go(FLYING, launch).events.of("landing")
    hopping = let_go(FLYING.replace(e_pressed=0.3), launch)
    hit = after(first(hopping, "rail_collision"), 0)
    assert hit.motion is physics.Motion.FLYING
    assert 0.2 < hit.velocity_z < 1.0
    assert hopping.events.of("landing")


def test_a_stacked_ball_comes_down_or_is_off_the_table():
    """Exactly above another, at rest on it: it bounces, and it ends; perched counts as off the table (WPA 8.5)."""
    result = let_go(FLYING, {1: Launch((0.6, 1.0)), 2: airborne((0.6, 1.0), (0.0, 0.0, 0.0), 2 * R + 0.01)})
    assert result.status is Status.AT_REST
    assert result.facts.off_table[2] >= 0
    leaning = let_go(FLYING, {1: Launch((0.6, 1.0)), 2: airborne((0.601, 1.0), (0.0, 0.0, 0.0), 2 * R + 0.01)})
    assert leaning.status is Status.AT_REST
    assert leaning.facts.off_table[2] == -1
    assert leaning.final.position(2) is not None


MISPLACED = [
    ({0: airborne((0.6, 1.0), (0.0, 0.0, math.nan), 0.1)}, "vertical_velocities"),
    ({0: airborne((0.6, 1.0), (0.0, 0.0, 0.0), -0.1)}, "heights"),
    ({0: airborne((0.02, 1.0), (0.0, 0.0, 0.0), 0.005)}, "positions"),
    ({0: airborne((3.0, 1.0), (0.0, 0.0, 0.0), 0.5)}, "positions"),
    ({0: airborne((0.6, 1.0), (0.0, 0.0, 0.0), 0.05), 1: Launch((0.6, 1.0))}, "overlaps"),
]


@pytest.mark.parametrize(("launches", "said"), MISPLACED, ids=lambda value: value if isinstance(value, str) else "")
def test_snapshots_that_cannot_be_are_refused(launches, said):
    with pytest.raises(physics.InvalidState, match=said):
        let_go(FLYING, launches)


def test_a_table_that_does_not_fly_refuses_flying_balls():
    for table in (FLAT, physics.Table.olympiad()):
        with pytest.raises(physics.InvalidState, match="do not fly"):
            let_go(table, {0: airborne((0.6, 1.0), (0.0, 0.0, 0.0), 0.05)})


@pytest.mark.parametrize(
    ("name", "value"), [("e_cloth", 0.95), ("e_strike", -0.1), ("e_pressed", 0.6), ("e_rail", math.nan), ("flight", 1)]
)
def test_parameters_of_flight_have_ranges(name, value):
    with pytest.raises(physics.InvalidTable, match=name):
        physics.Table.nine_foot().replace(**{name: value})


def test_states_tell_heights_only_where_balls_fly():
    one = jump(FLYING, 3.0, 40.0, {}).events[0].states[0].to_dict()
    assert one["height"] == 0.0
    assert one["velocity_z"] > 1.0
    assert "height" not in jump(FLAT, 3.0, 40.0, {}).events[0].states[0].to_dict()
