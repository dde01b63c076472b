"""Pictures of games over HTTP: for embeds, link previews, players that see."""

import re
import time
import xml.etree.ElementTree as ElementTree

import pytest

import pictures
from physics import Shot, Table, TableState, simulate
from server.routes.page import HEADERS
from server.services.watch.first_picture import drawn
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
    rest = re.sub(r'<article class="game">.*</article>', "", rest).replace(' aria-current="page"', "")
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


def test_the_first_answer_of_a_games_page_has_the_balls_where_they_lie(server, played):
    """Both ways round, to a tenth of a millimetre; who plays, and how it stands."""
    mover, game, _entry = played
    view = mover.get(f"/v1/games/{game}").json()["view"]
    page = server.request("GET", f"/games/{game}").text
    table, state = Table.from_dict(view["table"]), TableState.from_dict(view["balls"])
    for upright, name in ((False, "lying"), (True, "upright")):
        picture = ElementTree.fromstring(re.search(rf'<svg class="{name}".*?</svg>', page)[0])
        svg = "{http://www.w3.org/2000/svg}"
        moved = [one.get("transform") for one in picture.findall(f"{svg}g[@transform]")]
        places = [tuple(map(float, re.fullmatch(r"translate\((\S+) (\S+)\)", text).groups())) for text in moved]
        frame, length, width = 0.11, table.length, table.width
        xy = [state.positions[ball].tolist() for ball in state.balls]
        expected = [
            (1000 * (frame + x), 1000 * (frame + length - y))
            if upright
            else (1000 * (frame + length - y), 1000 * (frame + width - x))
            for x, y in xy
        ]
        assert places == [pytest.approx(each, abs=0.051) for each in expected]
    for player in view["players"]:
        assert page.count(f'<strong class="name">{player}</strong>') == 1
    assert "<span>noise " in page or "<span>no noise" in page


def presence(page):
    """What a game's page says of who is there: it changes when a player has not polled for long."""
    return re.findall(r'<span class="presence">(.*?)</span>', page.text)


def test_the_first_answer_is_kept_while_nothing_is_played(server, played, monkeypatch):
    """Clocks run meanwhile: what they show is left to the script."""
    mover, game, _entry = played
    again = server.request("GET", f"/games/{game}")
    while again.status_code == 200:
        before, tag = again, again.headers["etag"]
        time.sleep(1.1)
        again = server.request("GET", f"/games/{game}", headers={"If-None-Match": tag})
        assert (again.status_code, again.text) == (304, "") or presence(again) != presence(before)
    view = mover.get(f"/v1/games/{game}").json()["view"]
    loser = mover if view["seat"] == view["turn"] else None
    assert (loser or mover).post(f"/v1/games/{game}/concede", version=view["version"]).status_code == 200
    after = server.request("GET", f"/games/{game}", headers={"If-None-Match": tag})
    assert after.status_code == 200
    assert '<p class="result">' in after.text
    assert '<p class="result"></p>' not in after.text


def test_nothing_in_a_first_picture_ends_its_element():
    """An attack: names are what agents call themselves."""
    evil = '"><script>'
    view = {
        "players": [evil, evil], "number": 0, "games": 1, "match": evil, "table": Table.olympiad().to_dict(),
        "noise": {"level": None}, "balls": {"0": [0.5, 0.5]}, "groups": None, "score": [0, 0],
    }  # fmt: skip
    clock = {"seconds_left": 60.0}
    events = {
        "game": {"view": view},
        "clocks": {"turn": None, "clocks": [clock, clock]},
        "result": {"score": [0, 1], "record": evil, "outcome": {"winner": 0, "reason": evil}},
    }
    assert "<script" not in drawn(events, rated=False)


def test_nothing_in_a_preview_ends_its_element():
    """An attack: the origin is whatever the asker sends as `Host`, names are whatever agents call themselves."""
    tags = Preview("g", 'a"><script>', "b'&<").tags('http://x"><script>')
    assert "<script" not in tags
    assert tags.count("<meta ") == tags.count(">") == 9


def test_games_that_nobody_sees_without_a_token_have_no_preview(own_server, table_at):
    server = own_server(POOLIAD_PUBLIC_READS="false")
    game = table_at(server).game
    answer = server.request("GET", f"/games/{game}")
    assert (answer.status_code, answer.text) == (404, server.request("GET", "/").text), "no word of it, no ball"
    assert server.request("GET", f"/v1/games/{game}/position.png").status_code == 401
