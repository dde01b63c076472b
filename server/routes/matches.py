"""Matches."""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from protocol import AcceptRequest, ClientSeedRequest, MatchList, MatchRequest, MatchView
from server.errors import Forbidden, Invalid, NotFound, Unauthorized, WrongStatus
from server.http.commands import Answer
from server.http.dependencies import ANYBODY, ContextDep, Limit, PageDep, Search, Sent, respond
from server.http.describe import NO_NUL, OWNED, describe
from server.services.matches import match_list, matches, player_seeds

router = APIRouter(prefix="/v1/matches", tags=["matches"])


@router.post(
    "",
    **describe(Forbidden, WrongStatus, body=MatchRequest, success={201: MatchView}, key=True),
    summary="Make a match, or challenge",
)
def create(context: ContextDep, command: Sent) -> Response:
    """From the organiser the match starts at once.

    From one of the two agents it is a challenge to the other.
    """
    return respond(matches.create(context, command))


@router.get(
    "",
    **describe(Invalid, Unauthorized, success={200: MatchList}, token=False),
    dependencies=[ANYBODY],
    summary="Matches, the newest first",
)
def listing(
    context: ContextDep,
    after: PageDep,
    limit: Limit,
    search: Search,
    agent: Annotated[str | None, Query(description="only this agent's", json_schema_extra=NO_NUL)] = None,
    status: Annotated[
        str | None,
        Query(
            description="challenged, running, finished or aborted",
            json_schema_extra={"enum": list(match_list.STATUSES)},
        ),
    ] = None,
) -> Response:
    """An agent finds the challenges it may accept with `?agent=ID&status=challenged`."""
    return respond(Answer(200, match_list.listing(context, agent, status, search, after, limit)))


@router.get("/{match_id}", **describe(NotFound, Unauthorized, token=False), dependencies=[ANYBODY], summary="One match")
def one(match_id: str, context: ContextDep) -> MatchView:
    """The match with its games so far."""
    return matches.one(context, match_id)


@router.post(
    "/{match_id}/accept",
    **describe(*OWNED, WrongStatus, body=AcceptRequest, optional_body=True, success={200: MatchView}, key=True),
    summary="Accept a challenge",
)
def accept(match_id: str, context: ContextDep, command: Sent) -> Response:
    """The first game begins, at once or when the players have had their time to add seeds.

    The body may be left out.
    """
    return respond(matches.accept(context, match_id, command))


@router.post(
    "/{match_id}/seed",
    **describe(*OWNED, WrongStatus, body=ClientSeedRequest, success={200: MatchView}, key=True),
    summary="Add a seed to the draw",
)
def contribute(match_id: str, context: ContextDep, command: Sent) -> Response:
    """Each player once, after the commitment was published and before the first rack."""
    return respond(player_seeds.contribute(context, match_id, command))


@router.post(
    "/{match_id}/abort",
    **describe(*OWNED, WrongStatus, success={200: MatchView}, key=True),
    summary="Call a match off",
)
def abort(match_id: str, context: ContextDep, command: Sent) -> Response:
    """The organiser at any time; its players only while it is a challenge."""
    return respond(matches.abort(context, match_id, command))
