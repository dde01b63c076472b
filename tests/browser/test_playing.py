"""Playing by hand: the page's own controls, against another player and against a house bot; the laboratory."""

import json
import re
import subprocess
import sys
import time
import tomllib
import uuid
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Page
from support.held_back import HeldBack
from support.play_along import Match, act
from support.players import Potter
from support.require import ROOT

import physics
from client import notation
from physics import RealTable, Table
from physics.table_file import read_table, write_table
from protocol import View
from referee.record import verify_record

FRAME = 0.11
"""Width of the frame drawn around the cushion noses, m."""
PATIENCE = 150_000
"""Milliseconds for a turn to come; a bot starts and thinks meanwhile."""


class Hand:
    """Somebody at the page: thinks like a `Potter`, and works the controls."""

    def __init__(self, page: Page, server: Any) -> None:
        self.page, self.server = page, server
        self.potter = Potter("hand")
        self.token = page.evaluate("sessionStorage.getItem('pooliad.token')")
        self.id = json.loads(page.evaluate("sessionStorage.getItem('pooliad.agent')"))["id"]

    def view(self, game: str) -> View:
        answer = self.server.send("GET", f"/v1/games/{game}", self.token)
        return View.model_validate(answer.json()["view"])

    def take_turn(self, view: View) -> None:
        """Do by the controls what the potter would do."""
        turn = self.page.locator(f'section.turn[data-version="{view.version}"]')  # not the one before, still shown
        turn.wait_for(timeout=PATIENCE)
        action = self.potter(view)
        if action.decision is not None:
            turn.get_by_role("button", name=str(action.decision).replace("_", " "), exact=True).click()
        else:
            if action.cue_ball is not None:
                self.fill("Cue ball across, m", action.cue_ball[0])
                self.fill("Cue ball along, m", action.cue_ball[1])
            self.call(action.call)
            self.fill("Direction, degrees", action.shot.phi % 360)
            self.fill("Cue speed, m/s", action.shot.v)
            turn.get_by_role("button", name="Shoot").click()

    def call(self, call: Any) -> None:
        if call == "safety":
            self.page.get_by_role("checkbox", name="safety").check()
        elif call is not None:
            self.page.get_by_role("checkbox", name="safety").uncheck()
            self.page.get_by_label("Called ball").select_option(str(call.ball))
            self.page.get_by_label("Pocket").select_option(str(call.pocket))

    def fill(self, label: str, value: float) -> None:
        self.page.locator("details.numbers").evaluate_all("all => all.forEach((one) => { one.open = true; })")
        field = self.page.get_by_label(label, exact=True)
        field.fill(repr(value))
        field.press("Tab")


@pytest.fixture
def human(new_page: Any, server: Any) -> Hand:
    """At the page Play, signed in under a new name; without animations, as whoever prefers so."""
    return sat_down(new_page(reduced_motion="reduce"), server)


CHOOSE_AGAIN = """async ([path]) => {
    const { PlayView } = await import(path);
    const [later, asked, pauses] = [window.setTimeout.bind(window), [], []];
    const until = async (met) => { while (!met()) await new Promise((go) => later(go, 5)); };
    const answered = async (about) => until(() => asked.filter((one) => one.includes(about)).length === 3);
    window.setTimeout = (go, time) => (time === 2000 ? pauses.push(go) : later(go, time));
    window.fetch = async (address) => {
        asked.push(address);
        return new Response('{"matches": [], "agents": []}');
    };
    const view = new PlayView();
    for (let time = 0; time < 3; time++) view.chooseOpponent({ id: "me", name: "me" });
    await answered("status=challenged");
    await until(() => pauses.length === 3);
    for (const go of pauses.splice(0)) go(); // the time between two looks has passed, in the order of the choices
    await until(() => pauses.length > 0);
    view.close();
    return asked.filter((address) => address.includes("status=challenged")).length;
}"""


def test_only_the_choice_on_show_looks_out_for_challenges(page, server):
    """Seen: the loop of one before went on, and entered another match while a result was shown."""
    page.goto(f"{server.url}/#/nowhere")  # no view that asks for anything while nobody answers
    page.get_by_text("There is nothing at").wait_for()
    assert page.evaluate(CHOOSE_AGAIN, [f"{server.url}/web/view_play.js"]) == 3 + 1


def sat_down(page: Page, server: Any) -> Hand:
    """Signed in under a new name."""
    page.goto(f"{server.url}/#/play")
    page.get_by_label("New here? Choose a name").fill(f"human {uuid.uuid4().hex}")
    page.get_by_role("button", name="Begin").click()
    page.get_by_text("You are").wait_for()
    return Hand(page, server)


def challenge(hand: Hand) -> tuple[Match, int]:
    """A match that the hand asks for by name and the other accepts; the other's seat."""
    other = hand.server.register()
    hand.page.get_by_label("Name of the player").fill(other["agent"]["name"])
    hand.page.get_by_role("button", name="Challenge").click()
    hand.page.get_by_text("Waiting for the opponent").wait_for()
    (view,) = hand.server.http.get(f"/v1/matches?agent={hand.id}").json()["matches"]
    accepted = hand.server.send(
        "POST", f"/v1/matches/{view['id']}/accept", other["token"], json={"client_seed": "5" * 64}
    )
    assert (accepted.json()["status"], accepted.json()["rated"]) == ("running", False)
    seat = view["agents"].index(other["agent"]["id"])
    tokens = [hand.token, hand.token]
    tokens[seat] = other["token"]
    return Match(hand.server, view, tokens), seat


def seated(hand: Hand, **terms: Any) -> tuple[Match, int]:
    """A match that is the same every time; the hand has seat 0 and begins, the other has seat 1."""
    other = hand.server.register()
    request = {"agents": [hand.id, other["agent"]["id"]], "seed": "d" * 64, "noise": {"level": 0.0}}
    made = hand.server.send("POST", "/v1/matches", json=request | {"clock": {"seconds": 3600}} | terms)
    assert made.status_code == 201, made.text
    return Match(hand.server, made.json(), [hand.token, other["token"]]), 1


def play_out(hand: Hand, match: Match, other: int, most: int) -> bool:
    """Play on, the hand at the page and the other by requests; whether the game ended by the rules."""
    for _ in range(most):
        view = hand.view(match.game)
        if view.turn is None:
            return True
        if view.turn != other:
            hand.take_turn(view)
            wait_for_version(hand, match, view)
            continue
        message = hand.server.send("GET", "/v1/turns?wait=10", match.tokens[other]).json()
        act(match, other, View.model_validate(message["view"]))
    return False


def wait_for_version(hand: Hand, match: Match, view: View) -> None:
    """Until the server has what the page sent; a refusal shows on the page and fails here."""
    end = time.monotonic() + PATIENCE / 1000
    while time.monotonic() < end:
        if hand.view(match.game).version > view.version:
            return
        hand.page.wait_for_timeout(50)
    pytest.fail(f"nothing was accepted: {hand.page.locator('.refusal').all_inner_texts()}, {view}")


def test_a_whole_game_is_played_by_hand(human):
    """From the break to the result, every stroke by the page's controls; the page finds the match that waits."""
    match, other = seated(human, first_breaker=0)
    human.page.reload()
    human.page.get_by_role("heading", level=1).filter(has_text="–").wait_for()
    assert play_out(human, match, other, 400)
    human.page.locator(".result", has_text=re.compile("wins|Drawn")).wait_for()
    human.page.get_by_role("button", name="Play again").wait_for()
    view = human.view(match.game)
    human.page.locator("ol.strokes li").nth(view.version - 2).wait_for()
    assert human.page.locator("ol.strokes li").count() == view.version - 1
    assert view.outcome.rule in {"R42", "R43", "R44", "R45", "R46", "R49"}
    strokes = human.server.http.get(f"/v1/games/{match.game}/shots?limit=200").json()["shots"]
    by_hand = [one for one in strokes if one["seat"] != other]
    assert len([one for one in by_hand if one["shot"]]) >= 3


START = {
    "balls": {
        "0": [0.56, 1.7],
        "8": [0.56, 1.35],
        "2": [0.15, 0.4],
        "5": [0.9, 1.2],
        "7": [0.3, 1.9],
        "9": [0.2, 1.1],
        "12": [0.95, 0.25],
        "15": [0.6, 1.0],
    },
    "groups": ["solids", "stripes"],
}
"""Three balls for each, and the 8: docs/protocol.md, Games from a position."""


@pytest.mark.long
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_whole_game_from_a_position_is_played_by_hand(new_page, server, scheme):
    """With noise, on a phone, groups fixed from the start; marked as unrated, and its record is true."""
    page = new_page(390, 844, color_scheme=scheme, reduced_motion="reduce", has_touch=True, is_mobile=True)
    human = sat_down(page, server)
    match, other = seated(human, start=START, noise={"level": 0.3})
    page.reload()
    page.get_by_role("heading", level=1).filter(has_text="–").wait_for()
    page.locator(".mark", has_text="unrated").wait_for()
    page.get_by_role("img", name="3 to make").first.wait_for()
    assert play_out(human, match, other, 400)
    page.locator(".result", has_text=re.compile("wins|Drawn")).wait_for()
    view = human.view(match.game)
    page.locator("ol.strokes li").nth(view.version - 2).wait_for()
    assert page.locator("ol.strokes li").count() == view.version - 1
    assert "break" not in page.locator("ol.strokes li").first.inner_text()
    with page.expect_download() as download:
        page.get_by_role("link", name="record").click()
    lines = Path(download.value.path()).read_text().splitlines()
    assert verify_record(lines).ok
    strokes = [json.loads(line) for line in lines[1:-2]]
    assert len([one for one in strokes if one["seat"] != other]) >= 3
    page.get_by_role("button", name="Play again").wait_for()


def test_a_challenge_by_name_is_accepted_and_conceded(human):
    match, other = challenge(human)
    human.page.get_by_role("heading", level=1).filter(has_text="–").wait_for()
    while human.view(match.game).turn == other:
        message = human.server.send("GET", "/v1/turns?wait=10", match.tokens[other]).json()
        act(match, other, View.model_validate(message["view"]))
    human.page.get_by_role("region", name="Your turn").wait_for(timeout=PATIENCE)
    human.page.get_by_role("button", name="Concede").click()
    human.page.get_by_role("button", name="Really concede?").click()
    human.page.locator(".result", has_text="wins: concession").wait_for(timeout=PATIENCE)


def test_news_of_an_earlier_match_does_not_end_the_turns_of_this_one(human):
    """Seen: after `match_over` of a match left long ago the page asked for no more turns, and lost by not showing up.

    News is delivered once, to whoever polls next: what ended while nobody asked comes before the first turn.
    """
    earlier, _ = seated(human, first_breaker=1)
    assert human.server.send("POST", f"/v1/matches/{earlier.id}/abort").json()["status"] == "aborted"
    match, _ = seated(human, first_breaker=0)
    human.page.reload()
    human.take_turn(human.view(match.game))
    human.page.locator("ol.strokes li").first.wait_for()


def test_a_match_that_begins_while_the_page_waits_is_entered(human):
    """Seen: it was found after a reload alone; who waited at the page lost by not showing up.

    So begins a match of an organiser's, or a challenge that is accepted after its player went elsewhere and came back.
    """
    match, _ = seated(human, first_breaker=0)
    human.take_turn(human.view(match.game))
    human.page.locator("ol.strokes li").first.wait_for()


def test_a_game_that_ends_in_ones_own_turn_is_over_on_the_page_too(human):
    """Seen: called off, or out of time, it stayed "Your turn", and nothing that came later was asked for."""
    match, _ = seated(human, first_breaker=0)
    human.page.reload()
    turn = human.page.get_by_role("region", name="Your turn")
    turn.wait_for(timeout=PATIENCE)
    human.server.send("POST", f"/v1/matches/{match.id}/abort")
    human.page.get_by_role("button", name="Play again").wait_for()
    assert not turn.is_visible()


def test_the_cue_ball_is_dragged_and_the_cue_aimed_by_mouse_and_keys(human):
    """The break by pointer: an illegal place is shown as one; a drag beside the ball aims; arrows turn and speed up."""
    match, _ = seated(human, first_breaker=0)
    page = human.page
    page.reload()
    turn = page.get_by_role("region", name="Your turn")
    turn.wait_for(timeout=PATIENCE)
    view = human.view(match.game)
    table = view.table_model()
    carry(page, table, (0.3, 1.95))
    carry(page, table, (0.3, 0.5))
    page.get_by_text("may not lie there").wait_for()
    assert turn.get_by_role("button", name="Shoot").is_disabled()
    human.fill("Cue ball across, m", 0.3)
    human.fill("Cue ball along, m", 1.95)
    drag(page, table, (0.8, 1.2), (0.5, 2.15))
    direction = page.get_by_label("Direction, degrees", exact=True)
    assert float(direction.input_value()) == pytest.approx(45.0, abs=1.0)
    page.locator(".table canvas").press("ArrowRight")
    assert float(direction.input_value()) == pytest.approx(44.0, abs=1.0)
    human.fill("Direction, degrees", 359.9999)
    assert direction.input_value() == "0"
    speed = page.get_by_label("Cue speed, m/s", exact=True)
    before = float(speed.input_value())
    page.locator(".table canvas").press("Shift+ArrowDown")
    assert float(speed.input_value()) == pytest.approx(before - 0.05)


def cue_ball(page: Page) -> tuple[float, ...]:
    """Where the fields say that it lies."""
    return tuple(float(page.get_by_label(f"Cue ball {way}, m").input_value()) for way in ("across", "along"))


def carry(page: Page, table: physics.Table, end: Any) -> None:
    """Drag the cue ball; again when the page has moved below the pointer, for a preview that came meanwhile."""
    for _ in range(4):
        drag(page, table, cue_ball(page), end)
        if cue_ball(page) == pytest.approx(end, abs=0.005):
            return
    pytest.fail(f"the cue ball was dragged to {end} and lies at {cue_ball(page)}")


def drag(page: Page, table: physics.Table, start: Any, end: Any) -> None:
    canvas = page.locator(".table canvas")
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    page.mouse.move(*pixel(table, box, start))
    page.mouse.down()
    page.mouse.move(*pixel(table, box, end), steps=4)
    page.mouse.up()


def pixel(table: physics.Table, box: Any, place: Any) -> tuple[float, float]:
    """Where the page draws a place of the table: to scale, upright or lying, never mirrored."""
    if box["width"] > box["height"]:
        scale = box["width"] / (table.length + 2 * FRAME)
        right, down = table.length - place[1], table.width - place[0]
    else:
        scale = box["width"] / (table.width + 2 * FRAME)
        right, down = place[0], table.length - place[1]
    return box["x"] + (FRAME + right) * scale, box["y"] + (FRAME + down) * scale


def test_the_laboratory_simulates_spreads_and_writes(human):
    """What the page says of a shot is what the physics says, and what it writes can be read."""
    page = human.page
    page.goto(f"{human.server.url}/#/lab")
    page.get_by_label("Text", exact=True).fill("0:0.5,1.7 3:0.4,0.6")
    page.get_by_role("button", name="Set up from the notation").click()
    page.get_by_role("checkbox", name="cue as low as it can be").uncheck()
    for label, value in (
        ("Direction, degrees", 265.0),
        ("Cue raised, degrees", 5.0),
        ("Height, mm (up is positive)", 4.0),
    ):
        human.fill(label, value)
    state = notation.read("0:0.5,1.7 3:0.4,0.6")
    result = physics.simulate(physics.Table.olympiad(), state, physics.Shot(3.0, 265.0, 5.0, 0.0, 4.0))
    human.fill("Cue speed, m/s", 3.0)
    page.get_by_text(f"{result.n_events} events in {result.duration:.2f} s").wait_for()
    page.get_by_role("button", name="Play it 200 times").click()
    page.get_by_text(re.compile("Pocketed|No ball")).wait_for()
    page.get_by_label("Format").select_option("JSON")
    written = json.loads(page.get_by_label("Text", exact=True).input_value())
    assert written["shot"] == {"v": 3, "phi": 265, "theta": 5, "a": 0, "b": 4}
    page.get_by_label("Format").select_option("Python")
    names: dict[str, Any] = {}
    exec(page.get_by_label("Text", exact=True).input_value(), names)
    assert names["result"].final == result.final
    page.get_by_role("button", name="Play the shot").click()
    page.wait_for_function("() => document.querySelector('output.time').textContent !== ''")
    page.get_by_role("button", name="Back to the position").click()
    page.get_by_label("Text", exact=True).fill("3:x")
    page.get_by_role("button", name="Set up from the notation").click()
    page.get_by_text("is no ball").wait_for()


@pytest.mark.parametrize("late", ["before it is read", "after it was read"])
def test_a_late_preview_leaves_text_and_error_to_who_writes_a_notation(human, late):
    """Seen: it wrote the position over what was typed, and wiped the reason why that is none."""
    page = human.page
    preview = HeldBack(page, "**/v1/simulate")
    with page.expect_request("**/v1/simulate"):
        page.goto(f"{human.server.url}/#/lab")
    page.get_by_label("Text", exact=True).fill("3:x")
    set_up = page.get_by_role("button", name="Set up from the notation")
    if late == "before it is read":
        set_up.focus()
    else:
        set_up.click()
    preview.let_go()
    page.get_by_text("events in").wait_for()
    if late == "before it is read":
        set_up.click()
    page.get_by_text("is no ball").wait_for()
    assert page.get_by_label("Text", exact=True).input_value() == "3:x"


def test_the_laboratory_shows_no_spread_of_an_earlier_shot(human, foretold):
    """Seen: one that was asked for before a change was shown after it; choosing a ball showed one from before it."""
    page = human.page
    page.goto(f"{human.server.url}/#/lab")
    foretold(page)
    spread, told = (
        page.get_by_role("button", name="Play it 200 times"),
        page.get_by_text(re.compile("Pocketed|No ball")),
    )
    spread.click()
    told.wait_for()
    shoot_faster(human, foretold)
    before = picture(page)
    page.get_by_label("Ends of").select_option("0")
    assert picture(page) == before
    answer = HeldBack(page, "**/v1/simulate/batch")
    with page.expect_request("**/v1/simulate/batch"):
        spread.click()
    shoot_faster(human, foretold)
    answer.let_go()
    page.wait_for_timeout(1000)
    assert not told.is_visible()


def shoot_faster(hand: Hand, foretold: Any) -> None:
    """Another speed, and the preview of it."""
    hand.fill("Cue speed, m/s", float(hand.page.get_by_label("Cue speed, m/s", exact=True).input_value()) + 0.5)
    foretold(hand.page)


def picture(page: Page) -> str:
    return str(page.locator(".table canvas").evaluate("canvas => canvas.toDataURL()"))


@pytest.mark.slow
def test_a_game_by_hand_on_the_table_that_was_calibrated(new_page, own_server_with_bot, tmp_path):
    """docs/calibration.md, "Playing on it", from the shipped data to strokes on a phone's page (issue 19)."""
    server, file = own_server_with_bot, tmp_path / "my_table.toml"
    data = ROOT / "examples" / "calibration"
    words = ["calibrate", data / "paths.csv", "--strokes", data / "strokes.csv", "--table", "nine_foot", "--out", file]
    fitted = "mu_slide,mu_roll,e_ball,e_cushion,mu_cushion"
    done = subprocess.run(
        [sys.executable, "-m", "client.cli", *map(str, words), "--fit", fitted],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    table = read_table(file)
    assert isinstance(table, RealTable)
    page = new_page(390, 844, reduced_motion="reduce", has_touch=True, is_mobile=True)
    hand = sat_down(page, server)
    page.get_by_label("Table file, from pooliad calibrate").set_input_files(file)
    kind = page.get_by_label("Kind of table").locator("option:checked", has_text="my_table.toml: nine-foot table, own ")
    kind.wait_for(state="attached")
    assert page.evaluate("document.documentElement.scrollWidth") == 390, "a long name widens nothing"
    page.get_by_role("button", name="Play random").click(timeout=PATIENCE)
    page.wait_for_url(re.compile("#/play/game_"), timeout=PATIENCE)
    game = page.url.rpartition("/")[2]
    strokes: list[dict[str, Any]] = []
    by_hand = 0
    while by_hand < 3 and (view := own_turn(hand, game)) is not None:
        hand.take_turn(view)
        while hand.view(game).version == view.version:
            page.wait_for_timeout(100)
            assert not page.locator(".said-over .refusal").inner_text()
        strokes = server.http.get(f"/v1/games/{game}/shots?limit=200").json()["shots"]
        by_hand = len([one for one in strokes if one["shot"] and one["seat"] == view.seat])
    assert by_hand, "over sooner only by an 8 that fell"
    (match,) = server.http.get("/v1/matches").json()["matches"]
    assert Table.from_dict(match["table"]) == table, "to the bit, what calibrate wrote"
    assert {one["seat"] for one in strokes} == {0, 1}, "the bot has played too"
    box = page.locator(".table canvas").bounding_box()
    long, wide = (side + 2 * table.rail_width for side in (table.length, table.width))
    shown = sorted((box["width"], box["height"]))
    assert shown[1] / shown[0] == pytest.approx(long / wide, rel=0.01), "drawn to its own measures"
    page.get_by_text("nine-foot table, own mu slide").first.wait_for()


def own_turn(hand: Hand, game: str) -> View | None:
    """The next turn of the hand's, once the server has it; None when the game is over."""
    end = time.monotonic() + PATIENCE / 1000
    while time.monotonic() < end:
        view = hand.view(game)
        if view.outcome is not None or view.turn == view.seat:
            return view if view.outcome is None else None
        hand.page.wait_for_timeout(100)
    pytest.fail("no turn came")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('name = "nine_foot"\nmu_slide: 0.2\n', "line 2: must be name = value"),
        ('name = "nine_foot"\nmu_slide = 0.2\nmu_slide = 0.3\n', "line 3: mu_slide stands there twice"),
        ('name = "round"\n', "must be one of"),
        ('name = "nine_foot"\nconstructor = 1\n', "constructor"),
        ('name = "nine_foot"\n__proto__ = 1\n', "__proto__"),
        ('name = "nine_foot"\ne_cushion = 7.5\n', "e_cushion"),
        ("#" * 70_000, "at most 65536 bytes"),
    ],
)
def test_a_file_that_is_no_table_is_said_to_be_none(human, watched, tmp_path, text, said):
    """By its line, or by the server's sentence; the choice of a table stays as it was."""
    watched.forgiven = ("422",)
    file = tmp_path / "my_table.toml"
    file.write_text(text)
    human.page.get_by_label("Table file, from pooliad calibrate").set_input_files(file)
    human.page.locator(".refusal", has_text=said).wait_for()
    assert human.page.get_by_label("Kind of table").input_value() == "olympiad"


def test_the_page_reads_a_table_file_as_the_physics_does(page, server, tmp_path):
    """Every form that ``write_table`` has, and that a hand may give it."""
    page.goto(server.url)
    table = Table.nine_foot().replace(mu_slide=0.2151234567890123, mu_roll=1e-2, mu_spin=4.5e-03, flight=False)
    file = tmp_path / "my_table.toml"
    write_table(file, table, ("Fitted.", 'name = "round"'))
    text = file.read_text() + "\n  e_ball=0.9_4  # by hand\r\n"
    read = page.evaluate("async (text) => (await import('/web/table_file.js')).valuesOf(text, 'x')", text)
    assert read == tomllib.loads(text)


@pytest.mark.slow
def test_a_house_bot_accepts_and_plays(new_page, own_server_with_bot):
    """An unrated game, with a seed of each player's in its draw."""
    page = new_page(reduced_motion="reduce")
    page.goto(f"{own_server_with_bot.url}/#/play")
    page.get_by_label("New here? Choose a name").fill("guest of the house")
    page.get_by_role("button", name="Begin").click()
    page.get_by_role("button", name="Play random").click(timeout=PATIENCE)
    page.get_by_role("region", name="Your turn").wait_for(timeout=PATIENCE)
    page.get_by_role("button", name="Concede").click()
    page.get_by_role("button", name="Really concede?").click()
    page.locator(".result", has_text="random wins: concession").wait_for(timeout=PATIENCE)
    page.locator(".mark", has_text="unrated").wait_for()
    (match,) = own_server_with_bot.http.get("/v1/matches").json()["matches"]
    assert match["rated"] is False
    assert all(match["client_seeds"])
