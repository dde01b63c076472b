"""Clocks while no server process runs or none reaches the database: nobody is charged for that time."""

from collections.abc import Iterator
from typing import Any, Final

from sqlalchemy import ColumnElement, case, select, update

from referee.play.clock import GameClock
from server.services.play.clock import columns
from server.services.play.clock.columns import HELD
from server.services.play.live_game import LiveGame, find
from server.services.runtime.context import Context, Writing
from server.store.locks import hold_match_of
from server.store.tables import games, matches

NOBODY: Final = ""
"""Comes before every agent: games with a mover are those that go on, and are found in its index."""


def hold(writing: Writing, last: int) -> None:
    """Charge every running turn up to the last heartbeat; nothing runs on until `release`."""
    for live in _running(writing):
        _store(writing, live, live.clock.held(last, HELD))
    waits = matches.c.opens_until
    left = case((waits > last, waits - last), else_=0)
    writing.connection.execute(update(matches).where(waits < HELD).values(opens_until=HELD + left))


def release(context: Context) -> None:
    """Let what is held go on, as of now: turns can be fetched, players have the rest of their time to add seeds."""
    with context.writing() as writing:
        _resume(writing, writing.now, games.c.deadline >= HELD)
        waits = matches.c.opens_until
        going_on = update(matches).where(waits >= HELD).values(opens_until=waits - HELD + writing.now)
        writing.connection.execute(going_on)


def make_up(writing: Writing, last: int) -> None:
    """Charge every running turn up to the last heartbeat; it can be fetched anew at once, for the server listens."""
    _resume(writing, last)


def _resume(writing: Writing, stopped: int, *conditions: ColumnElement[bool]) -> None:
    grace = columns.fetch_grace(writing.context.settings)
    for live in _running(writing, *conditions):
        _store(writing, live, live.clock.resumed(stopped, writing.now, grace))


def _running(writing: Writing, *conditions: ColumnElement[Any]) -> Iterator[LiveGame]:
    """The running games that satisfy the conditions, each locked by the transaction."""
    found = select(games.c.id).where(games.c.mover > NOBODY, *conditions)
    for game_id in writing.connection.scalars(found).all():
        hold_match_of(writing.connection, game_id)
        live = find(writing.connection, game_id)
        if live.is_running:
            yield live


def _store(writing: Writing, live: LiveGame, clock: GameClock) -> None:
    values = columns.written(clock, writing.context.settings)
    writing.connection.execute(update(games).where(games.c.id == live.id).values(values))
    writing.woken.update(live.agents)
