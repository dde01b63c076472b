"""The view: what a player may know when it is their turn, and what a spectator may know at any time."""

from collections.abc import Callable, Sequence
from typing import Any, Self

from physics.state import TableState
from protocol.allowed import Allowed, Area
from protocol.game_terms import GameTerms
from protocol.late_fields import LATE, LateFields
from protocol.memory import IN_MEMORY, MAKER, STATE, TABLE, fields_of, made
from protocol.outcomes import OutcomeView
from protocol.strokes import StrokeView
from protocol.terms import ClockView
from protocol.values import Balls, Integer, Number, ObjectBall, Seat, trusted
from referee.game import Game, Group, Outcome, Phase


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
        values = {name: value for name, value in fields_of(terms).items() if name not in (STATE, TABLE)}
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
            TABLE: (terms.table, table),
            MAKER: LateFields(terms, game, table, strokes_since),
        }
        return trusted(cls, **values)

    def __getattr__(self, name: str) -> Any:
        """A field that nobody has read yet."""
        values = fields_of(self)
        late = values.get(MAKER)
        if late is None or name not in LATE:
            return super().__getattr__(name)  # type: ignore[misc]  # it has the words
        value = values[name] = getattr(late, name)()
        return value

    @property
    def __dict__(self) -> dict[str, Any]:
        """Every field: whoever looks here copies, compares or serialises the view, by pydantic's code or another's."""
        values = fields_of(self)
        if MAKER in values:
            whole = {name: getattr(self, name) for name in type(self).model_fields} | {TABLE: values[TABLE]}
            values.clear()
            values |= whole
        return values

    @__dict__.setter
    def __dict__(self, values: dict[str, Any]) -> None:
        """For those who make a view."""
        IN_MEMORY.__set__(self, values)

    @property
    def state(self) -> TableState:
        """The balls on the table, as the physics takes them."""
        late = fields_of(self).get(MAKER)
        return made(self, STATE, self.balls, TableState.from_positions) if late is None else late.game.state

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
