"""Tournaments: made by the organiser, their matches given out by the server as the results come in.

How an event stands follows from its terms and its entries alone, by the same code that runs events without a server
(`tournament.ledger`). Whatever writes an event holds its name first; the one exception is the end of a match, which
holds the match already, and nothing that holds an event's name then waits for a match that exists.
"""

import secrets
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any, Final

from sqlalchemy import Connection, Row, bindparam, insert, select

from physics import Table
from protocol import (
    DisqualifyRequest,
    EntriesPage,
    StandingsView,
    TournamentList,
    TournamentRequest,
    TournamentView,
    VoidRequest,
)
from protocol.values import trusted
from server.errors import WrongStatus, invalid_field
from server.http.commands import Answer, Command, once, parse
from server.security.callers import Caller
from server.services.matches.matches import call_off
from server.services.runtime.context import Context, Writing
from server.services.tournaments import progress, tournament_views
from server.store import paging
from server.store.prepared import Prepared
from server.store.tables import agents, tournaments
from tournament import Spec
from tournament.ledger import Act
from tournament.size import games_of

SECRET_BYTES: Final = 32
MOST_GAMES: Final = 10_000
"""In one event: its plan, its games and its standings are each one answer."""


def create(context: Context, command: Command) -> Answer:
    """A new event; no match is made before it is started."""
    command.caller.require_organiser()

    def make() -> Answer:
        with context.writing() as writing:
            return once(writing.connection, command, lambda: _created(writing, command))

    return context.kernels.awaited(make)


def start(context: Context, tournament_id: str, command: Command) -> Answer:
    """Give out the first matches, or go on after a pause."""
    return _decided(context, tournament_id, command, "go_on", ("created", "paused"))


def pause(context: Context, tournament_id: str, command: Command) -> Answer:
    """Give out no further match; those that are running are played."""
    return _decided(context, tournament_id, command, "pause", ("running",))


def abort(context: Context, tournament_id: str, command: Command) -> Answer:
    """End an event for good, its running matches too."""
    return _decided(context, tournament_id, command, "abort", ("created", "running", "paused"))


def void(context: Context, tournament_id: str, command: Command) -> Answer:
    """Take a finished game out of an event; it is played again."""
    return _decided(
        context, tournament_id, command, "void", ("running", "paused"), lambda: parse(command, VoidRequest).model_dump()
    )


def disqualify(context: Context, tournament_id: str, command: Command) -> Answer:
    """Take an entrant out of an event: its running matches are called off, its due games are forfeit."""
    fields = lambda: parse(command, DisqualifyRequest).model_dump()  # noqa: E731
    return _decided(context, tournament_id, command, "disqualify", ("created", "running", "paused"), fields)


def one(context: Context, tournament_id: str) -> TournamentView:
    """An event; raises `NotFound`."""
    with context.database.reading() as connection:
        return tournament_views.view(context, connection, progress.find(connection, tournament_id))


def standings(context: Context, tournament_id: str) -> StandingsView:
    """How its entrants stand; raises `NotFound`."""
    with context.database.reading() as connection:
        return tournament_views.standings_view(context, connection, progress.find(connection, tournament_id))


def entries(context: Context, tournament_id: str, caller: Caller, after: int, limit: int) -> EntriesPage:
    """Results and decisions after an entry, in order; raises `NotFound`. Organisers': results tell the noise."""
    caller.require_organiser()
    with context.database.reading() as connection:
        row = progress.find(connection, tournament_id)
        found = progress.entries_after(connection, row.id, after, limit + 1)
        return tournament_views.entries_page(found, limit, row.terms.get("lots"))


def listing(
    context: Context, status: str | None, search: str | None, after: paging.PagePosition | None, limit: int
) -> bytes:
    """A `TournamentList` in JSON: the newest first, of one status or with a name when asked for; raises `Invalid`."""
    if status is not None and status not in progress.STATUSES:
        raise invalid_field("status", status, f"one of {', '.join(progress.STATUSES)}")
    page = _page(status is not None, search is not None, after is None)
    asked = {"status": status, "search": search, **(paging.part_of(search) if search is not None else {})}
    with context.database.reading() as connection:
        rows = page.all(connection, **paging.values(after, limit), **asked)
    shown, more = paging.cut(rows, limit)
    summaries = tuple(tournament_views.summary(row) for row in shown)
    return trusted(TournamentList, tournaments=summaries, next_cursor=more).model_dump_json().encode()


@cache
def _page(of_status: bool, sought: bool, is_first: bool) -> Prepared:
    """The statement of a page: events of one status, with something in the name."""
    query = select(*tournament_views.SUMMED)
    if of_status:
        query = query.where(tournaments.c.status == bindparam("status"))
    if sought:
        query = query.where(paging.contains(tournaments.c.name) | (tournaments.c.id == bindparam("search")))
    return Prepared(paging.newest_first(query, tournaments, is_first=is_first))


def _created(writing: Writing, command: Command) -> Answer:
    request = parse(command, TournamentRequest)
    spec = _spec(request)
    writing.context.kernels.require(Table.of(spec.table))
    row = {
        "id": f"tournament_{secrets.token_hex(8)}",
        "name": spec.name,
        "status": "created",
        "terms": spec.to_dict(),
        "agents": _agents(writing.connection, spec, request),
        "games": 0,
        "due": 0,
        "created_at": writing.now,
    }
    writing.connection.execute(insert(tournaments).values(row))
    made = progress.find(writing.connection, str(row["id"]))
    progress.note(writing, made, "opened", command.caller.id, {})
    return Answer.of(201, _gone_on(writing, made), location=f"/v1/tournaments/{made.id}")


def _spec(request: TournamentRequest) -> Spec:
    """The terms, with secrets drawn here unless a seed was chosen."""
    spec = request.terms
    if spec.lots is not None:
        raise invalid_field("terms.lots", "<secret>", "nothing: the server draws them")
    if spec.seed is None:
        spec = replace(spec, seed=secrets.token_hex(SECRET_BYTES), lots=secrets.token_hex(SECRET_BYTES))
    _, games = games_of(spec)
    if games > MOST_GAMES:
        raise invalid_field("terms.pairs", spec.pairs, f"at most {MOST_GAMES} games in all; these terms make {games}")
    return spec


def _agents(connection: Connection, spec: Spec, request: TournamentRequest) -> dict[str, str]:
    """Each entrant's agent; raises `Invalid` for one that is not registered, or plays under two names."""
    if unknown := sorted(set(request.agents) - set(spec.names)):
        raise invalid_field("agents", unknown, f"the names of entrants: {', '.join(spec.names)}"[:500])
    found: dict[str, str] = {}
    for name in spec.names:
        wanted = request.agents.get(name)
        this = agents.c.name == name if wanted is None else agents.c.id == wanted
        row = connection.execute(select(agents.c.id).where(this)).one_or_none()
        if row is None or row.id in found.values():
            raise invalid_field(f"agents.{name}", wanted or name, "the id of a registered agent, another for each name")
        found[name] = str(row.id)
    return found


def _decided(
    context: Context,
    tournament_id: str,
    command: Command,
    kind: str,
    allowed: tuple[str, ...],
    fields: Callable[[], dict[str, Any]] = dict,
) -> Answer:
    """Carry out an organiser's decision once, then call off the running matches that no longer belong to the event."""
    with context.writing() as writing:
        row = progress.hold(writing.connection, tournament_id)
        command.caller.require_organiser()
        answer = once(
            writing.connection, command, lambda: _act(writing, row, command.caller.id, kind, allowed, fields())
        )
    for match_id in progress.stray_matches(context, tournament_id):
        call_off(context, match_id)
    return answer


def _act(
    writing: Writing, row: Row[Any], by: str, kind: str, allowed: tuple[str, ...], fields: dict[str, Any]
) -> Answer:
    """Note the decision, if the event as it stands allows it, and give out what follows."""
    if row.status not in allowed:
        raise WrongStatus(f"status = {row.status}: must be {' or '.join(allowed)}")
    refused = progress.course_here(writing, row).ledger.after([Act(kind, fields)]).refused
    if refused:
        raise invalid_field(next(iter(fields)), fields[next(iter(fields))], refused[-1])
    progress.note(writing, row, kind, by, fields)
    return Answer.of(200, _gone_on(writing, row))


def _gone_on(writing: Writing, row: Row[Any]) -> TournamentView:
    """The event after what follows from its entries was done."""
    row = progress.go_on(writing, row)
    return tournament_views.view_of(writing.connection, row, progress.course_here(writing, row))
