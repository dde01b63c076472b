"""At the table: it and what plays on it share one screen at every size; hands, lines; no stroke told before its end.

Issue 17, "The page, playing" and "Measured": structure, not pixels.
"""

from typing import Any

import pytest
from playwright.sync_api import Page, expect
from support.axe import violations
from support.play_along import Match, act, next_turn

SIZES = ((390, 844), (844, 390), (768, 1024), (1280, 800), (1920, 1080))
START: dict[str, Any] = {
    "balls": {"0": [0.56, 1.7], "8": [0.9, 0.3], "2": [0.56, 1.1], "5": [0.9, 1.2], "9": [0.2, 1.1], "12": [0.95, 0.6]},
    "groups": ["solids", "stripes"],
}
"""Ball 2 stands straight before the cue ball."""
BOXES = """async (width) => {
  const boxes = () => Object.fromEntries([["table", ".table canvas"], ["shoot", "button.shoot"], ["dock", ".dock"]].map(
    ([name, which]) => [name, document.querySelector(which).getBoundingClientRect().toJSON()]));
  const frame = () => new Promise((go) => requestAnimationFrame(go));
  while (innerWidth !== width) await frame();
  for (let same = 0, last = ""; same < 3; last = JSON.stringify(boxes())) { // laid out anew, however long that takes
    await frame();
    same = JSON.stringify(boxes()) === last ? same + 1 : 0;
  }
  return boxes();
}"""
FRAME, WIDTH, LENGTH = 0.11, 1.116, 2.236


def seated(page: Page, server: Any, **terms: Any) -> Match:
    """At the table, in a match that is the same every time; the page's player has seat 0 and begins."""
    me, other = server.register(), server.register()
    page.goto(server.url)
    page.evaluate(
        "([token, agent]) => { sessionStorage.setItem('pooliad.token', token);"
        " sessionStorage.setItem('pooliad.agent', JSON.stringify(agent)); }",
        [me["token"], me["agent"]],
    )
    agents = [me["agent"]["id"], other["agent"]["id"]]
    request = {"agents": agents, "seed": "d" * 64, "noise": {"level": 0.0}, "first_breaker": 0}
    made = server.send("POST", "/v1/matches", json=request | {"clock": {"seconds": 3600}} | terms)
    assert made.status_code == 201, made.text
    page.goto(f"{server.url}/#/play")
    page.get_by_role("region", name="Your turn").wait_for()
    # What comes to the board later could move the table: the other is away, and the page has found its own player.
    expect(page.locator(".presence", has_text="disconnected")).to_have_count(1, timeout=60_000)
    page.locator(".clock.running").wait_for()
    return Match(server, made.json(), [me["token"], other["token"]])


def on_the_table(page: Page, x: float, y: float) -> tuple[float, float]:
    """The pixel of a place of the Olympiad's table, upright or lying."""
    box = page.locator(".table canvas").bounding_box()
    assert box is not None
    if box["width"] > box["height"]:
        scale = box["width"] / (LENGTH + 2 * FRAME)
        right, down = LENGTH - y, WIDTH - x
    else:
        scale = box["width"] / (WIDTH + 2 * FRAME)
        right, down = x, LENGTH - y
    return box["x"] + (FRAME + right) * scale, box["y"] + (FRAME + down) * scale


def shot_of(page: Page) -> dict[str, float]:
    """What the numbers say."""
    fields = page.locator(".numbers .number-field input[type=number]")
    return {
        str(field["name"]): float(field["value"])
        for field in fields.evaluate_all("all => all.map(({ name, value }) => ({ name, value }))")
    }


@pytest.mark.parametrize("in_hand", [True, False], ids=["ball in hand", "call"])
def test_table_and_shoot_are_on_one_screen_at_every_size(new_page, server, in_hand):
    """Before: on a phone's screen one aimed, and scrolled two screens down to shoot."""
    page = new_page(*SIZES[0], has_touch=True, reduced_motion="reduce")
    seated(page, server, **({} if in_hand else {"start": START}))
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        boxes = page.evaluate(BOXES, width)
        assert page.evaluate("[scrollX, scrollY]") == [0, 0]
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        for name in ("table", "shoot"):
            box = boxes[name]
            assert box["top"] >= 0 <= box["left"], (width, name, box)
            assert box["right"] <= width, (width, name, box)
            assert box["bottom"] <= height, (width, name, box)
        table, dock, shoot = boxes["table"], boxes["dock"], boxes["shoot"]
        assert table["right"] <= dock["left"] or table["bottom"] <= dock["top"], (width, boxes)
        assert dock["top"] <= shoot["top"], (width, boxes)
        assert shoot["bottom"] <= dock["bottom"], (width, boxes)
        assert shoot["height"] >= 40, (width, boxes)
        assert table["width"] * table["height"] > 0.2 * width * height, (width, boxes)
        middle = page.evaluate(
            "([x, y]) => document.elementFromPoint(x, y).className",
            [(shoot["left"] + shoot["right"]) / 2, (shoot["top"] + shoot["bottom"]) / 2],
        )
        assert "shoot" in middle, (width, middle)
        upright = table["height"] > table["width"]
        assert upright is (width == 390), "the table turns to fit"


def test_the_turn_is_accessible_on_a_phone_with_the_spin_open(new_page, server):
    page = new_page(390, 844, has_touch=True, is_mobile=True, reduced_motion="reduce")
    seated(page, server, start=START)
    page.get_by_role("button", name="Spin and elevation").click()
    page.locator("details.numbers summary").click()
    assert violations(page) == []


def test_spin_elevation_and_fine_aim_are_at_hand(new_page, server):
    """By touch over the table, by strip and by key; a cue raised by hand is no more as low as it can be."""
    page = new_page(390, 844, has_touch=True, reduced_motion="reduce")
    seated(page, server, start=START)
    before = shot_of(page)
    strip = page.get_by_role("slider", name="Fine aim")
    box = strip.bounding_box()
    page.mouse.move(box["x"] + 100, box["y"] + 10)
    page.mouse.down()
    page.mouse.move(box["x"] + 150, box["y"] + 10, steps=5)
    page.mouse.up()
    assert shot_of(page)["phi"] == pytest.approx(before["phi"] - 1.0, abs=1e-3)
    strip.press("Shift+ArrowLeft")
    assert shot_of(page)["phi"] == pytest.approx(before["phi"] - 0.99, abs=1e-3)
    page.get_by_role("button", name="Spin and elevation").tap()
    sheet = page.get_by_role("group", name="Where the tip strikes")
    ball = sheet.locator("svg").bounding_box()
    page.touchscreen.tap(ball["x"] + ball["width"] / 2, ball["y"] + ball["height"] * 0.7)
    shot = shot_of(page)
    assert shot["b"] < -8
    assert abs(shot["a"]) <= 0.5
    lowest = sheet.get_by_role("checkbox", name="as low as the cue can be")
    assert lowest.is_checked()
    sheet.get_by_label("Cue raised").fill("30")
    assert not lowest.is_checked()
    assert shot_of(page)["theta"] == 30
    sheet.get_by_role("button", name="Done").tap()
    assert not sheet.is_visible()


def test_the_cue_is_pulled_back_and_let_go(new_page, server):
    """Pushed forward again, nothing is played; let go, the speed is what the pull said."""
    page = new_page(390, 844, has_touch=True, reduced_motion="reduce")
    match = seated(page, server, start=START)
    strokes = page.locator("ol.strokes li")
    x, y = on_the_table(page, *START["balls"]["0"])
    before = shot_of(page)["v"]
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, y - 90, steps=4)
    page.get_by_text("Let go to shoot at").wait_for()
    pulled = shot_of(page)["v"]
    assert 1.0 < pulled < 6.0
    page.mouse.move(x, y - 3, steps=4)
    page.get_by_text("nothing is played").wait_for()
    page.mouse.up()
    assert shot_of(page)["v"] == before
    page.mouse.move(x, y - 20)  # the cue itself
    page.mouse.down()
    page.mouse.move(x, y - 110, steps=4)
    assert shot_of(page)["v"] == pytest.approx(pulled)
    page.mouse.up()
    strokes.first.wait_for()
    (stroke,) = server.http.get(f"/v1/games/{match.game}/shots").json()["shots"]
    assert stroke["shot"]["v"] == pytest.approx(pulled, abs=1e-3)
    assert stroke["shot"]["phi"] == pytest.approx(270.0)


COLOURS = """async () => {
  const canvas = document.querySelector(".table canvas");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const near = ([r, g, b]) => {
    let count = 0;
    for (let at = 0; at < data.length; at += 4) {
      if (Math.abs(data[at] - r) + Math.abs(data[at + 1] - g) + Math.abs(data[at + 2] - b) < 24) count += 1;
    }
    return count;
  };
  return { struck: near([255, 192, 77]), cueBall: near([155, 215, 255]) };
}"""


def test_the_lines_are_the_servers_or_geometry_where_simulations_are_counted(new_page, server):
    """Seen: the page simulated as often as it liked in games whose terms give a budget of simulations."""
    for budget in (None, 5):
        page = new_page(1280, 800, reduced_motion="reduce")
        asked: list[str] = []
        page.on("request", lambda request, asked=asked: asked.append(request.url.rpartition("/v1/")[2]))
        terms = {} if budget is None else {"clock": {"seconds": 3600, "simulations": 5}}
        seated(page, server, start=START, **terms)
        with page.expect_request("**/v1/simulate" if budget is None else "**/v1/min-elevation"):
            page.locator(".table canvas").press("ArrowRight")
            page.locator(".table canvas").press("ArrowRight")
        page.wait_for_timeout(600)
        lines = page.evaluate(COLOURS)
        assert lines["struck"] > 30, lines
        assert lines["cueBall"] > 10, lines
        assert ("simulate" in asked) is (budget is None)


def test_an_earlier_stroke_is_looked_at_without_a_stroke_by_mistake(new_page, server):
    """Replaying does not compete with shooting: while another stroke is on the table there is a way back alone."""
    page = new_page(1280, 800, reduced_motion="reduce")
    match = seated(page, server, start=START)
    page.get_by_role("button", name="Shoot").click()
    page.locator("ol.strokes li").first.wait_for()
    while (turn := next_turn(match)) is not None and turn[0] != 0:
        act(match, *turn)
    page.get_by_role("region", name="Your turn").wait_for()
    assert page.get_by_role("button", name="Play", exact=True).count() == 0
    replay = page.get_by_role("button", name="Replay").evaluate("one => getComputedStyle(one).backgroundColor")
    assert replay != page.get_by_role("button", name="Shoot").evaluate("one => getComputedStyle(one).backgroundColor")
    page.locator("ol.strokes button").first.click()
    page.get_by_role("button", name="Back to your shot").wait_for()
    assert not page.get_by_role("button", name="Shoot", exact=True).is_visible()
    page.get_by_role("button", name="Back to your shot").click()
    page.get_by_role("button", name="Shoot", exact=True).wait_for()


def test_nothing_is_told_of_a_stroke_that_still_rolls(page, server):
    """List, sentence, clocks and result wait for the picture; held back here by a slow replay."""
    match = server.match(start=START, noise={"level": 0.0}, rated=False)
    page.goto(f"{server.url}/#/games/{match.game}")
    page.get_by_role("heading", level=1).filter(has_text="–").wait_for()
    page.locator(".side.turn").wait_for()
    page.get_by_label("Speed").select_option("0.1")
    mover = page.locator(".side.turn .name").inner_text()
    for played in (1, 2):
        turn = next_turn(match)
        assert turn is not None
        seat, view = turn
        body: dict[str, Any] = {
            "shot": {"v": 3.0, "phi": 270.0, "theta": 5.0, "a": 0.0, "b": 0.0},
            "call": "safety",
            "cue_ball": None,
        }
        if view.cue_ball_area:
            body["cue_ball"] = [0.56, 1.9]
        path, headers = f"/v1/games/{view.game}/shots", {"If-Match": f'"{view.version}"'}
        answer = server.send("POST", path, match.tokens[seat], json=body, headers=headers)
        assert answer.status_code == 200, answer.text
        if played == 1:
            page.locator("ol.strokes li").first.wait_for()
    page.wait_for_timeout(500)
    assert page.locator("ol.strokes li").count() == 1, "the second has been played, but not been seen"
    assert page.locator("ol.strokes .tag").count() == 0
    assert page.locator(".sentence").inner_text().endswith("plays: safety …")
    assert page.locator("ul.rules li").count() == 0
    assert page.locator(".side.turn .name").inner_text() == mover
    slider = page.get_by_label("Time of the stroke")
    slider.evaluate("slider => { slider.value = slider.max; slider.dispatchEvent(new Event('input')); }")
    page.locator("ul.rules li").first.wait_for()
