"""How an event goes, as it goes: a bar for the games and the standings under it, on standard error."""

import contextlib
import sys
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tournament.ledger import Ledger

MOST_LINES = 30
"""Standings shown while playing; the rest is in the report."""
REDRAW_SECONDS = 0.5


@contextlib.contextmanager
def shown(total: int, quiet: bool) -> Iterator["Callable[[Ledger, int], None]"]:
    """An observer for `client.arena.runner.Runner` that draws what it is told; one that is silent if `quiet`.

    Args:
        total: games of the event, at most.
        quiet: draw nothing. Nothing is drawn either where standard error is no terminal.
    """
    if quiet or not sys.stderr.isatty():
        yield lambda ledger, running: None
        return
    from rich.console import Console
    from rich.live import Live

    board = _Board(total)
    with Live(console=Console(stderr=True), auto_refresh=False) as live:
        yield lambda ledger, running: board.draw(live, ledger, running)


class _Board:
    """The picture, drawn when something has changed and now and then."""

    def __init__(self, total: int) -> None:
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

        self._bar = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TimeRemainingColumn(elapsed_when_finished=True),
        )
        self._task = self._bar.add_task("games", total=total)
        self._drawn = (-1, -1)
        self._at = 0.0

    def draw(self, live: Any, ledger: "Ledger", running: int) -> None:
        """Draw it again if there is news."""
        from rich.console import Group

        news = len(ledger.event.results), running
        if news == self._drawn or (time.monotonic() - self._at < REDRAW_SECONDS and not ledger.over):
            return
        self._drawn, self._at = news, time.monotonic()
        state = "paused" if ledger.paused else f"{running} pairs under way"
        self._bar.update(self._task, completed=len(ledger.event.counted), description=state)
        live.update(Group(self._bar, standings_table(ledger)), refresh=True)


def standings_table(ledger: "Ledger") -> Any:
    """The standings as a `rich` table."""
    from rich.table import Table

    from tournament import standings

    table = Table("rank", "name", "points", "games", "won", "drawn", "lost", title=ledger.event.spec.name)
    for line in standings(ledger.event)[:MOST_LINES]:
        name = f"{line.name} (out)" if line.withdrawn else line.name
        cells = (line.rank, name, f"{line.points:g}", line.games, line.wins, line.draws, line.losses)
        table.add_row(*map(str, cells))
    return table
