"""A player's action, from the complete request to the stored answer: exactly once, whatever happens.

The shot is simulated between two transactions; the second stores all of it or nothing. Noise depends on the
game's seed and the stroke's index alone, so that a shot simulated twice is the same shot.
"""

import logging
from collections.abc import Callable
from dataclasses import dataclass

from sqlalchemy import Connection, insert, select

from physics import PhysicsError
from referee import Action, Decision, Refusal
from referee.play import Refused, Stroke, play_stroke
from referee.play.clock import SECOND_NS
from referee.record import Chain, stroke_entry
from referee.wire import DecisionRequest, Fault, ShotRequest, StrokeAnswer, StrokeDetail, shown
from server import errors
from server.security.callers import Caller
from server.services import games, simulations
from server.services.commands import Answer, Command, keep, parse, recall
from server.services.context import Context, Writing
from server.services.live import LiveGame, find, hold_seen
from server.store.tables import games as game_rows
from server.store.tables import moves

log = logging.getLogger("pooliad.server.strokes")


def shoot(context: Context, game_id: str, command: Command) -> Answer:
    """Play a stroke."""
    return _act(context, game_id, command, lambda: _Asked.of(parse(command, ShotRequest)))


def decide(context: Context, game_id: str, command: Command) -> Answer:
    """Make one of the choices that a break leaves."""
    return _act(context, game_id, command, lambda: _Asked.of(parse(command, DecisionRequest)))


def concede(context: Context, game_id: str, command: Command) -> Answer:
    """Give the game up, in turn. The body is not looked at."""
    return _act(context, game_id, command, lambda: _Asked(Action(decision=Decision.CONCEDE)))


@dataclass(frozen=True, slots=True)
class _Asked:
    """What a request asks for, and the shots its player declares to have simulated for it."""

    action: Action
    simulated: int = 0

    @classmethod
    def of(cls, request: ShotRequest | DecisionRequest) -> "_Asked":
        return cls(request.to_action(), request.simulated)


def _act(context: Context, game_id: str, command: Command, read: Callable[[], _Asked]) -> Answer:
    context.pulse.require(context.time.now())
    with context.database.reading() as connection:
        _limit_others(context, connection, game_id, command.caller)
        live = find(connection, game_id)
        seat = live.seat_of(command.caller)
        if stored := recall(connection, command):
            return stored
        _require_turn(connection, live, seat, command)
    context.failpoint("shot-admitted")
    asked, stroke = _played(live, read)
    context.failpoint("shot-simulated")
    with context.writing() as writing:
        live = hold_seen(writing.connection, live)
        if stored := recall(writing.connection, command):
            return stored
        _require_turn(writing.connection, live, seat, command)
        simulations.require_left(live, seat, asked.simulated)
        end = games.TurnEnd(live.charge_of_action(command.arrived), games.next_move(live), asked.simulated)
        answer = _stored(writing, live, stroke, end)
        keep(writing.connection, command, answer)
        context.failpoint("shot-kept")
    context.failpoint("shot-committed")
    _account(context, live, command, end, stroke)
    context.wakeups.notify(live.agents)
    context.failpoint("shot-woken")
    return answer


def _account(context: Context, live: LiveGame, command: Command, end: games.TurnEnd, stroke: Stroke) -> None:
    """Count and log a stroke that was stored; its id is the game's with the number of the move."""
    context.metrics.strokes.inc()
    context.metrics.stroke_seconds.observe(max(0, context.time.now() - command.arrived) / SECOND_NS)
    fields = {"game": live.id, "shot": f"{live.id}/{end.move}", "seat": stroke.seat, "rules": stroke.ruling.rules}
    log.info("stroke", extra={"fields": fields})


def _limit_others(context: Context, connection: Connection, game_id: str, caller: Caller) -> None:
    """Count the request unless it is its sender's turn: on the own turn the clock decides, not a 429."""
    if connection.scalar(select(game_rows.c.mover).where(game_rows.c.id == game_id)) != caller.id:
        context.limits.count(caller)


def _require_turn(connection: Connection, live: LiveGame, seat: int, command: Command) -> None:
    """The checks between repetition and content, in the contract's order: 428, 409, 412, 409."""
    version = _version(command)
    if not live.is_running:
        raise errors.GameFinished(f"game {live.id} is {live.row.status}")
    if version != live.row.version:
        raise errors.StaleVersion(
            f"the game is at version {live.row.version}, not {version}",
            field="If-Match",
            value=command.if_match,
            allowed=f'"{live.row.version}"',
            view=live.view(connection, seat, command.arrived),
        )
    if live.game.turn != seat:
        raise errors.NotYourTurn(f"it is the turn of seat {live.game.turn}, {live.players[live.game.turn]}")
    if live.is_out_of_time(command.arrived):
        raise errors.OutOfTime("your time had run out when the request was complete")


def _version(command: Command) -> int:
    """The version in If-Match: digits, in quotes or not."""
    text = command.if_match
    if text is None:
        raise errors.VersionRequired(
            "the request does not say which view it answers",
            field="If-Match",
            allowed='the view\'s version, as "7"',
        )
    digits = text.strip().removeprefix('"').removesuffix('"')
    if not (digits.isascii() and digits.isdecimal() and len(digits) <= 15):
        raise errors.BadHeader(
            "If-Match holds no version",
            field="If-Match",
            value=shown(text),
            allowed='the view\'s version, as "7"',
        )
    return int(digits)


def _played(live: LiveGame, read: Callable[[], _Asked]) -> tuple[_Asked, Stroke]:
    try:
        asked = read()
        return asked, play_stroke(live.rules, live.game, asked.action, live.seeds, live.noise)
    except Refused as refused:
        raise errors.Refused([_fault(refusal) for refusal in refused.refusals]) from refused
    except PhysicsError as error:
        raise errors.invalid_physics(error) from error


def _fault(refusal: Refusal) -> Fault:
    return Fault(
        code="refused",
        field=refusal.field,
        value=shown(refusal.value),
        allowed=refusal.allowed,
        detail=refusal.words,
        rule=refusal.rule,
    )


def _stored(writing: Writing, live: LiveGame, stroke: Stroke, end: games.TurnEnd) -> Answer:
    """Write the move, the game that follows and its clocks; the answer to them."""
    number = games.next_move(live)
    detail, chain = StrokeDetail.of(stroke, number), Chain(live.row.head)
    move = {
        "game_id": live.id,
        "number": number,
        "seat": stroke.seat,
        "stroke": detail.model_dump(mode="json", exclude={"events"}),
        "line": chain.add(stroke_entry(stroke, number, end.charge.charged_ns)),
    }
    writing.connection.execute(insert(moves), move | {"created_at": writing.now})
    writing.context.failpoint("shot-moved")
    live = games.advance(writing, live, stroke.game, end, chain)
    writing.context.failpoint("shot-advanced")
    view = live.view(writing.connection, stroke.seat, writing.now)
    message = StrokeAnswer(game=live.id, stroke=detail, view=view, clocks=view.clocks)
    return Answer.of(200, message, etag=f'"{live.row.version}"')
