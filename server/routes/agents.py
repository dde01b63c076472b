"""Registration and tokens."""

from fastapi import APIRouter, Response

from referee.wire import AgentList, AgentRequest, AgentToken
from server.errors import Invalid, NameTaken, Unauthorized
from server.routes.dependencies import ANYBODY, Authenticated, Body, ContentType, Cursor, Limit, Sent, Server, respond
from server.routes.describe import OWNED, describe
from server.services import agents
from server.services.commands import parse_body

router = APIRouter(prefix="/v1/agents", tags=["agents"])


@router.post(
    "",
    **describe(NameTaken, body=AgentRequest, success={201: AgentToken}, token=False),
    summary="Register an agent",
)
def register(context: Server, body: Body, content_type: ContentType = None) -> Response:
    """The answer holds the agent's token, which is shown this once."""
    return respond(agents.register(context, parse_body(body, content_type, AgentRequest)))


@router.get("", **describe(Invalid, Unauthorized, token=False), dependencies=[ANYBODY], summary="All agents")
def listing(context: Server, cursor: Cursor, limit: Limit) -> AgentList:
    """Agents in order of registration."""
    return agents.listing(context, cursor, limit)


@router.post(
    "/{agent_id}/token",
    **describe(*OWNED, success={200: AgentToken}, key=True),
    summary="Rotate an agent's token",
)
def rotate(agent_id: str, context: Server, command: Sent) -> Response:
    """A new token; the old ones are void from now on."""
    return respond(agents.rotate(context, agent_id, command))


@router.delete("/{agent_id}/token", **describe(*OWNED, success={204: ""}), summary="Revoke an agent's tokens")
def revoke(agent_id: str, context: Server, caller: Authenticated) -> Response:
    """The agent is left without a token; the organiser can give it a new one."""
    agents.revoke(context, agent_id, caller)
    return Response(status_code=204)
