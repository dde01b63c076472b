"""Thousands of games over HTTP, in search of a time-out that nothing explains.

``python -m benchmarks.soak --games 20000 --minutes 120``

Every player takes its turns from the long poll, answers at once, and is never silent: whoever loses on time or for
not showing up does so by a fault of the server. It ends with the games or with the minutes. Prints how many turns and
hours that was, and how often it can happen at most, with 95 % confidence, if it was seen so seldom (Clopper and
Pearson; three in n when it was never seen).
"""

import argparse
import asyncio
import itertools
import json
import math
import os
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from scipy.stats import beta

from benchmarks import recording
from benchmarks.load import ORGANISER, connections, ready, serving
from benchmarks.load_client import Connection
from benchmarks.load_games import Player, begin, next_request
from benchmarks.recording import Tables

AT_ONCE = 16
"""Matches at a time."""
MATCH_GAMES = 50
"""Then the match is over and two fresh agents begin another."""
CLOCK = 300.0
"""Seconds a player has for a game: hundreds of times what it needs on a machine that does nothing else."""
STROKES = 24
"""A game is given up after so many: more games in the same time, and ends of both kinds."""
FULL = 20_000
SHARE = 100
CONFIDENCE = 0.95
UNEXPLAINED = ("time_out", "no_show")


@dataclass
class Exposure:
    """What was played.

    Attributes:
        wanted: games after which it is over. until: s, on this machine's clock, when it is over at the latest.
        ends: games by their reason. turns: strokes and decisions answered.
        refused: strokes that could not be. waited_s: by players for their answers.
    """

    wanted: int
    until: float
    ends: Counter[str] = field(default_factory=Counter)
    turns: int = 0
    refused: int = 0
    waited_s: float = 0.0

    @property
    def games(self) -> int:
        """Games that ended."""
        return self.ends.total()

    @property
    def is_over(self) -> bool:
        """Whether that is enough."""
        return self.games >= self.wanted or time.perf_counter() >= self.until


def bound(seen: int, of: int) -> float:
    """The one-sided upper bound of a probability that was seen so often."""
    return 1.0 if seen >= of else float(beta.ppf(CONFIDENCE, seen + 1, of - seen))


async def soak(games: int, minutes: float) -> Exposure:
    """Play until so many games have ended, or so many minutes have passed."""
    exposure = Exposure(games, time.perf_counter() + 60.0 * minutes)
    with (
        tempfile.TemporaryDirectory() as folder,
        serving("server", "--database", f"sqlite:///{folder}/soak.db") as port,
    ):
        await ready(port)
        async with connections(port, 2 * AT_ONCE) as wires:
            numbers = itertools.count()
            await asyncio.gather(
                *(pair_up(wires[place], wires[place + 1], numbers, exposure) for place in range(0, 2 * AT_ONCE, 2))
            )
    return exposure


async def pair_up(one: Connection, two: Connection, numbers: Iterator[int], exposure: Exposure) -> None:
    """Match after match."""
    while not exposure.is_over:
        table = await begin(one, next(numbers), ORGANISER, games=MATCH_GAMES, seconds=CLOCK)
        await asyncio.gather(*(attend(wire, table, seat, exposure) for seat, wire in enumerate((one, two))))


async def attend(wire: Connection, table: tuple[Player, Player], seat: int, exposure: Exposure) -> None:
    """One player in one match: the next message, and what it asks for."""
    poll = Connection.request("GET", "/v1/turns?wait=2", headers=f"Authorization: Bearer {table[seat].token}\r\n")
    refused = 0
    while not exposure.is_over:
        reply = await wire.send(poll)
        if reply.status != 200:
            assert reply.status == 204, reply.body
            continue
        message = json.loads(reply.body)
        if message["type"] == "match_over":
            return
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
    if reply.status not in (200, 422):  # whoever lost on time meanwhile is told so, and counted at the game's end
        assert json.loads(reply.body)["code"] in ("out_of_time", "game_finished"), reply.body
        return 0
    exposure.refused += reply.status == 422
    exposure.turns += reply.status == 200
    return refused + 1 if reply.status == 422 else 0


def measure(full: bool) -> Tables:
    """20,000 games, or a share of them."""
    return accounted(FULL if full else SHARE, math.inf)


def accounted(games: int, minutes: float) -> Tables:
    """Play, and account for it."""
    started = time.perf_counter()
    exposure = asyncio.run(soak(games, minutes))
    hours = (time.perf_counter() - started) / 3600
    unexplained = sum(exposure.ends[reason] for reason in UNEXPLAINED)
    row = {
        "games": exposure.games,
        "player_turns": exposure.turns,
        "refused": exposure.refused,
        "hours": round(hours, 3),
        "game_hours": round(AT_ONCE * hours, 2),
        "games_a_minute": round(exposure.games / hours / 60, 1),
        "unexplained_time_outs": unexplained,
        "at_most_a_game_95": bound(unexplained, exposure.games),
        "at_most_a_turn_95": bound(unexplained, exposure.turns),
        "mean_answer_ms": round(1e3 * exposure.waited_s / max(1, exposure.turns), 1),
        "load_after": round(os.getloadavg()[0], 1),
    }
    return {"exposure": [row], "ends": [dict(sorted(exposure.ends.items()))]}


def main() -> None:
    """A run is a full one when 20,000 games were asked for and not cut short by the minutes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--games", type=int, default=SHARE, help="a full run has 20,000")
    parser.add_argument("--full", dest="games", action="store_const", const=FULL)
    parser.add_argument("--minutes", type=float, default=math.inf, help="no longer than this")
    told = parser.parse_args()
    full = told.games >= FULL and math.isinf(told.minutes)
    line = recording.run("soak", lambda _: accounted(told.games, told.minutes), full)
    sys.exit(1 if line["tables"]["exposure"][0]["unexplained_time_outs"] > 1 else 0)


if __name__ == "__main__":
    main()
