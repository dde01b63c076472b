"""What holds for every view: headers, accessibility (axe-core, WCAG 2.2 AA), 390 px, keys, both colour schemes."""

from typing import Any

import pytest
from playwright.sync_api import Page
from support.axe import violations
from support.play_along import play_on

VIEWS = ("lobby", "game", "match", "agent", "tournament", "play", "lab")


@pytest.fixture(scope="module")
def match(server):
    made = server.match()
    play_on(made, 2)
    return made


@pytest.fixture(scope="module")
def event(server):
    """A tournament under way; its id."""
    agents = {name: server.register()["agent"]["id"] for name in ("ann", "bob")}
    terms = {"name": "Cup", "entrants": list(agents), "pairs": 1, "seed": 5}
    made = server.send("POST", "/v1/tournaments", json={"terms": terms, "agents": agents}).json()
    assert server.send("POST", f"/v1/tournaments/{made['id']}/start").status_code == 200
    return made["id"]


def addresses(match: Any, event: str) -> dict[str, str]:
    return {
        "tournament": f"#/tournaments/{event}",
        "lobby": "#/",
        "game": f"#/games/{match.game}",
        "match": f"#/matches/{match.id}",
        "agent": f"#/agents/{match.view['agents'][0]}",
        "play": "#/play",
        "lab": "#/lab",
    }


def sign_in(page: Page, server: Any) -> str:
    """Into the page's tab, by the token of a fresh agent; its id."""
    made = server.register()
    page.goto(f"{server.url}/#/play")
    page.get_by_label("Or come back with your token").fill(made["token"])
    page.get_by_role("button", name="Sign in").click()
    page.get_by_text("You are").wait_for()
    return str(made["agent"]["id"])


def take_a_turn(page: Page, server: Any, agent: str) -> None:
    """At the table, with the cue ball in hand."""
    request = {"agents": [agent, server.register()["agent"]["id"]], "first_breaker": 0, "clock": {"seconds": 3600}}
    assert server.send("POST", "/v1/matches", json=request).status_code == 201
    page.goto(f"{server.url}/#/play")
    page.reload()
    page.get_by_role("region", name="Your turn").wait_for()


def show(page: Page, server: Any, match: Any, event: str, view: str) -> None:
    page.goto(f"{server.url}/{addresses(match, event)[view]}")
    page.locator("main h1").wait_for()
    ready = {
        "lobby": "a.thumbnail .names",
        "game": "ul.rules li",
        "lab": ".shot-form",
        "play": "section.panel",
        "tournament": "tbody tr",
    }
    if view in ready:
        page.locator(ready[view]).first.wait_for(state="attached")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing(new_page, server, match, event, scheme):
    page = new_page(color_scheme=scheme)
    found = {}
    page.goto(f"{server.url}/#/play")
    page.get_by_label("New here").wait_for()
    found["signed out"] = violations(page)
    agent = sign_in(page, server)
    for view in VIEWS:
        show(page, server, match, event, view)
        if view == "game":
            page.locator("summary", has_text="Events").click()
        found[view] = violations(page)
        if view == "game":
            page.evaluate("document.documentElement.classList.add('embedded')")
            found["embedded"] = violations(page)
            page.evaluate("document.documentElement.classList.remove('embedded')")
    take_a_turn(page, server, agent)
    found["turn"] = violations(page)
    page.get_by_role("button", name="Concede").click()
    page.get_by_role("button", name="Really concede?").click()
    page.get_by_role("button", name="Play again").wait_for()
    found["over"] = violations(page)
    assert [(view, *faults) for view, faults in found.items() if faults] == []
    page.evaluate("document.querySelector('main').append(document.createElement('button'))")
    assert any(fault.startswith("button-name") for fault in violations(page)), "axe looks at nothing"


def test_every_view_fits_a_phone(new_page, server, match, event):
    page = new_page(390, 844, has_touch=True, is_mobile=True)
    agent = sign_in(page, server)
    for view in (*VIEWS, "turn"):
        if view == "turn":
            take_a_turn(page, server, agent)
        else:
            show(page, server, match, event, view)
        page.wait_for_timeout(200)
        assert page.evaluate("document.documentElement.scrollWidth") <= 390, view
        small = page.evaluate(SMALL)
        assert small == [], (view, small)


SMALL = """() => [...document.querySelectorAll('main button, main select, main input')]
  .filter((one) => one.checkVisibility() && one.getBoundingClientRect().height < (one.matches('.link, .row') ? 24 : 16))
  .map((one) => one.outerHTML)"""
"""Targets too small for a finger: 24 px by WCAG 2.2, 2.5.8, but for the native slider and check box."""


def test_headers_let_nothing_else_in(server):
    for path in (
        "/",
        "/web/page.js",
        "/web/main.js",
        "/web/style.css",
        "/web/icon.svg",
        "/web/rules.json",
        "/web/named_tables.js",
    ):
        answer = server.http.get(path)
        assert answer.status_code == 200, path
        policy = answer.headers["content-security-policy"]
        assert "default-src 'none'" in policy
        assert "script-src 'self';" in policy
        assert "unsafe" not in policy
        assert answer.headers["x-content-type-options"] == "nosniff"
        again = server.http.get(path, headers={"If-None-Match": answer.headers["etag"]})
        assert (again.status_code, again.content) == (304, b"")
    for path in ("/web/none.js", "/web/..%2Fapp.py", "/web/%2e%2e/app.py"):
        assert server.http.get(path).status_code == 404


def test_a_breach_of_the_policy_is_seen(page, server, watched):
    """The other tests find none because there is none, not because nobody looks."""
    page.goto(server.url)
    with pytest.raises(Exception, match="TrustedHTML"):
        page.evaluate("document.body.innerHTML = '<b>x</b>'")
    with page.expect_console_message(lambda told: "Content Security Policy" in told.text):
        page.evaluate("fetch('http://127.0.0.1:9/').catch(() => {})")
    assert any("Content Security Policy" in fault for fault in watched.faults)
    watched.forgiven = ("",)


def test_the_game_is_worked_by_keys(page, server, match):
    page.goto(f"{server.url}/#/games/{match.game}")
    page.locator("ul.rules li").first.wait_for()
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.id") == "skip"
    page.keyboard.press("Enter")
    assert page.evaluate("document.activeElement.id") == "main"
    reached = set()
    for _ in range(40):
        page.keyboard.press("Tab")
        reached.add(
            page.evaluate("document.activeElement.getAttribute('aria-label') ?? document.activeElement.textContent")
        )
    assert {"Play", "Event before", "Next event", "Time of the stroke", "Speed", "◂ stroke"} <= reached


def test_nothing_moves_by_itself_for_who_asked_so(new_page, server):
    page = new_page(reduced_motion="reduce")
    match = server.match()
    page.goto(f"{server.url}/#/games/{match.game}")
    page.get_by_role("heading", level=1).filter(has_text="–").wait_for()
    play_on(match)
    page.locator(".row[aria-current]").wait_for()
    page.get_by_role("button", name="Play", exact=True).wait_for()
    end = float(page.get_by_label("Time of the stroke").get_attribute("max"))
    page.locator("output.time", has_text=f"{end:.2f} s").wait_for()


def test_colours_are_chosen_and_kept(page, server):
    page.goto(server.url)
    assert page.evaluate("document.documentElement.dataset.theme") == "light"
    page.get_by_role("button", name="Dark colours").click()
    page.reload()
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"


@pytest.mark.slow
def test_the_reference_of_the_interface_is_read_in_a_browser(new_page, server):
    """At /docs, on a phone, under the page's policy; `new_page` sees requests to other hosts and breaches."""
    page = new_page(390)
    page.goto(f"{server.url}/docs")
    page.get_by_role("link", name="POST /v1/simulate", exact=True).click()
    page.get_by_role("heading", name="POST /v1/simulate Simulate one shot").wait_for()
    page.locator("#post-v1-simulate").get_by_role("link", name="SimulateAnswer").click()
    page.locator("#SimulateAnswer").get_by_role("link", name="FactsView").click()
    page.locator("#FactsView").get_by_text("first_contact_cue_ball", exact=True).first.wait_for()
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert violations(page) == []
