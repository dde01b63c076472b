"""What an organiser decides about an event while it runs: `pooliad tournament pause` and its fellows."""

from pathlib import Path
from typing import Annotated, Any

import typer

from client.cli.events import Event, ledger_of, opened
from client.cli.output import USAGE, fail, say

Reason = Annotated[str, typer.Option(help="Why; it stays in the journal.")]


def pause(directory: Event, reason: Reason = "") -> None:
    """Start no further game until `go-on`; those under way are played to their end."""
    _decide(directory, "pause", reason=reason)


def go_on(directory: Event, reason: Reason = "") -> None:
    """Take back a pause; an event whose runner has left goes on with `resume`."""
    _decide(directory, "go_on", reason=reason)


def abort(directory: Event, reason: Reason = "") -> None:
    """End an event for good; its results so far stand."""
    _decide(directory, "abort", reason=reason)


def void(
    directory: Event,
    pair: Annotated[str, typer.Argument(help="Id of the pair, as in r0-m2-p1.")],
    leg: Annotated[int, typer.Argument(min=0, max=1, help="0 for its first game, 1 for its second.")],
    reason: Reason = "",
) -> None:
    """Take a finished game out of the event; it is played again, on the same racks with fresh noise."""
    _decide(directory, "void", pair=pair, leg=leg, reason=reason)


def disqualify(
    directory: Event, name: Annotated[str, typer.Argument(help="The entrant's name.")], reason: Reason = ""
) -> None:
    """Take an entrant out: its due games are forfeit, and it is not paired any more."""
    _decide(directory, "disqualify", name=name, reason=reason)


def _decide(directory: Path, kind: str, **fields: Any) -> None:
    """Write an organiser's decision into the journal, if it can be carried out as the event stands."""
    from client.arena.remote import PLACE
    from tournament.ledger import Act

    event = opened(directory)
    if (event.path / PLACE).exists():
        fail(f"{event.path} is an event at a server: POST /v1/tournaments/ID/… there decides about it", USAGE)
    before = ledger_of(event)
    after = before.after([Act(kind, fields)])
    if len(after.refused) > len(before.refused):
        fail(after.refused[-1], USAGE)
    if before.aborted:
        fail("the event was aborted; nothing more can be decided about it", USAGE)
    event.journal.append(kind, by=_who(), **fields)
    say(f"noted in {event.journal.path}; a runner acts on it within a second")


def _who() -> str:
    """Who decides, for the journal."""
    import getpass

    try:
        return getpass.getuser()
    except (KeyError, OSError):
        return "unknown"
