"""What players notice of sixteen clients that play the costliest strokes there are: times of strokes with and without.

A few games are played through real HTTP as in `benchmarks.load`. In every other period sixteen more clients play games
that they began by challenge, on a table and from a start chosen for strokes of 20,000 events: a row of balls a hair
apart, on slow cloth, that lose a fifth of their speed in every collision. Each plays such a stroke, gives the game up,
and plays the next one, as fast as it is answered.
"""

import asyncio
import contextlib
import itertools
import json
import tempfile
from collections import Counter
from collections.abc import AsyncIterator
from typing import Any

from benchmarks.command import main
from benchmarks.load import ORGANISER, Tally, connections, current_view, play_one, ready, serving
from benchmarks.load_client import Connection
from benchmarks.load_games import Player, begin
from benchmarks.recording import Row, Tables
from benchmarks.saturation import row
from physics.constants import BALL_RADIUS

GAMES = 4
HOSTILE = 16
HAIR = 1e-5
"""m, between the balls of the row."""
TABLE = {
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
"""Within half of the named table's parameters: what a player may ask of another."""
SHOT = {"v": 7.6, "phi": 270.0, "theta": 5.0, "a": 0.1, "b": -0.5}

_keys = itertools.count()


def measure(full: bool) -> Tables:
    """Periods without and with the hostile clients, in turns."""
    return {"strokes": asyncio.run(compare(periods=4 if full else 1, seconds=60.0 if full else 20.0))}


async def compare(periods: int, seconds: float) -> list[Row]:
    """The quiet row and the busy one. Every period has a server of its own: what was asked for is played after it."""
    found: dict[str, list[Tally]] = {"quiet": [], "costly strokes": []}
    asked, answered = dict.fromkeys(found, 0), dict.fromkeys(found, 0)
    for _ in range(periods):
        for name, tallies in found.items():
            tally, count = await period(HOSTILE if name != "quiet" else 0, seconds)
            tallies.append(tally)
            asked[name] += count["asked"]
            answered[name] += count["answered"]
    measured = [row(name, tallies, seconds) for name, tallies in found.items()]
    quiet = measured[0]["p99_ms"]
    for each in measured:
        name = each["what"]
        each |= {"p99_ratio": round(each["p99_ms"] / quiet, 2), "asked": asked[name], "answered": answered[name]}
    return measured


async def period(hostile: int, seconds: float) -> tuple[Tally, Counter[str]]:
    """The strokes of a fresh server's games beside so many hostile clients, and what those came to."""
    with (
        tempfile.TemporaryDirectory() as folder,
        serving("server", "--database", f"sqlite:///{folder}/pooliad.db") as port,
    ):
        await ready(port)
        async with connections(port, GAMES) as wires, connections(port, hostile) as others:
            tables = [await begin(wire, number, ORGANISER) for number, wire in enumerate(wires)]
            matches = [await challenge(wire, number) for number, wire in enumerate(others)]
            async with crowd(port, matches) as count:
                tally = Tally(seconds, GAMES)
                played = (play_one(wire, table, tally) for wire, table in zip(wires, tables, strict=True))
                await asyncio.gather(*played)
    return tally, count


def start() -> dict[str, Any]:
    """The row of balls, and the cue ball behind it."""
    x, y, step = 0.11732483858262863, 0.3189617756320054, 2.0 * BALL_RADIUS + HAIR
    balls: dict[str, list[float]] = {str(ball): [x, y + step * (ball - 1)] for ball in range(1, 14)}
    balls["0"] = [x, y + 12.0 * step + 0.0672]
    return {"balls": balls, "groups": ["solids", "stripes"]}


async def challenge(wire: Connection, number: int) -> tuple[Player, Player]:
    """A match that two hostile agents have agreed upon."""
    names = [f"hostile {number} {seat}" for seat in (0, 1)]
    made = [await wire.post("/v1/agents", {"name": name}, ORGANISER, name) for name in names]
    terms = {
        "agents": [one["agent"]["id"] for one in made],
        "games": 1000,
        "table": TABLE,
        "start": start(),
        "noise": {"level": 0.0, "told": True},
        "clock": {"seconds": 86_400},
    }
    match = await wire.post("/v1/matches", terms, made[0]["token"], f"hostile {number}")
    await wire.post(f"/v1/matches/{match['id']}/accept", {}, made[1]["token"], f"accept {number}")
    one, two = (Player(each["token"], match["id"]) for each in made)
    return one, two


@contextlib.asynccontextmanager
async def crowd(port: int, matches: list[tuple[Player, Player]]) -> AsyncIterator[Counter[str]]:
    """These clients at work for as long as the block lasts; how many costly strokes were asked for, and answered."""
    count: Counter[str] = Counter(asked=0, answered=0)
    tasks = [asyncio.create_task(hold_up(port, players, count)) for players in matches]
    try:
        yield count
    finally:
        for task in tasks:
            task.cancel()
        for result in await asyncio.gather(*tasks, return_exceptions=True):
            if not isinstance(result, asyncio.CancelledError):
                raise RuntimeError("a hostile client came to an end") from result


async def hold_up(port: int, players: tuple[Player, Player], count: Counter[str]) -> None:
    """Play the stroke, give the game up, and again."""
    async with connections(port, 1) as (wire,):
        while True:
            view = await current_view(wire, players)
            turn = players[view["turn"]].token
            verb, action = "concede", {}
            if view["strokes_since"] == []:
                callable_ball = view["callable_balls"][0]
                verb, action = "shots", {"shot": SHOT, "call": {"ball": callable_ball, "pocket": 0}, "cue_ball": None}
            body = json.dumps(action).encode()
            headers = (
                f"Authorization: Bearer {turn}\r\n"
                f'If-Match: "{view["version"]}"\r\nIdempotency-Key: costly {next(_keys)}\r\n'
            )
            request = Connection.request("POST", f"/v1/games/{view['game']}/{verb}", len(body), headers)
            count["asked"] += verb == "shots"
            reply = await wire.send(request, body)
            assert reply.status == 200 or b"stale" in reply.body, reply.body
            count["answered"] += verb == "shots" and reply.status == 200


if __name__ == "__main__":
    main("costly_strokes", measure)
