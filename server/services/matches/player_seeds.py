"""The opening of a match: between its commitment and its first rack the players may add seeds of their own.

It waits only if the match's terms say so, at most as long as they say, and no longer than until both seeds are
there: nobody can hold a match up.
"""

import logging
from typing import Any

from sqlalchemy import Connection, Row, select, update

from protocol import ClientSeedRequest
from referee.play.clock import SECOND_NS
from server.errors import Forbidden, Unavailable, WrongStatus
from server.http.commands import Answer, Command, once, parse
from server.services.matches import match_seeds, match_views
from server.services.play import agent_messages, games
from server.services.play.live_game import RUNNING, find_match, hold_match
from server.services.runtime.context import Context, Writing
from server.store.tables import matches

log = logging.getLogger("pooliad.server.openings")

CHALLENGED = "challenged"
OPENING = "opening"


def contribute(context: Context, match_id: str, command: Command) -> Answer:
    """A player adds a seed to the draw; the match begins when it was the last that was waited for."""
    with context.writing() as writing:
        match = hold_match(writing.connection, match_id)
        seat = _seat(match, command.caller.id)
        answer = once(writing.connection, command, lambda: _contributed(writing, match, seat, command))
    context.wakeups.notify((match.seat_0, match.seat_1))
    return answer


def begin_or_wait(writing: Writing, match: Row[Any]) -> Row[Any]:
    """Begin the first game, unless the players have time to add seeds and have not both done so."""
    if match.opening == 0 or (match.client_seed_0 and match.client_seed_1):
        return _begin(writing, match)
    match = update_match(writing.connection, match.id, status=OPENING, opens_until=writing.now + match.opening)
    agent_messages.seeds_wanted(writing.connection, match, match.opening / SECOND_NS)
    return match


def begin_due(context: Context) -> None:
    """Begin every match whose players have had their time."""
    due = select(matches.c.id).where(matches.c.opens_until <= context.time.now())
    with context.database.reading() as connection:
        waited = connection.scalars(due).all()
    for match_id in waited:
        try:
            _begin_late(context, match_id)
        except Unavailable:
            raise
        except Exception:
            log.exception("match %s could not begin; the timer goes on with the others", match_id)


def add_seed(writing: Writing, match: Row[Any], seat: int, seed: str) -> Row[Any]:
    """Keep a player's seed; raises `WrongStatus` for a second one."""
    column = ("client_seed_0", "client_seed_1")[seat]
    if getattr(match, column) is not None:
        raise WrongStatus(f"seat {seat} has added a seed already; each player adds one")
    return update_match(writing.connection, match.id, **{column: seed})


def update_match(connection: Connection, match_id: str, **values: object) -> Row[Any]:
    """Change a match; the row as it is then."""
    connection.execute(update(matches).where(matches.c.id == match_id).values(**values))
    return find_match(connection, match_id)


def _contributed(writing: Writing, match: Row[Any], seat: int, command: Command) -> Answer:
    if match.status not in (CHALLENGED, OPENING):
        raise WrongStatus(f"the match is {match.status}; seeds are added before the first rack")
    match = add_seed(writing, match, seat, parse(command, ClientSeedRequest).seed)
    if match.status == OPENING and match.client_seed_0 and match.client_seed_1:
        match = _begin(writing, match)
    return Answer.of(200, match_views.view(writing.connection, match))


def _begin(writing: Writing, match: Row[Any]) -> Row[Any]:
    values = {"status": RUNNING, "started_at": writing.now, "opens_until": None}
    match = update_match(writing.connection, match.id, first_breaker=match_seeds.first_breaker(match), **values)
    games.begin(writing, match, 0)
    return match


def _begin_late(context: Context, match_id: str) -> None:
    with context.writing() as writing:
        match = hold_match(writing.connection, match_id)
        if match.status != OPENING:
            return
        _begin(writing, match)
    context.wakeups.notify((match.seat_0, match.seat_1))


def _seat(match: Row[Any], agent_id: str) -> int:
    if agent_id not in (match.seat_0, match.seat_1):
        raise Forbidden("this is for the match's two players")
    return int(agent_id == match.seat_1)
