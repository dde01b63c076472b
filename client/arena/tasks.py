"""What a worker is given: the games of a pair that are to be played, and who plays them."""

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from client.arena.game_task import GameTask
from client.arena.hosting import Hosting
from client.arena.resumable_game import play
from client.arena.seats import seat_of
from client.session import Session
from tournament import GameResult

MOST_REPORTS = 100
"""From one pair: who fails a thousand times fails like the first hundred."""


@dataclass(frozen=True, slots=True)
class PairTask:
    """The games of one pair that are due, one after the other.

    Attributes:
        games: at most two, the first leg first.
        players: how the entrants are run, by seat.
        agent_seed: for agents of this package.
        directory: of the event; None: the worker cannot reach it.
    """

    games: tuple[GameTask, ...]
    players: tuple[Hosting, Hosting]
    agent_seed: int
    directory: str | None

    @property
    def pair(self) -> str:
        """The pair's id."""
        return self.games[0].due.pair.id


@dataclass(frozen=True, slots=True)
class PairDone:
    """What came of it.

    Attributes:
        results: of the games, in order.
        records: their records, where the worker could not put them in their place; else empty.
        reports: entrant's name (empty: nobody in particular) and what went wrong, in order.
    """

    results: tuple[GameResult, ...]
    records: tuple[str, ...]
    reports: tuple[tuple[str, str], ...]


def play_pair(task: PairTask) -> PairDone:
    """Play the games of a pair. Runs in any process that can import this package."""
    reports: list[tuple[str, str]] = []
    with _seated(task, reports) as (seats, folder):
        played = [play(game, seats, folder, lambda name, what: reports.append((name, what))) for game in task.games]
    records = () if folder is not None else tuple(record for _, record in played)
    return PairDone(tuple(result for result, _ in played), records, tuple(reports[:MOST_REPORTS]))


@contextlib.contextmanager
def _seated(task: PairTask, reports: list[tuple[str, str]]) -> Iterator[tuple[tuple[Session, Session], Path | None]]:
    """Both seats, and the folder for the records if it is there; the seats are closed afterwards."""
    directory = _reachable(task.directory)
    logs = None if directory is None else directory / "logs"
    with contextlib.ExitStack() as stack:
        seats = []
        for number, hosting in enumerate(task.players):
            name = task.games[0].due.pair.players[number]
            log = None if logs is None else logs / f"{task.pair}-seat{number}.log"
            seat = seat_of(hosting, task.agent_seed, log, lambda what, name=name: reports.append((name, what)))  # type: ignore[misc]
            stack.callback(seat.close)
            seats.append(seat)
        yield (seats[0], seats[1]), None if directory is None else directory / "games"


def _reachable(directory: str | None) -> Path | None:
    """The event's directory, if this worker sees it; one on another machine may not."""
    if directory is None:
        return None
    path = Path(directory)
    return path if (path / "games").is_dir() and (path / "logs").is_dir() else None
