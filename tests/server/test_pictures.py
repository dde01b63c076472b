"""Pictures of games over HTTP: for embeds, link previews, players that see."""

import xml.etree.ElementTree as ElementTree

import pytest

import pictures
from physics import Shot, Table, TableState, simulate


@pytest.fixture
def played(new_table):
    """A game with one stroke: its mover, and the stroke as the history has it."""
    table = new_table()
    mover, view = table.mover()
    assert mover.act(view, {"shot": {"v": 8, "phi": 269, "theta": 5, "a": 0, "b": 2}, "call": None}).status_code == 200
    (entry,) = mover.get(f"/v1/games/{view['game']}/shots").json()["shots"]
    return mover, view["game"], entry


def test_the_position_is_drawn_as_it_lies(played):
    mover, game, _entry = played
    answer = mover.get(f"/v1/games/{game}/position.svg")
    view = mover.get(f"/v1/games/{game}")
    assert (answer.status_code, answer.headers["content-type"]) == (200, "image/svg+xml")
    assert answer.headers["etag"] == view.headers["etag"]
    assert answer.headers["content-security-policy"] == "default-src 'none'"
    state = TableState.from_dict(view.json()["view"]["balls"])
    assert answer.text == pictures.svg(state, table=Table.from_dict(view.json()["view"]["table"]))


def test_a_stroke_is_drawn_as_it_was_played(played):
    """With its noise: the picture is that of the shot that the history tells."""
    mover, game, entry = played
    answer = mover.get(f"/v1/games/{game}/shots/0.svg", theme="light", upright="true")
    shot = Shot.from_dict(entry["shot"])
    result = simulate(Table.olympiad(), TableState.from_dict(entry["before"]), shot)
    drawn = pictures.svg(result, shot=shot, theme="light", upright=True)
    assert answer.text == drawn
    ElementTree.fromstring(answer.text)


@pytest.mark.parametrize("number", ["1", "-1", "x", "9" * 30, "0x0", "%C2%B2"])
def test_there_is_no_picture_of_what_was_not_played(played, number):
    mover, game, _entry = played
    answer = mover.get(f"/v1/games/{game}/shots/{number}.svg")
    assert (answer.status_code, answer.json()["code"]) == (404, "not_found")


def test_nor_of_a_game_that_is_not_there(new_player):
    assert new_player().get("/v1/games/none/position.svg").status_code == 404
    assert new_player().get("/v1/games/none/shots/0.svg").status_code == 404


def test_a_theme_that_is_not_there_is_refused(played):
    mover, game, _entry = played
    answer = mover.get(f"/v1/games/{game}/position.svg", theme="<script>")
    problem = answer.json()
    assert (answer.status_code, problem["code"], problem["field"]) == (422, "invalid", "theme")
    assert (problem["value"], problem["allowed"]) == ("<script>", "one of dark, light")


@pytest.mark.parametrize("address", ["position.svg", "shots/0.svg"])
@pytest.mark.parametrize("value", ["maybe", "null", "1", ""])
def test_a_flag_that_is_none_is_refused_as_everything_is(played, address, value):
    """The framework's own refusal was JSON of another shape, which no client of ours reads."""
    mover, game, _entry = played
    answer = mover.get(f"/v1/games/{game}/{address}", upright=value)
    problem = answer.json()
    assert (answer.status_code, answer.headers["content-type"]) == (422, "application/problem+json")
    assert (problem["code"], problem["field"], problem["allowed"]) == ("invalid", "upright", "true or false")
