"""What every service works with: made once by `create_app`, handed down, never global."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import Context as Vars
from dataclasses import dataclass, field
from functools import partial
from typing import Final, Generic, TypeVar

from anyio import CapacityLimiter, to_thread
from sqlalchemy import Connection

from referee.play.clock import nanoseconds
from server import failpoints
from server.failpoints import Failpoint
from server.ops.metrics import Metrics
from server.security.limits import RequestLimits
from server.services.physics.pool import PhysicsPool
from server.services.play.clock.in_hand import RequestsInHand
from server.services.play.game_cache import GameCache
from server.services.play.long_strokes import LongStrokes
from server.services.runtime.cache import VersionedCache
from server.services.runtime.heartbeat_health import HeartbeatHealth
from server.services.runtime.time import TimeSource
from server.services.runtime.wakeups import Wakeups
from server.services.runtime.warmup import Kernels
from server.services.tournaments.tournament_cache import TournamentCache, TournamentState
from server.services.watch.ladder_cache import KeptLadder
from server.services.watch.presence import Presence
from server.settings import Settings
from server.store.database import Database

T = TypeVar("T")

THREADS_ASIDE: Final = 4
MATCHES_KEPT: Final = 4096
"""Matches, about 1 kB each."""


@dataclass(frozen=True, slots=True)
class Context:
    """One server's parts.

    Attributes:
        kernels: which of the physics' compiled kernels are loaded.
        seen: running games that need not be read again.
        aside: threads for what must not wait behind requests: signs of life, the timer, what is asked about health.
        pulse: whether the signs of life reach the database.
        in_hand: the requests that are being worked on.
        courses: how the tournaments stand that were asked for last. ladder: likewise, of all rated games.
        over: matches that are over, as lists show them.
        failpoint: told every step at which tests have the process killed.
        match_over: called when a match has ended, with its id, in the transaction that ended it.
    """

    settings: Settings
    database: Database
    time: TimeSource = field(default_factory=TimeSource)
    wakeups: Wakeups = field(default_factory=Wakeups)
    presence: Presence = field(default_factory=Presence)
    kernels: Kernels = field(default_factory=Kernels)
    metrics: Metrics = field(default_factory=Metrics)
    aside: CapacityLimiter = field(default_factory=lambda: CapacityLimiter(THREADS_ASIDE))
    pulse: HeartbeatHealth = field(init=False)
    seen: GameCache = field(default_factory=GameCache)
    limits: RequestLimits = field(init=False)
    physics: PhysicsPool = field(init=False)
    long_strokes: LongStrokes = field(default_factory=LongStrokes)
    in_hand: RequestsInHand = field(default_factory=RequestsInHand)
    courses: TournamentCache = field(default_factory=TournamentCache)
    over: VersionedCache[bytes] = field(default_factory=lambda: VersionedCache(MATCHES_KEPT, lambda text: 0))
    ladder: KeptLadder = field(default_factory=KeptLadder)
    failpoint: Failpoint = field(default_factory=lambda: failpoints.parse(""))
    match_over: Callable[["Writing", str], None] = lambda writing, match_id: None

    def __post_init__(self) -> None:
        object.__setattr__(self, "pulse", HeartbeatHealth(nanoseconds(self.settings.heartbeat_period)))
        object.__setattr__(self, "limits", RequestLimits.of(self.settings, self.time))
        object.__setattr__(self, "physics", PhysicsPool(self.settings.physics_threads))

    async def run_aside(self, work: Callable[[], T]) -> T:
        """What `work` returns, done by a thread that no request can keep busy."""
        return await to_thread.run_sync(work, limiter=self.aside)

    @contextmanager
    def writing(self) -> Iterator["Writing"]:
        """A transaction that commits at the end of the block and rolls back when it raises.

        Then the agents in `Writing.woken` are, and `Writing.courses` are what is known.
        """
        with self.database.writing() as connection:
            writing = Writing(connection, self, self.time.now())
            yield writing
        self.tell(writing)

    def carry_out(self, work: Callable[["Writing"], T]) -> T:
        """The same for work that may share its transaction with others' (`Database.carry_out`)."""
        written = _Written(self, work)
        return written.told(self.database.carry_out(written.carried_out))

    def carry_out_together(self, works: Sequence[tuple[Callable[["Writing"], T], Vars]]) -> list[Callable[[], T]]:
        """The same for what one thread has collected (`Database.carry_out_together`)."""
        written = [(_Written(self, work), variables) for work, variables in works]
        results = self.database.carry_out_together([(one.carried_out, variables) for one, variables in written])
        return [
            partial(lambda one, result: one.told(result()), one, result)
            for (one, _), result in zip(written, results, strict=True)
        ]

    def tell(self, writing: "Writing") -> None:
        """What a transaction made known is, now that it is committed."""
        self.courses.keep(writing.courses)
        if writing.woken:
            self.wakeups.notify(writing.woken)


class _Written(Generic[T]):
    """Work in a transaction that others may share, and what it made known."""

    def __init__(self, context: Context, work: Callable[["Writing"], T]) -> None:
        self._context = context
        self._work = work
        self._writing: Writing | None = None

    def carried_out(self, connection: Connection) -> T:
        """What the work makes of the transaction; called again where that failed by another's fault."""
        self._writing = Writing(connection, self._context, self._context.time.now())
        return self._work(self._writing)

    def told(self, result: T) -> T:
        """The result, once it is committed and what it made known is told."""
        assert self._writing is not None
        self._context.tell(self._writing)
        return result


@dataclass(frozen=True, slots=True)
class Writing:
    """A transaction that is under way: its connection, the server's parts, and the time it happens at.

    Attributes:
        woken: agents to be told that there may be news for them, once it is committed.
        courses: of the tournaments it looked at or wrote, its own entries included.
    """

    connection: Connection
    context: Context
    now: int
    woken: set[str] = field(default_factory=set, compare=False)
    courses: dict[str, TournamentState] = field(default_factory=dict, compare=False)
