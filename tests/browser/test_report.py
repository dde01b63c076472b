"""The report of an event as a browser shows it (docs/tournaments.md, "Reports"): a file that asks for nothing."""

from importlib.util import find_spec
from pathlib import Path

import pytest
from support.events import by_lot, play, spec_of
from support.require import require

from tournament import NoisePlan, SprtTerms, Tournament
from tournament.report import event_report, page

WIDE, PHONE = (1200, 900), (390, 844)


@pytest.fixture(scope="module")
def reports(tmp_path_factory):
    """A table of five players at three levels, and a sequential test of two; the addresses of their files."""
    table = spec_of(5, noise=NoisePlan((0.0, 1.0, 5.0)), pairs=3)
    test = spec_of(2, pairs=40, sprt=SprtTerms(elo1=200.0))
    folder, found = tmp_path_factory.mktemp("reports"), []
    for name, spec in (("table", table), ("test", test)):
        path = folder / f"{name}.html"
        path.write_text(page(event_report(play(Tournament(spec), by_lot(3)))), encoding="utf-8")
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


def violations(shown):
    """What axe-core finds, contrast included; by the debugger, for the page's policy lets no script in."""
    spec = find_spec("axe_playwright_python")
    require(spec is not None, "axe-playwright-python, of the test extra")
    shown.evaluate((Path(spec.origin).parent / "axe.min.js").read_text())
    found = shown.evaluate("axe.run(document)")["violations"]
    return [f"{one['id']}: {[node['html'] for node in one['nodes']][:3]}" for one in found]
