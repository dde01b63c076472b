"""Who a request comes from and what the token allows: an agent, an organiser, an administrator, a reader."""

import hmac
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Final

from sqlalchemy import Connection, bindparam, select

from server.errors import Forbidden, Unauthorized
from server.security.tokens import digest, matches
from server.store.prepared import Prepared
from server.store.tables import tokens

ORGANISER = "organiser"
"""The caller with the token of the settings; the others' identifiers start with `agent_` and `token_`."""


class Scope(StrEnum):
    """What a token is good for. Public reads need none; every valid token may do them."""

    AGENT = "agent"
    """Playing: as the one agent that the token belongs to."""
    ORGANISER = "organiser"
    """Matches between any agents, verdicts on their games, tokens of agents, invitations."""
    ADMIN = "admin"
    """Tokens with any scope, and all that an organiser may."""
    READ = "read"
    """Nothing but public reads, where the server does not give them to everybody."""


AGENTS = frozenset({Scope.AGENT})
ORGANISERS = frozenset({Scope.ORGANISER, Scope.ADMIN})


@dataclass(frozen=True, slots=True)
class Caller:
    """Somebody with a valid token: an agent by its identifier, others by their token's."""

    id: str
    token: str = field(repr=False)
    scopes: frozenset[Scope] = AGENTS

    @classmethod
    def organiser(cls, token: str) -> "Caller":
        """Whoever has the token of the settings: may do everything but play."""
        return cls(ORGANISER, token, ORGANISERS)

    @classmethod
    def stranger(cls, address: str) -> "Caller":
        """A caller without a token, known by address. It may do what needs no token."""
        return cls(address, "", frozenset())

    @property
    def is_stranger(self) -> bool:
        """Whether it came without a token."""
        return not self.scopes

    @property
    def is_organiser(self) -> bool:
        """Whether it may do what organisers do."""
        return bool(self.scopes & ORGANISERS)

    def require_organiser(self) -> None:
        """Raise `Forbidden` unless it is an organiser."""
        if not self.is_organiser:
            raise Forbidden("only an organiser may do this")

    def require_admin(self) -> None:
        """Raise `Forbidden` unless it is an administrator."""
        if Scope.ADMIN not in self.scopes:
            raise Forbidden("this takes a token with the scope admin")

    def require_player(self) -> None:
        """Raise `Forbidden` for those who neither play nor organise."""
        if not (self.is_organiser or Scope.AGENT in self.scopes):
            raise Forbidden("this takes a token with the scope agent or organiser")

    def require_self(self, agent_id: str) -> None:
        """Raise `Forbidden` unless it is this agent or an organiser."""
        if not self.is_organiser and self.id != agent_id:
            raise Forbidden(f"this is for agent {agent_id} or an organiser; the token is {self.id}'s")

    def require_agent(self) -> str:
        """The agent's identifier; raises `Forbidden` for everybody who does not play."""
        if Scope.AGENT not in self.scopes:
            raise Forbidden("this is for agents; the token has the scope " + ", ".join(sorted(self.scopes)))
        return self.id


def identify(connection: Connection, token: str | None, organiser_digest: str | None, now: int) -> Caller:
    """The caller with this token; raises `Unauthorized` for none and for one that is unknown, revoked or expired."""
    if token is None:
        raise Unauthorized("there is no token: must be sent in the header Authorization: Bearer TOKEN")
    if organiser_digest is not None and hmac.compare_digest(digest(token), organiser_digest):
        return Caller.organiser(token)
    row = _BY_DIGEST.first(connection, digest=digest(token))
    if row is None or row.revoked_at is not None or not matches(token, row.digest):
        raise Unauthorized("the token is not valid: unknown, rotated or revoked")
    if row.expires_at is not None and row.expires_at <= now:
        raise Unauthorized("the token is not valid any more: it has expired")
    return Caller(row.agent_id or row.id, token, frozenset(Scope(scope) for scope in row.scopes.split()))


_BY_DIGEST: Final = Prepared(select(tokens).where(tokens.c.digest == bindparam("digest")))
