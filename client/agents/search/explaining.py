"""What `search` thinks about a position, for people: the strokes that came far, and what kind each is."""

import math
from dataclasses import dataclass

import numpy as np

import physics
from client.agents.search.budget import Budget, Pace
from client.agents.search.evaluate import Evaluator, Responder, answered
from client.agents.search.options import Options
from client.agents.search.sight import Sight
from client.agents.search.thinking import Considered, Thought, TurnSearch
from client.agents.search.value import Values
from physics import EventKind, Result
from referee import Call, CueBallArea, EightBall, Game, Phase
from referee.play import NoiseModel

HIGH, LOOKS = 0.01, 100
"""m off the cloth, higher than a cue ball hops that is struck as level as can be; and how often it is looked at."""


@dataclass(frozen=True, slots=True)
class Explained:
    """A stroke that was considered, and what it does as it is meant.

    Attributes:
        stroke: the stroke with its worth. kind: `straight pot`, `bank`, `kick`, `combination`, `jump`, several of them
            joined by +, or `safety`. result: the stroke without noise. made: whether it then makes its call.
    """

    stroke: Considered
    kind: str
    result: Result
    made: bool


def thought_about(rules: EightBall, game: Game, noise: float | NoiseModel, options: Options, seed: int = 0) -> Thought:
    """What `search` thinks about a called stroke.

    Args:
        rules: the referee, on its table. game: the position. noise: of the game, or its level. seed: of what it
            simulates.

    Raises:
        ValueError: the game is over, or what is asked for is a break or a decision: those are not searched for.
    """
    if game.phase is not Phase.PLAY:
        raise ValueError(
            f"phase = {game.phase.value!r}: must be 'play'; breaks were studied beforehand (docs/agents.md)"
        )
    noise = NoiseModel.of(noise)
    values = Values(Sight(rules.table, noise), noise.by_direction)
    chance = np.random.default_rng(seed)
    budget = Budget(Pace(), options.shots, math.inf if options.shots else options.seconds)
    kitchen = game.cue_ball_in_hand is CueBallArea.KITCHEN
    evaluator = Evaluator(rules.table, values, noise, chance, budget, kitchen, options)
    turn = TurnSearch(rules, game, evaluator, options, chance)
    return answered(turn.best(), Responder(rules.table, values, physics.simulate_batch))


def explained(rules: EightBall, game: Game, stroke: Considered) -> Explained:
    """A considered stroke, simulated as it is meant."""
    action = stroke.action
    if action.shot is None:
        raise ValueError(f"action = {action!r}: must be a stroke")
    state = game.state if action.cue_ball is None else game.state.moved(0, action.cue_ball)
    result = physics.simulate(rules.table, state, action.shot)
    call = action.call if isinstance(action.call, Call) else None
    made = call is not None and result.facts.pocket[call.ball] == call.pocket
    return Explained(stroke, kind_of(result, call), result, made)


def kind_of(result: Result, call: Call | None) -> str:
    """What players call such a stroke."""
    if call is None:
        return "safety"
    first = next((event for event in result.events if event.kind is EventKind.BALL_COLLISION), None)
    before = [event for event in result.events if first is None or event.time <= first.time]
    kinds = []
    if _jumps(result, result.duration if first is None else first.time):
        kinds.append("jump")
    if any(event.kind is EventKind.RAIL_COLLISION and event.ball == 0 for event in before):
        kinds.append("kick")
    if first is not None and call.ball not in (first.ball, first.other):
        kinds.append("combination")
    if any(event.kind is EventKind.RAIL_COLLISION and event.ball == call.ball for event in result.events):
        kinds.append("bank")
    return " + ".join(kinds) or "straight pot"


def _jumps(result: Result, until: float) -> bool:
    """Whether the cue ball flies so high on its way that it can pass over something."""
    _, heights = result.paths(np.linspace(0.0, until, LOOKS))
    return bool(np.nanmax(heights[:, 0], initial=0.0) > HIGH)
