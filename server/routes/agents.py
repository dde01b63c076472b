"""Registration and tokens."""

from typing import Annotated

from fastapi import APIRouter, Query, Response

from protocol import AgentList, AgentRequest, AgentToken, AgentView
from server.errors import Forbidden, Invalid, NameTaken, Unauthorized
from server.http.commands import parse_body
from server.http.dependencies import (
    ANYBODY,
    Address,
    Authenticated,
    Body,
    ContentType,
    ContextDep,
    Limit,
    PageDep,
    Search,
    Sent,
    Visitor,
    flag,
    respond,
)
from server.http.describe import OWNED, describe
from server.services.accounts import agents

router = APIRouter(prefix="/v1/agents", tags=["agents"])


@router.post(
    "",
    **describe(NameTaken, Unauthorized, Forbidden, body=AgentRequest, success={201: AgentToken}, token=False),
    summary="Register an agent",
)
def register(
    context: ContextDep, visitor: Visitor, address: Address, body: Body, content_type: ContentType = None
) -> Response:
    """The answer holds the agent's token, which is shown this once."""
    request = parse_body(body, content_type, AgentRequest)
    return respond(agents.register(context, request, visitor, address))


@router.get("", **describe(Invalid, Unauthorized, token=False), dependencies=[ANYBODY], summary="All agents")
def listing(
    context: ContextDep,
    after: PageDep,
    limit: Limit,
    search: Search,
    house: Annotated[
        str | None,
        Query(description="true: only house bots; false: all but them", json_schema_extra={"enum": ["true", "false"]}),
    ] = None,
) -> AgentList:
    """Agents in order of registration."""
    return agents.listing(context, flag("house", house), search, after, limit)


@router.get("/me", **describe(Forbidden), summary="The calling agent")
def me(context: ContextDep, caller: Authenticated) -> AgentView:
    """Whose token this is."""
    return agents.me(context, caller)


@router.post(
    "/{agent_id}/token",
    **describe(*OWNED, success={200: AgentToken}, key=True),
    summary="Rotate an agent's token",
)
def rotate(agent_id: str, context: ContextDep, command: Sent) -> Response:
    """A new token; the old ones are void from now on."""
    return respond(agents.rotate(context, agent_id, command))


@router.delete("/{agent_id}/token", **describe(*OWNED, success={204: ""}), summary="Revoke an agent's tokens")
def revoke(agent_id: str, context: ContextDep, caller: Authenticated) -> Response:
    """The agent is left without a token; the organiser can give it a new one."""
    agents.revoke(context, agent_id, caller)
    return Response(status_code=204)
