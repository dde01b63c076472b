"""How events stand, kept from one request to the next: only entries that came since are read and carried out.

An event's entries are appended and never changed, so how it stands is a value that belongs to its last entry's number.
What a transaction adds is kept when it is committed, and not before: the numbers of entries that were rolled back may
come again with something else behind them (SQLite).
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

from server.services.runtime.cache import VersionedCache
from tournament import Standing, standings
from tournament.ledger import Ledger
from tournament.statistics import Rating, rate

MOST_KEPT: Final = 64
"""Events: one of 10,000 games takes some 20 MB."""


@dataclass(frozen=True)
class TournamentState:
    """An event up to one of its entries.

    Attributes:
        sequence: number of that entry. ledger: how the event stands after it.
    """

    sequence: int
    ledger: Ledger

    @cached_property
    def standings(self) -> tuple[Standing, ...]:
        """The entrants, the best first."""
        return standings(self.ledger.event)

    @cached_property
    def ratings(self) -> tuple[Rating, ...]:
        """Their ratings; none before the first result."""
        event = self.ledger.event
        return rate(event.counted, event.spec.names).table if event.counted else ()


class TournamentCache(VersionedCache[TournamentState]):
    """The courses of the events that were asked for last."""

    def __init__(self) -> None:
        super().__init__(MOST_KEPT, lambda course: course.sequence)
