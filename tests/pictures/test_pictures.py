"""Pictures: to scale, whole in themselves, saying nothing by colour alone."""

import math
import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest

import pictures
from physics import RealTable, Result, Shot, Table, TableState, min_elevation, rack, simulate, simulate_batch
from physics.constants import BALL_RADIUS, N_BALLS
from pictures.projection import MM, Projection
from pictures.theme import BALLS, ink_of
from pictures.tracks import tracks

SVG = "{http://www.w3.org/2000/svg}"
TABLES = [Table.olympiad(), Table.nine_foot(), Table.seven_foot()]
BREAK = Shot(9.0, 268.5, 4.0, 1.0, 3.0)


def broken(table: Table, seed: int = 3) -> Result:
    return simulate(table, rack(table, seed=seed), BREAK)


def root_of(text: str) -> ElementTree.Element:
    return ElementTree.fromstring(text)


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.name)
@pytest.mark.parametrize("theme", pictures.THEMES)
@pytest.mark.parametrize("upright", [False, True])
def test_a_picture_is_one_well_formed_document_that_needs_nothing_else(table, theme, upright):
    for shown in (table, rack(table, seed=1), broken(table)):
        text = pictures.svg(shown, table=table, theme=theme, upright=upright)
        root = root_of(text)
        assert root.tag == f"{SVG}svg"
        assert root.find(f"{SVG}title").text == pictures.described(shown)
        assert not re.search(r"href|url\(|<style|<script|font|\bid=", text), "it stands alone beside any other picture"
        assert "nan" not in text


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.name)
def test_a_picture_is_to_scale(table):
    """The bounds are those of rails; a ball is where its position says, as large as it is."""
    view = Projection(table)
    state = TableState.from_positions({5: (0.3, 0.9)})
    root = root_of(pictures.svg(state, table=table))
    width, height = map(float, root.attrib["viewBox"].split()[2:])
    assert width - height == pytest.approx((table.length - table.width) * MM, abs=0.2)
    (drawn,) = [group for group in root.iter(f"{SVG}g") if group.attrib.get("transform", "").startswith("translate(")]
    x, y = map(float, re.findall(r"[-\d.]+", drawn.attrib["transform"]))
    assert (x, y) == pytest.approx(view.at((0.3, 0.9)), abs=0.06)
    radii = {float(circle.attrib["r"]) for circle in drawn.iter(f"{SVG}circle")}
    assert radii == {round(BALL_RADIUS * MM, 1)}


def test_a_picture_is_turned_and_never_mirrored():
    """Three places that turn left in the table's frame turn left in either picture."""
    for upright in (False, True):
        view = Projection(Table.olympiad(), upright)
        (x0, y0), (x1, y1), (x2, y2) = map(view.at, ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)))
        assert (x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0) < 0.0, "y grows downwards in a picture"
    assert Projection(Table.olympiad()).at((0.5, 2.0))[0] < Projection(Table.olympiad()).at((0.5, 0.2))[0], (
        "head string on the left"
    )


@pytest.mark.parametrize("name", ["nine_foot", "seven_foot"])
def test_jaws_are_drawn_where_they_are(name):
    """Every end of a nose, facing and horn of `Table.pockets` is a corner of a cushion's outline."""
    table = Table.named(name).replace(horn_radius=0.012)
    assert isinstance(table, RealTable)
    text = pictures.svg(table)
    view = Projection(table)
    for pocket in table.pockets:
        for jaw in pocket.jaws:
            for point in (jaw.nose_end, jaw.facing_start, jaw.facing_end):
                x, y = (f"{value:.1f}".removesuffix(".0") for value in view.at(point))
                assert f"{x} {y}" in text
    assert text.count("A12 12 0 0 ") == 12, "twelve horns"


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.name)
def test_tracks_are_where_the_balls_are(table):
    """A Bezier curve between events is the parabola of a constant acceleration: equal to `result.at(t)`."""
    result = broken(table)
    followed = tracks(result)
    for time in np.linspace(0.0, result.duration, 200).tolist():
        snapshot = result.at(time)
        for track in followed:
            gone = track.pocketed if track.left is None else track.left
            if gone is None or time < gone:
                assert track.at(time) == pytest.approx(snapshot.positions[track.ball].tolist(), abs=1e-9)
            else:
                assert math.isnan(snapshot.positions[track.ball, 0])
    assert {track.ball for track in followed} == set(range(N_BALLS))


def test_a_ball_driven_off_the_table_is_drawn_to_where_it_leaves_and_no_farther():
    table = Table.nine_foot().replace(cue_test=False)
    state = TableState.from_positions({0: (0.3, 1.0), 3: (0.9, 1.2)})
    result = simulate(table, state, Shot(6.0, 180.0, 40.0))
    cue_ball, three = tracks(result)
    assert cue_ball.left == result.events.of("off_table")[0].time
    assert not cue_ball.stays
    assert three.stays
    assert cue_ball.end[0] == pytest.approx(-table.rail_width, abs=1e-9)
    times = np.linspace(0.0, cue_ball.left, 50)[:-1]
    positions, heights = result.paths(times)
    assert heights[:, 0].max() > 0.06
    for time, there in zip(times.tolist(), positions[:, 0].tolist(), strict=True):
        assert cue_ball.at(time) == pytest.approx(there, abs=1e-9)
    drawn = pictures.svg(result)
    assert drawn.count("translate(") == pictures.svg(state, table=table).count("translate("), (
        "faint, and not at the end"
    )


def test_a_pocketed_ball_leads_into_its_hole_and_is_not_drawn_at_the_end():
    table = Table.nine_foot()
    state = TableState.from_positions({0: (0.635, 1.6), 4: (0.635, 2.1), 9: (0.2, 0.2)})
    x, y = table.mouths[3].tolist()
    phi = math.degrees(math.atan2(y - 2.1, x - 0.635))
    corner = state.moved(0, (0.635 - 0.3 * math.cos(math.radians(phi)), 2.1 - 0.3 * math.sin(math.radians(phi))))
    result = simulate(table, corner, Shot(2.0, phi, min_elevation(table, corner, phi)))
    assert result.facts.pocket[4] == 3
    (four,) = [track for track in tracks(result) if track.ball == 4]
    assert four.pocketed is not None
    centre = table.pockets[3].hole_centre
    x, y = (f"{value:.1f}".removesuffix(".0") for value in Projection(table).at(centre))
    assert f"L{x} {y}" in pictures.svg(result)
    numbers = pictures.svg(result).count("translate(")
    assert pictures.svg(result.final, table=table).count("translate(") < numbers


def test_a_number_has_contrast_with_its_ball():
    """WCAG 2.2, 1.4.3: at least 4.5 between ink and ball, so that colour is never what tells balls apart."""

    def luminance(colour):
        parts = [int(colour[place : place + 2], 16) / 255 for place in (1, 3, 5)]
        linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    for ball in range(1, 9):
        dark, light = sorted((luminance(BALLS[ball]), luminance(ink_of(ball))))
        assert (light + 0.05) / (dark + 0.05) >= 4.5, ball


def test_call_cue_and_variants_are_drawn():
    table = Table.olympiad()
    state = TableState.from_positions({0: (0.5, 1.7), 3: (0.4, 0.6)})
    shot = Shot(2.0, 264.8, 5.0, 3.0, 0.0)
    plain = pictures.svg(state)
    assert len(pictures.svg(state, call=(3, 0))) > len(plain)
    assert len(pictures.svg(state, shot=shot)) > len(plain)
    shots = np.array([[2.0, 264.8 + 0.1 * n, 5.0, 0.0, 0.0] for n in range(20)])
    batch = simulate_batch(table, state, shots)
    text = pictures.svg(simulate(table, state, shot), variants=batch)
    assert text.count('r="9"') >= 20


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"theme": "sepia"}, "theme = 'sepia': must be one of"),
        ({"call": (0, 3)}, "call.ball = 0: must be an integer from 1 to 15"),
        ({"call": (3, 6)}, "call.pocket = 6: must be an integer from 0 to 5"),
        ({"width": 0}, "width = 0: must be a positive number of pixels"),
        ({"width": math.nan}, "width = nan: must be"),
    ],
)
def test_what_cannot_be_drawn_is_refused(options, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        pictures.svg(Table.olympiad(), **options)


def test_a_result_without_events_has_no_picture():
    table = Table.olympiad()
    result = simulate(table, rack(table, seed=1), BREAK, trace=False)
    with pytest.raises(ValueError, match="no trace"):
        pictures.svg(result)
    assert result._repr_svg_() is None


def test_notebooks_draw_tables_positions_and_results():
    table = Table.nine_foot()
    result = broken(table)
    assert table._repr_svg_() == pictures.svg(table)
    assert result._repr_svg_() == pictures.svg(result)
    assert result.final.valid_on(table)._repr_svg_() == pictures.svg(result.final, table=table)


def test_a_title_cannot_end_the_document():
    text = pictures.svg(Table.olympiad(), title="</title><script>alert(1)</script>")
    assert root_of(text).find(f"{SVG}title").text == "</title><script>alert(1)</script>"


def test_png_has_the_width_asked_for():
    data = pictures.png(broken(Table.olympiad()), width=700)
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    assert int.from_bytes(data[16:20], "big") == 700
    assert len(set(data)) > 100, "something is drawn"


def test_docs_name_every_theme():
    text = (Path(__file__).parents[2] / "docs" / "pictures.md").read_text(encoding="utf-8")
    assert all(f"`{theme}`" in text for theme in pictures.THEMES)
