"""A replay opened from its file, without a network."""

import json
import re

import pytest

import pictures
from physics import Shot, Table, rack, simulate
from pictures.projection import Projection

CHOOSE = """time => {
  const slider = document.getElementById("time");
  slider.step = "any";
  slider.value = time;
  slider.oninput();
}"""


@pytest.fixture
def scenes():
    table = Table.nine_foot()
    first = simulate(table, rack(table, seed=5), Shot(9.0, 269.0, 4.0, 0.0, 2.0))
    second = simulate(table, first.final.removed(), Shot(2.0, 100.0, 0.0))
    return [pictures.ReplayShot(first, "the break"), pictures.ReplayShot(second, "</script><b>& a second")]


def test_a_replay_plays_from_a_file(scenes, browser, tmp_path):
    """Balls are at their exact places at any time that is chosen; it ends where the shot ends; nothing is loaded."""
    file = tmp_path / "replay.html"
    file.write_text(pictures.html(scenes, title="A <game>"), encoding="utf-8")
    context = browser.new_context(offline=True, viewport={"width": 390, "height": 844})
    page = context.new_page()
    asked, faults = [], []
    page.on("request", lambda request: asked.append(request.url))
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.goto(file.as_uri())
    assert page.title() == "A <game>"
    assert page.inner_text("#caption") == "1 of 2: the break"
    result = scenes[0].result
    view = Projection(result.table)
    for time in (0.0, 0.37, 1.0):
        page.evaluate(CHOOSE, time)
        places = result.at(time).positions
        for ball in range(16):
            text = page.get_attribute(f"#ball-{ball}", "transform")
            x, y = map(float, text.removeprefix("translate(").removesuffix(")").split())
            assert (x, y) == pytest.approx(view.at(places[ball].tolist()), abs=0.02)
    page.click("#on")
    assert page.inner_text("#caption") == "2 of 2: </script><b>& a second"
    page.select_option("#speed", "4")
    page.click("#play")
    page.wait_for_function("document.getElementById('play').textContent === 'Play'", timeout=60_000)
    assert page.inner_text("#clock").split()[0] == f"{scenes[1].result.duration:.2f}"
    assert page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
    assert asked == [file.as_uri()]
    assert faults == []
    context.close()


def test_a_replay_is_of_one_table(scenes):
    other = simulate(Table.olympiad(), rack(Table.olympiad(), seed=1), Shot(3.0, 270.0))
    with pytest.raises(ValueError, match="2 tables"):
        pictures.html([*scenes, pictures.ReplayShot(other)])
    with pytest.raises(ValueError, match=re.escape("scenes = []: must be at least one shot")):
        pictures.html([])


def test_a_page_holds_each_shot_once(scenes):
    data = re.search(r'id="scenes">(.*?)</script>', pictures.html(scenes), re.DOTALL)
    assert data is not None
    shots = json.loads(data.group(1))
    assert [shot["caption"] for shot in shots] == ["the break", "</script><b>& a second"]
