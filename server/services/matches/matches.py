"""Matches: made by the organiser or by challenge and acceptance, played game after game, aborted."""

import logging
import secrets
from typing import Any

from sqlalchemy import Connection, Row, insert, select

from physics import PhysicsError, Table
from protocol import AcceptRequest, MatchRequest, MatchView
from referee import EightBall, InvalidGame
from referee.play import nanoseconds
from referee.record import this_engine
from server.errors import Forbidden, WrongStatus, invalid_field, invalid_physics
from server.http.commands import Answer, Command, once, parse
from server.security.callers import Caller, Scope
from server.services.accounts import house_bots
from server.services.matches import challenges, match_seeds, match_views
from server.services.matches.player_seeds import CHALLENGED, OPENING, add_seed, begin_or_wait, update_match
from server.services.play import agent_messages, games
from server.services.play.live_game import ABORTED, RUNNING, find_match, hold_match
from server.services.runtime.context import Context, Writing
from server.store.tables import agents, matches

log = logging.getLogger("pooliad.server.matches")


def create(context: Context, command: Command) -> Answer:
    """A match by the organiser, which starts at once, or a challenge by one of the two agents."""

    def make() -> Answer:
        with context.writing() as writing:
            return once(writing.connection, command, lambda: _created(writing, command))

    answer = context.kernels.awaited(make)
    _announce(context, answer)
    return answer


def accept(context: Context, match_id: str, command: Command) -> Answer:
    """The challenged agent (or the organiser) accepts, and the match opens."""
    with context.writing() as writing:
        match = hold_match(writing.connection, match_id)
        _require_challenged(match, command.caller)
        answer = once(writing.connection, command, lambda: _accepted(writing, match, command))
    context.wakeups.notify((match.seat_0, match.seat_1))
    return answer


def abort(context: Context, match_id: str, command: Command) -> Answer:
    """Call a match off: the organiser at any time, a player only while it is a challenge."""
    with context.writing() as writing:
        match = hold_match(writing.connection, match_id)
        _require_may_abort(match, command.caller)
        answer = once(writing.connection, command, lambda: _aborted(writing, match))
    context.wakeups.notify((match.seat_0, match.seat_1))
    return answer


def call_off(context: Context, match_id: str) -> None:
    """Call off a match that is still on, because what it was made for is over."""
    with context.writing() as writing:
        match = hold_match(writing.connection, match_id)
        if match.status in (OPENING, RUNNING):
            _abort(writing, match)
    context.wakeups.notify((match.seat_0, match.seat_1))


def one(context: Context, match_id: str) -> MatchView:
    """A match with its games; raises `NotFound`."""
    with context.database.reading() as connection:
        return match_views.view(connection, find_match(connection, match_id))


def abort_foreign(context: Context) -> None:
    """Call every match off that is committed to another engine: with this one its records would not be true."""
    unfinished = matches.c.status.in_((CHALLENGED, OPENING, RUNNING))
    foreign = select(matches.c.id).where(unfinished, matches.c.engine != this_engine().digest)
    with context.database.reading() as connection:
        found = connection.scalars(foreign).all()
    for match_id in found:
        with context.writing() as writing:
            match = hold_match(writing.connection, match_id)
            if match.status in (CHALLENGED, OPENING, RUNNING):
                log.warning("match %s is committed to another engine and is aborted", match_id)
                _abort(writing, match)


def _created(writing: Writing, command: Command) -> Answer:
    request = parse(command, MatchRequest)
    _require_right(request, command.caller)
    _require_agents(writing.connection, request)
    challenges.require_usual_table(request, command.caller)
    writing.context.kernels.require(Table.from_dict(request.table))
    _require_start(request)
    challenger = None if command.caller.is_organiser else command.caller.id
    house_bots.require_terms(writing, request, challenger)
    house_bots.require_no_other(writing, request, challenger)
    challenges.require_few(writing, request, challenger)
    match = insert_match(writing, request, challenger, foreseeable=request.seed is not None)
    if match.challenger is None or house_bots.has_place(writing, match):
        match = begin_or_wait(writing, match)
    return Answer.of(201, match_views.view(writing.connection, match), location=f"/v1/matches/{match.id}")


def _require_right(request: MatchRequest, caller: Caller) -> None:
    if caller.is_organiser:
        return
    if Scope.AGENT not in caller.scopes or caller.id not in request.agents:
        raise Forbidden("only the organiser makes matches of others; an agent challenges for itself")
    organisers = (("seed", request.seed), ("racks.seed", request.racks.seed), ("first_breaker", request.first_breaker))
    for field, value in organisers:
        if value is not None:
            raise invalid_field(field, value, "null: only the organiser may give it")


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


def insert_match(
    writing: Writing, request: MatchRequest, challenger: str | None, *, foreseeable: bool = False
) -> Row[Any]:
    """Store a match that an organiser made, or a challenge; nothing has begun.

    Whoever chose its seed knows its noise in advance: `foreseeable`, it counts for no rating.
    """
    match_id = f"match_{secrets.token_hex(8)}"
    row = {
        "id": match_id,
        "seat_0": request.agents[0],
        "seat_1": request.agents[1],
        "challenger": challenger,
        "status": OPENING if challenger is None else CHALLENGED,
        "games": request.games,
        "rules": request.rules,
        "table": request.table,
        "noise_level": request.noise.level,
        "noise_told": request.noise.told,
        "noise_sigmas": None if request.noise.sigmas is None else request.noise.sigmas.model_dump(),
        "allowance": nanoseconds(request.clock.seconds),
        "simulations": request.clock.simulations,
        "lag_turn": nanoseconds(writing.context.settings.lag_turn),
        "lag_game": nanoseconds(writing.context.settings.lag_game),
        "start": None if request.start is None else request.start.model_dump(mode="json"),
        "rated": _counts(request) and not foreseeable and not house_bots.is_challenged(writing, request, challenger),
        "foreseeable": foreseeable,
        "created_at": writing.now,
    }
    writing.connection.execute(insert(matches).values(row | match_seeds.columns(request, match_id)))
    return find_match(writing.connection, match_id)


def _counts(request: MatchRequest) -> bool:
    """Whether such a match is to count for ratings."""
    return request.rated and request.start is None


def _accepted(writing: Writing, match: Row[Any], command: Command) -> Answer:
    if match.status != CHALLENGED:
        raise WrongStatus(f"the match is {match.status}; only a challenge can be accepted")
    request = parse(command, AcceptRequest) if command.body else AcceptRequest()
    if request.client_seed is not None:
        if command.caller.is_organiser:
            raise invalid_field("client_seed", request.client_seed, "null: the organiser does not play")
        match = add_seed(writing, match, int(command.caller.id == match.seat_1), request.client_seed)
    match = begin_or_wait(writing, match)
    return Answer.of(200, match_views.view(writing.connection, match))


def _aborted(writing: Writing, match: Row[Any]) -> Answer:
    if match.status not in (CHALLENGED, OPENING, RUNNING):
        raise WrongStatus(f"the match is {match.status} already")
    return Answer.of(200, match_views.view(writing.connection, _abort(writing, match)))


def _abort(writing: Writing, match: Row[Any]) -> Row[Any]:
    """Call a match off; players who wait for it are told, those of a challenge are not."""
    before, ended = match.status, {"status": ABORTED, "opens_until": None, "ended_at": writing.now}
    match = update_match(writing.connection, match.id, **ended)
    if before != CHALLENGED:
        games.abort_running(writing, match)
        agent_messages.match_over(writing.connection, match, ABORTED)
        writing.context.match_over(writing, match.id)
    return match


def _require_challenged(match: Row[Any], caller: Caller) -> None:
    if caller.is_organiser or (caller.id in (match.seat_0, match.seat_1) and caller.id != match.challenger):
        return
    raise Forbidden("only the challenged agent or the organiser accepts")


def _require_may_abort(match: Row[Any], caller: Caller) -> None:
    if caller.is_organiser:
        return
    if caller.id not in (match.seat_0, match.seat_1):
        raise Forbidden("only its players and the organiser may call a match off")
    if match.status != CHALLENGED:
        raise Forbidden(
            "a match that is no challenge any more is called off by the organiser alone; a player can concede a game"
        )


def _announce(context: Context, answer: Answer) -> None:
    made = MatchView.model_validate_json(answer.body)
    context.wakeups.notify(made.agents)
