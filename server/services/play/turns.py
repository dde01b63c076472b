"""The long poll: what an agent is to be told next, and the moment its clock starts."""

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Final

from sqlalchemy import Connection, Row, bindparam, select, update

from protocol import Turn
from server.security.callers import Caller
from server.services.play.clock import columns
from server.services.play.live_game import LiveGame
from server.services.runtime.batches import Batches
from server.services.runtime.context import Context, Writing
from server.services.runtime.steps import Done, Steps
from server.store.locks import hold_match_of, is_shared, only_one
from server.store.prepared import Prepared
from server.store.tables import games, notices

Sender = Callable[[Connection], Caller]
"""Looks up who sent a request; may raise `Unauthorized`."""
IsGone = Callable[[], Awaitable[bool]]
"""Whether the client has hung up."""


async def poll(
    context: Context, batches: Batches, sender: Sender, wait: Callable[[], float], is_gone: IsGone
) -> bytes | None:
    """The sender's next message as JSON, or None when there was none for `wait` or the server is stopping.

    Who asks is looked up together with the first look for a message: most polls end there. Nothing is delivered to a
    caller who is gone: it would start a clock that nobody sees.

    Args:
        context: the server's parts.
        batches: what carries polls out.
        sender: who asks.
        wait: seconds, asked for when it is known that the sender plays; may raise `Invalid`.
        is_gone: whether the sender has hung up.
    """
    if await is_gone():
        return None
    asker, message = await batches.carry_out(partial(Fetch, context, partial(_asker, context, sender, wait)))
    context.presence.seen(asker.agent, context.time.now())
    if message is not None:
        context.failpoint("turn-committed")
        return message
    with context.limits.waiting(asker.caller):
        return await _wait_for_message(context, batches, asker, is_gone) if asker.seconds else None


@dataclass(frozen=True, slots=True)
class Asker:
    """Who polls, and for how many seconds."""

    caller: Caller
    agent: str
    seconds: float


def _asker(context: Context, sender: Sender, wait: Callable[[], float], connection: Connection) -> Asker:
    caller = sender(connection)
    context.limits.count(caller)
    return Asker(caller, caller.require_agent(), wait())


class Fetch(Steps[tuple[Asker, bytes | None], bytes | None]):
    """One look for a message, and its delivery.

    Args:
        context: the server's parts.
        asker: whose it is.
    """

    def __init__(self, context: Context, asker: Callable[[Connection], Asker]) -> None:
        super().__init__(context)
        self._who = asker

    def looked(self, connection: Connection) -> Done[tuple[Asker, bytes | None]] | None:
        """A message that may be given at once, if there is one; None for one whose delivery is to be stored first."""
        self._asker = asker = self._who(connection)
        if self.context.wakeups.draining.is_set():
            return Done((asker, None))
        look = _look(self.context, connection, asker.agent)
        return None if look.is_new else Done((asker, look.message))

    def store(self, writing: Writing) -> bytes | None:
        """The message, with the note that the agent has it: news are not told again, and the turn's clock runs."""
        return _delivered(writing, self._asker.agent)

    def finished(self, stored: bytes | None) -> tuple[Asker, bytes | None]:
        """The message."""
        return self._asker, stored


async def _wait_for_message(context: Context, batches: Batches, asker: Asker, is_gone: IsGone) -> bytes | None:
    """The message that comes within the asker's seconds.

    A wake-up is only a hint: the database is asked after each, and every few seconds without one, for another
    process may have written what is waited for.
    """
    loop, agent = asyncio.get_running_loop(), asker.agent
    end = loop.time() + asker.seconds
    fetch = partial(Fetch, context, lambda connection: asker)
    hint = context.wakeups.listen(agent)
    context.presence.enter(agent)
    try:
        while not context.wakeups.draining.is_set() and not await is_gone():
            hint.clear()
            _, message = await batches.carry_out(fetch)
            if message is not None:
                context.failpoint("turn-committed")
                return message
            left = end - loop.time()
            if left <= 0:
                return None
            await _wait(hint, min(left, context.settings.poll_recheck))
        return None
    finally:
        context.presence.leave(agent, context.time.now())
        context.wakeups.leave(agent, hint)


async def _wait(hint: asyncio.Event, seconds: float) -> None:
    try:
        async with asyncio.timeout(seconds):
            await hint.wait()
    except TimeoutError:
        return


@dataclass(frozen=True, slots=True)
class _Look:
    """What there is for an agent: a message that may be given at once, or one whose delivery is to be stored first."""

    message: bytes | None = None
    is_new: bool = False


def _look(context: Context, connection: Connection, agent: str) -> _Look:
    if _news(connection, agent) is not None:
        return _Look(is_new=True)
    if (turn := _waiting_turn(connection, agent, now := context.time.now())) is None:
        return _Look()
    if not turn.delivered:
        return _Look(is_new=True)
    return _Look(_message(connection, context.seen.find(connection, turn.id), agent, now))


def _delivered(writing: Writing, agent: str) -> bytes | None:
    connection, now = writing.connection, writing.now
    if (news := _new(connection, agent)) is not None:
        _NOTICE_DELIVERED.run(connection, {"this": news.sequence, "now": now})
        return str(news.message).encode()
    if (turn := _waiting_turn(connection, agent, now)) is not None and is_shared(connection):
        hold_match_of(connection, turn.id)
        turn = _waiting_turn(connection, agent, now, turn.id)  # as it is now that nobody else changes it
    if turn is None:
        return None
    message = _turn_begun(writing, writing.context.seen.find(connection, turn.id, is_committed=False), agent)
    writing.context.failpoint("turn-delivered")
    return message


_NEWS: Final = Prepared(
    select(notices)
    .where(notices.c.agent_id == bindparam("agent"), notices.c.delivered_at.is_(None))
    .order_by(notices.c.sequence)
    .limit(1)
)
_NOTICE_DELIVERED: Final = Prepared(
    update(notices).where(notices.c.sequence == bindparam("this")).values(delivered_at=bindparam("now"))
)
_TURNS: Final = (
    select(games.c.id, games.c.delivered)
    .where(games.c.mover == bindparam("agent"), games.c.deadline > bindparam("now"))
    .order_by(games.c.delivered, games.c.available_at)
    .limit(1)
)
_WAITING: Final = Prepared(_TURNS)
_WAITING_IN: Final = Prepared(_TURNS.where(games.c.id == bindparam("game")))
_FETCHED: Final = Prepared(update(games).where(games.c.id == bindparam("this")))


def _news(connection: Connection, agent: str) -> Row[Any] | None:
    row: Row[Any] | None = _NEWS.first(connection, agent=agent)
    return row


def _new(connection: Connection, agent: str) -> Row[Any] | None:
    """The agent's next news, to be delivered by this transaction alone."""
    only_one(connection, f"news of {agent}")
    return _news(connection, agent)


def _waiting_turn(connection: Connection, agent: str, now: int, game_id: str | None = None) -> Row[Any] | None:
    """The game of a turn, and whether that was delivered.

    One not delivered yet goes before one that was; one whose time is out waits for the timer alone.
    """
    row: Row[Any] | None
    if game_id is None:
        row = _WAITING.first(connection, agent=agent, now=now)
    else:
        row = _WAITING_IN.first(connection, agent=agent, now=now, game=game_id)
    return row


def _turn_begun(writing: Writing, live: LiveGame, agent: str) -> bytes:
    """The turn as a message; the first delivery starts the clock, unless it runs already."""
    if not live.row.delivered:
        started = columns.written(live.clock.fetched(writing.now), writing.context.settings)
        _FETCHED.run(writing.connection, started | {"this": live.id})
        live = replace(live, row=replace(live.row, **started))
    return _message(writing.connection, live, agent, writing.now)


def _message(connection: Connection, live: LiveGame, agent: str, now: int) -> bytes:
    view = live.view(connection, live.agents.index(agent), now)
    return Turn.model_construct(game=live.id, view=view).model_dump_json().encode()
