"""The ladder as it was computed last, kept from one request to the next."""

import threading
from dataclasses import dataclass, field

from tournament.statistics.ladder import Rung


@dataclass
class KeptLadder:
    """The last ladder of this process; one thread at a time makes a new one, the others are given the old."""

    rungs: tuple[Rung, ...] = ()
    games: int = 0
    until: int = 0
    lock: threading.Lock = field(default_factory=threading.Lock)
