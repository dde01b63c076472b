"""Who a request comes from: an agent, the organiser, or nobody in particular."""

import hmac
from dataclasses import dataclass, field

from sqlalchemy import Connection, select

from server.errors import Forbidden, Unauthorized
from server.security.tokens import digest, matches
from server.store.tables import tokens

ORGANISER = "organiser"
"""The organiser's name as a caller; agents' identifiers start with `agent_`, so that they never clash."""


@dataclass(frozen=True, slots=True)
class Caller:
    """Somebody with a valid token: an agent by its identifier, or the organiser."""

    id: str
    token: str = field(repr=False)

    @property
    def is_organiser(self) -> bool:
        """Whether it is the organiser."""
        return self.id == ORGANISER

    def require_organiser(self) -> None:
        """Raise `Forbidden` unless it is the organiser."""
        if not self.is_organiser:
            raise Forbidden("only the organiser may do this")

    def require_self(self, agent_id: str) -> None:
        """Raise `Forbidden` unless it is this agent or the organiser."""
        if not self.is_organiser and self.id != agent_id:
            raise Forbidden(f"this is for agent {agent_id} or the organiser; the token is {self.id}'s")

    def require_agent(self) -> str:
        """The agent's identifier; raises `Forbidden` for the organiser, who does not play."""
        if self.is_organiser:
            raise Forbidden("this is for agents; the token is the organiser's")
        return self.id


def identify(connection: Connection, token: str | None, organiser_digest: str | None) -> Caller:
    """The caller with this token; raises `Unauthorized` for none, an unknown one, or one that was revoked."""
    if token is None:
        raise Unauthorized("no token; allowed: the header Authorization: Bearer TOKEN")
    if organiser_digest is not None and hmac.compare_digest(digest(token), organiser_digest):
        return Caller(ORGANISER, token)
    row = connection.execute(select(tokens).where(tokens.c.digest == digest(token))).one_or_none()
    if row is None or row.revoked_at is not None or not matches(token, row.digest):
        raise Unauthorized("the token is not valid: unknown, rotated or revoked")
    return Caller(row.agent_id, token)
