"""Spectators are told at once what they have read up to, and in order whatever they have not.

The story: 100 spectators of one game cost the server six times what its strokes do, for every one of their three events
went through a queue, a task and the framework by itself. Now a look writes all it found to each, in one piece.
"""

import asyncio
import json

import pytest

from server.services.play.game_cache import MOST_KEPT
from server.services.runtime.cache import VersionedCache
from server.services.watch.spectator_events import SpectatorEvent
from server.services.watch.spectators import BACKLOG, KEEP_ALIVE, News, Spectator


def stroke(sequence, game="g"):
    return SpectatorEvent(game, "stroke", json.dumps({"n": sequence}), sequence)


def clocks(game="g"):
    return SpectatorEvent(game, "clocks", "{}")


class Reader:
    """A connection: takes what is written at once, unless it has not read."""

    def __init__(self):
        self.got, self.has_read = [], True

    def write(self, part):
        if self.has_read:
            self.got.append(part)
        return self.has_read


async def follow(spectator, reader, seconds=10.0):
    """What the framework does: sends what is queued, one after another."""
    while (part := await spectator.next(seconds)) is not None:
        await asyncio.sleep(0)
        reader.got.append(part)


def told(reader):
    return [json.loads(line[6:])["n"] for part in reader.got for line in part.decode().split("\n") if '"n"' in line]


def test_who_has_read_all_is_written_to_at_once_in_one_piece():
    async def scene():
        reader = Reader()
        spectator = Spectator({"g": 0}, several=False, write=reader.write)
        task = asyncio.create_task(follow(spectator, reader))
        await asyncio.sleep(0)
        spectator.tell(News((stroke(1), clocks())))
        assert told(reader) == [1]
        assert len(reader.got) == 1
        task.cancel()

    asyncio.run(scene())


@pytest.mark.parametrize("seed", range(30))
def test_nothing_overtakes_what_waits(seed):
    """Whatever a reader does in between: every stroke once, in order."""

    async def scene():
        import random

        chance, reader = random.Random(seed), Reader()
        spectator = Spectator({"g": 0}, several=False, write=reader.write)
        task = asyncio.create_task(follow(spectator, reader))
        for sequence in range(1, 200):
            reader.has_read = chance.random() < 0.6
            for _ in range(chance.randrange(3)):
                await asyncio.sleep(0)
            news = (stroke(max(1, sequence - chance.randrange(3))), stroke(sequence), clocks())
            spectator.tell(News(tuple({each.sequence: each for each in news}.values())))
        spectator.send_home()
        await task
        assert told(reader) == list(range(1, 200))

    asyncio.run(scene())


def test_who_does_not_read_is_sent_home():
    async def scene():
        reader = Reader()
        reader.has_read = False
        spectator = Spectator({"g": 0}, several=False, write=reader.write)
        for sequence in range(1, BACKLOG + 2):
            spectator.tell(News((stroke(sequence),)))
        assert await spectator.next(10.0) is None

    asyncio.run(scene())


def test_silence_is_kept_alive():
    async def scene():
        spectator = Spectator({"g": 0}, several=False)
        assert await spectator.next(0.01) == KEEP_ALIVE

    asyncio.run(scene())


def test_news_are_encoded_once_for_all_but_those_who_know_some():
    news = News((stroke(1), stroke(2), clocks()))
    assert news.encoded(0, several=False)[0] is news.encoded(0, several=False)[0]
    text, last = news.encoded(1, several=False)
    assert (b'"n": 1' in text, b'"n": 2' in text, last) == (False, True, 2)
    assert news.encoded(5, several=True) == (clocks().among_others, 5)


def test_two_thousand_games_that_are_on_are_all_remembered():
    """With room for fewer than are played in turn, the game that was forgotten is always the next."""
    kept = VersionedCache[int](MOST_KEPT, lambda version: version)
    for version in (1, 2):
        found = [kept.get(str(game)) for game in range(2_000)]
        assert found == [None if version == 1 else 1] * 2_000
        for game in range(2_000):
            kept.keep({str(game): version})
