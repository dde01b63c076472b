"""Matches in pages, the newest first: every page is read from indices in its order, however many matches there are."""

from collections.abc import Sequence
from functools import cache
from typing import Any, Final, NamedTuple, get_args

from pydantic_core import to_json
from sqlalchemy import ColumnElement, Connection, Select, String, bindparam, or_, select

from protocol import MatchStatus
from server.errors import invalid_field
from server.services.matches import match_views
from server.services.matches.secrecy import MATCH_OPEN
from server.services.runtime.context import Context
from server.store import paging
from server.store.prepared import Prepared
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
    asked = {"agent": agent_id, "status": status, "search": search}
    if search is not None:
        asked |= paging.part_of(search)
    with context.database.reading() as connection:
        named = [] if search is None or agent_id is not None else _NAMED.all(connection, **asked)
        shape = _Shape(agent_id is not None, status is not None, search is not None, len(named), after is None)
        asked |= {_named(number): row.id for number, row in enumerate(named)} | paging.values(after, limit)
        found = _page(shape).all(connection, **asked)
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


class _Shape(NamedTuple):
    """What a page is asked for by.

    Attributes:
        named: agents with something in their names, at most one more than `MOST_NAMED`.
    """

    by_agent: bool
    by_status: bool
    by_name: bool
    named: int
    is_first: bool


@cache
def _page(shape: _Shape) -> Prepared:
    """The statement of a page."""
    queries = _queries(shape)
    if shape.by_status:
        queries = [query.where(matches.c.status == bindparam("status")) for query in queries]
    return Prepared(paging.newest_of(queries, matches, is_first=shape.is_first))


def _queries(shape: _Shape) -> list[Select[Any]]:
    """What the places of the matches asked for are made up of, no match in two of them."""
    every = select(matches.c.created_at, matches.c.id)
    if shape.by_agent:
        found = (_has_name(),) if shape.by_name else ()
        return [every.where(seat == bindparam("agent"), *found) for seat in (matches.c.seat_0, matches.c.seat_1)]
    if not shape.by_name:
        return [every]
    if shape.named > MOST_NAMED:
        return [every.where(_has_name())]
    named: list[Any] = [bindparam(_named(number)) for number in range(shape.named)]
    other = matches.c.id != _SEARCH
    first = [every.where(matches.c.seat_0 == one, other) for one in named]
    second = [every.where(matches.c.seat_1 == one, matches.c.seat_0.not_in(named), other) for one in named]
    return [every.where(matches.c.id == _SEARCH), *first, *second]


def _named(number: int) -> str:
    """The parameter that an agent with something in its name is."""
    return f"named_{number}"


def _has_name() -> ColumnElement[bool]:
    """A match has this id, or a player with this in the name.

    Not for the planner to start from: concatenated, the columns have no index, and the list is read in its order.
    """
    seats = (matches.c.seat_0, matches.c.seat_1)
    return or_(*(seat.concat("").in_(_WITH_NAME) for seat in seats), matches.c.id.concat("") == _SEARCH)


_SEARCH: Final = bindparam("search", type_=String)
_WITH_NAME: Final = select(agents.c.id).where(paging.contains(agents.c.name))
_NAMED: Final = Prepared(_WITH_NAME.limit(MOST_NAMED + 1))
