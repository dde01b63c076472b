"""Thousands of games over HTTP, in search of a time-out that nothing explains.

``python -m benchmarks.soak --games 20000``

Every player takes its turns from the long poll, answers at once, and is never silent: whoever loses on time or for not
showing up does so by a fault of the server. Prints how many turns and hours that was, and how often it can happen at
most, with 95 % confidence, if it was seen so seldom (Clopper and Pearson; three in n when it was never seen).
"""

import asyncio
import json
import os
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field

from scipy.stats import beta

from benchmarks import recording
from benchmarks.load import ORGANISER, connections, ready, serving
from benchmarks.load_client import Connection
from benchmarks.load_games import Player, begin, next_request
from benchmarks.recording import Tables

AT_ONCE = 16
"""Matches at a time."""
STROKES = 24
"""A game is given up after so many: more games in the same time, and ends of both kinds."""
CONFIDENCE = 0.95
UNEXPLAINED = ("time_out", "no_show")


@dataclass
class Exposure:
    """What was played.

    Attributes:
        ends: games by their reason. turns: strokes and decisions answered. waited_s: by players for their answers.
    """

    ends: Counter[str] = field(default_factory=Counter)
    turns: int = 0
    waited_s: float = 0.0

    @property
    def games(self) -> int:
        """Games that ended."""
        return self.ends.total()


def bound(seen: int, of: int) -> float:
    """The one-sided upper bound of a probability that was seen so often."""
    return 1.0 if seen >= of else float(beta.ppf(CONFIDENCE, seen + 1, of - seen))


async def soak(games: int) -> Exposure:
    """Play until so many games have ended."""
    exposure = Exposure()
    with (
        tempfile.TemporaryDirectory() as folder,
        serving("server", "--database", f"sqlite:///{folder}/soak.db") as port,
    ):
        await ready(port)
        async with connections(port, 2 * AT_ONCE) as wires:
            pairs = [(wires[2 * number], wires[2 * number + 1]) for number in range(AT_ONCE)]
            tables = [await begin(pair[0], number, ORGANISER) for number, pair in enumerate(pairs)]
            players = [
                attend(wire, table, seat, games, exposure)
                for pair, table in zip(pairs, tables, strict=True)
                for seat, wire in enumerate(pair)
            ]
            await asyncio.gather(*players)
    return exposure


async def attend(wire: Connection, table: tuple[Player, Player], seat: int, games: int, exposure: Exposure) -> None:
    """One player: the next message, and what it asks for."""
    poll = Connection.request("GET", "/v1/turns?wait=2", headers=f"Authorization: Bearer {table[seat].token}\r\n")
    refused = 0
    while exposure.games < games:
        reply = await wire.send(poll)
        if reply.status != 200:
            assert reply.status == 204, reply.body
            continue
        message = json.loads(reply.body)
        if message["type"] == "game_over" and seat == 0:
            exposure.ends[message["outcome"]["reason"]] += 1
        if message["type"] == "turn":
            refused = await answer(wire, message["view"], table, refused, exposure)


async def answer(
    wire: Connection, view: dict[str, object], table: tuple[Player, Player], refused: int, exposure: Exposure
) -> int:
    """Play the turn; how often in a row that was refused."""
    head, body = next_request(view, table, refused)
    if int(str(view["version"])) > STROKES:
        head, body = head.replace(b"/shots", b"/concede").replace(b"/decisions", b"/concede"), body
    started = time.perf_counter()
    reply = await wire.send(head, body)
    exposure.waited_s += time.perf_counter() - started
    assert reply.status in (200, 422), reply.body
    exposure.turns += reply.status == 200
    return refused + 1 if reply.status == 422 else 0


def measure(games: int) -> Tables:
    """Play, and account for it."""
    started = time.perf_counter()
    exposure = asyncio.run(soak(games))
    unexplained = sum(exposure.ends[reason] for reason in UNEXPLAINED)
    row = {
        "games": exposure.games,
        "player_turns": exposure.turns,
        "hours": round((time.perf_counter() - started) / 3600, 3),
        "game_hours": round(AT_ONCE * (time.perf_counter() - started) / 3600, 2),
        "unexplained_time_outs": unexplained,
        "at_most_a_game_95": bound(unexplained, exposure.games),
        "at_most_a_turn_95": bound(unexplained, exposure.turns),
        "mean_answer_ms": round(1e3 * exposure.waited_s / max(1, exposure.turns), 1),
        "load_after": round(os.getloadavg()[0], 1),
    }
    return {"exposure": [row], "ends": [dict(sorted(exposure.ends.items()))]}


def main() -> None:
    """`--games N`; a full run has 20,000."""
    words = sys.argv[1:]
    games = int(words[words.index("--games") + 1]) if "--games" in words else 20_000 if "--full" in words else 100
    line = recording.run("soak", lambda _: measure(games), full=games >= 20_000)
    sys.exit(1 if line["tables"]["exposure"][0]["unexplained_time_outs"] > 1 else 0)


if __name__ == "__main__":
    main()
