"""What players notice of a client that keeps the batch endpoint busy: times of strokes with and without it, in turns.

A few games are played through real HTTP as in `benchmarks.load`. In every other period one more client sends batches of
simulations back to back, a rack with fast shots in all directions, so that the physics' threads never rest.
"""

import asyncio
import contextlib
import json
import tempfile
from collections.abc import AsyncIterator
from typing import Any

import numpy as np

import physics
from benchmarks.command import main
from benchmarks.load import ORGANISER, Tally, connections, play_one, ready, serving
from benchmarks.load_client import Connection
from benchmarks.load_games import begin
from benchmarks.recording import Row, Tables

GAMES = 4
ROWS = 1000
"""Shots of a batch: some 50 ms of a core."""


def measure(full: bool) -> Tables:
    """Periods without and with the batches, one after the other."""
    return {"strokes": asyncio.run(compare(periods=7 if full else 2, seconds=8.0 if full else 3.0))}


async def compare(periods: int, seconds: float) -> list[Row]:
    """The quiet row and the busy one."""
    found: dict[str, list[Tally]] = {"quiet": [], "batches": []}
    simulated = dict.fromkeys(found, 0)
    with (
        tempfile.TemporaryDirectory() as folder,
        serving("server", "--database", f"sqlite:///{folder}/pooliad.db") as port,
    ):
        await ready(port)
        async with connections(port, GAMES) as wires:
            tables = [await begin(wire, number, ORGANISER) for number, wire in enumerate(wires)]
            for _ in range(periods):
                for name, tallies in found.items():
                    async with batches(port, busy=name == "batches") as count:
                        tally = Tally(seconds, GAMES)
                        await asyncio.gather(
                            *(play_one(wire, table, tally) for wire, table in zip(wires, tables, strict=True))
                        )
                    tallies.append(tally)
                    simulated[name] += count[0]
    rows = [row(name, tallies, seconds) for name, tallies in found.items()]
    quiet = rows[0]["p99_ms"]
    for each in rows:
        each |= {"p99_ratio": round(each["p99_ms"] / quiet, 2), "simulated": simulated[each["what"]]}
    return rows


@contextlib.asynccontextmanager
async def batches(port: int, busy: bool) -> AsyncIterator[list[int]]:
    """One client that sends batches for as long as the block lasts, if it is to; how many shots were answered."""
    count = [0]
    task = asyncio.create_task(saturate(port, count)) if busy else None
    try:
        yield count
    finally:
        if task is not None:
            task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await task


async def saturate(port: int, count: list[int]) -> None:
    """Send batch after batch."""
    body = json.dumps(scene()).encode()
    head = Connection.request(
        "POST", "/v1/simulate/batch", length=len(body), headers=f"Authorization: Bearer {ORGANISER}\r\n"
    )
    async with connections(port, 1) as (wire,):
        while True:
            reply = await wire.send(head, body)
            assert reply.status == 200, reply.body
            count[0] += ROWS


def scene() -> dict[str, Any]:
    """A rack, and fast shots in all directions."""
    state = physics.rack(physics.Table.olympiad(), "eight_ball", seed=1)
    balls = {str(ball): state.position(ball) for ball in state.balls}
    shots = [{"v": 8.0, "phi": 360.0 * n / ROWS, "theta": 50.0, "a": 0.0, "b": 0.0} for n in range(ROWS)]
    return {"balls": balls, "shots": shots}


def row(what: str, tallies: list[Tally], seconds: float) -> Row:
    """All periods of one kind together."""
    latencies = np.concatenate([np.array(tally.latencies) for tally in tallies])
    in_time = sum(tally.in_time for tally in tallies)
    p50, p99 = np.quantile(latencies, (0.5, 0.99))
    return {
        "what": what,
        "games": GAMES,
        "strokes_a_second": round(in_time / (seconds * len(tallies)), 1),
        "p50_ms": round(1e3 * float(p50), 2),
        "p99_ms": round(1e3 * float(p99), 2),
        "strokes": len(latencies),
    }


if __name__ == "__main__":
    main("saturation", measure)
