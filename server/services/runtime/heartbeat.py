"""Signs of life in the database, so that nobody is charged for time in which no server process ran.

Every process leaves a heartbeat each second. A process that starts and finds no other alive knows how long there was
none: every running turn is charged up to the last heartbeat and no further. It then holds all games until a process
listens; from that moment turns can be fetched anew, and their grace begins.
"""

import contextlib
import logging
import secrets
from collections.abc import AsyncIterator

from sqlalchemy import Connection, delete, func, insert, select, update

from referee.play.clock import SECOND_NS
from server.errors import Unavailable
from server.services.play.clock import standstill
from server.services.runtime.context import Context, Writing
from server.services.runtime.periodic import Periodic
from server.store.locks import only_one
from server.store.tables import heartbeats

log = logging.getLogger("pooliad.server.heartbeat")


class Heartbeat:
    """This process's signs of life."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._process = f"process_{secrets.token_hex(8)}"
        self._period = context.settings.heartbeat_period
        self._releases = False

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """Take up the games that wait, and beat for as long as the block lasts."""
        await self._context.run_aside(self._begin)
        beats = Periodic("the heartbeat", self._beat_once, self._period, outage=self._missed)
        try:
            async with beats.running():
                yield
        finally:
            try:
                await self._context.run_aside(self._leave)
            except Unavailable:
                log.warning("the last heartbeat could not be left: the database does not answer")

    async def listening(self) -> None:
        """Requests are accepted from now on: the games that were held go on.

        While the database does not answer they stay held; the next heartbeat that it takes releases them.
        """
        self._releases = True
        try:
            await self._context.run_aside(self._release)
        except Unavailable:
            self._context.pulse.missed()
            log.warning("the games cannot go on yet: the database does not answer")

    def _begin(self) -> None:
        """The first process at work on the database holds the games; others that start now wait until it has."""
        membership = self._context.database.membership
        membership.enter()
        self._context.time.adjust()
        begin(self._context, self._process, alone=membership.is_alone)
        membership.settle()

    def _leave(self) -> None:
        beat(self._context, self._process, stopped=True)

    def _beat(self) -> None:
        self._context.database.membership.renew()
        self._context.time.adjust()
        beat(self._context, self._process)
        if self._releases:
            self._release()
        if self._context.database.writes_fail.is_set():
            self._context.database.try_writing()

    def _release(self) -> None:
        standstill.release(self._context)
        self._releases = False

    async def _beat_once(self) -> None:
        await self._context.run_aside(self._beat)

    def _missed(self) -> None:
        self._context.pulse.missed()
        log.warning("no heartbeat: the database does not answer; the next is due in %g s", self._period)


def begin(context: Context, process: str, *, alone: bool) -> None:
    """The first heartbeat; `alone` the process also holds the games that stood still, until `standstill.release`."""
    with context.writing() as writing:
        if alone:
            last = writing.connection.scalar(select(func.max(heartbeats.c.beat_at)))
            standstill.hold(writing, writing.now if last is None else min(last, writing.now))
            writing.connection.execute(delete(heartbeats))
        _beat(writing, process, stopped=False)
    context.pulse.felt(writing.now)


def beat(context: Context, process: str, *, stopped: bool = False) -> None:
    """One more heartbeat; the first after an outage of the database gives back the time since the last."""
    with context.writing() as writing:
        if context.pulse.has_failed and not stopped:
            _make_up_for_outage(writing)
        _beat(writing, process, stopped)
    context.pulse.felt(writing.now)


def _make_up_for_outage(writing: Writing) -> None:
    """When nobody could leave a heartbeat nobody could play: of several processes the first that can sees to it."""
    if _last_before_outage(writing) is None:
        return
    only_one(writing.connection, "outage")
    last = _last_before_outage(writing)
    if last is not None:
        log.warning("no heartbeats for %.1f s; games go on from the last", (writing.now - last) / SECOND_NS)
        standstill.make_up(writing, last)


def _last_before_outage(writing: Writing) -> int | None:
    """The last heartbeat of anybody, if it is too long ago."""
    last = writing.connection.scalar(select(func.max(heartbeats.c.beat_at)))
    gone = last is not None and writing.now - last > writing.context.pulse.longest_gap
    return int(last) if gone else None


def _beat(writing: Writing, process: str, stopped: bool) -> None:
    this = heartbeats.c.process == process
    values = {
        "beat_at": writing.now,
        "clear_until": writing.context.in_hand.clear_until(writing.now),
        "stopped": stopped,
        "present": sorted(writing.context.presence.here(writing.now)),
    }
    if writing.connection.execute(update(heartbeats).where(this).values(values)).rowcount != 1:
        writing.connection.execute(insert(heartbeats).values(process=process, **values))


def is_clear(connection: Connection, context: Context, deadline: int) -> bool:
    """Whether no process that is alive may still be at work on a request that was complete before the deadline."""
    since = context.time.now() - context.pulse.longest_gap
    alive = heartbeats.c.stopped.is_(False) & (heartbeats.c.beat_at > since)
    behind = select(heartbeats.c.process).where(alive, heartbeats.c.clear_until < deadline).limit(1)
    return connection.execute(behind).first() is None
