"""What lists, strokes and a start cost in a database of 10^5 finished games, beside one that is new.

Both servers run at the same time and are asked in turn. Costs are CPU time of the server's process, from the first
byte of a request to the end of its answer, HTTP included; each ratio is the median over neighbouring rounds, so that a
loaded machine slows both sides.
"""

import asyncio
import contextlib
import json
import statistics
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from benchmarks.command import main
from benchmarks.growth_fill import AGENTS, fill
from benchmarks.load import ORGANISER, connections, current_view, ready, serving
from benchmarks.load_client import Connection
from benchmarks.load_games import Player, begin, next_request
from benchmarks.recording import Row, Tables

GAMES = 100_000
FEW = 2_000
"""For a short run."""
AGENT = f"agent_{AGENTS // 2:016x}"
LISTS = {
    "matches": "/v1/matches",
    "matches, finished": "/v1/matches?status=finished",
    "matches, running": "/v1/matches?status=running",
    "matches of an agent": f"/v1/matches?agent={AGENT}",
    "matches of an agent, finished": f"/v1/matches?agent={AGENT}&status=finished",
    "matches, by a name": "/v1/matches?search=player%20500",
    "matches, by a part of all names": "/v1/matches?search=player",
    "matches, by a name that there is not": "/v1/matches?search=nobody",
    "agents": "/v1/agents",
    "agents, by a name": "/v1/agents?search=player%20500",
    "house bots": "/v1/agents?house=true",
    "tournaments": "/v1/tournaments",
    "tournaments, finished": "/v1/tournaments?status=finished",
    "tournaments, by a name": "/v1/tournaments?search=event%20500",
    "strokes of a game": "/v1/games/{game}/shots",
    "a game": "/v1/games/{game}",
    "a game's clock": "/v1/games/{game}/clock",
    "turns, none": "/v1/turns",
}


def measure(full: bool) -> Tables:
    """Fill one database, and ask both servers."""
    games = GAMES if full else FEW
    with tempfile.TemporaryDirectory() as name:
        new, filled = Path(name) / "new.db", Path(name) / "filled.db"
        for database in (new, filled):
            asyncio.run(_one_match(database))
        began = time.perf_counter()
        fill(filled, games)
        filling = time.perf_counter() - began
        with Side(new) as before, Side(filled) as after:
            starts = [
                {"what": each.what, "cpu_s": each.start_cpu, "wall_s": each.start_wall} for each in (before, after)
            ]
            lists = list(asyncio.run(_lists(before, after, 20 if full else 3)))
            strokes = asyncio.run(_strokes(before, after, 15 if full else 3))
        size = filled.stat().st_size
    what = {"games": games, "filled_in_s": round(filling, 1), "file_MB": round(size / 1e6)}
    return {"database": [what], "lists": lists, "strokes": [strokes], "starts": starts}


class Side:
    """A server on one database, with settings of its own."""

    def __init__(self, database: Path, settings: Mapping[str, str] | None = None) -> None:
        self.what, self._database, self._settings = database.stem, database, settings
        self._stack = contextlib.ExitStack()

    def __enter__(self) -> "Side":
        began = time.perf_counter()
        self.port = self._stack.enter_context(self._serving())
        self.start_wall = round(time.perf_counter() - began, 2)
        self.process = serving_process(self.port)
        self.start_cpu = round(self.cpu(), 2)
        asyncio.run(ready(self.port))
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def _serving(self) -> contextlib.AbstractContextManager[int]:
        return serving("server", "--database", f"sqlite:///{self._database}", settings=self._settings)

    def cpu(self) -> float:
        """CPU seconds of the server so far, by the clock of its process (clock_getcpuclockid(3))."""
        return time.clock_gettime((~self.process << 3) | 2)


def serving_process(port: int) -> int:
    """The process that listens at a port of this machine (`/proc/net/tcp`)."""
    lines = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    inode = next(line[9] for line in lines if line[1].endswith(f":{port:04X}") and line[3] == "0A")
    for one in Path("/proc").glob("[0-9]*/fd/*"):
        with contextlib.suppress(OSError):
            if str(one.readlink()) == f"socket:[{inode}]" and (one.parents[1] / "stat").read_text().split()[3] != "0":
                return int(one.parts[2])
    raise RuntimeError(f"nobody listens at {port}")


async def _one_match(database: Path) -> None:
    """A database in which a match was played, and an event made, by the server itself."""
    with serving("server", "--database", f"sqlite:///{database}") as port:
        await ready(port)
        async with connections(port, 1) as (wire,):
            players = await begin(wire, 0, ORGANISER, games=1)
            await _event(wire)
            view = await current_view(wire, players)
            for stroke in range(10**6):
                request, body = next_request(view, players, 99 if stroke >= 30 else 0)
                reply = await wire.send(request, body)
                view = json.loads(reply.body)["view"] if reply.status == 200 else await current_view(wire, players)
                if view["turn"] is None:
                    return


async def _event(wire: Connection) -> None:
    names = ["ann", "bob"]
    for name in names:
        await wire.post("/v1/agents", {"name": name}, ORGANISER, name)
    await wire.post("/v1/tournaments", {"terms": {"name": "event", "entrants": names}}, ORGANISER, "event")


async def _lists(before: Side, after: Side, rounds: int) -> list[Row]:
    async with connections(before.port, 1) as (one,), connections(after.port, 1) as (other,):
        players = [await begin(wire, 1, ORGANISER) for wire in (one, other)]
        games = [(await current_view(wire, each))["game"] for wire, each in zip((one, other), players, strict=True)]
        return [
            await _list(what, path, ((before, one, players[0], games[0]), (after, other, players[1], games[1])), rounds)
            for what, path in LISTS.items()
        ]


async def _list(what: str, path: str, sides: Any, rounds: int) -> Row:
    """The costs of one list at both servers, asked in turn, ten times a round."""
    costs: tuple[list[float], list[float]] = ([], [])
    for _ in range(rounds):
        for each, (side, wire, players, game) in zip(costs, sides, strict=True):
            head = f"Authorization: Bearer {players[0 if path != '/v1/turns' else 1].token}\r\n"
            request = Connection.request("GET", path.format(game=game), headers=head)
            used = side.cpu()
            for _ in range(10):
                reply = await wire.send(request)
                assert reply.status in (200, 204), reply
            each.append(1e2 * (side.cpu() - used))
    new, filled = (statistics.median(each) for each in costs)
    return {"list": what, "new_ms": round(new, 2), "filled_ms": round(filled, 2), "bytes": len(reply.body)}


async def _strokes(before: Side, after: Side, rounds: int) -> Row:
    """CPU time a stroke, ten games at a time at each server in turn."""
    sides = []
    for side in (before, after):
        wires = [Connection(side.port) for _ in range(10)]
        players = [await begin(wire, 100 + number, ORGANISER) for number, wire in enumerate(wires)]
        sides.append((side, [Table(wire, each) for wire, each in zip(wires, players, strict=True)]))
    for _, tables in sides:
        await asyncio.gather(*(table.play(5) for table in tables))
    pairs = []
    for _ in range(rounds):
        costs = []
        for side, tables in sides:
            used = side.cpu()
            played = sum(await asyncio.gather(*(table.play(20) for table in tables)))
            costs.append(1e3 * (side.cpu() - used) / played)
        pairs.append(costs)
    new, filled = (statistics.median(each) for each in zip(*pairs, strict=True))
    ratio = statistics.median(filled / new for new, filled in pairs)
    return {"rounds": rounds, "new_ms": round(new, 3), "filled_ms": round(filled, 3), "ratio": round(ratio, 3)}


class Table:
    """A match that goes on, played from its answers."""

    def __init__(self, wire: Connection, players: tuple[Player, Player]) -> None:
        self._wire, self._players = wire, players
        self._view: dict[str, Any] | None = None
        self._tries = 0

    async def play(self, requests: int) -> int:
        """Send `requests` requests; returns the number of strokes played."""
        played = 0
        for _ in range(requests):
            view = self._view or await current_view(self._wire, self._players)
            request, body = next_request(view, self._players, self._tries)
            reply = await self._wire.send(request, body)
            self._tries = 0 if reply.status == 200 else self._tries + 1
            if reply.status == 200:
                played += 1
                following = json.loads(reply.body)["view"]
                self._view = None if following["turn"] is None else following
            else:
                self._view = view
        return played


if __name__ == "__main__":
    main("growth", measure)
