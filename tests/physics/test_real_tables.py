"""Tables with jaws as values: their measures, the geometry of their mouths, what they refuse, where balls may lie."""

import dataclasses
import json
import math
import pickle
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.require import reference_data

import physics
from physics.mouths import Mouth

NINE = physics.RealTable.of_size("nine_foot")
NAMED = [physics.Table.nine_foot(), physics.Table.eight_foot(), physics.Table.seven_foot()]
R = 0.028575

CORNER = Mouth(
    in_corner=True,
    tip=0.08082230508962238,
    nose_end=0.08300878543401174,
    horn_radius=0.00635,
    facing_start=(0.07909933506569382, -0.0013461317145973153),
    facing_end=(0.015801270174213983, -0.0508),
    facing_normal=(-0.6156614753256583, 0.788010753606722),
    facing_length=0.08032639732613402,
    hole_centre=(-0.03367596045400932, -0.03367596045400932),
    hole_radius=0.0635,
    throat=0.09418841955164813,
    clearance=0.09418841955164813,
)
SIDE = Mouth(
    in_corner=False,
    tip=0.0635,
    nose_end=0.06846116372831766,
    horn_radius=0.00635,
    facing_start=(0.06229978586646508, -0.004813795962942109),
    facing_end=(0.05083413745556642, -0.0508),
    facing_normal=(-0.9702957262759965, 0.24192189559966773),
    facing_length=0.047394008642657165,
    hole_centre=(-0.0682625, 0.0),
    hole_radius=0.0635,
    throat=0.10166827491113284,
    clearance=0.10166827491113284,
)


@pytest.mark.parametrize("table", NAMED, ids=lambda table: table.name)
def test_every_named_table_has_the_mouths_of_the_wpa_bit_for_bit(table):
    """Derived by a fixed sequence: the same literals on every machine."""
    assert table.corner_shape == CORNER
    assert table.side_shape == SIDE


def test_the_literals_are_those_of_the_reference_to_1e_15():
    """``flight/nine_foot.json``; the side mouth's pairs are (U, Y) there, (s, d) = (Y, U) here."""
    reference = json.loads(reference_data("flight/nine_foot.json").read_text())
    for mouth, known, turned in ((CORNER, reference["corner"], False), (SIDE, reference["side"], True)):
        values = dataclasses.asdict(mouth) | {"horn_centre": mouth.horn_centre}
        names = {"tip": "apex", "nose_end": "nose_ends"}
        for name in ("tip", "nose_end", "horn_radius", "facing_length", "hole_radius", "throat"):
            assert abs(values[name] - known[names.get(name, name)]) <= 1e-15, name
        for name in ("horn_centre", "facing_start", "facing_end", "facing_normal"):
            pair = values[name][::-1] if turned else values[name]
            assert max(abs(a - b) for a, b in zip(pair, known[name], strict=True)) <= 1e-15, name
        assert max(abs(a - b) for a, b in zip(mouth.hole_centre, known["hole_centre"], strict=True)) <= 1e-15
    assert abs(NINE.contact_distance - reference["common"]["rho"]) <= 1e-15


def test_sizes():
    """Nose to nose, inches: 100 x 50 (WPA), 92 x 46, 78 x 39."""
    inches = [(table.length / 0.0254, table.width / 0.0254) for table in NAMED]
    assert np.allclose(inches, [(100, 50), (92, 46), (78, 39)], rtol=1e-14)
    assert NINE.foot_spot == (0.635, 0.635)
    assert NINE.head_string == 1.905


def test_the_default_laws_and_their_constants():
    assert (NINE.cushion, NINE.e_cushion, NINE.mu_cushion, NINE.ball, NINE.flight) == (
        "han",
        0.85,
        0.2,
        "alciatore",
        True,
    )
    assert (NINE.v_max, NINE.theta_max, NINE.ball_mass, NINE.cue_mass) == (12.0, 85.0, 0.170097, 0.567)
    assert (NINE.cue_end_mass, NINE.mu_tip, NINE.e_ball, NINE.mu_roll) == (0.0056699, 0.6, 0.95, 0.01)


def test_a_law_brings_its_published_constants_along():
    by_law = NINE.replace(cushion="mathavan")
    assert (by_law.e_cushion, by_law.mu_cushion) == (0.98, 0.14)
    mixed = NINE.replace(cushion="mathavan", e_cushion=0.9)
    assert (mixed.e_cushion, mixed.mu_cushion) == (0.9, 0.14)
    assert by_law.replace(e_cushion=0.9).mu_cushion == 0.14


@pytest.mark.parametrize(
    "table",
    [
        *NAMED,
        NINE.replace(cushion="mathavan"),
        NINE.replace(cushion="mathavan", e_cushion=0.85, mu_cushion=0.2),
        NINE.replace(corner_mouth=0.13, side_cut=100, v_max=8, cue_end_mass=0.0, ball="consistent"),
    ],
    ids=str,
)
def test_real_tables_survive_json_and_pickle(table):
    back = physics.Table.from_dict(json.loads(json.dumps(table.to_dict())))
    assert back == table == pickle.loads(pickle.dumps(table))
    assert back.digest == table.digest
    assert type(back) is physics.RealTable


def test_left_out_parameters_have_the_named_tables_values():
    assert physics.Table.from_dict({"name": "seven_foot"}) == physics.Table.seven_foot()
    assert physics.Table.from_dict({"name": "nine_foot", "cushion": "mathavan"}) == NINE.replace(cushion="mathavan")


OLD_FIELDS = (
    *("name", "width", "length", "corner_mouth", "side_mouth", "nose_height", "cue_length", "cue_mass", "mu_slide"),
    *("mu_roll", "mu_spin", "mu_ball", "e_ball", "cushion_parallel", "cushion_perpendicular", "cushion_spin", "v_max"),
    *("theta_max", "rack_gap", "collisions", "cue_test"),
)


@pytest.mark.parametrize(
    ("table", "digest"),
    [
        (physics.Table.olympiad(), "003525150ba1014a87d4bc5b3aaa3d10e5c124caa4d2357a090be14e4adc946a"),
        (physics.Table.fastfiz(), "9051c9d5dea35a69da427bdc9667a8dfa7a3458919a4a0ca25afd153b243761d"),
    ],
    ids=["olympiad", "fastfiz"],
)
def test_old_tables_write_what_version_0_1_0_wrote(table, digest):
    """The 21 fields and the digest of commit 8336b41."""
    assert tuple(table.to_dict()) == OLD_FIELDS
    assert table.digest == digest


@pytest.mark.parametrize(
    "change",
    [
        {"cushion": "han"},
        {"ball": "alciatore"},
        {"flight": False},
        {"e_cushion": 0.9},
        {"v_max": 12.0},
        {"corner_cut": 140.0},
    ],
    ids=str,
)
def test_old_tables_refuse_the_parameters_of_new_ones(change):
    (name,) = change
    for table in (physics.Table.olympiad(), physics.Table.fastfiz()):
        with pytest.raises(physics.InvalidTable) as caught:
            table.replace(**change)
        assert caught.value.field == name
    with pytest.raises(physics.InvalidTable):
        physics.Table.from_dict({"name": "olympiad"} | change | ({"v_max": 12.0} if name == "v_max" else {}))


def test_new_tables_refuse_collisions():
    for values in ({"collisions": "consistent"}, {"collisions": "fastfiz"}):
        with pytest.raises(physics.InvalidTable, match="collisions"):
            NINE.replace(**values)
        with pytest.raises(physics.InvalidTable, match="collisions"):
            physics.Table.from_dict({"name": "nine_foot"} | values)


def ranges():
    from physics.specifications import RANGES

    return sorted(RANGES.items())


@pytest.mark.parametrize(("name", "limits"), ranges())
def test_every_number_has_a_range(name, limits):
    for bad in (limits.low - 1e-6 - abs(limits.low) * 1e-6, limits.high * 1.001, math.nan, math.inf, "0.1", None, True):
        with pytest.raises(physics.InvalidTable) as caught:
            NINE.replace(**{name: bad})
        assert caught.value.field == name
        assert caught.value.value is bad
        assert caught.value.allowed == limits.allowed


@pytest.mark.parametrize(
    "change",
    [{"cushion": "fastfiz"}, {"cushion": None}, {"ball": "han"}, {"ball": 1}, {"flight": 1}, {"cue_test": 1}],
    ids=str,
)
def test_laws_have_names(change):
    (name,) = change
    with pytest.raises(physics.InvalidTable, match=f"{name} = .*: must be"):
        NINE.replace(**change)


@pytest.mark.parametrize(
    "change", [{"name": "eight_foot"}, {"width": 1.0}, {"length": 2.0}, {"colour": "green"}], ids=str
)
def test_size_and_name_are_fixed(change):
    with pytest.raises(physics.InvalidTable):
        NINE.replace(**change)
    with pytest.raises(physics.InvalidTable):
        physics.Table.from_dict({"name": "ten_foot"})


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"corner_cut": 155.0}, "corner_mouth"),  # the throat is 32 mm
        ({"side_cut": 125.0, "side_mouth": 0.1}, "side_mouth"),
        ({"corner_mouth": 0.09, "corner_cut": 150.0}, "corner_mouth"),
        (
            {"corner_mouth": 0.16, "corner_shelf": 0.02, "corner_hole_radius": 0.045},
            "corner_hole_radius",
        ),  # a ball would get behind a facing
        ({"side_mouth": 0.16, "side_cut": 95.0, "side_hole_radius": 0.045}, "side_hole_radius"),
        ({"side_hole_radius": 0.08}, "side_hole_radius"),  # 164 mm deep, in a rail of 139.7 mm
        ({"corner_shelf": 0.0}, "corner_shelf"),  # a ball on the bed, off the cushions, would drop
    ],
    ids=str,
)
def test_mouths_that_cannot_be_are_refused(change, field):
    with pytest.raises(physics.InvalidTable) as caught:
        NINE.replace(**change)
    assert caught.value.field == field


def distance_to_jaws(table, x, y):
    """Least distance from a point to noses, horns and facings, as a drawing of ``table.pockets`` has them, m."""
    pieces, horns = [], []
    for pocket in table.pockets:
        for jaw in pocket.jaws:
            pieces.append((jaw.facing_start, jaw.facing_end))
            horns.append((jaw.horn_centre, jaw.horn_radius))
    ends = {jaw.number: jaw.nose_end for pocket in table.pockets for jaw in pocket.jaws}
    pieces += [(ends[a], ends[b]) for a, b in ((1, 2), (3, 4), (5, 6), (7, 8), (9, 10), (11, 0))]
    point = np.array([x, y])
    nearest = [np.linalg.norm(point - np.array(centre)) - radius for centre, radius in horns]
    for start, end in ((np.array(a), np.array(b)) for a, b in pieces):
        along = np.clip((point - start) @ (end - start) / ((end - start) @ (end - start)), 0.0, 1.0)
        nearest.append(np.linalg.norm(point - start - along * (end - start)))
    return min(nearest)


@given(st.floats(-0.1, 1.4), st.floats(-0.1, 2.7))
def test_where_a_centre_may_lie_agrees_with_the_drawing(x, y):
    """Clear of every piece by rho, over no hole, and inside noses and mouths."""
    rho = NINE.contact_distance
    gap = distance_to_jaws(NINE, x, y) - rho
    over_hole = any(math.dist((x, y), pocket.hole_centre) <= pocket.hole_radius for pocket in NINE.pockets)
    inside = 0.0 <= x <= NINE.width and 0.0 <= y <= NINE.length
    if NINE.contains(x, y):
        assert gap >= -2e-9
        assert not over_hole
    elif inside and not over_hole:
        assert gap <= 1e-12


@pytest.mark.parametrize(
    ("place", "may"),
    [
        ((0.635, 1.27), True),
        ((0.0275137338, 0.6), True),
        ((0.0275, 0.6), False),
        ((0.0275, 1.27), True),  # in the side mouth, on its shelf
        ((0.0, 1.27), True),
        ((-0.004762, 1.27), True),
        ((-0.004763, 1.27), False),  # over the hole
        ((0.02, 0.02), True),  # in the jaws of a corner
        ((0.01, 0.01), False),
        ((math.nan, 1.0), False),
        ((math.inf, 1.0), False),
    ],
)
def test_places_in_the_jaws_are_on_the_table(place, may):
    assert NINE.contains(*place) is may
    assert NINE.contains(NINE.width - place[0], NINE.length - place[1]) is may


def test_arrays_of_places_are_answered_one_by_one():
    x, y = np.random.default_rng(1).uniform(-0.1, 0.2, (2, 2000))
    assert NINE.contains(x, y).tolist() == [NINE.contains(float(a), float(b)) for a, b in zip(x, y, strict=True)]


def test_pockets_describe_mouths_for_a_drawing():
    """Half turns of one another, jaws numbered round the table, mouths measured between tips."""
    for pocket, opposite in zip(NINE.pockets, [NINE.pockets[n] for n in (3, 4, 5, 0, 1, 2)], strict=True):
        turned = (NINE.width - pocket.hole_centre[0], NINE.length - pocket.hole_centre[1])
        assert turned == pytest.approx(opposite.hole_centre, abs=1e-15)
        assert [jaw.number for jaw in pocket.jaws] == [2 * pocket.number, 2 * pocket.number + 1]
        wide = NINE.corner_mouth if pocket.number in (0, 2, 3, 5) else NINE.side_mouth
        assert math.dist(*pocket.mouth) == pytest.approx(wide, abs=1e-15)
        for jaw in pocket.jaws:
            reach = math.dist(jaw.facing_start, jaw.horn_centre)
            assert reach == pytest.approx(jaw.horn_radius, abs=1e-15)
            assert math.dist(jaw.nose_end, jaw.horn_centre) == pytest.approx(jaw.horn_radius, abs=1e-15)
            across = np.array(jaw.facing_end) - jaw.facing_start
            assert across @ jaw.facing_normal == pytest.approx(0.0, abs=1e-15)
            assert (np.array(pocket.mouth).mean(axis=0) - jaw.facing_start) @ jaw.facing_normal > 0.0
        assert json.loads(json.dumps(pocket.to_dict()))["number"] == pocket.number


def test_straight_mouths_have_ends_and_no_jaws():
    pockets = physics.Table.olympiad().pockets
    assert [pocket.jaws for pocket in pockets] == [()] * 6
    assert np.allclose(pockets[1].mouth, ((0.0, 1.058), (0.0, 1.178)), atol=1e-15)
    assert math.dist(*pockets[0].mouth) == pytest.approx(0.11)
    assert {pocket.hole_radius for pocket in pockets} == {None}


def test_geometry_needs_no_compiler():
    code = (
        "import physics, sys; physics.Table.nine_foot().replace(side_cut=100.0).pockets; print('numba' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
