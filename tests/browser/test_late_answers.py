"""Answers that come late: to a view that has been left, or about a stroke that is no more on the table."""

import re

import pytest
from playwright.sync_api import Page
from support.held_back import HeldBack
from support.play_along import play_on

FOR_WHAT_MUST_NOT_COME = 700
"""Milliseconds, longer than any pause of the page before it acts on an answer."""


def answered_late(page: Page, answers: HeldBack) -> None:
    """What was held back comes, and the page has time for it."""
    answers.let_go()
    page.wait_for_load_state("networkidle")
    page.wait_for_timeout(FOR_WHAT_MUST_NOT_COME)


def to_the_lobby(page: Page) -> None:
    page.get_by_role("link", name="Lobby").click()
    page.get_by_role("heading", name="Lobby").wait_for()


def is_in_the_lobby(page: Page) -> bool:
    heading = page.get_by_role("heading", name="Lobby")
    return bool(page.url.endswith("#/") and heading.is_visible())


def test_a_laboratory_that_was_left_takes_no_address(page, server):
    """Seen: left before its racks had come, it wrote its own address over that of the page shown."""
    racks = HeldBack(page, "**/web/racks.json")
    page.goto(f"{server.url}/#/lab")
    racks.wait()
    to_the_lobby(page)
    answered_late(page, racks)
    assert is_in_the_lobby(page)


@pytest.mark.parametrize("player", [True, False], ids=["player", "spectator"])
def test_a_game_that_was_left_before_it_was_there_takes_no_address(page, server, player):
    """Seen: the page sat down at a table, or led to a game, that its reader had turned away from."""
    match = server.match()
    me = {"id": match.view["agents"][0], "name": match.view["players"][0]}
    made = {"token": match.tokens[0], "agent": me} if player else server.register()
    page.goto(server.url)
    page.evaluate(
        "([token, agent]) => { sessionStorage.setItem('pooliad.token', token);"
        " sessionStorage.setItem('pooliad.agent', JSON.stringify(agent)); }",
        [made["token"], made["agent"]],
    )
    answers = HeldBack(page, re.compile(r"/v1/matches/match_\w+$"))
    page.goto(f"{server.url}/#/play" if player else f"{server.url}/#/play/{match.game}")
    answers.wait()
    to_the_lobby(page)
    answered_late(page, answers)
    assert is_in_the_lobby(page)


def test_a_stroke_without_noise_is_not_laid_over_another_one(page, server):
    match = server.match(noise={"level": 1.0})
    play_on(match, 3)
    page.goto(f"{server.url}/#/games/{match.game}/strokes/0")
    page.locator("ul.rules li").first.wait_for()
    answer = HeldBack(page, "**/v1/simulate")
    page.get_by_role("button", name="Without noise").click()
    answer.wait()
    page.get_by_role("button", name="stroke ▸").click()
    page.get_by_label("Time of the stroke").evaluate("one => { one.value = 0; one.dispatchEvent(new Event('input')); }")
    before = page.locator(".table canvas").evaluate("canvas => canvas.toDataURL()")
    answered_late(page, answer)
    assert page.locator(".table canvas").evaluate("canvas => canvas.toDataURL()") == before
    assert not page.get_by_text("is drawn in light blue").is_visible()
