"""The clock's flag: a game whose mover has run out of time ends by itself, whoever asks or does not ask."""

import logging
from functools import partial

from sqlalchemy import select

from referee.game import EndReason
from server.errors import Unavailable
from server.services.matches.player_seeds import begin_due
from server.services.play import games as course
from server.services.play.live_game import find
from server.services.runtime import heartbeat
from server.services.runtime.context import Context
from server.services.runtime.periodic import Periodic
from server.store.locks import lease_match_of
from server.store.tables import games

log = logging.getLogger("pooliad.server.timer")


def timer(context: Context) -> Periodic:
    """The look at all deadlines, several times a second."""

    async def look() -> None:
        await context.run_aside(partial(begin_due, context))
        await context.run_aside(partial(flag, context))

    return Periodic("the timer", look, context.settings.timer_period)


def flag(context: Context) -> None:
    """End every game whose mover is out of time; exactly zero left is out.

    Not after an outage of the database whose time has not been given back yet.
    """
    now = context.time.now()
    if context.pulse.is_lost(now):
        return
    due = select(games.c.id).where(games.c.deadline <= now)
    with context.database.reading() as connection:
        late = connection.scalars(due).all()
    for game_id in late:
        try:
            _flag(context, game_id, now)
        except Unavailable:
            raise
        except Exception:
            log.exception("game %s could not be ended; the timer goes on with the others", game_id)


def _flag(context: Context, game_id: str, now: int) -> None:
    with context.writing() as writing:
        if not lease_match_of(writing.connection, game_id):
            return
        live = find(writing.connection, game_id)
        deadline = live.row.deadline
        if deadline is None or deadline > now or context.in_hand.has_before(game_id, deadline):
            return
        if context.database.is_shared and not heartbeat.is_clear(writing.connection, context, deadline):
            return
        # the deadline of a turn that nobody ever fetched may come before its clock runs out
        timed_out = deadline >= live.clock.runs_out()
        reason = EndReason.TIME_OUT if timed_out else EndReason.NO_SHOW
        course.end_from_outside(writing, live, reason, live.game.turn, until=deadline)
    context.wakeups.notify(live.agents)
