"""Agents and their tokens."""

import secrets
from typing import Any

from sqlalchemy import Connection, Row, insert, select, update

from protocol import AgentList, AgentRequest, AgentToken, AgentView
from referee.play import nanoseconds
from server.errors import Forbidden, NameTaken, NotFound
from server.http.commands import Answer, Command
from server.security.addresses import UNKNOWN
from server.security.callers import Caller, Scope
from server.security.names import skeleton
from server.security.tokens import derived_token, digest, new_token
from server.services.accounts.shown_secrets import once_with_salt
from server.services.accounts.tokens import use_invitation
from server.services.runtime.context import Context, Writing
from server.services.runtime.time import date_time
from server.store import paging
from server.store.locks import only_one
from server.store.tables import agents, tokens


def register(context: Context, request: AgentRequest, caller: Caller | None = None, address: str = UNKNOWN) -> Answer:
    """A new agent with its first token; raises `NameTaken`, and `Forbidden` where not everybody may register.

    Organisers register as often as they ask for anything; others are counted by their address, which raises
    `TooManyRequests`: every account has rates of its own, and must not come as cheap as a read.
    """
    if caller is None or not caller.is_organiser:
        context.limits.count_registration(address)
    agent_id = f"agent_{secrets.token_hex(8)}"
    with context.writing() as writing:
        connection = writing.connection
        _require_welcome(writing, request, caller, agent_id)
        if (taken := namesake(connection, request.name)) is not None:
            raise NameTaken(
                f"name = {request.name!r}: must not look like that of another agent, {taken.name!r}",
                field="name",
                value=request.name,
                allowed=f"another name, which does not look like {taken.name!r}",
            )
        insert_agent(writing, agent_id, request.name, house=False)
        token = new_token()
        _issue(writing, agent_id, token)
        agent = _agent(connection, agent_id)
    return Answer.of(201, AgentToken(agent=_view(agent), token=token))


def namesake(connection: Connection, name: str) -> Row[Any] | None:
    """The agent of this name, else the first that looks like it, else None: then the name is the transaction's."""
    common = skeleton(name)
    only_one(connection, f"name {common}")
    alike = select(agents).where(agents.c.skeleton == common)
    return connection.execute(alike.order_by(agents.c.name != name, agents.c.created_at, agents.c.id)).first()


def insert_agent(writing: Writing, agent_id: str, name: str, *, house: bool) -> None:
    """Store a new agent, whose name `namesake` has not found."""
    row = {"id": agent_id, "name": name, "skeleton": skeleton(name), "house": house, "created_at": writing.now}
    writing.connection.execute(insert(agents).values(row))


def _require_welcome(writing: Writing, request: AgentRequest, caller: Caller | None, agent_id: str) -> None:
    """Organisers register whom they like; whether others may is a setting."""
    if caller is not None and caller.is_organiser:
        return
    match writing.context.settings.registration:
        case "invited":
            use_invitation(writing.connection, request.invitation, agent_id, writing.now)
        case "closed":
            raise Forbidden("registration is closed; an organiser registers agents")


def me(context: Context, caller: Caller) -> AgentView:
    """The calling agent; raises `Forbidden` for the organiser."""
    with context.database.reading() as connection:
        return _view(_agent(connection, caller.require_agent()))


def listing(
    context: Context, house: bool | None, search: str | None, after: paging.PagePosition | None, limit: int
) -> AgentList:
    """Agents in order of registration, those after a place.

    House bots alone, or all but them, and those whose name contains something, when asked for.
    """
    query = select(agents)
    if house is not None:
        query = query.where(agents.c.house.is_(house))
    sought = {}
    if search is not None:
        query = query.where(paging.contains(agents.c.name) | (agents.c.id == search))
        sought = paging.part_of(search)
    query = paging.oldest_first(query, agents, is_first=after is None)
    with context.database.reading() as connection:
        rows = connection.execute(query, paging.values(after, limit) | sought).all()
    page, more = paging.cut(rows, limit)
    return AgentList(agents=tuple(_view(row) for row in page), next_cursor=more)


def rotate(context: Context, agent_id: str, command: Command) -> Answer:
    """A new token in place of the old ones, which stop working at once.

    An agent that loses the answer to its own rotation has a void token left, and asks the organiser for another.
    """
    with context.writing() as writing:
        agent = _owned(writing.connection, agent_id, command.caller)
        salt, _ = once_with_salt(writing.connection, command, lambda salt: _rotated(writing, agent_id, command, salt))
    return Answer.of(200, AgentToken(agent=_view(agent), token=derived_token(command.caller.token, salt)))


def renewed_token(writing: Writing, agent_id: str) -> str:
    """A new token for an agent; all others of its are void."""
    token = new_token()
    _revoke(writing, agent_id)
    _issue(writing, agent_id, token)
    return token


def _rotated(writing: Writing, agent_id: str, command: Command, salt: str) -> str:
    _revoke(writing, agent_id)
    _issue(writing, agent_id, derived_token(command.caller.token, salt))
    return agent_id


def revoke(context: Context, agent_id: str, caller: Caller) -> None:
    """Void the agent's tokens; only the organiser can give it another."""
    with context.writing() as writing:
        _owned(writing.connection, agent_id, caller)
        _revoke(writing, agent_id)


def _owned(connection: Connection, agent_id: str, caller: Caller) -> Row[Any]:
    agent = _agent(connection, agent_id)
    caller.require_self(agent_id)
    return agent


def _agent(connection: Connection, agent_id: str) -> Row[Any]:
    row = connection.execute(select(agents).where(agents.c.id == agent_id)).one_or_none()
    if row is None:
        raise NotFound(f"there is no agent {agent_id}")
    return row


def _issue(writing: Writing, agent_id: str, token: str) -> None:
    lifetime = nanoseconds(writing.context.settings.token_seconds)
    row = {
        "id": f"token_{secrets.token_hex(8)}",
        "digest": digest(token),
        "agent_id": agent_id,
        "scopes": Scope.AGENT,
        "created_at": writing.now,
        "expires_at": writing.now + lifetime if lifetime else None,
    }
    writing.connection.execute(insert(tokens).values(row))


def _revoke(writing: Writing, agent_id: str) -> None:
    valid = (tokens.c.agent_id == agent_id) & (tokens.c.revoked_at.is_(None))
    writing.connection.execute(update(tokens).where(valid).values(revoked_at=writing.now))


def _view(row: Row[Any]) -> AgentView:
    return AgentView(id=row.id, name=row.name, house=row.house, created_at=date_time(row.created_at))
