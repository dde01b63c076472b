"""The report of an event as a browser shows it (docs/tournaments.md, "Reports"): a file that asks for nothing."""

from importlib.util import find_spec
from pathlib import Path

import pytest
from support.events import by_lot, play, spec_of
from support.require import require
from support.short_games import short_game

from tournament import NoisePlan, SprtTerms, Tournament
from tournament.report import event_report, page, replay, turning_points

WIDE, PHONE = (1200, 900), (390, 844)


@pytest.fixture(scope="module")
def reports(tmp_path_factory):
    """A table of five players at three levels, and a sequential test of two; the addresses of their files."""
    table = spec_of(5, noise=NoisePlan((0.0, 1.0, 5.0)), pairs=3)
    test = spec_of(2, pairs=40, sprt=SprtTerms(elo1=200.0))
    folder, found = tmp_path_factory.mktemp("reports"), []
    lines = tuple(short_game(3, 6).record())
    (folder / "game.html").write_text(replay(lines), encoding="utf-8")
    for name, spec in (("table", table), ("test", test)):
        event = play(Tournament(spec), by_lot(3))
        first = type(event.results[0]).from_dict(event.results[0].to_dict() | {"record": "game.jsonl"})
        event = Tournament(spec).with_results(first, *event.results[1:])
        data = event_report(event, moments=turning_points({"game.jsonl": lines}), replays={"game.jsonl": "game.html"})
        path = folder / f"{name}.html"
        path.write_text(page(data), encoding="utf-8")
        found.append(path.as_uri())
    return found


@pytest.mark.parametrize(("size", "scheme"), [(WIDE, "light"), (PHONE, "dark")], ids=["wide", "phone"])
def test_a_report_asks_for_nothing_complains_of_nothing_and_fits(browser, reports, size, scheme):
    context = browser.new_context(viewport={"width": size[0], "height": size[1]}, color_scheme=scheme)
    shown, faults, asked = context.new_page(), [], []
    shown.on("pageerror", lambda error: faults.append(str(error)))
    shown.on("console", lambda told: faults.append(told.text))
    shown.on("request", lambda request: asked.append(request.url))
    for address in reports:
        shown.goto(address)
        shown.locator("h1").wait_for()
        assert shown.evaluate("document.documentElement.scrollWidth") <= size[0]
        assert violations(shown) == []
        assert shown.get_by_role("img").count() >= 1
    assert faults == []
    assert asked == reports
    context.close()


def test_a_game_of_a_report_is_watched_without_a_network(browser, reports):
    context = browser.new_context(offline=True)
    shown = context.new_page()
    shown.goto(reports[0])
    shown.get_by_role("link", name="watch the game").click()
    shown.locator("#caption", has_text="1 of 6").wait_for()
    shown.get_by_role("button", name="Play").click()
    shown.wait_for_function("() => Number(document.getElementById('time').value) > 0")
    context.close()


def violations(shown):
    """What axe-core finds, contrast included; by the debugger, for the page's policy lets no script in."""
    spec = find_spec("axe_playwright_python")
    require(spec is not None, "axe-playwright-python, of the test extra")
    shown.evaluate((Path(spec.origin).parent / "axe.min.js").read_text())
    found = shown.evaluate("axe.run(document)")["violations"]
    return [f"{one['id']}: {[node['html'] for node in one['nodes']][:3]}" for one in found]
