"""Pictures of games over HTTP: for embeds, link previews, players that see."""

import re
import xml.etree.ElementTree as ElementTree

import pytest

import pictures
from physics import Shot, Table, TableState, simulate
from server.routes.page import HEADERS
from server.services.watch.previews import Preview


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


def test_a_link_to_a_game_is_shown_in_small_where_it_is_posted(server, played):
    """Open Graph (ogp.me): absolute addresses, who plays, how it stands, a picture of the same position."""
    mover, game, _entry = played
    page = server.request("GET", f"/games/{game}", headers={"Host": "pool.example"})
    view = mover.get(f"/v1/games/{game}").json()["view"]
    tags = dict(re.findall(r'<meta property="og:([\w:]+)" content="([^"]*)">', page.text))
    assert page.status_code == 200
    assert tags["title"] == " – ".join(view["players"])
    assert tags["description"] == "Game 1 of 1 · strokes so far: 1 · score 0 : 0 · olympiad table"
    assert tags["url"] == f"http://pool.example/games/{game}"
    assert tags["image"] == f"http://pool.example/v1/games/{game}/position.png"
    rest = re.sub(r"\n    <meta (property|name=.twitter).*", "", page.text)
    assert rest == server.request("GET", "/").text, "else it is the page"
    assert {name: page.headers[name] for name in HEADERS} == HEADERS
    kept = {"Host": "pool.example", "If-None-Match": page.headers["etag"]}
    again = server.request("GET", f"/games/{game}", headers=kept)
    assert again.status_code == 304
    view, version = mover.get(f"/v1/games/{game}").json()["view"], mover.get(f"/v1/games/{game}").headers["etag"]
    picture = server.request("GET", f"/v1/games/{game}/position.png")
    assert (picture.status_code, picture.headers["content-type"]) == (200, "image/png")
    assert picture.headers["etag"] == version
    state, table = TableState.from_dict(view["balls"]), Table.from_dict(view["table"])
    assert picture.content == pictures.png(state, table=table, width=800)


def test_the_link_of_a_game_that_is_over_tells_how_it_ended(server, played):
    mover, game, _entry = played
    view = mover.get(f"/v1/games/{game}").json()["view"]
    loser = mover if view["seat"] == view["turn"] else None
    conceding = loser or mover
    answer = conceding.post(f"/v1/games/{game}/concede", version=view["version"])
    assert answer.status_code == 200, answer.text
    outcome = answer.json()["view"]["outcome"]
    winner = view["players"][outcome["winner"]]
    assert f" · {winner} wins: concession · " in server.request("GET", f"/games/{game}").text


def test_a_link_to_no_game_is_the_page_without_a_picture(server):
    """The page says so itself; a problem as JSON would be no answer to somebody who followed a link."""
    answer = server.request("GET", "/games/none")
    assert (answer.status_code, answer.text) == (404, server.request("GET", "/").text)
    assert server.request("GET", "/v1/games/none/position.png").status_code == 404


def test_nothing_in_a_preview_ends_its_element():
    """An attack: the origin is whatever the asker sends as `Host`, names are whatever agents call themselves."""
    tags = Preview("g", 'a"><script>', "b'&<").tags('http://x"><script>')
    assert "<script" not in tags
    assert tags.count("<meta ") == tags.count(">") == 9


def test_games_that_nobody_sees_without_a_token_have_no_preview(own_server, table_at):
    server = own_server(POOLIAD_PUBLIC_READS="false")
    game = table_at(server).game
    answer = server.request("GET", f"/games/{game}")
    assert "og:" not in answer.text
    assert server.request("GET", f"/v1/games/{game}/position.png").status_code == 401
