"""How events stand, kept from one request to the next: only entries that came since are read and carried out.

An event's entries are appended and never changed, so how it stands is a value that belongs to its last entry's number.
What a transaction adds is kept when it is committed, and not before: the numbers of entries that were rolled back may
come again with something else behind them (SQLite).
"""

import threading
from collections import OrderedDict
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Final

from tournament import Standing, standings
from tournament.ledger import Ledger
from tournament.statistics import Rating, rate

MOST_KEPT: Final = 64
"""Events: one of 10,000 games takes some 20 MB."""


@dataclass(frozen=True)
class Course:
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


class Courses:
    """The courses of the events that were asked for last, for all threads."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._kept: OrderedDict[str, Course] = OrderedDict()

    def get(self, tournament_id: str) -> Course | None:
        """What is known of an event; there may be later entries."""
        with self._lock:
            if tournament_id in self._kept:
                self._kept.move_to_end(tournament_id)
            return self._kept.get(tournament_id)

    def keep(self, courses: Mapping[str, Course]) -> None:
        """Keep courses whose entries are committed, unless later ones are known already."""
        with self._lock:
            for tournament_id, course in courses.items():
                known = self._kept.get(tournament_id)
                if known is None or known.sequence < course.sequence:
                    self._kept[tournament_id] = course
                    self._kept.move_to_end(tournament_id)
            while len(self._kept) > MOST_KEPT:
                self._kept.popitem(last=False)
