"""The stroke: check, place, noise, simulate, rule. The one loop body of everything that plays.

Server, local games, search, learning environments and the verification of records all call ``play_stroke``.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from physics import Result, Shot, TableState, simulate
from physics.shot import FIELDS
from referee.errors import RefereeError
from referee.game import Action, Game, Refusal, Ruling
from referee.play.noise import NoiseModel
from referee.play.seeds import GameSeeds
from referee.rules import EightBall
from referee.rules.checks import start_state


class Refused(RefereeError):
    """The referee does not accept an action. Nothing happened: no stroke, no noise drawn; the clock runs on.

    Attributes:
        refusals: every reason; ``field``, ``value`` and ``allowed`` are those of the first.
    """

    def __init__(self, refusals: Sequence[Refusal]) -> None:
        first = refusals[0]
        super().__init__(first.field, first.value, first.allowed)
        self.refusals = tuple(refusals)

    def __str__(self) -> str:
        return "; ".join(refusal.words for refusal in self.refusals)

    def __reduce__(self) -> tuple[type, tuple[tuple[Refusal, ...]]]:  # type: ignore[override]
        """Pickle by the refusals, so that the error crosses process borders."""
        return type(self), (self.refusals,)


@dataclass(frozen=True, slots=True)
class Stroke:
    """A stroke that was played, or a decision that was made.

    Attributes:
        seat: who.
        index: the stroke's index in its game; None for a decision.
        action: as submitted, negative zeros made positive.
        before: the table the stroke was played on, the cue ball placed.
        shot: as played, with noise; None for a decision.
        result: of the physics; None for a decision.
        ruling: the referee's.
        game: as it goes on, racked again if the ruling says so.
    """

    seat: int
    index: int | None
    action: Action
    before: TableState
    shot: Shot | None
    result: Result | None
    ruling: Ruling
    game: Game

    def __repr__(self) -> str:
        what = self.action.decision or self.shot
        rest = f", {self.result!r}" if self.result is not None else ""
        return f"<Stroke {self.index} of seat {self.seat}: {what}{rest}>"


def start_game(rules: EightBall, seeds: GameSeeds, breaker: int = 0) -> Game:
    """A new game, racked from its own seeds."""
    return rules.new_game(seeds.rack(0), breaker=breaker)


def play_stroke(
    rules: EightBall,
    game: Game,
    action: Action,
    seeds: GameSeeds,
    noise: NoiseModel,
    *,
    trace: bool = True,
) -> Stroke:
    """Play one action of the player in turn.

    Args:
        rules: the referee, on its table; its limits end a stroke that has too many events.
        game: as it stands.
        action: a stroke, a decision or a concession.
        seeds: of the game; someone who searches ahead gives seeds of their own.
        noise: of the game.
        trace: whether the result keeps its events.

    Raises:
        Refused: the action is not allowed, with all reasons.
    """
    action = without_negative_zeros(action)
    refusals = rules.check(game, action)
    if refusals:
        raise Refused(refusals)
    if action.shot is None:
        ruling = rules.apply(game, action, None, None)
        return Stroke(game.turn, None, action, game.state, None, None, ruling, racked(rules, ruling, game, seeds))
    before = start_state(game, action)
    shot = noise.perturb(action.shot, seeds.noise_seed, game.stroke, rules.table)
    result = simulate(rules.table, before, shot, trace=trace, event_limit=rules.limits.events)
    ruling = rules.apply(game, action, result.facts, result.final)
    after = racked(rules, ruling, game, seeds)
    return Stroke(game.turn, game.stroke, action, before, shot, result, ruling, after)


def racked(rules: EightBall, ruling: Ruling, before: Game, seeds: GameSeeds) -> Game:
    """The game after a ruling, with new balls if it asks for them: the next rack of this game."""
    return rules.rerack(ruling.game, seeds.rack(before.rack + 1)) if ruling.rerack else ruling.game


def without_negative_zeros(action: Action) -> Action:
    """The same action with 0.0 for -0.0, which canonical JSON cannot tell apart: records must be exact."""
    shot = action.shot
    if shot is None:
        return action
    values = (shot.v, shot.phi, shot.theta, shot.a, shot.b, *(action.cue_ball or ()))
    if not any(value == 0.0 and math.copysign(1.0, value) < 0.0 for value in values):
        return action
    positive = [value + 0.0 for value in values]
    cue_ball = None if action.cue_ball is None else (positive[-2], positive[-1])
    return replace(action, shot=Shot(*positive[: len(FIELDS)]), cue_ball=cue_ball)
