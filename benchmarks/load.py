"""Shots a second through real HTTP at 1 to 500 concurrent games, next to a bare endpoint on the same stack.

Every game is played from its answers: a stroke is sent as soon as the one before is answered, whoever's turn it is. The
clock of the measurement starts when every game has its first break behind it, whose answer is five times the others'.
Shots answered by its end count for the rate; those sent by its end, however late they are answered, for the times. The
bare endpoint (`benchmarks.bare_endpoint`) does nothing but one transaction of as many bytes, flushed as the server's
are, and answers as many bytes; it gets requests of the same size from the same client. So what differs is what
the server does about a shot: token, repetition, version, clocks, rules, physics, record and view.
"""

import asyncio
import contextlib
import json
import math
import os
import secrets
import subprocess
import sys
import tempfile
import time
from collections.abc import AsyncIterator, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.command import main
from benchmarks.load_client import Connection, Reply
from benchmarks.load_games import Player, begin, next_request
from benchmarks.recording import ROOT, Row, Tables

GAMES = (1, 10, 100, 500)
ORGANISER = secrets.token_hex(32)


def measure(full: bool) -> Tables:
    """Each number of games on the server, then on the bare endpoint with the bytes that the server was seen to move."""
    seconds = 10.0 if full else 3.0
    rows = [row for games in GAMES for row in asyncio.run(compare(games, seconds))]
    return {"shots": rows}


async def compare(games: int, seconds: float) -> list[Row]:
    """The rows of the server, with `group_commit` off and on, and of the bare endpoint."""
    played, size, kept = await _played(games, seconds, group_commit=False)
    together, *_ = await _played(games, seconds, group_commit=True)
    answer, request = int(np.mean(played.answered)), int(np.mean(played.sent))
    with tempfile.TemporaryDirectory() as folder:
        options = ("--answer", str(answer), "--store", str(size), "--database", f"{folder}/bare.db")
        with serving("benchmarks.bare_endpoint", *options) as port:
            bare = await hammer(port, games, seconds, request)
    sizes = {"answer_bytes": answer, "stored_bytes": size, "kept_bytes": kept}
    sides = {"server": played, "server, group_commit": together, "bare endpoint": bare}
    return [seen.row(what, games) | {"of_bare": seen.rate / bare.rate} | sizes for what, seen in sides.items()]


async def _played(games: int, seconds: float, *, group_commit: bool) -> tuple["Tally", int, int]:
    """What a server made of it, and the bytes of a shot: written, and left when the answers are deleted."""
    with tempfile.TemporaryDirectory() as folder:
        database = Path(folder) / "pooliad.db"
        settings = {"GROUP_COMMIT": str(group_commit).lower()}
        with serving("server", "--database", f"sqlite:///{database}", settings=settings) as port:
            await ready(port)
            played = await play(port, games, seconds)
        size, kept = (total // max(1, played.shots) for total in stored_bytes(database))
        return played, size, kept


class Tally:
    """What a run saw after its warm-up: a shot in every game, and some seconds.

    Args:
        seconds: to measure. games: whose first shots are waited for.
    """

    def __init__(self, seconds: float, games: int) -> None:
        self.seconds = seconds
        self.begins = self.ends = math.inf
        self._warm_at = time.perf_counter() + min(3.0, seconds / 3)
        self._to_warm = games
        self.shots = 0
        """All, those of the warm-up too."""
        self.in_time = 0
        """Answered before the end."""
        self.latencies: list[float] = []
        self.answered: list[int] = []
        self.sent: list[int] = []
        self.refused = 0

    @property
    def is_over(self) -> bool:
        """Whether to stop."""
        return time.perf_counter() >= self.ends

    def add(self, started: float, sent: int, reply: Reply) -> None:
        """Count an answer."""
        now = time.perf_counter()
        if reply.status != 200:
            self.refused += 1
            return
        self.shots += 1
        if self.begins <= started:
            self.latencies.append(now - started)
        if self.begins <= now < self.ends:
            self.in_time += 1
            self.answered.append(len(reply.body))
            self.sent.append(sent)

    def is_warm(self) -> None:
        """One more game, or connection, has its first answer."""
        self._to_warm -= 1
        if self._to_warm == 0:
            self.begins = max(time.perf_counter(), self._warm_at)
            self.ends = self.begins + self.seconds

    @property
    def rate(self) -> float:
        """Shots a second."""
        return self.in_time / self.seconds

    def row(self, what: str, games: int) -> Row:
        """The figures."""
        p50, p99 = np.quantile(self.latencies, (0.5, 0.99))
        return {
            "what": what,
            "games": games,
            "shots_a_second": round(self.rate, 1),
            "p50_ms": round(1e3 * float(p50), 2),
            "p99_ms": round(1e3 * float(p99), 2),
            "shots": self.in_time,
            "refused": self.refused,
        }


async def play(port: int, games: int, seconds: float) -> Tally:
    """Play so many games at once."""
    async with connections(port, games) as wires:
        tables = [await begin(wire, number, ORGANISER) for number, wire in enumerate(wires)]
        tally = Tally(seconds, games)
        await asyncio.gather(*(play_one(wire, table, tally) for wire, table in zip(wires, tables, strict=True)))
    return tally


async def play_one(wire: Connection, players: tuple[Player, Player], tally: Tally) -> None:
    """One match, stroke after stroke."""
    view, tries, cold = await current_view(wire, players), 0, True
    while not tally.is_over:
        request, body = next_request(view, players, tries)
        started = time.perf_counter()
        reply = await wire.send(request, body)
        tally.add(started, len(request) + len(body), reply)
        if reply.status != 200:
            tries += 1
            continue
        if cold:
            tally.is_warm()
        view, tries, cold = json.loads(reply.body)["view"], 0, False
        if view["turn"] is None:
            view = await current_view(wire, players)


async def current_view(wire: Connection, players: tuple[Player, Player]) -> dict[str, Any]:
    """The view of the game that is being played."""
    match = json.loads((await wire.get(f"/v1/matches/{players[0].match}")).body)
    return dict(json.loads((await wire.get(f"/v1/games/{match['played'][-1]['id']}")).body)["view"])


async def hammer(port: int, games: int, seconds: float, size: int) -> Tally:
    """As many connections at the bare endpoint."""
    body = json.dumps({"shot": "x" * max(0, size - 200)}).encode()
    request = Connection.request("POST", "/shot", length=len(body), headers=f"Authorization: Bearer {'x' * 40}\r\n")
    async with connections(port, games) as wires:
        tally = Tally(seconds, games)

        async def one(wire: Connection) -> None:
            json.loads((await wire.send(request, body)).body)
            tally.is_warm()
            while not tally.is_over:
                started = time.perf_counter()
                reply = await wire.send(request, body)
                tally.add(started, len(request) + len(body), reply)
                json.loads(reply.body)

        await asyncio.gather(*(one(wire) for wire in wires))
    return tally


@contextlib.asynccontextmanager
async def connections(port: int, count: int) -> AsyncIterator[list[Connection]]:
    """Open so many."""
    made = [Connection(port) for _ in range(count)]
    try:
        yield made
    finally:
        for wire in made:
            wire.close()


@contextlib.contextmanager
def serving(module: str, *options: str, tree: Path = ROOT, settings: Mapping[str, str] | None = None) -> Iterator[int]:
    """A server as a process, of the checkout that is named, with settings of its own; its port."""
    limits = dict.fromkeys(("TOKEN_RATE", "TOKEN_BURST", "ADDRESS_RATE", "ADDRESS_BURST"), "1e9")
    environment = os.environ | {"POOLIAD_ORGANISER_TOKEN": ORGANISER}
    environment |= {f"POOLIAD_{name}": value for name, value in limits.items()}
    environment |= {"POOLIAD_LOG_LEVEL": "warning", "POOLIAD_STREAMS": "1000", "PYTHONPATH": str(tree)}
    environment |= {f"POOLIAD_{name}": value for name, value in (settings or {}).items()}
    command = [sys.executable, "-P", "-m", module, "--port", "0", *options]
    with subprocess.Popen(command, env=environment, cwd=tree, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            yield int(json.loads(process.stdout.readline())["url"].rpartition(":")[2])
        finally:
            process.terminate()


async def ready(port: int) -> None:
    """Wait until the kernels are loaded."""
    async with connections(port, 1) as (wire,):
        while (await wire.get("/readyz")).status != 200:
            await asyncio.sleep(0.1)


def stored_bytes(database: Path) -> tuple[int, int]:
    """Bytes that the shots wrote, their games' rows and answers among them; and those of the file that stay for good.

    The second are measured: answers are deleted, as they are when nobody can ask for them again, and the file is made
    smaller.
    """
    import sqlite3

    with contextlib.closing(sqlite3.connect(database)) as connection:
        columns = {
            "moves": ("stroke", "line", "packed"),
            "answers": ("body", "headers", "route", "key", "request_digest"),
        }
        written = 0
        for table, names in columns.items():
            for name in names:
                written += connection.execute(f"SELECT coalesce(sum(length({name})), 0) FROM {table}").fetchone()[0]
        state = connection.execute("SELECT avg(length(state)) FROM games").fetchone()[0]
        moves = connection.execute("SELECT count(*) FROM moves").fetchone()[0]
        connection.execute("DELETE FROM answers")
        connection.commit()
        connection.execute("VACUUM")
        (page_size,) = connection.execute("PRAGMA page_size").fetchone()
        (pages,) = connection.execute("PRAGMA page_count").fetchone()
        return int(written + state * moves), page_size * pages


if __name__ == "__main__":
    main("load", measure)
