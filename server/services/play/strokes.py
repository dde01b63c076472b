"""A player's action, from the complete request to the stored answer: exactly once, whatever happens.

The shot is simulated between two transactions; the second stores all of it or nothing. Noise depends on the
game's seed and the stroke's index alone, so that a shot simulated twice is the same shot.
"""

import contextlib
import logging
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Final

from sqlalchemy import Connection, insert

from physics import PhysicsError, Result, Status
from protocol import (
    DecisionRequest,
    EventView,
    Fault,
    MinimalAnswer,
    ShotRequest,
    StrokeAnswer,
    StrokeDetail,
    StrokeView,
    View,
    shown,
)
from referee import Action, Decision, Refusal
from referee.play import Refused, Stroke, play_stroke
from referee.play.clock import SECOND_NS
from referee.record import Chain, canonical, stroke_entry
from server import errors
from server.http.commands import Answer, Command, keep, parse, recall
from server.http.preferences import APPLIED, MINIMAL
from server.security.callers import Caller
from server.services.play import budget, games, stored_strokes
from server.services.play.live_game import LiveGame
from server.services.play.long_strokes import MOST_EVENTS, IsLong
from server.services.runtime.context import Context, Writing
from server.services.runtime.steps import Done, Steps
from server.store.locks import hold_match_of
from server.store.prepared import Prepared
from server.store.tables import moves

log = logging.getLogger("pooliad.server.strokes")


Move = Callable[[Connection], Command]
"""A move as it came in: a command once its sender has been looked up, which may raise `Unauthorized`."""


def shoot(context: Context, game_id: str, move: Move) -> Answer:
    """Play a stroke, of however many events."""
    return _act(context, game_id, move, _shot, may_be_long=True)


def decide(context: Context, game_id: str, move: Move) -> Answer:
    """Make one of the choices that a break leaves."""
    return _act(context, game_id, move, lambda command: _Asked.of(parse(command, DecisionRequest)))


def concede(context: Context, game_id: str, move: Move) -> Answer:
    """Give the game up, in turn. The body is not looked at."""
    return _act(context, game_id, move, lambda command: _Asked(Action(decision=Decision.CONCEDE)))


@dataclass(frozen=True, slots=True)
class _Asked:
    """What a request asks for, and the shots its player declares to have simulated for it."""

    action: Action
    simulated: int = 0

    @classmethod
    def of(cls, request: ShotRequest | DecisionRequest) -> "_Asked":
        return cls(request.to_action(), request.simulated)


def _act(
    context: Context, game_id: str, move: Move, read: Callable[[Command], _Asked], may_be_long: bool = False
) -> Answer:
    """Again from the beginning as long as somebody else changes the game meanwhile: they got on with it."""
    context.pulse.require(context.time.now())
    while True:
        with contextlib.suppress(games.MoveConflict):
            return Attempt(context, game_id, move, read, may_be_long).carried_out()


class Attempt(Steps[Answer, tuple[LiveGame, Answer]]):
    """A move from the complete request to the stored answer.

    Args:
        context: the server's parts.
        game_id: the game that it is for.
        move: as it came in.
        read: what it asks for.
        may_be_long: whether a stroke may have very many events.
    """

    def __init__(
        self, context: Context, game_id: str, move: Move, read: Callable[[Command], _Asked], may_be_long: bool = False
    ) -> None:
        super().__init__(context)
        self._game_id: Final = game_id
        self._move: Final = move
        self._read: Final = read
        self._may_be_long: Final = may_be_long

    def looked(self, connection: Connection) -> Done[Answer] | None:
        """The answer, if the move was made before; else it is found to be its sender's turn."""
        self._command = command = self._move(connection)
        self._live = live = _found(self.context, connection, self._game_id, command.caller)
        self._seat = live.seat_of(command.caller)
        if stored := recall(connection, command):
            return Done(stored)
        _require_turn(connection, live, self._seat, command)
        return None

    def prepare(self) -> None:
        """Read the request, play the stroke and put it in words; raises `IsLong` for one of very many events."""
        self.context.failpoint("shot-admitted")
        live = self._live
        with _told_why():
            asked = self._read(self._command)
            _require_range(live, asked.action)
            budget.require_left(live, self._seat, asked.simulated)  # before any noise is drawn
            self._stroke = _played(live, asked.action, self._may_be_long)
        self._simulated = asked.simulated
        self._end = games.TurnEnd(live.clock.charge_of_action(self._command.arrived), games.next_move(live))
        self._told = _Told.of(live, self._stroke, self._end, whole=not self._command.minimal)
        self.context.failpoint("shot-simulated")

    @property
    def goes_alone(self) -> bool:
        """The end of a game is also counted, logged and gone on from."""
        return self._stroke.game.is_over

    def store(self, writing: Writing) -> tuple[LiveGame, Answer]:
        """All of it, with the answer; raises `MoveConflict` when the game is not any more as it was looked at."""
        hold_match_of(writing.connection, self._game_id)
        then = budget.declare(writing.connection, self._live, self._seat, self._simulated)
        after, view = _stored(writing, then, self._stroke, self._end, self._told)
        answer = _minimal(after, view) if self._command.minimal else _answer(after, self._told, view)
        keep(writing.connection, self._command, answer)
        self.context.failpoint("shot-kept")
        return after, answer

    def finished(self, stored: tuple[LiveGame, Answer]) -> Answer:
        """The answer of a move that is committed, told to those who wait for it."""
        after, answer = stored
        self.context.failpoint("shot-committed")
        self.context.seen.keep(after)
        _account(self.context, self._live, self._command, self._end, self._stroke)
        self.context.wakeups.notify(self._live.agents)
        self.context.failpoint("shot-woken")
        return answer


def attempt_of(context: Context, game_id: str, move: Move) -> Attempt:
    """A stroke that may not have very many events: `IsLong` is raised for one that has."""
    context.pulse.require(context.time.now())
    return Attempt(context, game_id, move, _shot)


def _shot(command: Command) -> _Asked:
    return _Asked.of(parse(command, ShotRequest))


def _played(live: LiveGame, action: Action, may_be_long: bool) -> Stroke:
    """The stroke, as the rules' limits have it; raises `IsLong`, having gone no further than an ordinary one would."""
    fixture = live.fixture
    if may_be_long or fixture.ordinary_rules is fixture.rules:
        return play_stroke(fixture.rules, live.game, action, live.seeds, fixture.noise)
    stroke = play_stroke(fixture.ordinary_rules, live.game, action, live.seeds, fixture.noise)
    if stroke.result is not None and stroke.result.status is Status.EVENT_LIMIT:
        raise IsLong
    return stroke


def _require_range(live: LiveGame, action: Action) -> None:
    """Raise `Invalid` for a shot beyond what the match's table allows."""
    if action.shot is None:
        return
    try:
        action.shot.refuse_beyond(live.rules.table)
    except PhysicsError as beyond:
        raise errors.invalid_physics(beyond, ("shot",)) from beyond


def _found(context: Context, connection: Connection, game_id: str, caller: Caller) -> LiveGame:
    """The game; a request about any but the sender's own turn is counted: on that the clock decides, not a 429."""
    try:
        live = context.seen.find(connection, game_id)
    except errors.NotFound:
        context.limits.count(caller)
        raise
    if live.row.mover != caller.id:
        context.limits.count(caller)
    return live


def _account(context: Context, live: LiveGame, command: Command, end: games.TurnEnd, stroke: Stroke) -> None:
    """Count and log a stroke that was stored; its id is the game's with the number of the move."""
    context.metrics.strokes.inc()
    context.metrics.stroke_seconds.observe(max(0, context.time.now() - command.arrived) / SECOND_NS)
    fields = {"game": live.id, "shot": f"{live.id}/{end.move}", "seat": stroke.seat, "rules": stroke.ruling.rules}
    log.info("stroke", extra={"fields": fields})


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
        raise errors.NotYourTurn(f"it is the turn of seat {live.game.turn}, {live.fixture.players[live.game.turn]}")
    if live.clock.is_too_late(command.arrived):
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


@contextlib.contextmanager
def _told_why() -> Iterator[None]:
    """What the referee and the physics refuse, as answers."""
    try:
        yield
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


@dataclass(frozen=True, slots=True)
class _Told:
    """A stroke in words: all of it that does not depend on when it is stored, put together while others may write.

    Attributes:
        seen: as views show it. text: a `StrokeDetail` in JSON; empty where nobody will read it. row: of `moves`.
        chain: of the record, the stroke's line the last.
    """

    seen: StrokeView
    text: str
    row: dict[str, Any]
    chain: Chain

    @classmethod
    def of(cls, live: LiveGame, stroke: Stroke, end: games.TurnEnd, *, whole: bool) -> "_Told":
        """`whole`: the answer will have all of it."""
        number, charged = games.next_move(live), end.charge.charged_ns
        chain, summary, text = Chain(live.row.head), None, ""
        if stroke.result is not None and stroke.result.n_events > stored_strokes.MOST_EVENTS:
            detail = StrokeDetail.of(stroke, number, events=False)
            told, recorded = _events(stroke.result)
            line = chain.add(stroke_entry(stroke, number, charged, events=False), {"events": recorded})
            summary = detail.model_dump(mode="json", exclude={"events"})
            text = detail.model_dump_json().removesuffix(_NO_EVENTS) + told
        else:
            line = chain.add(stroke_entry(stroke, number, charged))
            text = StrokeDetail.of(stroke, number).model_dump_json() if whole else ""
        row = {"game_id": live.id, "number": number, "seat": stroke.seat, **stored_strokes.columns(line, summary)}
        return cls(StrokeView.of(stroke, number), text, row, chain)


def _events(result: Result) -> tuple[str, str]:
    """Many events in words: the end of a `StrokeDetail`'s JSON, and the member of the record's line.

    One by one, and those of a long stroke with pauses: in between, other threads have the interpreter.
    """
    told, recorded = [], []
    rests = result.n_events > MOST_EVENTS
    began = time.thread_time()
    for number, event in enumerate(result.events):
        values = event.to_dict()
        told.append(EventView.model_validate(values).model_dump_json())
        recorded.append(canonical(values))
        if rests and number % EVENTS_AT_ONCE == 0:
            time.sleep(REST * (time.thread_time() - began))
            began = time.thread_time()
    return f'"events":[{",".join(told)}]}}', f"[{','.join(recorded)}]"


_NO_EVENTS: Final = '"events":[]}'
"""How the JSON of a `StrokeDetail` without events ends."""
EVENTS_AT_ONCE: Final = 10
"""A millisecond or two of the interpreter."""
REST: Final = 3.0
"""Times as long as a long stroke's events kept the interpreter, it is left to others."""


def _stored(writing: Writing, live: LiveGame, stroke: Stroke, end: games.TurnEnd, told: _Told) -> tuple[LiveGame, View]:
    """Write the move, the game that follows and its clocks: the game as it is then, and as the player sees it."""
    live = games.advance(writing, live, stroke.game, end, told.chain).with_stroke(told.seen)
    writing.context.failpoint("shot-advanced")
    _MOVE.run(writing.connection, told.row | {"created_at": writing.now})
    writing.context.failpoint("shot-moved")
    view = live.view_since((told.seen,), stroke.seat, writing.now)  # the player's last stroke is this one
    return live, view


def _answer(live: LiveGame, told: _Told, view: View) -> Answer:
    """A `StrokeAnswer` in JSON. Its events, which may be megabytes, were written before others had to wait."""
    rest = StrokeAnswer.model_construct(view=view, clocks=view.clocks).model_dump_json()
    body = f'{{"game":"{live.id}","stroke":{told.text},{rest.removeprefix("{")}'
    return Answer(200, body.encode(), {"etag": f'"{live.row.version}"'})


def _minimal(live: LiveGame, view: View) -> Answer:
    """A `MinimalAnswer` in JSON; sent again, the request gets the same, whatever it prefers then."""
    body = MinimalAnswer.model_construct(game=live.id, view=view).model_dump_json()
    return Answer(200, body.encode(), {"etag": f'"{live.row.version}"', APPLIED: MINIMAL})


_MOVE: Final = Prepared(insert(moves))
