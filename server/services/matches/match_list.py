"""Matches in pages, the newest first: every page is read from indices in its order, however many matches there are."""

from collections.abc import Sequence
from typing import Any, Final, get_args

from pydantic_core import to_json
from sqlalchemy import ColumnElement, Connection, Select, or_, select

from protocol import MatchStatus
from server.errors import invalid_field
from server.services.matches import match_views
from server.services.matches.secrecy import MATCH_OPEN
from server.services.runtime.context import Context
from server.store import paging
from server.store.tables import agents, matches

STATUSES: Final[tuple[str, ...]] = get_args(MatchStatus)
MOST_NAMED: Final = 16
"""Agents found by a part of their names up to which each one's matches are looked up; with more, every other match or
so has one of them, and the list is read in its order until the page is full."""
LONGEST_KEPT: Final = 4096
"""Bytes of a match that is kept: one of very many games is rarely asked for."""


def listing(
    context: Context,
    agent_id: str | None,
    status: str | None,
    search: str | None,
    after: paging.PagePosition | None,
    limit: int,
) -> bytes:
    """A `MatchList` in JSON: the newest first, when asked for of one agent, of one status, with a player's name.

    Raises `Invalid`.
    """
    if status is not None and status not in STATUSES:
        raise invalid_field("status", status, f"one of {', '.join(STATUSES)}")
    with context.database.reading() as connection:
        queries = _queries(connection, agent_id, search)
        if status is not None:
            queries = [query.where(matches.c.status == status) for query in queries]
        found = connection.execute(paging.newest_of(queries, matches, after, limit)).all()
        page, more = paging.cut(found, limit)
        shown = _shown(context, connection, [place.id for place in page])
    return b'{"matches":[%b],"next_cursor":%b}' % (b",".join(shown), to_json(more))


def _shown(context: Context, connection: Connection, ids: Sequence[str]) -> list[bytes]:
    """Each match as JSON; one that is over, and has no secret any more, never changes and is written once."""
    known = {each: text for each in ids if (text := context.over.get(each)) is not None}
    rows = match_views.rows(connection, [each for each in ids if each not in known])
    made = {}
    for row, view in zip(rows, match_views.views(connection, rows), strict=True):
        text = known[row.id] = view.model_dump_json().encode()
        if row.status not in MATCH_OPEN and view.noise.level is not None and len(text) <= LONGEST_KEPT:
            made[row.id] = text
    context.over.keep(made)
    return [known[each] for each in ids]


def _queries(connection: Connection, agent_id: str | None, search: str | None) -> list[Select[Any]]:
    """What the places of the matches asked for are made up of, no match in two of them."""
    every = select(matches.c.created_at, matches.c.id)
    if agent_id is not None:
        found = () if search is None else (_has_name(search),)
        return [every.where(seat == agent_id, *found) for seat in (matches.c.seat_0, matches.c.seat_1)]
    if search is None:
        return [every]
    named = connection.scalars(_named(search).limit(MOST_NAMED + 1)).all()
    if len(named) > MOST_NAMED:
        return [every.where(_has_name(search))]
    first = [every.where(matches.c.seat_0 == one, matches.c.id != search) for one in named]
    second = [every.where(matches.c.seat_1 == one, matches.c.seat_0.not_in(named)) for one in named]
    return [every.where(matches.c.id == search), *first, *(one.where(matches.c.id != search) for one in second)]


def _named(search: str) -> Select[str]:
    """The agents with this in their names."""
    return select(agents.c.id).where(paging.contains(agents.c.name, search))


def _has_name(search: str) -> ColumnElement[bool]:
    """A match has this id, or a player with this in the name.

    Not for the planner to start from: concatenated, the columns have no index, and the list is read in its order.
    """
    seats = (matches.c.seat_0, matches.c.seat_1)
    named = _named(search)
    return or_(*(seat.concat("").in_(named) for seat in seats), matches.c.id.concat("") == search)
