"""Where the page draws the balls: the closed forms (5) to (9), (43) of docs/physics.md, against `result.at(t)`."""

import json
import math
import random
from typing import Any

import pytest
from playwright.sync_api import Page
from support.axe import violations
from support.short_games import short_game

import physics
from client.local_game import PlayedGame

TOLERANCE = 1e-9
AT = """async ([table, entry, times]) => {
  const { traceOf } = await import("/web/trace.js");
  const trace = traceOf(table, entry);
  return times.map((time) => Object.fromEntries([...trace.at(time)]));
}"""


SLIDE = "(slider, time) => { slider.value = time; slider.dispatchEvent(new Event('input')); }"


def times_of(stroke: Any, chance: random.Random) -> list[float]:
    """The ends, moments at random, and events: their times and halfway to the next."""
    duration, events = stroke.result.duration, stroke.result.events
    if len(events) < 2:  # a miscue: nothing has moved
        return [0.0, duration]
    chosen = [events[chance.randrange(len(events))].time for _ in range(4)]
    places = [chance.randrange(len(events) - 1) for _ in range(4)]
    places += [event.index for event in events if event.kind == "jaw_collision" and event.index + 1 < len(events)]
    between = [events[n].time / 2 + events[n + 1].time / 2 for n in places]
    return [0.0, duration, *chosen, *between, *(chance.uniform(0.0, duration) for _ in range(4))]


def compare(page: Page, game: PlayedGame, seed: int) -> tuple[int, float]:
    """How many positions were compared, and the largest distance (m); moments right after hits of jaws among them."""
    chance, compared, worst = random.Random(seed), 0, 0.0
    header, *lines = [json.loads(line) for line in game.record()]
    for stroke, line in zip(game.strokes, lines, strict=False):
        if stroke.result is None:
            continue
        times = times_of(stroke, chance)
        for time, balls in zip(times, page.evaluate(AT, [header["table"], line, times]), strict=True):
            truth = stroke.result.at(time)
            for ball, shown in balls.items():
                x, y = truth.positions[int(ball)]
                assert math.isnan(x) == (shown["motion"] in ("pocketed", "absent", "driven_off")), (
                    seed,
                    line["entry"],
                    time,
                    ball,
                )
                if not math.isnan(x):
                    compared += 1
                    worst = max(worst, math.dist((x, y), shown["position"]))
                    spin, velocity = truth.spins[int(ball)], truth.velocities[int(ball)]
                    assert math.dist(spin, shown["spin"]) < 1e-6
                    assert math.dist(velocity, shown["velocity"]) < TOLERANCE
                    worst = max(worst, abs(truth.heights[int(ball)] - shown.get("height", 0.0)))
    return compared, worst


@pytest.mark.slow
def test_positions_of_fifty_records_are_those_of_the_physics(page, server):
    """Fifty breaks and the strokes after them; every tenth game on the historical table."""
    page.goto(server.url)
    compared, worst = 0, 0.0
    for seed in range(50):
        count, distance = compare(page, short_game(seed, 3), seed)
        compared, worst = compared + count, max(worst, distance)
    assert compared > 20_000
    assert worst < TOLERANCE


REAL = {
    "nine_foot": physics.Table.nine_foot(),
    "seven_foot": physics.Table.seven_foot(),
    "eight_foot of other laws": physics.Table.eight_foot().replace(cushion="mathavan", ball="consistent", mu_slide=0.3),
}


@pytest.mark.parametrize("kind", REAL)
def test_positions_of_games_with_jaws_are_those_of_the_physics(page, server, kind):
    """Issue 15: balls that rattle in the jaws, hang there or drop over the edge, drawn by the same closed forms."""
    page.goto(server.url)
    compared, worst, jaws, fallen = 0, 0.0, 0, 0
    for seed in range(15):
        game = short_game(seed, 5, REAL[kind])
        count, distance = compare(page, game, seed)
        compared, worst = compared + count, max(worst, distance)
        kinds = [event.kind for stroke in game.strokes if stroke.result for event in stroke.result.events]
        jaws, fallen = (
            jaws + kinds.count(physics.EventKind.JAW_COLLISION),
            fallen + kinds.count(physics.EventKind.POCKET_COLLISION),
        )
    assert compared > 8_000
    assert jaws > 20
    assert fallen > 5
    assert worst < TOLERANCE


JUMPS = {
    "over a ball": ({0: (0.635, 0.6), 1: (0.635, 0.9), 2: (0.635, 1.9)}, (3.0, 90.0, 45.0, 0.0, 20.0)),
    "into two balls": ({0: (0.4, 0.5), 1: (0.6, 1.3), 2: (0.66, 1.3)}, (4.0, 75.0, 35.0, 4.0, 8.0)),
    "over the rail": ({0: (0.3, 1.0), 3: (0.9, 1.2)}, (6.0, 180.0, 40.0, 0.0, 0.0)),
    "masse": ({0: (0.6, 0.8), 4: (0.6, 1.4)}, (3.5, 90.0, 75.0, 12.0, 4.0)),
}


@pytest.mark.parametrize("name", JUMPS)
def test_a_ball_in_the_air_is_drawn_where_it_is_and_as_high(page, server, name):
    """Issue 20: place, height and upward speed in closed form, between and at the events of shots that fly."""
    page.goto(server.url)
    positions, shot = JUMPS[name]
    table = physics.Table.nine_foot().replace(cue_test=False)
    state = physics.TableState.from_positions(positions)
    result = physics.simulate(table, state, physics.Shot(*shot))
    entry = {"before": positions, "events": result.events.to_dicts(), "duration": result.duration}
    times = [n * result.duration / 400 for n in range(400)] + [event.time for event in result.events]
    highest = 0.0
    for time, balls in zip(times, page.evaluate(AT, [table.to_dict(), entry, times]), strict=True):
        truth = result.at(time)
        assert balls.keys() == {str(ball) for ball in positions}
        for ball, shown in balls.items():
            number = int(ball)
            there = shown["motion"] not in ("pocketed", "driven_off")
            assert there != math.isnan(truth.positions[number][0]), (time, ball)
            if there:
                height, rising = shown.get("height", 0.0), shown.get("velocity_z", 0.0)
                assert math.dist(truth.positions[number], shown["position"]) < TOLERANCE
                assert abs(truth.heights[number] - height) < TOLERANCE
                assert abs(truth.vertical_velocities[number] - rising) < TOLERANCE
                assert math.dist(truth.spins[number], shown["spin"]) < 1e-6
                highest = max(highest, height)
    assert highest > 5e-4, "even a masse hops"


SIDE = """async ([table, entry, ball]) => {
  const { traceOf } = await import("/web/trace.js");
  const { passed, profile } = await import("/web/side_view.js");
  const trace = traceOf(table, entry);
  const samples = profile(trace, ball);
  return [samples, passed(trace, ball, samples).map((one) => one.ball)];
}"""


def test_the_side_view_has_the_heights_of_the_physics(page, server):
    """Issue 20: height over the way in plan, in closed form at every moment; and the ball that is jumped over."""
    page.goto(server.url)
    positions, shot = JUMPS["over a ball"]
    table = physics.Table.nine_foot().replace(cue_test=False)
    result = physics.simulate(table, physics.TableState.from_positions(positions), physics.Shot(*shot))
    entry = {"before": positions, "events": result.events.to_dicts(), "duration": result.duration}
    samples, over = page.evaluate(SIDE, [table.to_dict(), entry, 0])
    assert over == [1]
    assert samples[-1]["time"] == result.duration
    before = [*positions[0]]
    along = 0.0
    for one in samples:
        truth = result.at(one["time"])
        assert abs(one["height"] - truth.heights[0]) < TOLERANCE
        assert math.dist(one["position"], truth.positions[0]) < TOLERANCE
        along += math.dist(before, one["position"])
        before = one["position"]
        assert one["along"] == pytest.approx(along, abs=1e-9)
    assert sum(one["height"] > 0.0 for one in samples) > 40


def test_the_laboratory_shows_a_jump_from_the_side_up_to_85_degrees(page, server, foretold):
    page.goto(f"{server.url}/#/lab?table=nine_foot&balls=0:0.635,0.6+1:0.635,0.9+2:0.635,1.9&shot=3,90,45,0,20")
    foretold(page)
    positions, shot = JUMPS["over a ball"]
    result = physics.simulate(
        physics.Table.nine_foot(), physics.TableState.from_positions(positions), physics.Shot(*shot)
    )
    highest = max(result.at(n * result.duration / 20_000).heights[0] for n in range(5_000))
    page.get_by_role("img", name=f"cue ball: {100 * highest:.1f} cm high at most").wait_for()
    assert page.locator(".side-view .passed").count() == 1
    assert violations(page) == []
    raised = page.get_by_label("Cue raised, degrees", exact=True)
    raised.fill("85")
    raised.press("Tab")
    foretold(page)
    assert raised.input_value() == "85"
    page.get_by_label("Kind of table").select_option("olympiad")
    foretold(page)
    assert not page.locator(".side-view").is_visible(), "nothing flies there"


SHADE = """async ([table, height]) => {
  const { TablePicture } = await import("/web/table_picture.js");
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const picture = new TablePicture(canvas, table);
  picture.fit(900, 1700);
  const pixels = () => context.getImageData(0, 0, canvas.width, canvas.height).data;
  picture.draw({ balls: new Map() });
  const empty = pixels();
  picture.draw({ balls: new Map([[0, { position: [0.6, 1.2], height }]]) });
  const drawn = pixels();
  let [ivory, darker] = [0, 0];
  for (let at = 0; at < drawn.length; at += 4) {
    if (drawn[at] > empty[at] + 60) ivory += 1;
    else if (drawn[at] + 4 < empty[at] || drawn[at + 1] + 4 < empty[at + 1]) darker += 1;
  }
  return [ivory / picture.density ** 2, darker / picture.density ** 2];
}"""


def test_a_ball_in_the_air_looks_larger_and_its_shadow_parts_from_it(page, server):
    page.goto(server.url)
    table = physics.Table.nine_foot().to_dict()
    (low, close), (high, far) = (page.evaluate(SHADE, [table, height]) for height in (0.0, 0.2))
    assert 1.15 < high / low < 1.35, "seen from 2 m: (2 / 1.8)^2"
    assert far > 2.0 * close, "all of the shadow is seen"


@pytest.mark.long
def test_positions_of_whole_games_are_those_of_the_physics(page, server):
    page.goto(server.url)
    worst = max(compare(page, short_game(seed, 400), seed)[1] for seed in range(100, 150))
    assert worst < TOLERANCE


def test_a_record_file_replays_without_the_server(page, own_server, watched, tmp_path):
    """Chosen from the disk, scrubbed with the slider, stepped by event; the server is gone meanwhile."""
    watched.forgiven = ("Failed to load resource", "ERR_CONNECTION")
    game = short_game(3, 4)
    file = tmp_path / "record.jsonl"
    file.write_text("".join(f"{line}\n" for line in game.record()))
    page.goto(own_server.url)
    page.get_by_label("Look at a record").wait_for()
    own_server.process.terminate()
    own_server.process.wait(60)
    page.get_by_label("Look at a record").set_input_files(file)
    page.locator("ol.strokes li").nth(len(game.strokes) - 1).wait_for()
    assert page.locator("ol.strokes li").count() == len(game.strokes)
    slider = page.get_by_label("Time of the stroke")
    duration = game.strokes[0].result.duration
    assert float(slider.get_attribute("max")) == pytest.approx(duration, abs=1e-9)
    for part in (0.0, 0.31, 1.0):
        slider.evaluate(SLIDE, part * duration)
        page.locator("output.time", has_text=f"{part * duration:.2f} s").wait_for()
    page.get_by_label("Event before").click()
    before = max(event.time for event in game.strokes[0].result.events if event.time < duration)
    page.locator("output.time", has_text=f"{before:.2f} s").wait_for()
    page.get_by_role("button", name="Play", exact=True).click()
    page.locator("output.time", has_text=f"{duration:.2f}").wait_for()
    page.get_by_role("button", name="stroke ▸").click()
    page.locator(".row[aria-current]", has_text="ann 3").wait_for()


def test_a_file_that_is_no_record_is_said_to_be_none(page, server, tmp_path):
    for content in ("", "{}", "not json", '{"type":"game"}', "[1,2]"):
        file = tmp_path / "bad.jsonl"
        file.write_text(content)
        page.goto(server.url + "/#/")
        page.reload()
        page.get_by_label("Look at a record").set_input_files(file)
        page.locator(".problem", has_text="no record of a game").wait_for()
