"""What a stroke over HTTP costs now, with and without `group_commit`, beside version 0.1.0 and beside a bare endpoint.

All servers run at the same time, each on a database of its own on the same disk, and are asked in turn; ratios are
medians over rounds, so that a loaded machine slows all. `stroke`: each is sent as soon as the one before is answered.
`turn`: each turn is fetched by long poll first, as players do. Strokes are sent with `Prefer: return=minimal`, which
0.1.0 does not know. CPU is the server process's, its start and warm-up left out.
"""

import asyncio
import contextlib
import json
import math
import statistics
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.checkouts import checkout
from benchmarks.command import main
from benchmarks.growth import serving_process
from benchmarks.load import ORGANISER, current_view, ready, serving
from benchmarks.load_client import Connection
from benchmarks.load_games import Player, begin, next_request
from benchmarks.recording import ROOT, Row, Tables

BASE = "8336b41"
"""Version 0.1.0."""
GAMES = (1, 10, 100)
WAYS = ("stroke", "turn")
BARE = "bare endpoint"
ANSWER, STORED, SENT = 4_000, 7_000, 350
"""Bytes of the bare endpoint's answer, row and request: what strokes with minimal answers come to."""
MINIMAL = b"Host: load\r\nPrefer: return=minimal\r\n"


def measure(full: bool) -> Tables:
    """A row for each server, way and number of games."""
    with tempfile.TemporaryDirectory() as name, checkout(BASE) as tree:
        rows = []
        for games in GAMES:
            folder = Path(name) / f"{games}"
            folder.mkdir()
            with _sides(folder, tree) as sides:
                rows += asyncio.run(_compare(sides, games, 5 if full else 3, 8.0 if full else 3.0))
    return {"strokes": rows}


@dataclass
class Side:
    """One of the servers that are compared."""

    name: str
    port: int
    process: int
    players: list["Client"] = field(default_factory=list)

    def cpu(self) -> float:
        """CPU seconds of the process so far (clock_getcpuclockid(3))."""
        return time.clock_gettime((~self.process << 3) | 2)


@contextlib.contextmanager
def _sides(folder: Path, tree: Path) -> Iterator[list[Side]]:
    with contextlib.ExitStack() as stack:

        def begun(name: str, module: str, *options: str, tree: Path = ROOT, **settings: str) -> Side:
            database = f"{folder}/{len(sides)}.db"
            where = database if module != "server" else f"sqlite:///{database}"
            port = stack.enter_context(serving(module, "--database", where, *options, tree=tree, settings=settings))
            return Side(name, port, serving_process(port))

        sides: list[Side] = []
        sides.append(begun("0.1.0", "server", tree=tree))
        sides.append(begun("now", "server", GROUP_COMMIT="false"))
        sides.append(begun("now, group_commit", "server", GROUP_COMMIT="true"))
        sides.append(begun(BARE, "benchmarks.bare_endpoint", "--answer", str(ANSWER), "--store", str(STORED)))
        yield sides


async def _compare(sides: list[Side], games: int, rounds: int, seconds: float) -> list[Row]:
    for side in sides:
        await _warmed_up(side, games)
    seen: dict[tuple[str, str], list[Round]] = defaultdict(list)
    for _ in range(rounds):
        for way in WAYS:
            for side in sides:
                seen[side.name, way].append(await _round(side, way, seconds))
    for side in sides:
        for client in side.players:
            client.close()
    return [_row(name, way, games, seen) for name, way in seen]


async def _warmed_up(side: Side, games: int) -> None:
    """Begin ``games`` games, or connections to the bare endpoint, and play some strokes in each."""
    if side.name == BARE:
        side.players = [Bare(side.port) for _ in range(games)]
    else:
        await ready(side.port)
        for number in range(games):
            wire = Connection(side.port)
            side.players.append(Game(wire, await begin(wire, number, ORGANISER)))
    await _round(side, WAYS[0], 2.0)


@dataclass
class Round:
    """What some seconds came to."""

    strokes: int = 0
    cpu_ms: float = 0.0
    rate: float = 0.0
    bytes: int = 0
    seconds: list[float] = field(default_factory=list)


async def _round(side: Side, way: str, seconds: float) -> Round:
    seen = Round()
    used, began = side.cpu(), time.perf_counter()
    await asyncio.gather(*(client.play(way, began + seconds, seen) for client in side.players))
    seen.rate = seen.strokes / (time.perf_counter() - began)
    seen.cpu_ms = 1e3 * (side.cpu() - used) / max(1, seen.strokes)
    return seen


class Client:
    """One that sends a request as soon as the one before is answered."""

    async def play(self, way: str, end: float, seen: Round) -> None:
        """Until `end` (s, `perf_counter`)."""
        while time.perf_counter() < end:
            await self.next(way, seen)

    async def next(self, way: str, seen: Round) -> None:
        """One stroke."""
        raise NotImplementedError

    def close(self) -> None:
        """Hang up."""
        raise NotImplementedError


class Bare(Client):
    """A connection to the bare endpoint."""

    def __init__(self, port: int) -> None:
        self._wire = Connection(port)
        self._body = json.dumps({"shot": "x" * (SENT - 200)}).encode()
        headers = f"Authorization: Bearer {'x' * 40}\r\n"
        self._request = Connection.request("POST", "/shot", length=len(self._body), headers=headers)

    async def next(self, way: str, seen: Round) -> None:
        """A request of a stroke's size."""
        began = time.perf_counter()
        reply = await self._wire.send(self._request, self._body)
        json.loads(reply.body)
        seen.seconds.append(time.perf_counter() - began)
        seen.strokes += 1
        seen.bytes += len(reply.body)

    def close(self) -> None:
        """Hang up."""
        self._wire.close()


class Game(Client):
    """A match, played by both its players over one connection."""

    def __init__(self, wire: Connection, players: tuple[Player, Player]) -> None:
        self._wire, self._players = wire, players
        self._view: dict[str, Any] | None = None
        self._tries = 0

    async def next(self, way: str, seen: Round) -> None:
        """A stroke or a decision."""
        view = self._view or await current_view(self._wire, self._players)
        if way == "turn":
            fetched = await self._fetched(view)
            if fetched is None:
                return  # it was news
            view = fetched
        request, body = next_request(view, self._players, self._tries)
        began = time.perf_counter()
        reply = await self._wire.send(request.replace(b"Host: load\r\n", MINIMAL), body)
        if reply.status != 200:
            self._tries, self._view = self._tries + 1, view
            return
        seen.seconds.append(time.perf_counter() - began)
        seen.strokes += 1
        seen.bytes += len(reply.body)
        following = json.loads(reply.body)["view"]
        self._tries, self._view = 0, None if following["turn"] is None else following

    async def _fetched(self, view: dict[str, Any]) -> dict[str, Any] | None:
        token = self._players[view["turn"]].token
        head = Connection.request("GET", "/v1/turns?wait=30", headers=f"Authorization: Bearer {token}\r\n")
        reply = await self._wire.send(head)
        message = json.loads(reply.body) if reply.status == 200 else {"type": None}
        return dict(message["view"]) if message["type"] == "turn" else None

    def close(self) -> None:
        """Hang up."""
        self._wire.close()


def _row(name: str, way: str, games: int, seen: dict[tuple[str, str], list[Round]]) -> Row:
    rounds, before, bare = seen[name, way], seen["0.1.0", way], seen[BARE, way]
    times = [second for each in rounds for second in each.seconds]
    p50, p99 = np.quantile(times, (0.5, 0.99)) if times else (math.nan, math.nan)
    return {
        "what": name,
        "way": way,
        "games": games,
        "cpu_ms": round(statistics.median(each.cpu_ms for each in rounds), 2),
        "cpu_of_0.1.0": _ratio([(each.cpu_ms, other.cpu_ms) for each, other in zip(rounds, before, strict=True)]),
        "a_second": round(statistics.median(each.rate for each in rounds), 1),
        "rate_of_bare": _ratio([(each.rate, other.rate) for each, other in zip(rounds, bare, strict=True)]),
        "p50_ms": round(1e3 * float(p50), 1),
        "p99_ms": round(1e3 * float(p99), 1),
        "answer_bytes": sum(each.bytes for each in rounds) // max(1, sum(each.strokes for each in rounds)),
    }


def _ratio(pairs: list[tuple[float, float]]) -> float:
    return round(statistics.median(one / other for one, other in pairs), 3)


if __name__ == "__main__":
    main("stroke_costs", measure)
