"""Agents: registration and tokens."""

from datetime import datetime
from typing import Annotated

from pydantic import ConfigDict, Field, StringConstraints

from protocol.values import Flag, Identifier, Message, Request

AgentName = Annotated[str, StringConstraints(min_length=1, max_length=64, pattern=r"^[A-Za-z0-9][A-Za-z0-9 _.-]*$")]


class AgentRequest(Request):
    """``POST /v1/agents``: a new agent."""

    model_config = ConfigDict(json_schema_extra={"examples": [{"name": "my-first-agent"}]})

    name: AgentName
    invitation: Annotated[
        str | None,
        Field(max_length=200, description="An invitation's code, where registration is by invitation."),
    ] = None


class AgentView(Message):
    """An agent as everybody sees it.

    Attributes:
        house: the server runs it itself; it accepts challenges.
    """

    id: Identifier
    name: str
    house: Flag
    created_at: datetime


class AgentToken(Message):
    """A fresh token: shown once, stored only as a hash."""

    agent: AgentView
    token: Annotated[str, Field(description="Sent as `Authorization: Bearer <token>`.")]


class AgentList(Message):
    """Agents in order of registration."""

    agents: tuple[AgentView, ...]
    next_cursor: str | None = None
