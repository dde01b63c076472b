"""How long an event will take: counted from its terms, timed on a few games that are not part of it."""

import math
import time
from dataclasses import asdict, dataclass
from typing import Any

from client.arena.executors import InProcess
from client.arena.hosting import Kind
from client.arena.preflight import require_startable
from client.arena.tasks import play_pair
from client.arena.terms import Terms
from tournament import Tournament
from tournament.pairings import LEGS
from tournament.size import Phases, games_of, phases_of

SAMPLE_SECONDS = 60.0
"""No further sample game is begun after so long."""
SAMPLE_SEED = 2**62
"""Another event's: its racks and noise are not those of any game that will count."""


@dataclass(frozen=True, slots=True)
class Estimate:
    """What an event will take.

    Attributes:
        games: how many, at least and at most (extra pairs, early stops).
        workers: playing at once.
        sampled: games played to find out; game_seconds: mean wall time of those, None without any.
        seconds: of the whole event, at least and at most, from that mean; None without a sample. Workers play a pair
            at a time, and in a Swiss or a knockout some of them wait for the end of a round.
        longest_seconds: if everybody used the whole clock; None without clocks.
    """

    games: tuple[int, int]
    workers: int
    sampled: int
    game_seconds: float | None
    seconds: tuple[float, float] | None
    longest_seconds: float | None

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return asdict(self)


def estimate(terms: Terms, workers: int) -> Estimate:
    """Estimate an event's duration; plays for about a minute, or one game if that takes longer.

    Raises:
        EventError: an entrant cannot be made or started.
    """
    require_startable(terms, InProcess())
    spec = terms.spec
    least, most = games_of(spec)
    times = sample(terms)
    mean = sum(times) / len(times) if times else None
    turns = tuple(_games_in_turn(phases, workers) for phases in phases_of(spec))
    seconds = None if mean is None else (turns[0] * mean, turns[1] * mean)
    longest = None if spec.seconds is None else turns[1] * 2.0 * spec.seconds
    return Estimate((least, most), workers, len(times), mean, seconds, longest)


def _games_in_turn(phases: Phases, workers: int) -> int:
    """Games that follow each other: a worker has a pair at a time, and phases wait for each other."""
    return len(LEGS) * sum(math.ceil(pairs / workers) for pairs in phases)


def sample(terms: Terms) -> list[float]:
    """Wall seconds of one game for each meeting that brings in an entrant not timed yet; none with remote entrants."""
    if any(each.kind is Kind.REMOTE for each in terms.hosting.values()):
        return []
    event = Tournament(terms.spec.with_seed(SAMPLE_SEED))
    timed: set[str] = set()
    times: list[float] = []
    for due in event.due:
        if sum(times) > SAMPLE_SECONDS:
            break
        if not timed.issuperset(due.pair.players):
            started = time.perf_counter()
            play_pair(Terms(event.spec, terms.hosting).task((due,), None))
            times.append(time.perf_counter() - started)
            timed.update(due.pair.players)
    return times
