"""Watching on: the next game, chances to win, games in a frame of another page (issue 17, "The page, watching")."""

import json
from typing import Any

import pytest
from support.axe import violations
from support.play_along import Match, act, next_turn, play_on

from referee.game import Game
from tournament.luck import VALUE

CHANCES = """async ([games, noise]) => {
  const { chanceOfFirst } = await import("/web/chances.js");
  const { weights } = await (await fetch("/web/value.json")).json();
  return games.map((game) => chanceOfFirst(weights, game, noise));
}"""


def concede(match: Match) -> None:
    turn = next_turn(match)
    assert turn is not None
    seat, view = turn
    headers = {"If-Match": f'"{view.version}"'}
    path = f"/v1/games/{view.game}/concede"
    answer = match.server.send("POST", path, match.tokens[seat], headers=headers)
    assert answer.status_code == 200, answer.text


def test_the_next_game_follows_by_itself(new_page, server):
    """For whoever follows; the result of the one before is shown meanwhile."""
    page = new_page(reduced_motion="reduce")
    match = server.match(games=2, names=("follow ann", "follow bob"))
    first = match.game
    page.goto(f"{server.url}/#/games/{first}")
    page.get_by_text("Game 1 of 2").wait_for()
    concede(match)
    page.locator(".result", has_text="wins: concession").wait_for()
    page.get_by_text("Game 2 of 2").wait_for()
    assert match.game != first
    assert page.url.endswith(match.game)


def test_chances_are_those_of_the_luck_report(page, server):
    """The same numbers, whatever the state; over a game that was played, in a picture with its name."""
    match = server.match(noise={"level": 0.5})
    game = match.game
    play_on(match, 10)
    concede(match)
    lines = server.http.get(f"/v1/games/{game}/record").text.splitlines()
    entries = [one for one in map(json.loads, lines) if "entry" in one]
    states = [one["game"] for one in entries]
    variants: list[dict[str, Any]] = [
        state | {"groups": groups, "turn": turn, "cue_ball_in_hand": area, "phase": "play"}
        for state in states
        if state["phase"] == "play"
        for groups in (None, ["solids", "stripes"], ["stripes", "solids"])
        for turn in (0, 1)
        for area in (None, "anywhere", "kitchen")
    ]
    games = states + variants
    page.goto(server.url)
    shown = page.evaluate(CHANCES, [games, 0.5])
    truth = [VALUE(Game.from_dict(game), 0, 0.5) for game in games]
    assert len(games) > 50
    assert shown == pytest.approx(truth, abs=1e-12)
    page.goto(f"{server.url}/#/games/{game}")
    figure = page.get_by_role("figure").filter(has_text="the value that the luck report uses")
    figure.wait_for()
    label = figure.get_by_role("img").get_attribute("aria-label")
    assert label.endswith(f"over {len(entries)} strokes; now {round(100 * truth[len(states) - 1])} %"), label
    assert violations(page) == []


def test_the_curve_begins_where_the_game_did(page, server):
    """Seen: opened later, it began with how the game stood by then. From a position, in a second game."""
    start = {
        "balls": {"0": [0.5, 1.7], "3": [0.4, 0.6], "8": [0.9, 0.4], "11": [0.2, 0.2]},
        "groups": ["solids", "stripes"],
    }
    match = server.match(start=start, games=2, noise={"level": 0.0})
    for _ in range(2):
        turn = next_turn(match)
        assert turn is not None
        first = VALUE(turn[1].to_game(), 0, 0.0)
        act(match, *turn)
        page.goto(f"{server.url}/#/games/{match.game}")
        line = page.locator(".chances .line")
        line.wait_for(state="attached")
        end = float(line.get_attribute("points").split()[0].partition(",")[2])
        assert end == pytest.approx(100 * (1 - first), abs=0.01)
        concede(match)


def test_strokes_that_changed_the_chances_are_marked_wherever_they_are_listed(page, server):
    """The curve, its buttons and the list of strokes tell the same change; the lobby has the best one's picture."""
    match = server.match(noise={"level": 0.0}, seed="7" * 64)
    game = match.game
    play_on(match, 40)
    if match.server.http.get(f"/v1/matches/{match.id}").json()["status"] == "running":
        concede(match)
    lines = server.http.get(f"/v1/games/{game}/record").text.splitlines()
    entries = [one for one in map(json.loads, lines) if "entry" in one]
    states = [json.loads(lines[0])["start"], *(one["game"] for one in entries)]
    chances = [VALUE(Game.from_dict(state), 0, 0.0) for state in states]
    gains = {
        place: (chances[place + 1] - chances[place]) * (1 if entries[place]["seat"] == 0 else -1)
        for place in range(len(entries))
        if "decision" not in entries[place]["action"]
    }
    marked = sorted(gains, key=lambda place: -abs(gains[place]))[:8]
    marked = sorted(place for place in marked if abs(gains[place]) >= 0.08)
    assert marked, "seed 7: somebody pots, and somebody fouls"
    page.goto(f"{server.url}/#/games/{game}")
    buttons = page.locator(".chances .marks button")
    buttons.nth(len(marked) - 1).wait_for()
    told = [f"{'+' if gains[place] > 0 else '−'}{round(100 * abs(gains[place]))} %" for place in marked]
    assert [text.rpartition(" ")[0].split()[2].strip(",") for text in buttons.all_inner_texts()] == [*map(str, marked)]
    assert [" ".join(text.split()[-2:]) for text in buttons.all_inner_texts()] == told
    listed = page.locator("ol.strokes li").filter(has=page.locator("[title^='Change of']"))
    assert listed.count() == len(marked)
    assert page.locator(".chances .swing").count() == len(marked)
    ends = {place for place in range(len(entries)) if entries[place]["game"]["outcome"] is not None}
    made = [place for place in gains if place and entries[place]["ruling"]["made"] and place not in ends]
    best = max(made, key=lambda place: gains[place])
    (stroke,) = [one for one in server.http.get("/v1/best-strokes").json()["strokes"] if one["game"] == game]
    assert stroke["number"] == best
    assert stroke["after"] - stroke["before"] == pytest.approx(gains[best], abs=1e-12)


def test_a_game_is_shown_in_a_frame_of_those_who_may(new_page, own_server_in_frames, embedder, watched):
    """And acts for nobody there: a page around it could lead clicks astray."""
    server, (origin, folder) = own_server_in_frames, embedder
    watched.forgiven = (origin, "favicon", "404")
    match = server.match(names=("framed ann", "framed bob"))
    page = new_page()
    page.goto(f"{server.url}/#/games/{match.game}")
    page.get_by_text("Share and embed").click()
    frame = page.get_by_label("Frame for another page").input_value()
    assert f'<iframe src="{server.url}/games/{match.game}"' in frame
    (folder / "page.html").write_text(f"<!doctype html><title>x</title>{frame}")
    around = new_page()
    around.goto(f"{origin}/page.html")
    inside = around.frame_locator("iframe")
    inside.get_by_role("heading", level=1).filter(has_text="framed ann").wait_for()
    inside.locator(".table canvas").wait_for()  # the heading is in the page before the script has begun
    assert not inside.locator("header.bar").is_visible()
    table, around_it = inside.locator(".table canvas").bounding_box(), around.locator("iframe").bounding_box()
    assert table["y"] + table["height"] <= around_it["y"] + around_it["height"], "seen without scrolling"
    assert inside.locator("body").evaluate("async () => (await import('/web/api.js')).token()") is None
    policy = server.http.get("/").headers["content-security-policy"]
    assert f"frame-ancestors {origin};" in policy
    assert "frame-ancestors 'none'" in server.http.get("/docs").headers["content-security-policy"]


def test_nobody_shows_it_in_a_frame_unless_allowed_to(server):
    assert "frame-ancestors 'none'" in server.http.get("/").headers["content-security-policy"]


def test_a_lobby_shows_last_games_and_the_ladder_when_nothing_is_played(new_page, own_server):
    """Issue 17: a lobby that looks alive when nothing happens; ratings of a standing server, and who is there."""
    match = own_server.match(names=("rated ann", "rated bob"), seed=None)
    concede(match)
    page = new_page()
    page.goto(own_server.url)
    page.get_by_role("region", name="Last games").get_by_text("wins: concession").wait_for()
    picture = page.get_by_role("region", name="Last games").locator("img")
    picture.scroll_into_view_if_needed()
    page.wait_for_function("() => document.querySelector('[aria-label=\"Last games\"] img').naturalWidth > 0")
    rungs = own_server.http.get("/v1/ladder").json()["rungs"]
    assert [one["games"] for one in rungs] == [1, 1]
    ladder = page.get_by_role("table", name="after 1 rated game")
    rows = ladder.get_by_role("row")
    rows.nth(2).wait_for()
    for place, one in enumerate(rungs, 1):
        assert rows.nth(place).get_by_role("rowheader").inner_text().startswith(one["name"])
        assert f"{one['ordinal']:.1f}" in rows.nth(place).inner_text()
    assert violations(page) == []
    agents = page.get_by_role("region", name="Agents").get_by_role("listitem")
    first = agents.filter(has_text=rungs[0]["name"])
    first.get_by_text(f"rating {rungs[0]['ordinal']:.1f}").wait_for()
    first.get_by_text("1 rated game").wait_for()
    ladder.get_by_role("link", name=rungs[0]["name"]).click()
    page.get_by_text("Rung 1 of 2").wait_for()
    page.get_by_text("1 rated game", exact=True).wait_for()
