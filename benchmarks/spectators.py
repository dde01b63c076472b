"""What a stroke costs the server when 100 watch the game, beside the same with nobody watching.

CPU time of the server's process, strokes at a steady pace; each figure is the median over rounds with and without
spectators in turn. The spectators are another process's and read all that comes; all of them are seen to get every
stroke.
"""

import asyncio
import contextlib
import statistics
import tempfile
from pathlib import Path

from benchmarks.command import main
from benchmarks.growth import Side, Table
from benchmarks.load import ORGANISER, current_view
from benchmarks.load_client import Connection
from benchmarks.load_games import begin
from benchmarks.recording import Row, Tables

SPECTATORS = (1, 10, 100)
STROKES = 20
"""In a round."""
PACE = 0.12
"""Seconds between strokes: longer than the spectators' looks are apart."""


def measure(full: bool) -> Tables:
    """A row for each number of spectators."""
    with tempfile.TemporaryDirectory() as name, Side(Path(name) / "watched.db") as side:
        return {"spectators": [asyncio.run(_watched(side, count, 9 if full else 3)) for count in SPECTATORS]}


async def _watched(side: Side, count: int, rounds: int) -> Row:
    wire = Connection(side.port)
    players = await begin(wire, count, ORGANISER)
    table = Table(wire, players)
    await table.play(3)
    alone, watched, told = [], [], 0
    for _ in range(rounds):
        alone.append(await _round(side, table))
        game = (await current_view(wire, players))["game"]
        audience = [Watcher() for _ in range(count)]
        watching = [asyncio.create_task(each.watch(side.port, game)) for each in audience]
        while not all(each.is_told for each in audience):
            await asyncio.sleep(0.02)
        before = [each.strokes for each in audience]
        watched.append(await _round(side, table))
        await asyncio.sleep(0.3)
        told += sum(each.strokes - seen for each, seen in zip(audience, before, strict=True))
        for task in watching:
            task.cancel()
        await asyncio.gather(*watching, return_exceptions=True)
    wire.close()
    costs = [1e3 * (more - less) for less, more in zip(alone, watched, strict=True)]
    return {
        "spectators": count,
        "stroke_ms": round(1e3 * statistics.median(alone), 2),
        "watched_ms": round(1e3 * statistics.median(watched), 2),
        "spectators_ms": round(statistics.median(costs), 2),
        "told": told,
    }


async def _round(side: Side, table: Table) -> float:
    """CPU seconds a stroke."""
    used, played = side.cpu(), 0
    for _ in range(STROKES):
        played += await table.play(1)
        await asyncio.sleep(PACE)
    return (side.cpu() - used) / played


class Watcher:
    """Somebody who watches a game, and counts."""

    def __init__(self) -> None:
        self.strokes = 0
        self.is_told = False

    async def watch(self, port: int, game: str) -> None:
        """Read the game's stream until it ends or this is cancelled."""
        reader, writer = await asyncio.open_connection("127.0.0.1", port, limit=1 << 22)
        with contextlib.closing(writer):
            writer.write(Connection.request("GET", f"/v1/games/{game}/stream"))
            while line := await reader.readline():
                self.strokes += line.startswith((b"event: stroke", b"event: decision"))
                self.is_told |= line.startswith(b"event: clocks")


if __name__ == "__main__":
    main("spectators", measure)
