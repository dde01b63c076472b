"""The view: what a player may know when it is their turn, and what a spectator may know at any time."""

from collections.abc import Callable, Sequence
from typing import Annotated, Any, Final, NamedTuple, Self, TypeVar

from pydantic import BaseModel, Field

from physics.state import TableState
from physics.table import Table
from protocol.outcomes import OutcomeView
from protocol.strokes import StrokeView
from protocol.tables import contact_distance
from protocol.terms import BudgetView, ClockView, NoiseView
from protocol.values import (
    Balls,
    Digest,
    Flag,
    Identifier,
    Integer,
    Message,
    Number,
    ObjectBall,
    PocketNumber,
    RulesName,
    Seat,
    TableValues,
    trusted,
)
from referee.game import CueBallArea, Decision, Game, Group, Legal, Outcome, Phase, legal

_STATE, _TABLE, _LATE = "_state", "_table", "_late"
"""Where a view keeps, beside its fields, what was made of its balls and its table, and what makes fields that nobody
has read yet; models leave such names alone."""
_IN_MEMORY = BaseModel.__dict__["__dict__"]

Source = TypeVar("Source")
Made = TypeVar("Made")


def fields_of(message: BaseModel) -> dict[str, Any]:
    """The fields that a message has in memory; of a view, without those that nobody has read yet."""
    values: dict[str, Any] = _IN_MEMORY.__get__(message)
    return values


def _made(message: Message, name: str, source: Source, make: Callable[[Source], Made]) -> Made:
    """What ``make`` makes of a field, made once: views are asked for it again and again."""
    values = fields_of(message)
    kept = values.get(name)
    if kept is None or kept[0] is not source:  # a copy of the message may have another field
        kept = values[name] = source, make(source)
    made: Made = kept[1]
    return made


class Allowed(Message):
    """What the player whose turn it is may do.

    Attributes:
        actions: of ``shot``, ``decision``, ``concede``; empty when the game is over.
        call_required: a stroke must call a ball and a pocket, or a safety; on the break it must not.
        callable: the balls that may be called. pockets: likewise.
        safety: whether a safety may be called.
        cue_ball: where a cue ball in hand may be placed; null when it is not in hand.
        must_place: the stroke must say where, because the cue ball is not on the table.
        decisions: the choices open, when ``decision`` is among the actions.
    """

    actions: tuple[str, ...]
    call_required: Flag
    callable: tuple[ObjectBall, ...]
    pockets: tuple[PocketNumber, ...]
    safety: Flag
    cue_ball: CueBallArea | None
    must_place: Flag
    decisions: tuple[Decision, ...]

    @classmethod
    def of(cls, allowed: Legal) -> Self:
        """The wire's form of what the referee allows."""
        return trusted(
            cls,
            actions=allowed.actions,
            call_required=allowed.call_required,
            callable=allowed.callable,
            pockets=allowed.pockets,
            safety=allowed.safety,
            cue_ball=allowed.cue_ball,
            must_place=allowed.must_place,
            decisions=allowed.decisions,
        )


class Area(Message):
    """Where the cue ball may be placed: a rectangle for its centre, less the pocket mouths and other balls.

    On a table with jaws the cloth in the mouths belongs to it as well: a ball in the jaws is on the table.

    Attributes:
        name: ``kitchen`` (strictly behind the head string) or ``anywhere``.
        x, y: m, least and greatest; in the kitchen the least y itself, the head string, is not allowed.
    """

    name: CueBallArea
    x: tuple[Number, Number]
    y: tuple[Number, Number]

    @classmethod
    def of(cls, area: CueBallArea, table: Table) -> Self:
        """The rectangle of this area on this table."""
        near = contact_distance(table)
        least_y = table.head_string if area is CueBallArea.KITCHEN else near
        return trusted(cls, name=area, x=(near, table.width - near), y=(least_y, table.length - near))


class GameTerms(Message):
    """What stays the same throughout a game.

    Attributes:
        game, match: ids. number: of this game in its match, from 0; games: how many the match has.
        players: names, by seat.
        table: every parameter of the table.
        noise: its level is null when the players are not told.
        budget: of simulated shots; null when any number may be simulated.
        dry_visits_limit: after so many visits without a ball pocketed the rack is replayed (R49).
        replays_limit: after so many replays the next stalemate draws the game.
        strokes_limit: after so many strokes the game is drawn.
        commitment: to the secrets of the match and its terms (docs/protocol.md, Commitment).
    """

    game: Identifier
    match: Identifier
    number: Integer
    games: Integer
    players: tuple[str, str]
    rules: RulesName
    table: TableValues
    noise: NoiseView
    budget: BudgetView | None = None
    dry_visits_limit: Integer
    replays_limit: Integer
    strokes_limit: Integer
    commitment: Annotated[Digest, Field(examples=["0" * 64])]

    def table_model(self) -> Table:
        """The table, as the physics takes it."""
        return _made(self, _TABLE, self.table, Table.from_dict)


class View(GameTerms):
    """A game as one player, or a spectator, sees it.

    Attributes:
        version: sent back in ``If-Match`` with an action; it grows with everything that happens.
        seat: the reader's own; null for a spectator.
        turn: whose it is; null when the game is over. why: a sentence.
        phase: ``break``, ``play``, ``decision`` or ``over``.
        breaker: the seat that broke first in this game.
        stroke: the index of the next stroke; decisions do not count.
        rack: the index of the present rack.
        allowed: what the player in turn may do.
        callable_balls: the balls that may be called on this stroke.
        cue_ball_area: where the cue ball may be placed; null when it is not in hand.
        balls: on the table, m; a pocketed cue ball is absent until it is placed.
        groups: by seat; null while the table is open.
        choice: id of the rule that grants the decisions now open.
        visit_strokes: strokes the player in turn has played since coming to the table.
        dry_visits: consecutive visits without a ball pocketed: the stalemate counter.
        replays: racks replayed because of a stalemate.
        clocks: by seat.
        score: games won by seat, half a point for a draw.
        strokes_since: the reader's own last stroke and what followed; for a spectator the last stroke.
    """

    version: Integer
    seat: Seat | None
    turn: Seat | None
    why: str
    phase: Phase
    breaker: Seat
    stroke: Integer
    rack: Integer
    allowed: Allowed
    callable_balls: tuple[ObjectBall, ...]
    cue_ball_area: Area | None
    balls: Balls
    groups: tuple[Group, Group] | None
    choice: str | None
    visit_strokes: Integer
    dry_visits: Integer
    replays: Integer
    clocks: tuple[ClockView, ClockView]
    score: tuple[Number, Number]
    strokes_since: tuple[StrokeView, ...]
    outcome: OutcomeView | None

    @classmethod
    def of(
        cls,
        terms: GameTerms,
        game: Game,
        *,
        seat: int | None,
        version: int,
        clocks: tuple[ClockView, ClockView],
        score: tuple[float, float],
        strokes_since: Sequence[StrokeView] | Callable[[], Sequence[StrokeView]] = (),
    ) -> Self:
        """The view of ``game`` from ``seat`` (None: a spectator's).

        Args:
            terms: what stays the same throughout the game.
            game: the referee's state.
            seat: the reader's.
            version: of the game, for ``If-Match``.
            clocks: by seat.
            score: of the match, by seat.
            strokes_since: see the class, or what makes them when somebody reads; the last of them, if any, says why
                it is whose turn.
        """
        table = terms.table_model()
        values = {name: value for name, value in fields_of(terms).items() if name not in (_STATE, _TABLE)}
        values |= {
            "version": version,
            "seat": seat,
            "turn": None if game.phase is Phase.OVER else game.turn,
            "phase": game.phase,
            "breaker": game.breaker,
            "stroke": game.stroke,
            "rack": game.rack,
            "groups": game.groups,
            "choice": game.choice,
            "visit_strokes": game.visit_strokes,
            "dry_visits": game.dry_visits,
            "replays": game.replays,
            "clocks": clocks,
            "score": score,
            _TABLE: (terms.table, table),
            _LATE: _Late(terms, game, table, strokes_since),
        }
        return trusted(cls, **values)

    def __getattr__(self, name: str) -> Any:
        """A field that nobody has read yet."""
        values = fields_of(self)
        late = values.get(_LATE)
        if late is None or name not in LATE:
            return super().__getattr__(name)  # type: ignore[misc]  # it has the words
        value = values[name] = getattr(late, name)()
        return value

    @property
    def __dict__(self) -> dict[str, Any]:
        """Every field: whoever looks here copies, compares or serialises the view, by pydantic's code or another's."""
        values = fields_of(self)
        if _LATE in values:
            whole = {name: getattr(self, name) for name in type(self).model_fields} | {_TABLE: values[_TABLE]}
            values.clear()
            values |= whole
        return values

    @__dict__.setter
    def __dict__(self, values: dict[str, Any]) -> None:
        """For those who make a view."""
        _IN_MEMORY.__set__(self, values)

    @property
    def state(self) -> TableState:
        """The balls on the table, as the physics takes them."""
        late = fields_of(self).get(_LATE)
        return _made(self, _STATE, self.balls, TableState.from_positions) if late is None else late.game.state

    @property
    def my_turn(self) -> bool:
        """Whether the reader is to act."""
        return self.seat is not None and self.turn == self.seat

    def to_game(self) -> Game:
        """The referee's own state, for agents that look ahead with ``EightBall``."""
        outcome = self.outcome
        return Game(
            state=self.state,
            phase=self.phase,
            turn=self.breaker if self.turn is None else self.turn,
            breaker=self.breaker,
            groups=self.groups,
            cue_ball_in_hand=None if self.cue_ball_area is None else self.cue_ball_area.name,
            decisions=self.allowed.decisions,
            choice=self.choice,
            stroke=self.stroke,
            rack=self.rack,
            visit_strokes=self.visit_strokes,
            dry_visits=self.dry_visits,
            replays=self.replays,
            outcome=None if outcome is None else Outcome(outcome.winner, outcome.reason, outcome.rule),
        )


class _Late(NamedTuple):
    """What makes the fields of a view that cost more than a name: a method for each of `LATE`.

    Attributes:
        terms, game, table: that the view is of. strokes: see `View.of`.
    """

    terms: GameTerms
    game: Game
    table: Table
    strokes: Sequence[StrokeView] | Callable[[], Sequence[StrokeView]]

    def why(self) -> str:
        """Say in a sentence why it is whose turn."""
        if strokes := self.strokes_since():
            return strokes[-1].ruling.words
        game = self.game
        return f"{self.terms.players[game.turn]} {'breaks' if game.phase is Phase.BREAK else 'is to act'}"

    def allowed(self) -> Allowed:
        return Allowed.of(legal(self.game))

    def callable_balls(self) -> tuple[int, ...]:
        return legal(self.game).callable

    def cue_ball_area(self) -> Area | None:
        area = self.game.cue_ball_in_hand
        return None if area is None else Area.of(area, self.table)

    def balls(self) -> dict[int, tuple[float, float]]:
        return self.game.state.by_ball()

    def strokes_since(self) -> tuple[StrokeView, ...]:
        return tuple(self.strokes() if callable(self.strokes) else self.strokes)

    def outcome(self) -> OutcomeView | None:
        outcome = self.game.outcome
        return None if outcome is None else OutcomeView.of(outcome)


LATE: Final = frozenset(("why", "allowed", "callable_balls", "cue_ball_area", "balls", "strokes_since", "outcome"))
"""Fields of a view that are made when somebody reads them."""
