"""Tournaments."""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from protocol import (
    DisqualifyRequest,
    EntriesPage,
    StandingsView,
    TournamentList,
    TournamentRequest,
    TournamentView,
    VoidRequest,
)
from server.errors import Forbidden, Invalid, NotFound, Unauthorized, WrongStatus
from server.http.commands import Answer
from server.http.dependencies import ANYBODY, Authenticated, ContextDep, Cursor, Limit, PageDep, Search, Sent, respond
from server.http.describe import OWNED, describe
from server.services.tournaments import progress, tournaments

router = APIRouter(prefix="/v1/tournaments", tags=["tournaments"])


@router.post(
    "",
    **describe(Forbidden, body=TournamentRequest, success={201: TournamentView}, key=True),
    summary="Make a tournament",
)
def create(context: ContextDep, command: Sent) -> Response:
    """For the organiser; no match is made before it is started.

    The server draws the seed; one in the terms is for tests, and marks the event `foreseeable`.
    """
    return respond(tournaments.create(context, command))


@router.get(
    "",
    **describe(Invalid, Unauthorized, token=False),
    response_model=TournamentList,
    dependencies=[ANYBODY],
    summary="Tournaments, the newest first",
)
def listing(
    context: ContextDep,
    after: PageDep,
    limit: Limit,
    search: Search,
    status: Annotated[
        str | None,
        Query(
            description="created, running, paused, finished or aborted",
            json_schema_extra={"enum": list(progress.STATUSES)},
        ),
    ] = None,
) -> Response:
    """Of one status when asked for."""
    return respond(Answer(200, tournaments.listing(context, status, search, after, limit)))


@router.get(
    "/{tournament_id}",
    **describe(NotFound, Unauthorized, token=False),
    dependencies=[ANYBODY],
    summary="One tournament",
)
def one(tournament_id: str, context: ContextDep) -> TournamentView:
    """Its terms, its games with their matches, and what was decided.

    The seed is there when it is over, and so are levels of noise that the players are not told.
    """
    return tournaments.one(context, tournament_id)


@router.get(
    "/{tournament_id}/standings",
    **describe(NotFound, Unauthorized, token=False),
    dependencies=[ANYBODY],
    summary="How the entrants stand",
)
def standings(tournament_id: str, context: ContextDep) -> StandingsView:
    """The best first. Nobody is rated in an event that can be foreseen."""
    return tournaments.standings(context, tournament_id)


@router.get(
    "/{tournament_id}/entries", **describe(Forbidden, Invalid, NotFound), summary="What was noted about a tournament"
)
def entries(tournament_id: str, context: ContextDep, caller: Authenticated, after: Cursor, limit: Limit) -> EntriesPage:
    """Results and decisions in their order, after the entry whose number is the cursor. For organisers."""
    return tournaments.entries(context, tournament_id, caller, after, limit)


@router.post(
    "/{tournament_id}/start",
    **describe(*OWNED, WrongStatus, success={200: TournamentView}, key=True),
    summary="Start a tournament, or go on after a pause",
)
def start(tournament_id: str, context: ContextDep, command: Sent) -> Response:
    """The first matches begin; every other one when its players are free and its pairing is known."""
    return respond(tournaments.start(context, tournament_id, command))


@router.post(
    "/{tournament_id}/pause",
    **describe(*OWNED, WrongStatus, success={200: TournamentView}, key=True),
    summary="Begin no further matches",
)
def pause(tournament_id: str, context: ContextDep, command: Sent) -> Response:
    """Those that are running are played."""
    return respond(tournaments.pause(context, tournament_id, command))


@router.post(
    "/{tournament_id}/abort",
    **describe(*OWNED, WrongStatus, success={200: TournamentView}, key=True),
    summary="End a tournament for good",
)
def abort(tournament_id: str, context: ContextDep, command: Sent) -> Response:
    """Its running matches are called off; its results so far stand."""
    return respond(tournaments.abort(context, tournament_id, command))


@router.post(
    "/{tournament_id}/void",
    **describe(*OWNED, WrongStatus, body=VoidRequest, success={200: TournamentView}, key=True),
    summary="Take a finished game out",
)
def void(tournament_id: str, context: ContextDep, command: Sent) -> Response:
    """It is played again, on the same racks with fresh noise."""
    return respond(tournaments.void(context, tournament_id, command))


@router.post(
    "/{tournament_id}/disqualify",
    **describe(*OWNED, WrongStatus, body=DisqualifyRequest, success={200: TournamentView}, key=True),
    summary="Take an entrant out",
)
def disqualify(tournament_id: str, context: ContextDep, command: Sent) -> Response:
    """Its due games are forfeit, and it is not paired any more."""
    return respond(tournaments.disqualify(context, tournament_id, command))
