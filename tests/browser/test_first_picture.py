"""The first picture of a game's page is the server's: before the script, and where the canvas will stand (issue 17)."""

import json
import time
from typing import Any

import pytest
from support.play_along import play_on

from referee.game.outcome import EndReason
from server.services.watch.page_words import ending_in_words, noise_in_words, table_in_words

PATIENCE = 300.0
SIZES = [(390, 844), (844, 390), (768, 1024), (1280, 800), (1920, 1080)]
TABLE = ".first-picture svg:visible"
ABOVE = "() => [...document.querySelectorAll('.heading, .side')].map((one) => one.innerText.trim())"
SHIFTS = """
  window.shifts = [];
  const told = ({ node, previousRect: was, currentRect: is }) =>
    `${node?.nodeName} .${node?.className}: ${JSON.stringify(was)} -> ${JSON.stringify(is)}`;
  const shifts = (list) => list.getEntries().flatMap((one) => [one.value, ...one.sources.map(told)]);
  const observer = new PerformanceObserver((list) => window.shifts.push(...shifts(list)));
  observer.observe({ type: "layout-shift", buffered: true });
"""
SHIFTED = "() => new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(() => go(window.shifts))))"
"""Layout Instability (wicg.github.io/layout-instability): parts that stand elsewhere than a frame before."""
HOLD = """
  window.begun = false;
  const frame = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (act) => window.begun ? frame(act) : (window.held ??= []).push(act);
  window.begin = () => { window.begun = true; window.held.forEach((act) => frame(act)); };
"""
"""The script waits for a frame before it draws: it is let go when the first picture has been looked at."""
CUE_BALL = """() => {
  const isSeen = (one) => one.getBoundingClientRect().height > 0;
  const svg = [...document.querySelectorAll('.first-picture svg')].find(isSeen);
  const group = svg.querySelector(':scope > g[transform]');
  const { x, y, width, height } = group.getBoundingClientRect();
  return [x + width / 2, y + height / 2, width / 2];
}"""


@pytest.fixture(scope="module")
def games(server: Any) -> dict[str, str]:
    """One that begins, one with groups and little noise, one on a table with jaws, one that is over."""
    begun = server.match(names=("ann who begins", "bob who waits for quite a while"))
    start = {
        "balls": {"0": [0.5, 1.7], "3": [0.4, 0.6], "8": [0.9, 0.4], "11": [0.2, 0.2]},
        "groups": ["solids", "stripes"],
    }
    grouped = server.match(start=start, noise={"level": 0.25})
    jaws = server.match(table={"name": "nine_foot", "mu_slide": 0.21}, clock={"seconds": 700}, noise={"level": 0.0})
    play_on(jaws, 2)
    over = server.match(noise={"level": 1.0, "told": False})
    game = over.game
    play_on(over, 1)
    view = server.http.get(f"/v1/games/{game}").json()["view"]
    seat = view["turn"]
    headers = {"If-Match": f'"{view["version"]}"'}
    answer = server.send("POST", f"/v1/games/{game}/concede", over.tokens[seat], headers=headers)
    assert answer.status_code == 200, answer.text
    end = time.monotonic() + PATIENCE
    while server.http.get(f"/games/{jaws.game}").text.count("disconnected") < 2:
        assert time.monotonic() < end, "both players have left"
        time.sleep(0.1)  # else somebody who has just polled leaves while the test looks
    return {"begun": begun.game, "grouped": grouped.game, "jaws": jaws.game, "over": game}


CASES = [*((size, "begun") for size in SIZES), *((SIZES[0], state) for state in ("grouped", "jaws", "over"))]


@pytest.mark.parametrize(("size", "state"), CASES, ids=[f"{size[0]}x{size[1]}-{state}" for size, state in CASES])
def test_the_canvas_takes_the_place_of_the_first_picture(new_page, server, games, size, state):
    """Nothing moves: the same words above, the same box, the cue ball where the server drew it."""
    page = new_page(*size, reduced_motion="reduce")
    page.add_init_script(SHIFTS + HOLD)
    page.goto(f"{server.url}/games/{games[state]}")
    page.wait_for_function("() => window.held")
    before, told = page.locator(TABLE).bounding_box(), page.evaluate(ABOVE)
    cue_ball = page.evaluate(CUE_BALL)
    assert not page.locator(".table canvas").count(), "the script has drawn nothing"
    page.evaluate("window.begin()")
    page.locator(".strokes, .table canvas").first.wait_for()
    page.wait_for_function("() => document.querySelector('.table canvas')?.style.width")
    after = page.locator(".table canvas").bounding_box()
    assert after == {side: pytest.approx(before[side], abs=1.0) for side in after}
    assert [without_clock(text) for text in page.evaluate(ABOVE)] == [without_clock(text) for text in told]
    assert page.evaluate(SHIFTED) == []
    assert page.locator(".table canvas").evaluate(MIDDLE_OF_IVORY, cue_ball) == pytest.approx(cue_ball[:2], abs=1.5)


MIDDLE_OF_IVORY = """(canvas, [x, y, radius]) => {
  const box = canvas.getBoundingClientRect();
  const scale = canvas.width / box.width;
  const size = Math.round(3 * radius * scale);
  const [left, top] = [Math.round((x - box.x) * scale - size / 2), Math.round((y - box.y) * scale - size / 2)];
  const { data } = canvas.getContext("2d").getImageData(left, top, size, size);
  const isLit = (at) => Math.min(...data.slice(4 * at, 4 * at + 3)) > 110;
  const lit = Array.from({ length: size * size }, (_, at) => at).filter(isLit);
  const mean = (of) => lit.reduce((sum, at) => sum + of(at), 0) / lit.length;
  const [column, row] = [left + mean((at) => at % size), top + mean((at) => Math.floor(at / size))];
  return [(column + 0.5) / scale + box.x, (row + 0.5) / scale + box.y];
}"""
"""The cue ball is the only thing that bright around its place; its middle may be a red dot."""


def without_clock(text: str) -> str:
    """What the server leaves to the script."""
    lines = [line for line in text.splitlines() if line.strip() and ":" not in line]
    return "\n".join(lines)


def test_without_scripts_the_position_is_seen(new_page, server, games):
    """And the table turns to fit: the style sheet does it."""
    page = new_page(java_script_enabled=False)
    page.goto(f"{server.url}/games/{games['jaws']}")
    assert page.get_by_role("heading", level=1).count() == 1
    for width, height in SIZES:
        page.set_viewport_size({"width": width, "height": height})
        assert page.locator(TABLE).count() == 1, "one of the two ways round"
        box = page.locator(TABLE).bounding_box()
        assert 0 <= box["x"] <= box["x"] + box["width"] <= width
        assert box["height"] <= max(280, 0.66 * height) + 1
        seen = min(height, box["y"] + box["height"]) - box["y"]
        assert seen >= (0.95 if width == 390 else 1.0) * box["height"], (
            "without scrolling; upright, its lower rail may be below"
        )
        assert (box["width"] > box["height"]) is (width != 390)


def test_a_frame_of_another_page_has_it_too(new_page, own_server_in_frames, embedder, watched):
    """As small as the script draws it there."""
    server, (origin, folder) = own_server_in_frames, embedder
    watched.forgiven = (origin, "favicon", "404")
    game = server.match().game
    (folder / "page.html").write_text(
        f'<!doctype html><title>x</title><iframe src="{server.url}/games/{game}" width="720" height="560"></iframe>'
    )
    boxes = []
    for scripts, what in ((False, TABLE), (True, ".table canvas")):
        around = new_page(java_script_enabled=scripts)
        around.goto(f"{origin}/page.html")
        inside = around.frame_locator("iframe").locator(what)
        inside.wait_for()
        assert not around.frame_locator("iframe").locator("header.bar").is_visible()
        boxes.append(inside.bounding_box())
    assert boxes[1] == {side: pytest.approx(boxes[0][side], abs=1.0) for side in boxes[1]}


def test_server_and_script_say_the_same(page, server):
    """Names of tables, what is otherwise than there, noise, endings."""
    page.goto(server.url)
    tables = [server.http.get(f"/v1/tables/{name}").json()["table"] for name in TABLES]
    tables += [tables[0] | {"mu_slide": 0.3, "length": 2.3}, tables[2] | {"e_cushion": 0.7}]
    levels = [None, 0, 1, 0.5, 0.123456789, 2.0]
    endings = [{"winner": winner, "reason": str(reason)} for reason in EndReason for winner in (0, 1, None)]
    said = page.evaluate(
        """async ([tables, levels, endings]) => {
          const { describeTable } = await import("/web/tables.js");
          const { describeNoise, describeOutcome } = await import("/web/words.js");
          const noises = levels.map((level) => describeNoise({ level }));
          return [tables.map(describeTable), noises, endings.map((one) => describeOutcome(one, ["a", "b"]))];
        }""",
        json.loads(json.dumps([tables, levels, endings])),
    )
    assert said[0] == [table_in_words(table) for table in tables]
    assert said[1] == [noise_in_words(level) for level in levels]
    assert said[2] == [ending_in_words(ending, ["a", "b"]) for ending in endings]


TABLES = ("olympiad", "fastfiz", "nine_foot", "eight_foot", "seven_foot")
