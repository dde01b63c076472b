"""Strokes and polls in a batch (`group_commit`): each is carried out, refused or fails as it would alone."""

import asyncio
import contextlib
import json
import threading
from collections.abc import AsyncIterator
from functools import partial
from typing import Any

import pytest
from sqlalchemy import event
from support.server_time import SECOND, Stage

from server.errors import NotFound, OutOfTime, StaleVersion, Unauthorized, Unavailable
from server.security.callers import Caller
from server.services.play import history, live_game, strokes, turns
from server.services.play.long_strokes import IsLong
from server.services.runtime.batches import Batches

BREAK = {"v": 8.0, "phi": 270.0, "theta": 5.0, "a": 0.0, "b": 0.0}

WITHIN = 120.0


@pytest.fixture
def stage(tmp_path):
    made = Stage(tmp_path / "batches.db", group_commit=True)
    yield made
    made.close()


def games(stage, count, **terms):
    made = [stage.game(f"ann {number}", f"bob {number}", **terms) for number in range(count)]
    for seats in made:
        seats.fetch()
    return made


def broken_off(stage, seats, key="s", version=1, shot=BREAK, **members):
    """A request for the first stroke of a game."""
    command = stage.command(seats.mover, json.dumps({"shot": shot} | members).encode(), key, version)
    return seats.id, lambda connection: command


def together(stage, *requests):
    """What becomes of strokes in a batch."""
    return carried_out(stage, *(partial(strokes.attempt_of, stage.context, *each) for each in requests))


@contextlib.asynccontextmanager
async def held(stage: Stage) -> AsyncIterator[Batches]:
    """Batches at work whose thread waits as long as the block lasts: who comes meanwhile is carried out together."""
    entered, released = threading.Event(), threading.Event()

    def wait(connection: Any) -> Any:
        entered.set()
        assert released.wait(WITHIN)
        raise Unauthorized("no token")

    batches = Batches(stage.context)
    async with batches.running():
        holding = asyncio.ensure_future(batches.carry_out(partial(strokes.attempt_of, stage.context, "game", wait)))
        assert await asyncio.to_thread(entered.wait, WITHIN)
        yield batches
        released.set()
        with pytest.raises(Unauthorized):
            await holding


def carried_out(stage, *begun):
    """What becomes of requests that are all there when the batches' thread looks: a value or an exception each."""

    async def all_of_them() -> Any:
        async with held(stage) as batches:
            waiting = asyncio.gather(*map(batches.carry_out, begun), return_exceptions=True)
            await asyncio.sleep(0)  # each is put in the queue
        return await waiting

    return asyncio.run(all_of_them())


def commits(stage):
    """A list that grows by one with every commit from now on."""
    seen: list[int] = []
    event.listen(stage.context.database._engine, "commit", lambda connection: seen.append(1))
    return seen


def strokes_of(stage, seats):
    return history.shots(stage.context, seats.id, 0, 50).shots


def test_strokes_that_are_there_together_share_a_commit_and_are_what_they_are_alone(stage):
    first, *others = games(stage, 6, seed="a" * 64)
    seen = commits(stage)
    answers = together(stage, *(broken_off(stage, seats) for seats in others))
    assert len(seen) == 1
    (alone,) = together(stage, broken_off(stage, first))
    for seats, answer in zip([first, *others], [alone, *answers], strict=True):
        told = json.loads(answer.body)
        assert told["game"] == seats.id
        assert told["stroke"]["balls"] == json.loads(alone.body)["stroke"]["balls"]
        (stroke,) = strokes_of(stage, seats)
        assert stroke.model_dump(mode="json") == told["stroke"]


def test_each_is_refused_alone(stage):
    """By its token, its game, its version, its clock: the strokes beside it are played."""
    good, stale, late, also_good = games(stage, 4)
    gone = broken_off(stage, good)[0] + "x", broken_off(stage, good)[1]

    def nobody(connection: Any) -> Any:
        raise Unauthorized("no token")

    stage.time.pass_(20.0)
    _, came_late = broken_off(stage, late)
    stage.time.value -= 20 * SECOND
    answers = together(
        stage,
        broken_off(stage, good),
        (good.id, nobody),
        gone,
        broken_off(stage, stale, version=7),
        (late.id, came_late),
        broken_off(stage, also_good),
    )
    assert [type(each) for each in answers[1:5]] == [Unauthorized, NotFound, StaleVersion, OutOfTime]
    assert [each.status for each in (answers[0], answers[5])] == [200, 200]
    assert [len(strokes_of(stage, seats)) for seats in (good, stale, late, also_good)] == [1, 0, 0, 1]


def test_a_stroke_twice_in_a_batch_is_played_once(stage):
    """With one key both have the same bytes; with another key the second comes too late."""
    (seats,) = games(stage, 1)
    first, again, other = together(
        stage, broken_off(stage, seats), broken_off(stage, seats), broken_off(stage, seats, key="other")
    )
    assert first.body == again.body
    assert isinstance(other, StaleVersion)
    assert len(strokes_of(stage, seats)) == 1


@pytest.mark.parametrize("point", ["shot-admitted", "shot-simulated", "shot-advanced", "shot-moved", "shot-kept"])
def test_a_stroke_that_fails_at_any_step_hurts_nobody(stage, monkeypatch, point):
    """Whatever the step, and however often it is tried again."""
    *others, failing = games(stage, 4)
    fault = ZeroDivisionError("a fault of the program")
    in_hand: list[str] = []

    def fails(name):
        if name == point and in_hand[-1] == failing.id:
            raise fault

    object.__setattr__(stage.context, "failpoint", fails)
    for step in (strokes.Attempt.prepare, strokes.Attempt.store):

        def noted(attempt, *values, step=step):
            in_hand.append(attempt._game_id)
            return step(attempt, *values)

        monkeypatch.setattr(strokes.Attempt, step.__name__, noted)
    answers = together(stage, *(broken_off(stage, seats) for seats in (failing, *others)))
    assert answers[0] is fault
    assert [each.status for each in answers[1:]] == [200, 200, 200]
    assert [len(strokes_of(stage, seats)) for seats in (failing, *others)] == [0, 1, 1, 1]


def test_a_look_that_fails_is_made_again_for_each_by_itself(stage, monkeypatch):
    seen = games(stage, 3)
    find, failures = live_game.find_row, [ZeroDivisionError("a row half read")]

    def failing_once(connection, game_id):
        if failures:
            raise failures.pop()
        return find(connection, game_id)

    monkeypatch.setattr("server.services.play.game_cache.find_row", failing_once)
    answers = together(stage, *(broken_off(stage, seats) for seats in seen))
    assert not failures
    assert [each.status for each in answers] == [200, 200, 200]
    assert [len(strokes_of(stage, seats)) for seats in seen] == [1, 1, 1]


def test_a_database_that_does_not_answer_is_told_to_each(stage, monkeypatch):
    seen = games(stage, 3)

    def away(connection, game_id):
        raise Unavailable("away")

    monkeypatch.setattr("server.services.play.game_cache.find_row", away)
    answers = together(stage, *(broken_off(stage, seats) for seats in seen))
    assert {type(each) for each in answers} == {Unavailable}
    monkeypatch.undo()
    assert [each.status for each in together(stage, *(broken_off(stage, seats) for seats in seen))] == [200] * 3


def test_who_hangs_up_has_his_stroke_stored_and_hurts_nobody(stage):
    first, second = games(stage, 2)

    async def hung_up() -> Any:
        begun = (partial(strokes.attempt_of, stage.context, *broken_off(stage, seats)) for seats in (first, second))
        async with held(stage) as batches:
            gone, stays = (asyncio.create_task(batches.carry_out(each)) for each in begun)
            await asyncio.sleep(0)
            gone.cancel()
        return await stays

    assert asyncio.run(hung_up()).status == 200
    assert [len(strokes_of(stage, seats)) for seats in (first, second)] == [1, 1]


def test_a_long_stroke_is_found_to_be_one(stage, monkeypatch):
    monkeypatch.setattr("server.services.play.live_game.MOST_EVENTS", 20)
    first, second = games(stage, 2)
    soft = BREAK | {"v": 0.1}
    long, ordinary = together(stage, broken_off(stage, first), broken_off(stage, second, shot=soft))
    assert isinstance(long, IsLong)
    assert ordinary.status == 200
    assert [len(strokes_of(stage, seats)) for seats in (first, second)] == [0, 1]


def test_the_end_of_a_game_among_strokes(stage):
    """A stroke that ends its game is stored by itself, with what follows; those beside it go on."""
    black_alone = {"balls": {"0": [0.3, 0.3], "8": [0.1, 0.1], "9": [0.9, 1.5]}, "groups": ["solids", "stripes"]}
    sunk = {"v": 2.0, "phi": 225.0, "theta": 5.0, "a": 0.0, "b": 0.0}
    (ending,) = games(stage, 1, noise={"level": 0.0}, start=black_alone)
    (going_on,) = [stage.game("cat", "dan")]
    going_on.fetch()
    first, second = together(
        stage, broken_off(stage, ending, shot=sunk, call={"ball": 8, "pocket": 0}), broken_off(stage, going_on)
    )
    assert (first.status, second.status) == (200, 200)
    assert json.loads(first.body)["view"]["turn"] is None
    assert stage.waiting(ending) is None
    assert {stage.news(agent)["type"] for agent in ending.ids} == {"game_over"}
    assert stage.waiting(going_on) is not None
    assert together(stage, broken_off(stage, ending, shot=sunk, call={"ball": 8, "pocket": 0}))[0].body == first.body


def test_polls_in_a_batch_start_their_clocks_and_tell_news_once(stage):
    """Beside strokes: each agent is told what it would be told alone; a turn again, and news never again."""
    seats = [stage.game(f"ann {number}", f"bob {number}") for number in range(3)]
    over = stage.game("cat", "dan")
    over.fetch()
    over.concede()

    def fetch(agent):
        asker = turns.Asker(Caller(agent, "t"), agent, 0.0)
        return partial(turns.Fetch, stage.context, lambda connection: asker)

    seen = commits(stage)
    begun = [fetch(agent) for agent in (*(each.mover for each in seats), *[over.ids[0]] * 3)]
    *told, first, second, third = (message for _, message in carried_out(stage, *begun))
    assert len(seen) == 1
    assert [json.loads(each)["game"] for each in told] == [each.id for each in seats]
    assert [json.loads(each)["type"] for each in (first, second)] == ["game_over", "match_over"]
    assert third is None
    stage.time.pass_(1.0)
    ((_, redelivered),) = carried_out(stage, fetch(seats[0].mover))
    clocks = [json.loads(each)["view"]["clocks"] for each in (told[0], redelivered)]
    assert clocks[0] != clocks[1]
    assert len(seen) == 1, "nothing is written for a turn that was fetched"
    assert carried_out(stage, fetch(over.ids[0]))[0][1] is None
