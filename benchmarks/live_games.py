"""What a stroke costs a server with 2,000 live games, beside one with 100, and what memory they take.

Two servers run at the same time. In each round one stroke is played in every game of both, over fifty connections: no
game is asked for again before all others have been, which is the worst order for whatever remembers games. The ratio is
the median over neighbouring rounds. Breaks are played before.
"""

import asyncio
import statistics
import tempfile
from pathlib import Path

from benchmarks.command import main
from benchmarks.growth import Side, Table
from benchmarks.load import ORGANISER
from benchmarks.load_client import Connection
from benchmarks.load_games import begin
from benchmarks.recording import Row, Tables

FEW, MANY = 100, 2_000
MANY_OF_SHARE = 300
"""Games of a short run."""
WIRES = 50
PATIENT = {"NO_SHOW_SECONDS": "86400"}
"""Settings: to begin 2,000 matches takes longer than a player may be away."""


def measure(full: bool) -> Tables:
    """A row for each number of games."""
    with (
        tempfile.TemporaryDirectory() as name,
        Side(Path(name) / "few.db", PATIENT) as few,
        Side(Path(name) / "many.db", PATIENT) as many,
    ):
        halls = [Hall(few, FEW), Hall(many, MANY if full else MANY_OF_SHARE)]
        return {"live": asyncio.run(_compared(halls, 5 if full else 3))}


class Hall:
    """Matches that are on at one server.

    Args:
        side: the server. games: matches, each with one game at a time.
    """

    def __init__(self, side: Side, games: int) -> None:
        self.side, self.games = side, games
        self.empty_mb = resident_mb(side)
        self.costs: list[float] = []
        self.strokes = 0
        self._tables: list[list[Table]] = []

    async def open(self) -> None:
        """Begin the matches and play the breaks."""
        wires = [Connection(self.side.port) for _ in range(WIRES)]
        self._tables = await asyncio.gather(*(self._begun(wire, first) for first, wire in enumerate(wires)))
        await self._play()

    async def _begun(self, wire: Connection, first: int) -> list[Table]:
        return [Table(wire, await begin(wire, number, ORGANISER)) for number in range(first, self.games, WIRES)]

    async def round(self) -> None:
        """A stroke in every game; its cost, s of CPU each."""
        used = self.side.cpu()
        played = await self._play()
        self.costs.append((self.side.cpu() - used) / played)
        self.strokes += played

    async def _play(self) -> int:
        """Strokes played: some are refused."""
        return sum(await asyncio.gather(*(self._in_turn(tables) for tables in self._tables)))

    async def _in_turn(self, tables: list[Table]) -> int:
        return sum([await table.play(1) for table in tables])

    def row(self, ratio: float) -> Row:
        """The figures."""
        now = resident_mb(self.side)
        return {
            "games": self.games,
            "strokes": self.strokes,
            "cpu_ms": round(1e3 * statistics.median(self.costs), 3),
            "of_few": round(ratio, 3),
            "empty_MB": round(self.empty_mb),
            "live_MB": round(now),
            "kB_a_game": round(1e3 * (now - self.empty_mb) / self.games),
        }


async def _compared(halls: list[Hall], rounds: int) -> list[Row]:
    for hall in halls:
        await hall.open()
    for _ in range(rounds):
        for hall in halls:
            await hall.round()
    few = halls[0].costs
    return [hall.row(statistics.median(cost / of for cost, of in zip(hall.costs, few, strict=True))) for hall in halls]


def resident_mb(side: Side) -> float:
    """MB of memory that a server's process has."""
    lines = Path(f"/proc/{side.process}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS")) / 1024


if __name__ == "__main__":
    main("live_games", measure)
