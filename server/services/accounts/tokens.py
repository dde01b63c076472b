"""Tokens of organisers, administrators and readers, and invitations to register: made, listed, rotated, revoked."""

import secrets
from datetime import datetime
from typing import Any

from sqlalchemy import Connection, Row, insert, select, update

from protocol import InvitationRequest, Invitations, TokenList, TokenRequest, TokenSecret, TokenView
from referee.play import nanoseconds
from server.errors import Forbidden, NotFound, WrongStatus
from server.http.commands import Answer, Command, parse
from server.security.callers import Caller
from server.security.tokens import INVITATION_PREFIX, STAFF_PREFIX, derived_token, digest
from server.services.accounts.shown_secrets import once_with_salt
from server.services.runtime.context import Context
from server.services.runtime.time import date_time
from server.store import paging
from server.store.tables import invitations, tokens


def create(context: Context, command: Command) -> Answer:
    """A token with the scopes asked for; the answer shows it, and shows it again when the request is repeated."""
    command.caller.require_admin()
    with context.writing() as writing:
        salt, token_id = once_with_salt(
            writing.connection, command, lambda salt: _created(writing.connection, command, salt)
        )
        row = _find(writing.connection, token_id)
    return _secret(201, row, command, salt)


def rotate(context: Context, token_id: str, command: Command) -> Answer:
    """A new token in place of the one with this id, which stops working at once."""
    command.caller.require_admin()
    with context.writing() as writing:
        row = _find(writing.connection, token_id)
        salt, _ = once_with_salt(
            writing.connection, command, lambda salt: _rotated(writing.connection, row, command, salt)
        )
        row = _find(writing.connection, token_id)
    return _secret(200, row, command, salt)


def revoke(context: Context, token_id: str, caller: Caller) -> None:
    """Void a token for good."""
    caller.require_admin()
    with context.writing() as writing:
        row = _find(writing.connection, token_id)
        now = writing.now if row.revoked_at is None else row.revoked_at
        writing.connection.execute(update(tokens).where(tokens.c.id == token_id).values(revoked_at=now))


def listing(context: Context, caller: Caller, after: paging.PagePosition | None, limit: int) -> TokenList:
    """The tokens of everybody but agents, in the order they were made."""
    caller.require_admin()
    staff = select(tokens).where(tokens.c.agent_id.is_(None))
    with context.database.reading() as connection:
        query = paging.oldest_first(staff, tokens, is_first=after is None)
        rows = connection.execute(query, paging.values(after, limit)).all()
    page, more = paging.cut(rows, limit)
    return TokenList(tokens=tuple(_view(row) for row in page), next_cursor=more)


def invite(context: Context, command: Command) -> Answer:
    """Invitation codes, each good for one registration; shown again when the request is repeated."""
    command.caller.require_organiser()
    request = parse(command, InvitationRequest)
    with context.writing() as writing:
        salt, expires_at = once_with_salt(
            writing.connection, command, lambda salt: _invited(writing.connection, command, request, salt)
        )
    codes = _codes(command.caller.token, salt, request.count)
    return Answer.of(201, Invitations(invitations=codes, expires_at=_expiry(int(expires_at) or None)))


def use_invitation(connection: Connection, code: str | None, agent_id: str, now: int) -> None:
    """Take an invitation for this agent; raises `Forbidden` when it is none, expired or used."""
    this = (invitations.c.digest == digest(code or "")) & invitations.c.used_at.is_(None)
    this &= invitations.c.expires_at.is_(None) | (invitations.c.expires_at > now)
    taken = connection.execute(update(invitations).where(this).values(used_at=now, agent_id=agent_id))
    if taken.rowcount != 1:
        raise Forbidden("registration is by invitation; the code is missing, unknown, used or expired")


def _created(connection: Connection, command: Command, salt: str) -> str:
    request, token_id = parse(command, TokenRequest), f"token_{secrets.token_hex(8)}"
    row = {
        "id": token_id,
        "digest": digest(derived_token(command.caller.token, salt, STAFF_PREFIX)),
        "name": request.name,
        "scopes": " ".join(sorted(set(request.scopes))),
        "created_at": command.arrived,
        "expires_at": _after(command.arrived, request.seconds),
    }
    connection.execute(insert(tokens).values(row))
    return token_id


def _rotated(connection: Connection, row: Row[Any], command: Command, salt: str) -> str:
    if row.revoked_at is not None:
        raise WrongStatus("the token was revoked; make another")
    renewed = digest(derived_token(command.caller.token, salt, STAFF_PREFIX))
    connection.execute(update(tokens).where(tokens.c.id == row.id).values(digest=renewed))
    return str(row.id)


def _invited(connection: Connection, command: Command, request: InvitationRequest, salt: str) -> str:
    """Stores the codes; what is said of them is when they expire, 0 for never."""
    expires_at = _after(command.arrived, request.seconds)
    codes = _codes(command.caller.token, salt, request.count)
    rows = [{"digest": digest(code), "created_at": command.arrived, "expires_at": expires_at} for code in codes]
    connection.execute(insert(invitations), rows)
    return str(expires_at or 0)


def _codes(presented: str, salt: str, count: int) -> tuple[str, ...]:
    return tuple(derived_token(presented, f"{salt} {index}", INVITATION_PREFIX) for index in range(count))


def _find(connection: Connection, token_id: str) -> Row[Any]:
    this = (tokens.c.id == token_id) & tokens.c.agent_id.is_(None)
    row = connection.execute(select(tokens).where(this)).one_or_none()
    if row is None:
        raise NotFound(f"there is no token {token_id}; agents' tokens are at /v1/agents")
    return row


def _secret(status: int, row: Row[Any], command: Command, salt: str) -> Answer:
    token = derived_token(command.caller.token, salt, STAFF_PREFIX)
    return Answer.of(status, TokenSecret(**dict(_view(row)), token=token))


def _view(row: Row[Any]) -> TokenView:
    return TokenView(
        id=row.id,
        name=row.name,
        scopes=tuple(row.scopes.split()),
        created_at=date_time(row.created_at),
        expires_at=_expiry(row.expires_at),
        revoked_at=_expiry(row.revoked_at),
    )


def _after(now: int, seconds: float | None) -> int | None:
    return None if seconds is None else now + nanoseconds(seconds)


def _expiry(at: int | None) -> datetime | None:
    return None if at is None else date_time(at)
