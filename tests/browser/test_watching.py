"""Watching: live games by the server's events, through a restart, by links; records with hostile names."""

import json
import signal
import uuid
from pathlib import Path
from typing import Any

import pytest
from support.play_along import act, next_turn, play_on


def concede(match: Any) -> None:
    seat, view = next_turn(match)
    headers = {"If-Match": f'"{view.version}"'}
    path = f"/v1/games/{view.game}/decisions"
    answer = match.server.send("POST", path, match.tokens[seat], json={"decision": "concede"}, headers=headers)
    assert answer.status_code == 200, answer.text


def test_a_live_game_is_watched_to_its_end(new_page, server):
    """Every stroke appears as it is played, with its sentence; the end with its reason and the record."""
    page = new_page(reduced_motion="reduce")  # the list waits for the picture, which does not roll
    match = server.match(names=("watched ann", "watched bob"))
    game = match.game
    page.goto(f"{server.url}/#/games/{game}")
    page.get_by_role("heading", name="watched ann – watched bob").wait_for()
    page.locator(".presence", has_text="disconnected").first.wait_for()
    for played in range(1, 7):
        assert play_on(match) == 1
        page.locator("ol.strokes li").nth(played - 1).wait_for()
    concede(match)
    page.locator(".result", has_text="wins: concession").wait_for()
    assert sorted(page.locator(".score").all_inner_texts()) == ["0", "1"]
    page.locator("ol.strokes li").nth(6).wait_for()
    assert page.locator("ol.strokes li").count() == 7
    seconds = page.locator("output.time").inner_text
    page.wait_for_function("() => document.querySelector('.row[aria-current]')")
    page.get_by_role("checkbox", name="follow the game").uncheck()
    page.locator("ol.strokes button").nth(0).click()
    page.locator(".row[aria-current]", has_text="break").wait_for()
    page.get_by_label("Speed").select_option("0.25")  # time to stop it before its end
    page.get_by_role("button", name="Play", exact=True).click()
    page.wait_for_function("() => parseFloat(document.querySelector('output.time').textContent) > 0.3")
    page.get_by_role("button", name="Pause").click()
    assert float(seconds().split()[0]) > 0.3
    with page.expect_download() as download:
        page.get_by_role("link", name="record").click()
    text = Path(download.value.path()).read_text()
    assert json.loads(text.splitlines()[0])["game"] == game


@pytest.mark.slow
def test_a_restart_of_the_server_is_survived(page, own_server, watched):
    """Killed, not stopped: the page says so, comes back by itself, and goes on after the last stroke it has."""
    watched.forgiven = ("Failed to load resource", "ERR_CONNECTION", "ERR_INCOMPLETE", "ERR_NETWORK", "ERR_EMPTY")
    match = own_server.match()
    page.goto(f"{own_server.url}/#/games/{match.game}")
    play_on(match, 2)
    page.locator("ol.strokes li").nth(1).wait_for()
    own_server.stop(signal.SIGKILL)
    page.locator(".connection", has_text="lost").wait_for()
    own_server.start()
    play_on(match, 2)
    page.locator("ol.strokes li").nth(3).wait_for()
    assert page.locator("ol.strokes li").count() == 4
    page.wait_for_function("() => document.querySelector('.connection').textContent === ''")


def test_a_link_leads_to_a_stroke(page, server):
    match = server.match()
    play_on(match, 3)
    page.goto(f"{server.url}/#/games/{match.game}/strokes/1")
    page.locator(".row[aria-current]").wait_for()
    current = page.locator("ol.strokes li").nth(1).locator("button")
    assert current.get_attribute("aria-current") == "true"
    page.locator("ul.rules li").first.wait_for()
    assert page.locator("ul.rules li").first.inner_text().startswith("R")


def test_the_lobby_shows_what_is_played_and_leads_there(page, server):
    match = server.match(names=("lobby ann", "lobby bob"), seed=None)
    page.goto(server.url)
    small = page.locator("a.thumbnail", has_text="lobby ann – lobby bob")
    small.wait_for()
    play_on(match)
    page.get_by_label("Search agents").fill("LOBBY B")
    one = page.get_by_role("region", name="Agents").get_by_role("listitem")
    page.wait_for_function("() => document.querySelectorAll('[aria-label=Agents] li').length === 1")
    assert one.inner_text().split() == ["lobby", "bob", "no", "rated", "game"]
    page.get_by_label("Search matches").fill("nobody of this name")
    page.get_by_role("region", name="Matches").get_by_text("Nothing is called “nobody of this name”.").wait_for()
    page.get_by_role("link", name="lobby bob", exact=True).click()
    page.get_by_role("table", name="Head to head, in rated games").wait_for()
    page.get_by_role("link", name="lobby ann – lobby bob").click()
    page.get_by_role("link", name="Game 1").click()
    page.get_by_role("heading", name="lobby ann – lobby bob").wait_for()
    page.locator("ol.strokes li").first.wait_for()


def test_the_first_game_of_an_empty_lobby_brings_its_match(page, own_server):
    """Seen: the game was shown, and its match only after a reload."""
    with page.expect_response("**/v1/matches?status=running*"):
        page.goto(own_server.url)
    own_server.match(names=("first ann", "first bob"))
    page.locator("a.thumbnail", has_text="first ann – first bob").wait_for()
    matches = page.get_by_role("region", name="Matches")
    matches.get_by_role("link", name="first ann – first bob").wait_for()


def test_what_agents_say_never_becomes_markup(page, server, tmp_path):
    """Names and rulings of a record are anybody's text: shown as it is, and nothing else happens."""
    match = server.match()
    play_on(match)
    concede(match)
    lines = [json.loads(line) for line in server.http.get(f"/v1/games/{match.game}/record").text.splitlines()]
    evil = '<img src=x onerror="window.caught=1"><script>window.caught=1</script>'
    lines[0]["players"] = [evil, "javascript:window.caught=1"]
    lines[1]["ruling"]["words"] = f"Player 0 {evil}"
    lines[1]["ruling"]["rules"] = [evil]
    lines[1]["action"]["decision"] = evil
    file = tmp_path / "evil.jsonl"
    file.write_text("\n".join(json.dumps(line) for line in lines))
    page.goto(server.url)
    page.get_by_label("Look at a record").set_input_files(file)
    page.locator(".sentence", has_text="<script>").wait_for()
    page.locator("h1", has_text=f"{evil} – javascript:window.caught=1").wait_for()
    assert page.locator("main img, main script").count() == 0
    assert page.evaluate("window.caught") is None
    refused = server.http.post("/v1/agents", json={"name": evil})
    assert refused.status_code == 422


def test_nothing_there_is_said(page, server, watched):
    watched.forgiven = ("404",)
    page.goto(f"{server.url}/#/matches/match_none")
    page.locator(".problem", has_text="no match").wait_for()
    page.goto(f"{server.url}/#/nowhere")
    page.get_by_text("There is nothing at /nowhere.").wait_for()


def test_a_game_there_is_not_is_asked_for_once_and_said_to_be_none(page, server, watched):
    watched.forgiven = ("404",)
    asked = []
    page.on("request", lambda request: asked.append(request.url) if "game_none" in request.url else None)
    page.goto(f"{server.url}/#/games/game_none")
    page.get_by_role("heading", name="No such game").wait_for()
    page.locator(".problem", has_text="there is no game game_none").wait_for()
    before = len(asked)
    page.wait_for_timeout(2500)  # twice the time after which a lost connection is tried again
    assert len(asked) == before <= 2
    page.get_by_role("link", name="To the lobby").click()
    page.get_by_role("heading", name="Lobby").wait_for()


def test_a_refused_stream_says_why_and_is_tried_again(new_page, own_server_for_one, watched):
    """One stream an address: a second page is told so, and comes in when the first is closed."""
    watched.forgiven = ("429",)
    match = own_server_for_one.match()
    first, second = new_page(), new_page()
    for page in (first, second):
        page.goto(f"{own_server_for_one.url}/#/games/{match.game}")
        if page is first:
            page.get_by_role("heading", level=1).filter(has_text="–").wait_for()
    second.locator(".connection", has_text="1 streams open: must be at most 1").wait_for()
    first.goto(f"{own_server_for_one.url}/#/lab")
    second.get_by_role("heading", level=1).filter(has_text="–").wait_for()
    second.wait_for_function("() => document.querySelector('.connection').textContent === ''")


def test_the_search_finds_what_no_page_has_shown_yet(page, server):
    """Names far behind the first page are found by the server, and given in pages again."""
    mark = uuid.uuid4().hex[:8]
    for number in range(25):
        server.register(f"{mark} {number:02}")
    page.goto(server.url)
    agents = page.get_by_role("region", name="Agents")
    agents.get_by_label("Search agents").fill(mark.upper())
    agents.get_by_role("link", name=f"{mark} 19").wait_for()
    page.wait_for_function("() => document.querySelectorAll('[aria-label=Agents] li').length === 20")
    agents.get_by_role("button", name="More").click()
    agents.get_by_role("link", name=f"{mark} 24").wait_for()
    assert agents.get_by_role("listitem").count() == 25
    agents.get_by_label("Search agents").fill(f"{mark} 2")
    page.wait_for_function("() => document.querySelectorAll('[aria-label=Agents] li').length === 5")


def test_unrated_games_are_marked_wherever_they_are_shown(page, server):
    """With a break or from a position; what counts is not marked, and head to head counts nothing else."""
    for rated in (True, False):
        match = server.match(rated=rated, seed=None, names=(f"rated {rated} ann", f"rated {rated} bob"))
        concede(match)
        for address in (f"matches/{match.id}", f"games/{match.game}"):
            page.goto(f"{server.url}/#/{address}")
            page.get_by_role("heading", level=1).filter(has_text=f"rated {rated} ann").wait_for()
            page.wait_for_load_state("networkidle")
            mark = page.locator(".mark", has_text="unrated")
            if not rated:
                mark.wait_for()  # the game's comes with its match
            assert mark.is_visible() is not rated
        page.goto(f"{server.url}/#/agents/{match.view['agents'][0]}")
        expected = page.get_by_role("table", name="Head to head") if rated else page.get_by_text("no rated match yet")
        expected.wait_for()
        row = page.get_by_role("region", name="Matches").get_by_role("listitem")
        row.get_by_text("finished").wait_for()
        assert row.locator(".mark").count() == (0 if rated else 1)


def test_the_turn_of_both_is_played_by_the_same_hands(server):
    """The helper of these tests does play: otherwise nothing above would be watched."""
    match = server.match()
    seat, view = next_turn(match)
    act(match, seat, view)
    assert next_turn(match)[1].version == view.version + 1
