"""A server killed again and again under load: is anything lost, doubled or different?

``python -m benchmarks.kills --kills 200 --database sqlite``

Matches are played at once, half of them from their answers, half by long poll. At random instants the server's process
is killed, as ``kill -9`` does, and started anew on the same database; whoever has no answer sends the same bytes again.
In the end every stroke that was ever acknowledged is sent once more, and has to be answered byte for byte as before;
every game's history has to be the strokes acknowledged, each once and in order; every record has to verify; and the
same matches, played on another server that nobody kills, have to have the same strokes.
"""

import argparse
import asyncio
import contextlib
import itertools
import json
import os
import random
import signal
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from benchmarks import recording
from benchmarks.growth import serving_process
from benchmarks.load import ORGANISER, current_view, ready, serving
from benchmarks.load_client import Connection, Reply
from benchmarks.load_games import Player, begin, next_request
from benchmarks.recording import ROOT, Row, Tables
from referee.record import verify_record

sys.path.insert(0, str(ROOT / "tests"))

from support.postgres import cluster

DATABASES = ("sqlite", "postgresql")
MATCHES = 8
FULL = 200
SHARE = 5
LONGEST_LIFE = 1.2
"""Seconds from a life's first stroke, or in one life of ten from its start, to its end at most."""
ANSWERS_WITHIN = 120.0
"""Seconds for a server to come up again on a busy machine."""
PAUSE = 0.02
"""Seconds between two attempts to be answered."""


@dataclass(frozen=True, slots=True)
class Acknowledged:
    """A stroke or decision that was answered: the request's bytes, and the answer's."""

    head: bytes
    body: bytes
    answer: bytes


@dataclass
class Hands:
    """Both players of a match, who insist on an answer to everything and keep what was acknowledged.

    Attributes:
        polls: whether turns are fetched by long poll. tries: refused strokes of this turn.
        resent: requests that had to be sent again, after which an answer came. faults: what must not be.
    """

    wire: Connection
    players: tuple[Player, Player]
    polls: bool
    acknowledged: list[Acknowledged] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    resent: int = 0
    tries: int = 0
    view: dict[str, Any] | None = None

    async def play(self) -> None:
        """Send one stroke until it is answered."""
        view = self.view or await self._fetched()
        head, body = next_request(view, self.players, self.tries)
        resent = self.resent
        reply = await self.insist(head, body)
        if reply.status != 200:
            if reply.status != 422:
                self.faults.append(f"refused: {reply.status} {reply.body.decode()}")
            self.view, self.tries = (view, self.tries + 1) if reply.status == 422 else (None, 0)
            return
        if self.resent > resent and self.acknowledged:
            await self.repeat(self.acknowledged[-1])
        self.acknowledged.append(Acknowledged(head, body, reply.body))
        following = json.loads(reply.body)["view"]
        self.view, self.tries = None if self.polls or following["turn"] is None else following, 0

    async def _fetched(self) -> dict[str, Any]:
        """The view that is to be answered."""
        if not self.polls:
            return await self._shown()
        while True:
            for player in self.players:
                bearer = f"Authorization: Bearer {player.token}\r\n"
                reply = await self.insist(Connection.request("GET", "/v1/turns", headers=bearer))
                if reply.status == 200 and (message := json.loads(reply.body))["type"] == "turn":
                    return dict(message["view"])

    async def _shown(self) -> dict[str, Any]:
        """The view of the game that is being played; asked for again until there is an answer."""
        while True:
            try:
                return await current_view(self.wire, self.players)
            except (OSError, EOFError, KeyError):  # no server, or one that is not ready
                await self._pause()

    async def repeat(self, one: Acknowledged) -> None:
        """The same bytes again have to be answered by the same."""
        reply = await self.insist(one.head, one.body)
        if (reply.status, reply.body) != (200, one.answer):
            self.faults.append(f"answered otherwise: {one.answer.decode()}, then {reply.status} {reply.body.decode()}")

    async def insist(self, head: bytes, body: bytes = b"") -> Reply:
        """Send until there is an answer."""
        end = time.monotonic() + ANSWERS_WITHIN
        for attempt in itertools.count():
            try:
                reply = await self.wire.send(head, body)
            except (OSError, EOFError):
                reply = None
            if reply is not None and reply.status != 503:
                self.resent += attempt > 0
                return reply
            assert time.monotonic() < end, "no server answers any more"
            await self._pause()
        raise AssertionError

    async def _pause(self) -> None:
        self.wire.close()
        await asyncio.sleep(PAUSE)

    @property
    def strokes(self) -> list[list[Any]]:
        """What was acknowledged, game after game."""
        answers = [json.loads(one.answer) for one in self.acknowledged]
        games = itertools.groupby(answers, key=lambda answer: answer["game"])
        return [[answer["stroke"] for answer in ours] for _, ours in games]

    async def look_over(self) -> int:
        """Call the match off and compare everything stored with everything acknowledged; the records that verify."""
        for one in self.acknowledged:
            await self.repeat(one)
        match = await self.wire.post(f"/v1/matches/{self.players[0].match}/abort", {}, ORGANISER, "end")
        strokes = iter(self.strokes)
        verified = 0
        for game in match["played"]:
            if await history(self.wire, game["id"]) != next(strokes, []):
                self.faults.append(f"{game['id']}: what is stored is not what was acknowledged")
            record = (await self.wire.get(f"/v1/games/{game['id']}/record")).body.decode().splitlines()
            if verify_record(record).ok:
                verified += 1
            else:
                self.faults.append(f"{game['id']}: its record does not verify")
        if next(strokes, None) is not None:
            self.faults.append(f"{match['id']}: a game with acknowledged strokes is not there")
        return verified


async def history(wire: Connection, game: str) -> list[Any]:
    """The strokes of a game, all pages."""
    strokes: list[Any] = []
    cursor: int | None = 0
    while cursor is not None:
        page = json.loads((await wire.get(f"/v1/games/{game}/shots?limit=200&cursor={cursor}")).body)
        strokes, cursor = strokes + page["shots"], page["next_cursor"]
    return strokes


async def killed(url: str, kills: int, calm: str) -> tuple[Row, list[str]]:
    """Play on one database with so many kills, and look everything over; the same without kills on another."""
    chance, stop = random.Random(kills), asyncio.Event()
    with serving("server", "--database", url) as port:
        await ready(port)
        load = [await sit_down(port, number) for number in range(MATCHES)]
        players = [asyncio.create_task(_play(hands, stop)) for hands in load]
        await _live(load, chance, busy=True)
        os.kill(serving_process(port), signal.SIGKILL)
    began = time.perf_counter()
    for life in range(1, kills):
        with serving("server", "--database", url, "--port", str(port)):
            await _live(load, chance, busy=life % 10 > 0)
            os.kill(serving_process(port), signal.SIGKILL)
        for task in players:
            if task.done():
                task.result()
    hours = (time.perf_counter() - began) / 3600
    with serving("server", "--database", url, "--port", str(port)):
        await ready(port)
        before = [len(hands.acknowledged) for hands in load]
        while any(len(hands.acknowledged) == was for hands, was in zip(load, before, strict=True)):
            await asyncio.sleep(PAUSE)  # every game goes on
        stop.set()
        await asyncio.gather(*players)
        verified = sum([await hands.look_over() for hands in load])
        for hands in load:
            hands.wire.close()
    with serving("server", "--database", calm) as port:
        await ready(port)
        await asyncio.gather(*(_without_kills(port, number, hands) for number, hands in enumerate(load)))
    faults = [fault for hands in load for fault in hands.faults]
    return {
        "kills": kills,
        "matches": MATCHES,
        "strokes": sum(len(hands.acknowledged) for hands in load),
        "sent_again": sum(hands.resent for hands in load),
        "records": verified,
        "faults": len(faults),
        "hours": round(hours, 2),
    }, faults


async def sit_down(port: int, number: int) -> Hands:
    """A match of two fresh agents, the same for the same number."""
    wire = Connection(port)
    return Hands(wire, await begin(wire, number, ORGANISER), polls=number % 2 > 0)


async def _play(hands: Hands, stop: asyncio.Event) -> None:
    while not stop.is_set():
        await hands.play()


async def _live(load: list[Hands], chance: random.Random, *, busy: bool) -> None:
    """Let a server live for a while: from its first stroke when it is to be busy, else from its start."""

    def strokes() -> int:
        return sum(len(hands.acknowledged) for hands in load)

    before, end = strokes(), time.monotonic() + ANSWERS_WITHIN
    while busy and strokes() == before and time.monotonic() < end:
        await asyncio.sleep(PAUSE / 4)
    await asyncio.sleep(chance.uniform(0.0, LONGEST_LIFE))


async def _without_kills(port: int, number: int, disturbed: Hands) -> None:
    """The same match at a server that nobody kills has to have the same strokes."""
    hands = await sit_down(port, number)
    while len(hands.acknowledged) < len(disturbed.acknowledged):
        await hands.play()
    hands.wire.close()
    disturbed.faults += hands.faults
    if hands.strokes != disturbed.strokes:
        disturbed.faults.append(f"match {number} has other strokes than without kills")


@contextlib.contextmanager
def fresh(database: str) -> Iterator[tuple[str, str]]:
    """The addresses of two new databases that keep what is committed."""
    if database == "sqlite":
        with tempfile.TemporaryDirectory() as folder:
            yield f"sqlite:///{folder}/killed.db", f"sqlite:///{folder}/calm.db"
    else:
        with cluster(durable=True) as made:
            yield made.new(), made.new()


def measure(full: bool) -> Tables:
    """Some kills on each database."""
    return of_databases(FULL if full else SHARE, DATABASES)


def of_databases(kills: int, databases: Sequence[str]) -> Tables:
    """A table for each database, and one of all faults."""
    tables: Tables = {"failures": []}
    for database in databases:
        with fresh(database) as (url, calm):
            row, faults = asyncio.run(killed(url, kills, calm))
        tables[database] = [row | {"load_after": round(os.getloadavg()[0], 1)}]
        tables["failures"] += [{"database": database, "fault": fault} for fault in faults]
    return tables


def main() -> None:
    """A run is a full one with 200 kills or more."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=SHARE, help="on each database; a full run has 200")
    parser.add_argument("--full", dest="kills", action="store_const", const=FULL)
    parser.add_argument("--database", choices=DATABASES, help="on this one alone")
    told = parser.parse_args()
    databases = [told.database] if told.database else DATABASES
    line = recording.run("kills", lambda _: of_databases(told.kills, databases), told.kills >= FULL)
    sys.exit(1 if line["tables"]["failures"] else 0)


if __name__ == "__main__":
    main()
