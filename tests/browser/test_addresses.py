"""Addresses that can be sent, and players who come back: games, the laboratory, tokens (issue 17)."""

import json
import re
import uuid
from typing import Any

import pytest
from playwright.sync_api import Page
from support.play_along import play_on

import physics
from client import notation
from physics import TableState


def written(page: Page) -> dict[str, Any]:
    """What the laboratory says as JSON."""
    page.get_by_label("Format").select_option("JSON")
    found: dict[str, Any] = json.loads(page.get_by_label("Text", exact=True).input_value())
    return found


def test_the_laboratory_needs_no_name_and_its_address_is_its_state(new_page, server, foretold):
    """From a rack by a link, a shot set, and the address opened by somebody else: the same position and shot."""
    page = new_page()
    page.goto(f"{server.url}/#/lab?table=nine_foot&rack=3")
    page.get_by_text("events in").wait_for()
    rack = physics.rack(physics.Table.nine_foot(), seed=3)
    assert TableState.from_dict(written(page)["balls"]) == rack
    page.get_by_label("Direction, degrees", exact=True).fill("268.5")
    page.get_by_label("Direction, degrees", exact=True).press("Tab")
    foretold(page)
    there, other = written(page), new_page()
    page.wait_for_url(lambda url: f"shot=9,268.5,{there['shot']['theta']}," in url)  # it follows a moment later
    other.goto(page.url)
    foretold(other)
    assert written(other) == there
    assert there["table"] == "nine_foot"
    assert other.get_by_role("checkbox", name="cue as low as it can be").is_checked()
    other.goto(f"{server.url}/#/lab?balls=0:0.5,1.7+3:0.4,0.6&shot=2,264.9,5,0,0")
    other.get_by_role("button", name="Play it 200 times").click()
    other.get_by_text(re.compile("Pocketed|No ball")).wait_for()
    assert other.evaluate("sessionStorage.length + localStorage.length") == 0, "nobody was signed in"


@pytest.mark.parametrize("query", ["table=round", "balls=x", "balls=3:0.4,0.6", "shot=1,2", "rack=11"])
def test_an_address_that_cannot_be_is_said_to_be_none(page, server, query):
    """Seen: the first answer about the shot shown instead wiped the refusal out."""
    page.goto(f"{server.url}/#/lab?{query}")
    page.get_by_text("events in").wait_for()
    page.locator(".refusal", has_text=re.compile("no table|is no ball|no cue ball|no shot|no rack")).wait_for()


def test_a_stroke_is_taken_to_the_laboratory(page, server):
    match = server.match()
    play_on(match, 2)
    page.goto(f"{server.url}/#/games/{match.game}/strokes/1")
    page.locator("ul.rules li").first.wait_for()
    page.get_by_role("link", name="In the laboratory").click()
    page.get_by_text("events in").wait_for()
    entry = server.http.get(f"/v1/games/{match.game}/shots").json()["shots"][1]
    page.get_by_label("Format").select_option("Notation")
    assert notation.read(page.get_by_label("Text", exact=True).input_value()) == TableState.from_dict(entry["before"])


def test_a_player_leaves_comes_back_and_is_found(new_page, server):
    """The game's address leads its players to the table and everybody else to the game; the token is seen and kept."""
    page = new_page(reduced_motion="reduce")
    name = f"who returns {uuid.uuid4().hex[:8]}"
    page.goto(f"{server.url}/#/play")
    page.get_by_label("New here? Choose a name").fill(name)
    page.get_by_role("button", name="Begin").click()
    page.get_by_text("Your token").click()
    token = page.get_by_label("Token", exact=True).input_value()
    me = server.send("GET", "/v1/agents/me", token).json()
    assert me["name"] == name
    request = {"agents": [me["id"], server.register()["agent"]["id"]], "first_breaker": 0, "clock": {"seconds": 3600}}
    assert server.send("POST", "/v1/matches", json=request).status_code == 201
    page.wait_for_url(re.compile("#/play/game_"))
    page.get_by_role("region", name="Your turn").wait_for()
    address = page.url
    page.get_by_role("link", name="Lobby").click()
    page.get_by_role("link", name="Back to the table").click()
    page.get_by_role("region", name="Your turn").wait_for()
    again = page.context.new_page()  # the tab was closed; the device knows its player
    page.close()
    again.goto(address)
    again.get_by_role("region", name="Your turn").wait_for()
    again.goto(address.replace("/play/", "/games/"))
    again.get_by_role("link", name="To the table").click()
    again.get_by_role("region", name="Your turn").wait_for()
    other = new_page()
    other.goto(address)
    other.wait_for_url(address.replace("#/play/", "games/"))
    other.get_by_role("heading", level=1).filter(has_text=name).wait_for()
    assert not other.get_by_role("link", name="To the table").is_visible()


def test_a_link_that_was_posted_leads_to_its_game(page, server):
    """The address that the server tells of where it is posted (`test_pictures`), and that *Share* gives."""
    match = server.match(names=("posted ann", "posted bob"))
    page.goto(f"{server.url}/games/{match.game}")
    page.get_by_role("heading", name="posted ann – posted bob").wait_for()
    assert page.url == f"{server.url}/games/{match.game}", "it stays the address"
    page.get_by_text("Share and embed").click()
    assert page.get_by_label("Link", exact=True).input_value() == page.url
    page.get_by_role("link", name="Lobby").click()
    page.get_by_role("heading", name="Lobby").wait_for()
    assert page.url == f"{server.url}/#/"


def test_a_game_has_one_address_however_it_was_reached(page, server):
    """By a link within the page, an old address, back and forth; a stroke keeps its own."""
    one, other = server.match(names=("one ann", "one bob")), server.match(names=("other ann", "other bob"))
    play_on(one)
    page.goto(f"{server.url}/#/games/{one.game}")
    page.get_by_role("heading", name="one ann – one bob").wait_for()
    assert page.url == f"{server.url}/games/{one.game}"
    page.evaluate("game => { location.hash = `#/games/${game}`; }", other.game)
    page.get_by_role("heading", name="other ann – other bob").wait_for()
    assert page.url == f"{server.url}/games/{other.game}"
    page.go_back()
    page.get_by_role("heading", name="one ann – one bob").wait_for()
    assert page.url == f"{server.url}/games/{one.game}"
    page.get_by_role("link", name="Laboratory", exact=True).click()
    page.get_by_role("heading", name="Laboratory").wait_for()
    assert page.url.startswith(f"{server.url}/#/lab")
    page.go_back()
    page.get_by_role("heading", name="one ann – one bob").wait_for()
    page.go_forward()
    page.get_by_role("heading", name="Laboratory").wait_for()
    page.evaluate("game => { location.hash = `#/games/${game}/strokes/0`; }", one.game)
    page.locator("ul.rules li").first.wait_for()
    assert page.url == f"{server.url}/#/games/{one.game}/strokes/0"


def test_who_is_not_to_be_remembered_is_not(new_page, server):
    page = new_page()
    page.goto(f"{server.url}/#/play")
    page.get_by_label("New here? Choose a name").fill(f"passer-by {uuid.uuid4().hex[:8]}")
    page.get_by_role("checkbox", name="Stay signed in on this device").uncheck()
    page.get_by_role("button", name="Begin").click()
    page.get_by_text("You are").wait_for()
    assert page.evaluate("localStorage.getItem('pooliad.token')") is None
    page.get_by_role("button", name="Sign out").click()
    page.get_by_label("New here?").wait_for()
    assert page.evaluate("sessionStorage.length") == 0
