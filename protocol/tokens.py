"""Tokens of those who do not play, and invitations to register."""

from datetime import datetime
from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from protocol.agents import AgentName
from protocol.values import Identifier, Integer, Message, Number, Request

StaffScope = Literal["organiser", "admin", "read"]
Lifetime = Annotated[
    Number | None, Field(gt=0, le=10 * 365 * 86400, description="Seconds until it expires; null for never.")
]


class TokenRequest(Request):
    """``POST /v1/tokens``: a new token.

    Attributes:
        name: what it is for, shown in lists.
    """

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"name": "spring cup", "scopes": ["organiser"], "seconds": 604800.0}]}
    )

    name: AgentName
    scopes: Annotated[tuple[StaffScope, ...], Field(min_length=1, max_length=3)]
    seconds: Lifetime = None


class TokenView(Message):
    """A token without the token."""

    id: Identifier
    name: str | None
    scopes: tuple[str, ...]
    created_at: datetime
    expires_at: datetime | None
    revoked_at: datetime | None


class TokenSecret(TokenView):
    """A fresh token: shown to whoever asked for it, stored only as a hash."""

    token: Annotated[str, Field(description="Sent as `Authorization: Bearer <token>`.")]


class TokenList(Message):
    """Tokens in the order they were made."""

    tokens: tuple[TokenView, ...]
    next_cursor: str | None = None


class InvitationRequest(Request):
    """``POST /v1/invitations``: codes to register with, each good for one agent."""

    model_config = ConfigDict(json_schema_extra={"examples": [{"count": 2, "seconds": 604800.0}]})

    count: Annotated[Integer, Field(ge=1, le=100)] = 1
    seconds: Lifetime = None


class Invitations(Message):
    """Codes for ``invitation`` in ``POST /v1/agents``; stored only as hashes."""

    invitations: tuple[str, ...]
    expires_at: datetime | None
