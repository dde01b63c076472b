"""Matches: made by the organiser or by challenge and acceptance, played game after game, aborted."""

import secrets
from typing import Any, Final, get_args

from sqlalchemy import Connection, Row, insert, or_, select, update

from physics import PhysicsError, Table
from referee import EightBall, InvalidGame
from referee.play import nanoseconds
from referee.wire import MatchList, MatchRequest, MatchStatus, MatchView
from server.errors import Forbidden, NotFound, WrongStatus, invalid_field, invalid_physics
from server.security.callers import Caller
from server.services import games, house, match_views
from server.services.commands import Answer, Command, once, parse
from server.services.context import Context, Writing
from server.store.locks import hold_match
from server.store.tables import agents, matches

STATUSES: Final[tuple[str, ...]] = get_args(MatchStatus)


def create(context: Context, command: Command) -> Answer:
    """A match by the organiser, which starts at once, or a challenge by one of the two agents."""
    with context.writing() as writing:
        answer = once(writing.connection, command, lambda: _created(writing, command))
    _announce(context, answer)
    return answer


def accept(context: Context, match_id: str, command: Command) -> Answer:
    """The challenged agent (or the organiser) accepts, and the first game begins."""
    with context.writing() as writing:
        match = hold(writing.connection, match_id)
        _require_challenged(match, command.caller)
        answer = once(writing.connection, command, lambda: _accepted(writing, match))
    context.wakeups.notify((match.seat_0, match.seat_1))
    return answer


def abort(context: Context, match_id: str, command: Command) -> Answer:
    """Call a match off: the organiser at any time, a player only while it is a challenge."""
    with context.writing() as writing:
        match = hold(writing.connection, match_id)
        _require_may_abort(match, command.caller)
        answer = once(writing.connection, command, lambda: _aborted(writing, match))
    context.wakeups.notify((match.seat_0, match.seat_1))
    return answer


def one(context: Context, match_id: str) -> MatchView:
    """A match with its games; raises `NotFound`."""
    with context.database.reading() as connection:
        return match_views.view(connection, _find(connection, match_id))


def listing(context: Context, agent_id: str | None, status: str | None, cursor: int, limit: int) -> MatchList:
    """Matches, the newest first, of one agent or of one status when asked for; raises `Invalid`."""
    query = select(matches).order_by(matches.c.created_at.desc(), matches.c.id)
    if agent_id is not None:
        query = query.where(or_(matches.c.seat_0 == agent_id, matches.c.seat_1 == agent_id))
    if status is not None:
        if status not in STATUSES:
            raise invalid_field("status", status, f"one of {', '.join(STATUSES)}")
        query = query.where(matches.c.status == status)
    with context.database.reading() as connection:
        rows = connection.execute(query.offset(cursor).limit(limit + 1)).all()
        views = tuple(match_views.view(connection, row) for row in rows[:limit])
    return MatchList(matches=views, next_cursor=str(cursor + limit) if len(rows) > limit else None)


def _created(writing: Writing, command: Command) -> Answer:
    request = parse(command, MatchRequest)
    _require_right(request, command.caller)
    _require_agents(writing.connection, request)
    _require_start(request)
    house.require_terms(writing.connection, request, command.caller)
    match = _insert(writing, request, command.caller)
    if match.status == "running":
        games.begin(writing, match, 0)
    elif house.has_place(writing, match):
        match = start(writing, match)
    return Answer.of(201, match_views.view(writing.connection, match), location=f"/v1/matches/{match.id}")


def _require_right(request: MatchRequest, caller: Caller) -> None:
    if caller.is_organiser:
        return
    if caller.id not in request.agents:
        raise Forbidden("only the organiser makes matches of others; an agent challenges for itself")
    if request.seed is not None:
        raise invalid_field("seed", request.seed, "null: only the organiser may give a seed")


def _require_agents(connection: Connection, request: MatchRequest) -> None:
    if request.agents[0] == request.agents[1]:
        raise invalid_field("agents", list(request.agents), "two different agents")
    for seat, agent_id in enumerate(request.agents):
        if connection.execute(select(agents.c.id).where(agents.c.id == agent_id)).first() is None:
            raise invalid_field(f"agents.{seat}", agent_id, "the id of a registered agent")


def _require_start(request: MatchRequest) -> None:
    """What the match begins from has to be a position that can be played on from, on its table."""
    if request.start is None:
        return
    try:
        EightBall(Table.from_dict(request.table)).begin_from(request.start.to_game())
    except PhysicsError as error:
        raise invalid_physics(error, ("start",)) from error
    except InvalidGame as error:
        raise invalid_field(f"start.{error.field}", error.value, error.allowed) from error


def _insert(writing: Writing, request: MatchRequest, caller: Caller) -> Row[Any]:
    organised = caller.is_organiser
    row = {
        "id": f"match_{secrets.token_hex(8)}",
        "seat_0": request.agents[0],
        "seat_1": request.agents[1],
        "challenger": None if organised else caller.id,
        "status": "running" if organised else "challenged",
        "games": request.games,
        "rules": request.rules,
        "table": request.table,
        "noise_level": request.noise.level,
        "noise_told": request.noise.told,
        "allowance": nanoseconds(request.clock.seconds),
        "simulations": request.clock.simulations,
        "lag_turn": nanoseconds(writing.context.settings.lag_turn),
        "lag_game": nanoseconds(writing.context.settings.lag_game),
        "seed": request.seed or secrets.token_hex(32),
        "start": None if request.start is None else request.start.model_dump(mode="json"),
        "created_at": writing.now,
        "started_at": writing.now if organised else None,
    }
    writing.connection.execute(insert(matches).values(row))
    return _find(writing.connection, str(row["id"]))


def _accepted(writing: Writing, match: Row[Any]) -> Answer:
    if match.status != "challenged":
        raise WrongStatus(f"the match is {match.status}; only a challenge can be accepted")
    return Answer.of(200, match_views.view(writing.connection, start(writing, match)))


def start(writing: Writing, match: Row[Any]) -> Row[Any]:
    """Begin the first game of a challenge that is accepted; the match as it is now."""
    match = _update(writing.connection, match.id, status="running", started_at=writing.now)
    games.begin(writing, match, 0)
    return match


def _aborted(writing: Writing, match: Row[Any]) -> Answer:
    if match.status not in ("challenged", "running"):
        raise WrongStatus(f"the match is {match.status} already")
    was_running = match.status == "running"
    match = _update(writing.connection, match.id, status="aborted", ended_at=writing.now)
    if was_running:
        games.abort_running(writing, match)
    return Answer.of(200, match_views.view(writing.connection, match))


def _require_challenged(match: Row[Any], caller: Caller) -> None:
    if caller.is_organiser or (caller.id in (match.seat_0, match.seat_1) and caller.id != match.challenger):
        return
    raise Forbidden("only the challenged agent or the organiser accepts")


def _require_may_abort(match: Row[Any], caller: Caller) -> None:
    if caller.is_organiser:
        return
    if caller.id not in (match.seat_0, match.seat_1):
        raise Forbidden("only its players and the organiser may call a match off")
    if match.started_at is not None:
        raise Forbidden("a match that has begun is called off by the organiser alone; a player can concede a game")


def _find(connection: Connection, match_id: str) -> Row[Any]:
    row = connection.execute(select(matches).where(matches.c.id == match_id)).one_or_none()
    if row is None:
        raise NotFound(f"there is no match {match_id}")
    return row


def hold(connection: Connection, match_id: str) -> Row[Any]:
    """A match to be written by this transaction alone; raises `NotFound`."""
    hold_match(connection, match_id)
    return _find(connection, match_id)


def _update(connection: Connection, match_id: str, **values: object) -> Row[Any]:
    connection.execute(update(matches).where(matches.c.id == match_id).values(**values))
    return _find(connection, match_id)


def _announce(context: Context, answer: Answer) -> None:
    made = MatchView.model_validate_json(answer.body)
    context.wakeups.notify(made.agents)
