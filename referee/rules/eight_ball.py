"""8-ball as a pure state machine: no clock, no network, no randomness."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from physics.batch import Batch
from physics.facts import Facts
from physics.state import TableState
from physics.status import Status
from physics.table import Table
from referee.errors import InvalidAction, InvalidGame
from referee.game import (
    Action,
    CueBallArea,
    Decision,
    EndReason,
    Game,
    Legal,
    Outcome,
    Phase,
    Refusal,
    RuleId,
    Ruling,
    legal,
)
from referee.rules.checks import check_action, refuse_phase
from referee.rules.decisions import decide
from referee.rules.ending import FROM_OUTSIDE
from referee.rules.fouls import MISCUES, find_fouls
from referee.rules.judge import Judgement, judge, rules_cited
from referee.rules.position import begin_from
from referee.rules.rack import new_rack
from referee.rules.stalemate import Limits, over, stalemate, stroke_limit
from referee.rules.stroke_facts import read_stroke
from referee.rules.words import describe_decision, describe_next, describe_stroke


@dataclass(frozen=True, slots=True)
class EightBall:
    """World Standardized 8-ball on ``table``.

    Attributes:
        table: the table the game is played on.
        limits: when a game counts as stuck (R49), and when a stroke is ended.
    """

    table: Table
    limits: Limits = field(default_factory=Limits)

    def __post_init__(self) -> None:
        if not isinstance(self.table, Table):
            raise InvalidGame("table", self.table, "a physics.Table, such as Table.olympiad()")
        if not isinstance(self.limits, Limits):
            raise InvalidGame("limits", self.limits, "a referee.Limits")

    def new_game(self, rack_seed: int | bytes, breaker: int = 0) -> Game:
        """A racked table, ``breaker`` (seat 0 or 1) to break with ball in hand behind the head string."""
        if isinstance(breaker, bool) or breaker not in (0, 1):
            raise InvalidGame("breaker", breaker, "seat 0 or 1")
        return _racked(Game(new_rack(self.table, rack_seed), Phase.BREAK, breaker, breaker))

    def begin_from(self, game: Game) -> Game:
        """A new game that stands as `game` does: every counter at zero, the decisions those of its choice.

        Raises:
            InvalidGame: nothing that could be played on from, naming the field.
        """
        return begin_from(self.table, game)

    def rerack(self, game: Game, rack_seed: int | bytes) -> Game:
        """The game with a new rack, after a ruling with ``rerack``; ``game.turn`` breaks.

        Raises:
            InvalidGame: the game does not await a rack.
        """
        if game.phase is not Phase.RERACK:
            raise InvalidGame("phase", game.phase.value, "a game that awaits a rack (rerack)")
        return replace(_racked(game), state=new_rack(self.table, rack_seed), rack=game.rack + 1)

    def legal(self, game: Game) -> Legal:
        """What is allowed now: kinds of action, callable balls, safety, cue-ball area, decisions."""
        return legal(game)

    def check(self, game: Game, action: Action) -> tuple[Refusal, ...]:
        """All reasons why ``action`` cannot be accepted; empty when it may be played.

        Raises:
            InvalidAction: not an ``Action`` at all. InvalidGame: not a ``Game``.
        """
        _require_values(game, action)
        return check_action(self.table, game, action)

    def apply(self, game: Game, action: Action, facts: Facts | None = None, final: TableState | None = None) -> Ruling:
        """Rule on an action that ``check`` accepts.

        Args:
            game: the game before it.
            action: the intended stroke (what noise made of it shows in ``facts``), or a decision.
            facts, final: what the stroke did and where the balls came to rest; None for a decision.

        Raises:
            InvalidAction: a kind of action the game does not await, or facts that do not go with it.
        """
        _require_values(game, action)
        for refusal in refuse_phase(game, action):
            raise InvalidAction(refusal.field, refusal.value, refusal.allowed)
        if action.decision is not None:
            return self._decide(game, action.decision)
        if not isinstance(facts, Facts):
            raise InvalidAction("facts", facts, "the physics.Facts of the stroke")
        if not isinstance(final, TableState):
            raise InvalidAction("final", final, "the physics.TableState after the stroke")
        if facts.status not in _RULED:
            raise InvalidAction("facts.status", Status(facts.status).name, f"one of {_RULED_NAMES}")
        return self._rule(game, action, facts, final)

    def apply_batch(self, game: Game, actions: Sequence[Action], batch: Batch) -> list[Ruling]:
        """Rule on many strokes from the same game, one for each row of a ``physics.Batch``.

        Raises:
            InvalidAction: as for ``apply``, or not one action for each row.
        """
        if len(actions) != len(batch):
            raise InvalidAction("actions", len(actions), f"{len(batch)} actions, one for each row")
        return [
            self.apply(game, action, Facts.from_record(batch.facts[row]), batch.state(row))
            for row, action in enumerate(actions)
        ]

    def end(self, game: Game, reason: EndReason, loser: int | None = None) -> Ruling:
        """R48: end a game from outside the table.

        Args:
            game: a game that is not over.
            reason: concession, time_out, forfeit, no_show, crash or stall (lost by ``loser``), or aborted.
            loser: the seat that loses; None exactly when aborted.

        Raises:
            InvalidGame: the game is over, or reason and loser do not go together.
        """
        if game.is_over:
            raise InvalidGame("phase", game.phase.value, "a game that is not over")
        if reason not in (*FROM_OUTSIDE, EndReason.ABORTED):
            raise InvalidGame("reason", reason, f"one of {[str(one) for one in (*FROM_OUTSIDE, EndReason.ABORTED)]}")
        if loser not in ((None,) if reason is EndReason.ABORTED else (0, 1)):
            raise InvalidGame("loser", loser, "seat 0 or 1, and None when the game is aborted")
        after = over(game, Outcome(None if loser is None else 1 - loser, reason, RuleId.R48))
        return Ruling((RuleId.R48,), (), lambda: f"{describe_next(after).capitalize()}.", (), after)

    def _decide(self, game: Game, decision: Decision) -> Ruling:
        if decision is Decision.CONCEDE:
            return self.end(game, EndReason.CONCESSION, game.turn)
        after = decide(self.table, game, decision)
        rules = (game.choice or RuleId.R12, *((RuleId.R30, RuleId.R31) if decision is Decision.SPOT_EIGHT else ()))
        rerack = after.phase is Phase.RERACK
        return Ruling(rules, (), lambda: describe_decision(game, decision, after), (), after, rerack=rerack)

    def _rule(self, game: Game, action: Action, facts: Facts, final: TableState) -> Ruling:
        stroke = read_stroke(self.table, game, action, facts, final)
        found = find_fouls(stroke)
        judgement = judge(stroke, found)
        after = self._limited(judgement)
        rules = rules_cited(judgement.rules, judgement.evidence)
        return Ruling(
            rules=rules if after is judgement.game else (RuleId.R49, *rules),
            fouls=tuple(dict.fromkeys(one.rule for one in found)),
            sentence=lambda: describe_stroke(stroke, found, after),
            evidence=judgement.evidence,
            game=after,
            made=judgement.made,
            rerack=after.phase is Phase.RERACK,
        )

    def _limited(self, judgement: Judgement) -> Game:
        """The game after R49 has been looked at."""
        game = judgement.game
        return stroke_limit(game, self.limits) or stalemate(game, self.limits) or game


_RULED = (Status.AT_REST, Status.EVENT_LIMIT, *MISCUES)
_RULED_NAMES = ", ".join(status.name for status in _RULED)


def _require_values(game: Game, action: Action) -> None:
    """A game and an action, whatever a caller without a type checker gives."""
    if not isinstance(game, Game):
        raise InvalidGame("game", game, "a referee.Game")
    if not isinstance(action, Action):
        raise InvalidAction("action", action, "a referee.Action")


def _racked(game: Game) -> Game:
    return replace(game, phase=Phase.BREAK, cue_ball_in_hand=CueBallArea.KITCHEN)
