"""The value types: tables, states, shots; what they hold, what they refuse and how they say it."""

import json
import math
import pickle
import subprocess
import sys

import numpy as np
import pytest

import physics

TABLE = physics.Table.olympiad()
R, W, L = 0.028575, 1.116, 2.236


def test_the_olympiad_table():
    """PHYSICS "Olympiad table and constants"."""
    assert (TABLE.width, TABLE.length, TABLE.ball_radius) == (W, L, R)
    assert TABLE.head_string == pytest.approx(1.677, abs=1e-15)
    assert TABLE.foot_spot == (W / 2, L / 4)
    assert (TABLE.mu_slide, TABLE.mu_roll, TABLE.mu_spin, TABLE.mu_ball, TABLE.e_ball) == (0.2, 0.015, 0.044, 0.01, 1.0)
    assert TABLE.ball_mass == 0.16301
    assert TABLE.cue_mass == 0.160 / 0.302631579


def test_mouths_are_on_the_mouth_lines():
    cp = 0.11 / math.sqrt(2)
    for pocket, (x, y) in enumerate(TABLE.mouths):
        side, end = abs(x - W / 2), abs(y - L / 2)
        if pocket in (1, 4):
            assert (side, end) == pytest.approx((W / 2 - R, 0.0), abs=1e-15)
        else:
            assert side + end == pytest.approx(W / 2 + L / 2 - cp - R, abs=1e-15)
    assert not TABLE.mouths.flags.writeable


@pytest.mark.parametrize(
    ("place", "inside"),
    [
        ((0.5, 1.0), True),
        ((R, 0.5), True),
        ((W - R, 0.5), True),
        ((0.5, L - R), True),
        ((R - 1e-8, 0.5), False),
        ((R, L / 2), False),
        ((R, L / 2 + 0.06), True),
        ((R + 1e-6, L / 2), True),
        ((R, 0.11 / math.sqrt(2)), False),
        ((R, 0.11 / math.sqrt(2) + 1e-6), True),
        ((0.04, 0.04), False),
        ((math.nan, 0.5), False),
        ((math.inf, 0.5), False),
    ],
)
def test_where_a_centre_may_lie(place, inside):
    """On a cushion line it may, on a mouth line it may not."""
    assert TABLE.contains(*place) is inside


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [
        ("mu_slide", 0.01, 1.0),
        ("mu_roll", 0.001, 0.2),
        ("mu_spin", 0.001, 1.0),
        ("mu_ball", 0.0, 1.0),
        ("e_ball", 0.8, 1.0),
        ("cushion_parallel", 0.0, 1.0),
        ("cushion_perpendicular", 0.0, 1.0),
        ("cushion_spin", 0.0, 1.0),
    ],
)
def test_ranges_of_parameters(name, low, high):
    smooth = TABLE.replace(mu_roll=0.005)
    assert getattr(smooth.replace(**{name: low}), name) == low
    assert getattr(smooth.replace(**{name: high}), name) == high
    for bad in (low - 1e-3, high + 1e-3, math.nan, math.inf, "0.1", None, True):
        with pytest.raises(physics.InvalidTable, match=name) as caught:
            TABLE.replace(**{name: bad})
        assert caught.value.field == name
        assert caught.value.value is bad
        assert str(low) in caught.value.allowed


def test_rolling_friction_stays_below_sliding_friction():
    with pytest.raises(physics.InvalidTable, match="mu_roll"):
        TABLE.replace(mu_slide=0.01)
    assert TABLE.replace(mu_slide=0.01, mu_roll=0.01).mu_roll == 0.01


@pytest.mark.parametrize("name", ["width", "length", "name", "colour"])
def test_fixed_and_unknown_parameters_are_refused(name):
    with pytest.raises(physics.InvalidTable, match=name):
        TABLE.replace(**{name: 1.0})


@pytest.mark.parametrize("table", [TABLE, physics.Table.fastfiz(), TABLE.replace(mu_slide=0.25, e_ball=0.9)], ids=str)
def test_tables_survive_json_and_pickle(table):
    assert physics.Table.from_dict(json.loads(json.dumps(table.to_dict()))) == table
    assert pickle.loads(pickle.dumps(table)) == table


def test_a_state_from_positions_and_back():
    state = physics.TableState.from_positions({0: (0.5, 1.7), 3: (0.4, 0.6)})
    assert state.balls == (0, 3)
    assert state.position(3) == (0.4, 0.6)
    assert state.position(5) is None
    assert state.positions.shape == (16, 2)
    assert np.isnan(state.positions[5]).all()
    assert not state.positions.flags.writeable
    assert physics.TableState.from_positions(state.positions) == state
    assert physics.TableState.from_dict(json.loads(json.dumps(state.to_dict()))) == state
    assert pickle.loads(pickle.dumps(state)) == state
    assert hash(physics.TableState.from_positions(state.positions)) == hash(state)


def test_states_with_a_ball_moved_or_removed():
    state = physics.TableState.from_positions({0: (0.5, 1.7), 3: (0.4, 0.6)})
    assert state.moved(3, (0.4, 0.7)).position(3) == (0.4, 0.7)
    assert state.removed(3).balls == (0,)
    assert state.position(3) == (0.4, 0.6)


def test_equality_is_by_bits():
    one = physics.TableState.from_positions({0: (0.5, 1.7)})
    assert one != physics.TableState.from_positions({0: (math.nextafter(0.5, 1), 1.7)})
    assert one != "state"


@pytest.mark.parametrize(
    "positions",
    [
        {16: (0.5, 0.5)},
        {-1: (0.5, 0.5)},
        {True: (0.5, 0.5)},
        {0: (0.5,)},
        {0: (math.nan, 0.5)},
        {0: (math.inf, 0.5)},
        {0: "here"},
        {0: (0.5, 0.5), 1: (0.55, 0.5)},
        np.zeros((15, 2)),
    ],
    ids=str,
)
def test_positions_that_cannot_be(positions):
    with pytest.raises(physics.InvalidState) as caught:
        physics.TableState.from_positions(positions)
    assert caught.value.field.startswith("positions")
    assert caught.value.allowed


def test_a_nanometre_of_overlap_counts_as_touching():
    physics.TableState.from_positions({0: (0.5, 0.5), 1: (0.5 + 2 * R - 0.9e-9, 0.5)})
    with pytest.raises(physics.InvalidState, match="overlaps ball 0"):
        physics.TableState.from_positions({0: (0.5, 0.5), 1: (0.5 + 2 * R - 1.1e-9, 0.5)})


@pytest.mark.parametrize("place", [(R - 1e-6, 0.5), (R, L / 2), (0.03, 0.03), (2.0, 0.5)])
def test_balls_off_the_table_are_refused_by_the_shot(place):
    state = physics.TableState.from_positions({0: (0.5, 1.5), 7: place})
    with pytest.raises(physics.InvalidState, match=r"positions\[7\]"):
        physics.simulate(TABLE, state, physics.Shot(1.0, 0.0, 30.0))


def test_a_shot_and_back():
    shot = physics.Shot(3.0, 270.0, 5.0, 0.5, 4.0)
    assert (shot.v, shot.phi, shot.theta, shot.a, shot.b) == (3.0, 270.0, 5.0, 0.5, 4.0)
    assert physics.Shot.from_dict(json.loads(json.dumps(shot.to_dict()))) == shot
    assert physics.Shot.from_dict({"v": 1, "phi": 2}) == physics.Shot(1.0, 2.0)


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("v", math.nan),
        ("phi", math.inf),
        ("a", math.nan),
        ("b", "4"),
        ("v", True),
        ("v", None),
    ],
)
def test_shots_that_cannot_be(field, value):
    values = {"v": 1.0, "phi": 0.0, field: value}
    with pytest.raises(physics.InvalidShot, match=field) as caught:
        physics.Shot(**values)
    assert caught.value.field == field
    assert caught.value.value is value or caught.value.value == value
    pickled = pickle.loads(pickle.dumps(caught.value))
    assert (pickled.field, pickled.allowed) == (field, caught.value.allowed)


@pytest.mark.parametrize(
    ("table", "field", "value", "allowed"),
    [
        (TABLE, "v", -0.1, "from 0 to 10 m/s"),
        (TABLE, "v", 10.1, "from 0 to 10 m/s"),
        (TABLE, "theta", -1e-9, "from 0 to 70 deg"),
        (TABLE, "theta", 70.1, "from 0 to 70 deg"),
        (physics.Table.nine_foot(), "v", 12.1, "from 0 to 12 m/s"),
        (physics.Table.nine_foot(), "theta", 85.1, "from 0 to 85 deg"),
        (physics.Table.nine_foot().replace(v_max=3.0), "v", 3.1, "from 0 to 3 m/s"),
    ],
    ids=lambda value: getattr(value, "name", value),
)
def test_the_table_knows_the_range_of_speed_and_elevation(table, field, value, allowed):
    """A shot can be written down; to play it is refused before the stroke, and ``check`` says the same words."""
    shot = physics.Shot(**{"v": 1.0, "phi": 0.0, field: value})
    state = physics.TableState.from_positions({0: (0.5, 1.0)})
    with pytest.raises(physics.InvalidShot, match=f"{field} = .*{allowed}") as caught:
        physics.simulate(table, state, shot)
    assert (caught.value.field, caught.value.value) == (field, value)
    why = physics.check(table, state, shot)
    assert why.status is physics.Status.OUT_OF_RANGE
    assert why.reason == str(caught.value)


@pytest.mark.parametrize("values", [{"v": 1.0}, {"phi": 1.0}, {"v": 1.0, "phi": 0.0, "spin": 1.0}], ids=str)
def test_shots_with_missing_or_unknown_parameters(values):
    with pytest.raises(physics.InvalidShot):
        physics.Shot.from_dict(values)


def test_what_the_package_offers():
    """The public surface (CONTRACT "Python: physics"), frozen."""
    assert {name for name in vars(physics) if name in physics.__all__} == set(physics.__all__)
    assert set(physics.__all__) >= {
        *("Table", "TableState", "Shot", "Status", "Event", "EventKind", "Facts", "Result", "Batch"),
        *("PhysicsError", "InvalidShot", "InvalidState", "InvalidTable", "rack", "check", "min_elevation"),
        *("simulate", "simulate_batch", "resume", "contact_time"),
    }


def test_importing_loads_no_compiler():
    code = "import sys, physics; print([m for m in ('numba', 'scipy', 'llvmlite') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


LOADING = """
import sys, physics
table = physics.Table.olympiad()
physics.simulate(table, physics.rack(table, seed=7), physics.Shot(9.0, 270.0, 10.0, 0.0, 0.0))
assert "numba" in sys.modules
assert not {"numba.np.arraymath", "scipy.linalg"} & set(sys.modules), "half the time that the kernels took to load"
import numba, numpy
print(numba.njit(lambda a: numpy.dot(a, a))(numpy.arange(4.0)), "scipy.linalg" in sys.modules)
"""


def test_kept_kernels_load_without_a_compiler_and_leave_it_to_others():
    """numba fills its registries, and imports scipy to see whether there is a BLAS, when something is compiled."""
    pytest.importorskip("scipy")
    done = subprocess.run([sys.executable, "-c", LOADING], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "14.0 True"
