"""Agents and their tokens."""

import secrets
from typing import Any

from sqlalchemy import Connection, Row, insert, select, update

from referee.wire import AgentList, AgentRequest, AgentToken, AgentView
from server.errors import NameTaken, NotFound
from server.security.callers import Caller
from server.security.tokens import derived_token, digest, new_token
from server.services.commands import Answer, Command, once
from server.services.context import Context
from server.services.time import date_time
from server.store.locks import only_one
from server.store.tables import agents, tokens


def register(context: Context, request: AgentRequest) -> Answer:
    """A new agent with its first token; raises `NameTaken`."""
    now = context.time.now()
    agent_id = f"agent_{secrets.token_hex(8)}"
    with context.database.writing() as connection:
        only_one(connection, f"name {request.name}")
        if connection.execute(select(agents.c.id).where(agents.c.name == request.name)).first():
            raise NameTaken(
                f"the name {request.name!r} is taken",
                field="name",
                value=request.name,
                allowed="another name",
            )
        connection.execute(insert(agents).values(id=agent_id, name=request.name, house=False, created_at=now))
        token = new_token()
        _issue(connection, agent_id, token, now)
        agent = _agent(connection, agent_id)
    return Answer.of(201, AgentToken(agent=_view(agent), token=token))


def me(context: Context, caller: Caller) -> AgentView:
    """The calling agent; raises `Forbidden` for the organiser."""
    with context.database.reading() as connection:
        return _view(_agent(connection, caller.require_agent()))


def listing(context: Context, house: bool | None, cursor: int, limit: int) -> AgentList:
    """Agents in order of registration, from row `cursor` on; house bots alone, or all but them, when asked for."""
    query = select(agents).order_by(agents.c.created_at, agents.c.id).offset(cursor).limit(limit + 1)
    if house is not None:
        query = query.where(agents.c.house.is_(house))
    with context.database.reading() as connection:
        rows = connection.execute(query).all()
    more = str(cursor + limit) if len(rows) > limit else None
    return AgentList(agents=tuple(_view(row) for row in rows[:limit]), next_cursor=more)


def rotate(context: Context, agent_id: str, command: Command) -> Answer:
    """A new token in place of the old ones, which stop working at once.

    What is kept for a repetition is a salt, from which only the token presented makes the new one. An agent
    that loses the answer to its own rotation has a void token left, and asks the organiser for another.
    """
    with context.database.writing() as connection:
        agent = _owned(connection, agent_id, command.caller)
        salt = once(connection, command, lambda: _rotated(connection, agent_id, command)).body.decode()
    return Answer.of(200, AgentToken(agent=_view(agent), token=derived_token(command.caller.token, salt)))


def renewed_token(connection: Connection, agent_id: str, now: int) -> str:
    """A new token for an agent; all others of its are void."""
    token = new_token()
    _revoke(connection, agent_id, now)
    _issue(connection, agent_id, token, now)
    return token


def _rotated(connection: Connection, agent_id: str, command: Command) -> Answer:
    salt = secrets.token_hex(32)
    _revoke(connection, agent_id, command.arrived)
    _issue(connection, agent_id, derived_token(command.caller.token, salt), command.arrived)
    return Answer(200, salt.encode())


def revoke(context: Context, agent_id: str, caller: Caller) -> None:
    """Void the agent's tokens; only the organiser can give it another."""
    with context.database.writing() as connection:
        _owned(connection, agent_id, caller)
        _revoke(connection, agent_id, context.time.now())


def _owned(connection: Connection, agent_id: str, caller: Caller) -> Row[Any]:
    agent = _agent(connection, agent_id)
    caller.require_self(agent_id)
    return agent


def _agent(connection: Connection, agent_id: str) -> Row[Any]:
    row = connection.execute(select(agents).where(agents.c.id == agent_id)).one_or_none()
    if row is None:
        raise NotFound(f"there is no agent {agent_id}")
    return row


def _issue(connection: Connection, agent_id: str, token: str, now: int) -> None:
    connection.execute(insert(tokens).values(digest=digest(token), agent_id=agent_id, created_at=now))


def _revoke(connection: Connection, agent_id: str, now: int) -> None:
    valid = (tokens.c.agent_id == agent_id) & (tokens.c.revoked_at.is_(None))
    connection.execute(update(tokens).where(valid).values(revoked_at=now))


def _view(row: Row[Any]) -> AgentView:
    return AgentView(id=row.id, name=row.name, house=row.house, created_at=date_time(row.created_at))
