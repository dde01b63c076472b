"""Strokes of thousands of events hold nobody up (issue 13, item 4).

Seen: a challenge with a table and a start of its own had strokes of 46,908 events, 10 s and 35 MB each; eight of them
at once held everybody else for 5 s. `benchmarks.costly_strokes` measures what others notice of sixteen such clients.
"""

import asyncio
import concurrent.futures
import itertools
import threading
import time
from functools import partial

import pytest

from physics import Shot, Table
from protocol import StrokeDetail
from referee import Action, EightBall, Limits, MatchSeed, NoiseModel, play_stroke
from referee.record import Chain, stroke_entry, verify_record
from server.services.play import strokes
from server.services.play.long_strokes import MOST_EVENTS, SHARE, IsLong, LongStrokes

RADIUS = 0.028575
LIVELY = {
    "name": "olympiad",
    "mu_slide": 0.1,
    "mu_roll": 0.008,
    "mu_spin": 0.066,
    "mu_ball": 0.005,
    "e_ball": 0.8,
    "cushion_parallel": 0.45,
    "cushion_perpendicular": 0.3,
    "cushion_spin": 0.15,
}
"""Within half of the named table: a player may ask another for it."""
SHOT = {"v": 7.6, "phi": 270.0, "theta": 5.0, "a": 0.1, "b": -0.5}


def row_of(balls):
    """A start whose stroke has some thousand events: a row of balls a hair apart, the cue ball behind it."""
    x, y, step = 0.11732483858262863, 0.3189617756320054, 2.0 * RADIUS + 1e-5
    places = {str(ball): [x, y + step * (ball - 1)] for ball in range(1, balls + 1)}
    return {"balls": places | {"0": [x, y + step * (balls - 1) + 0.0672]}, "groups": ["solids", "stripes"]}


class Work:
    """Strokes that are long, played for a while; who was at work when."""

    def __init__(self, seconds):
        self.seconds, self.spans, self.tries = seconds, [], 0
        self.started = threading.Event()

    def __call__(self, may_be_long):
        self.tries += 1
        if not may_be_long:
            raise IsLong
        began = time.monotonic()
        self.started.set()
        time.sleep(self.seconds)
        self.spans.append((began, time.monotonic()))
        return len(self.spans)


def ways(work):
    """How a stroke is played as an ordinary one, and as a long one."""

    async def ordinary():
        return work(False)

    return ordinary, partial(work, True)


def test_long_strokes_are_played_one_at_a_time_with_rests_between_them():
    async def many():
        lane, work = LongStrokes(), Work(0.02)
        await asyncio.gather(*(lane.play(f"game {number}", *ways(work)) for number in range(6)))
        return work

    work = asyncio.run(many())
    spans = sorted(work.spans)
    assert len(spans) == 6
    for (began, ended), (follows, _) in itertools.pairwise(spans):
        assert follows - ended >= (ended - began) * (1.0 / SHARE - 1.0) * 0.9


def test_ordinary_strokes_wait_for_no_long_one_and_long_ones_keep_no_thread():
    """A hundred long strokes wait: more than there are threads for requests."""

    async def both():
        lane, work = LongStrokes(), Work(0.0)
        blocked = threading.Event()

        def first(may_be_long):
            if not may_be_long:
                raise IsLong
            work.started.set()
            blocked.wait()

        waiting = [asyncio.create_task(lane.play("game", *ways(first)))]
        await asyncio.to_thread(work.started.wait)
        waiting += [asyncio.create_task(lane.play(f"game {number}", *ways(work))) for number in range(100)]
        answers = [await lane.play(f"other {number}", *ways(lambda may_be_long: "played")) for number in range(50)]
        assert not any(task.done() for task in waiting)
        for task in waiting[1:]:
            task.cancel()
        blocked.set()
        await waiting[0]
        await asyncio.gather(*waiting, return_exceptions=True)
        return answers

    assert asyncio.run(both()) == ["played"] * 50


def test_a_game_waits_for_its_long_stroke_so_that_nobody_plays_another_one_instead():
    """Else the wait would tell what noise did to a stroke, while it can still be exchanged."""

    async def story():
        lane, order = LongStrokes(), []
        going, started = threading.Event(), threading.Event()

        def long(may_be_long):
            if not may_be_long:
                raise IsLong
            started.set()
            going.wait()
            order.append("long")

        async def other():
            await lane.play("game", *ways(lambda may_be_long: order.append("other")))

        first = asyncio.create_task(lane.play("game", *ways(long)))
        await asyncio.to_thread(started.wait)
        second = asyncio.create_task(other())
        await lane.play("another game", *ways(lambda may_be_long: order.append("elsewhere")))
        going.set()
        await asyncio.gather(first, second)
        return order

    assert asyncio.run(story()) == ["elsewhere", "long", "other"]


def test_a_fault_in_a_long_stroke_lets_the_next_one_play():
    async def story():
        lane = LongStrokes()

        def fails(may_be_long):
            raise ValueError("a fault") if may_be_long else IsLong

        with pytest.raises(ValueError, match="a fault"):
            await lane.play("game", *ways(fails))
        return await asyncio.wait_for(lane.play("game", *ways(lambda may_be_long: "played")), 60)

    assert asyncio.run(story()) == "played"


def told_in_one(stroke):
    """The words of a stroke as one message and one line of the record."""
    return StrokeDetail.of(stroke, 3).model_dump_json(), Chain().add(stroke_entry(stroke, 3, 5))


@pytest.mark.parametrize("most", [1, 10**6])
def test_events_told_one_by_one_are_the_same_words(most, monkeypatch):
    """Byte for byte what a whole message and a whole line say, with pauses and without."""
    monkeypatch.setattr(strokes, "MOST_EVENTS", most)
    rules, seeds, quiet = EightBall(Table.olympiad()), MatchSeed.of(1).game(0), NoiseModel(0.0)
    stroke = play_stroke(rules, rules.new_game(1), Action(Shot(9.0, 270.0, 15.0), None, (0.558, 1.8)), seeds, quiet)
    assert stroke.result is not None
    assert len(stroke.result.events) > 30
    told, recorded = strokes._events(stroke.result)
    bare = StrokeDetail.of(stroke, 3, events=False).model_dump_json().removesuffix(strokes._NO_EVENTS)
    line = Chain().add(stroke_entry(stroke, 3, 5, events=False), {"events": recorded})
    assert (bare + told, line) == told_in_one(stroke)


def test_a_long_stroke_is_played_stored_and_answered_once(own_server, table_at):
    """Sent twice at the same time; the history has it as the answer does, and the record verifies."""
    server = own_server()
    table = table_at(server, table=LIVELY, start=row_of(8), noise={"level": 0.0})
    mover, view = table.mover()
    action = {"shot": SHOT | {"v": 4.0}, "call": {"ball": view["callable_balls"][0], "pocket": 0}}
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        twice = [pool.submit(mover.act, view, action, key="long") for _ in range(2)]
        answers = [future.result() for future in twice]
    assert [answer.status_code for answer in answers] == [200, 200], answers[0].text[:500]
    assert answers[0].content == answers[1].content
    stroke = answers[0].json()["stroke"]
    assert len(stroke["events"]) > MOST_EVENTS
    assert [event["index"] for event in stroke["events"]] == list(range(len(stroke["events"])))
    kept = mover.get(f"/v1/games/{view['game']}/shots").json()["shots"]
    assert kept == [stroke]
    loser, view = table.mover()
    assert loser.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
    record = server.request("GET", f"/v1/games/{view['game']}/record").text
    assert verify_record(record.splitlines()).ok


@pytest.mark.long
def test_a_stroke_ends_at_twenty_thousand_events_and_the_game_goes_on(own_server, table_at):
    """`event_limit` stands in the answer and in the history, and the next player plays on from there."""
    server = own_server()
    table = table_at(server, table=LIVELY, start=row_of(13), noise={"level": 0.0})
    mover, view = table.mover()
    mover.server.http.timeout = 900.0
    answer = mover.act(view, {"shot": SHOT, "call": {"ball": view["callable_balls"][0], "pocket": 0}})
    assert answer.status_code == 200, answer.text[:500]
    stroke = answer.json()["stroke"]
    assert stroke["status"] == "event_limit"
    assert Limits().events <= len(stroke["events"]) < Limits().events + 200
    assert len(table.play(2)) == 2
