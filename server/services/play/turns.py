"""The long poll: what an agent is to be told next, and the moment its clock starts."""

import asyncio
from collections.abc import Awaitable, Callable
from dataclasses import replace
from typing import Any

from sqlalchemy import Connection, Row, select, update
from starlette.concurrency import run_in_threadpool

from protocol import Turn
from server.services.play.clock import columns
from server.services.play.live_game import find
from server.services.runtime.context import Context, Writing
from server.store.locks import hold_match_of, only_one
from server.store.tables import games, notices


async def wait_for_message(
    context: Context, agent: str, seconds: float, is_gone: Callable[[], Awaitable[bool]]
) -> bytes | None:
    """The agent's next message as JSON, or None when there was none for `seconds` or the server is stopping.

    Nothing is delivered to a caller who is gone: it would start a clock that nobody sees.

    A wake-up is only a hint: the database is asked after each, and every few seconds without one, for another
    process may have written what is waited for.
    """
    loop = asyncio.get_running_loop()
    end = loop.time() + seconds
    hint = context.wakeups.listen(agent)
    context.presence.enter(agent)
    try:
        while not context.wakeups.draining.is_set() and not await is_gone():
            hint.clear()
            if (message := await run_in_threadpool(next_message, context, agent)) is not None:
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
        await asyncio.wait_for(hint.wait(), seconds)
    except TimeoutError:
        return


def next_message(context: Context, agent: str) -> bytes | None:
    """News first, each once; else the turn that waits, again and again until it is played."""
    with context.database.reading() as connection:
        if _news(connection, agent) is None and _waiting_turn(connection, agent, context.time.now()) is None:
            return None
    with context.writing() as writing:
        connection, now = writing.connection, writing.now
        if (news := _new(connection, agent)) is not None:
            this = notices.c.sequence == news.sequence
            connection.execute(update(notices).where(this).values(delivered_at=now))
            return str(news.message).encode()
        if (turn := _waiting_turn(connection, agent, now)) is None:
            return None
        hold_match_of(connection, turn.id)
        turn = _waiting_turn(connection, agent, now, turn.id)  # as it is now that nobody else changes it
        message = None if turn is None else _delivered(writing, turn, agent)
        context.failpoint("turn-delivered")
        return message


def _news(connection: Connection, agent: str) -> Row[Any] | None:
    waiting = (notices.c.agent_id == agent) & (notices.c.delivered_at.is_(None))
    return connection.execute(select(notices).where(waiting).order_by(notices.c.sequence).limit(1)).first()


def _new(connection: Connection, agent: str) -> Row[Any] | None:
    """The agent's next news, to be delivered by this transaction alone."""
    only_one(connection, f"news of {agent}")
    return _news(connection, agent)


def _waiting_turn(connection: Connection, agent: str, now: int, game_id: str | None = None) -> Row[Any] | None:
    """A turn not delivered yet goes before one that was; one whose time is out waits for the timer alone."""
    turns = select(games).where(games.c.mover == agent, games.c.deadline > now)
    if game_id is not None:
        turns = turns.where(games.c.id == game_id)
    return connection.execute(turns.order_by(games.c.delivered, games.c.available_at).limit(1)).first()


def _delivered(writing: Writing, turn: Row[Any], agent: str) -> bytes:
    """The turn as a message; the first delivery starts the clock, unless it runs already."""
    live = find(writing.connection, turn.id)
    if not turn.delivered:
        started = columns.written(live.clock.fetched(writing.now), writing.context.settings)
        writing.connection.execute(update(games).where(games.c.id == turn.id).values(started))
        live = replace(live, row=replace(live.row, **started))
    view = live.view(writing.connection, live.agents.index(agent), writing.now)
    return Turn(game=turn.id, view=view).model_dump_json().encode()
