"""An event's directory opened, and said how it stands: for people, or as JSON."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from client.cli.output import emit, say

if TYPE_CHECKING:
    from client.arena.directory import EventDirectory
    from tournament.ledger import Ledger

Event = Annotated[Path, typer.Argument(help="Directory of the event.")]


def opened(directory: Path) -> "EventDirectory":
    """The directory of an event that was begun."""
    from client.arena.directory import EventDirectory

    return EventDirectory.open(directory)


def ledger_of(event: "EventDirectory") -> "Ledger":
    """The event as its journal has it."""
    from client.arena.terms import Terms
    from tournament import Tournament as Played
    from tournament.ledger import Ledger

    return Ledger(Played(Terms.from_dict(event.terms()).spec)).after(event.journal.new())


def say_standing(event: "EventDirectory", ledger: "Ledger", as_json: bool) -> None:
    """How the event stands, for people or as JSON."""
    if as_json:
        emit(_account(event, ledger))
        return
    from rich.console import Console

    from client.cli.progress import standings_table

    Console().print(standings_table(ledger))
    say(_sentence(event, ledger))


def _account(event: "EventDirectory", ledger: "Ledger") -> dict[str, Any]:
    """Everything about how the event stands."""
    from dataclasses import asdict

    from tournament import standings

    played = ledger.event
    return {
        "name": played.spec.name,
        "directory": str(event.path),
        "state": ledger.state,
        "games": len(played.counted),
        "due": len(played.due),
        "standings": [line.to_dict() for line in standings(played)],
        "sprt": None if played.test is None else asdict(played.test),
        "refused": list(ledger.refused),
    }


def _sentence(event: "EventDirectory", ledger: "Ledger") -> str:
    test = ledger.event.test
    words = f"{ledger.state}: {len(ledger.event.counted)} games; records and journal in {event.path}"
    if test is not None:
        words += f"; the test says {test.verdict} after {test.pairs} pairs (log-likelihood ratio {test.llr:.2f})"
    return words
