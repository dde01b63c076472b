"""The agent: gather plans, judge them under noise, play the best."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from client.agent import Agent
from client.agents.chance import generator
from client.agents.greedy import places
from client.agents.greedy.candidates import Candidates
from client.agents.greedy.judge import Judge
from client.agents.greedy.planned_action import PlannedAction
from client.agents.greedy.worth import worth_of_passing
from client.geometry import Point
from client.simulator import Simulator
from physics import Table
from protocol import View
from referee import Action, Call, CueBallArea, Decision, EightBall, Game, Phase
from referee.play import NoiseModel

USUAL_NOISE = 1.0
"""The level to reckon with when the game does not tell."""
POTS, PLACES = 8, 8
"""How many of the easiest pots, and of the most promising places of a cue ball in hand, are considered."""
SCREENING, FINALISTS, VARIANTS = 4, 6, 60
"""All plans are judged by a few noisy variants, the best by many: 60 tell 0.6 of success from 0.75."""
CONTENT = 0.1
"""A pot worth this much more than a safety is played without looking at other directions."""
BREAKING, RECEIVING = 0.5, 0.45
"""What a new rack is worth to the player who breaks it, and to the other."""

Judged = tuple[PlannedAction, float]
"""A plan and what it is worth."""


class GreedyAgent(Agent):
    """Plays the stroke of the greatest expected worth, looking no further than that stroke.

    Args:
        seed: repeats its choices; None draws fresh ones.
    """

    def __init__(self, seed: int | None = None) -> None:
        self._seed = seed

    def game_started(self, view: View) -> None:
        """Set up for this game's table and noise."""
        self._chance = generator(self._seed, view)
        self._noise = view.noise.model(USUAL_NOISE)
        self._rules = EightBall(view.table_model())

    def choose(self, view: View) -> Action:
        """The best stroke, or the decision that leads to the best one."""
        turn = _Turn(self._rules, view.to_game(), self._noise, self._chance, self.simulator)
        return turn.best_stroke()[0] if view.allowed.decisions == () else turn.best_decision()


class _Turn:
    """One turn: everything that depends on how the game stands."""

    def __init__(
        self, rules: EightBall, game: Game, noise: NoiseModel, chance: np.random.Generator, simulator: Simulator
    ) -> None:
        self._rules, self._game, self._noise, self._chance = rules, game, noise, chance
        self._simulator = simulator
        self._candidates = Candidates(rules.table, noise)
        self._judge = Judge(rules, game, noise, chance, simulator)

    @property
    def _table(self) -> Table:
        return self._rules.table

    def best_decision(self) -> Action:
        """The decision after which this player stands best."""
        worths = {each: self._worth_after(each) for each in self._game.decisions}
        return Action(decision=max(worths, key=lambda each: worths[each]))

    def _worth_after(self, decision: Decision) -> float:
        """What a decision is worth: of those to play on, the worth of the stroke that follows."""
        if decision is Decision.OPPONENT_RERACKS:
            return RECEIVING
        ruling = self._rules.apply(self._game, Action(decision=decision), None, None)
        if ruling.rerack:
            return BREAKING
        follow = _Turn(self._rules, ruling.game, self._noise, self._chance, self._simulator)
        return follow.best_stroke()[1]

    def best_stroke(self) -> tuple[Action, float]:
        """The stroke of the greatest expected worth, and that worth."""
        if self._game.phase is Phase.BREAK:
            plan, value = self._best_of(self._break_plans())
            return plan.action, value
        plan, value = self._refined(*self._best_called())
        return plan.action, value

    def _best_called(self) -> Judged:
        """The best of the open pots, and of strokes in all directions when no pot is good enough."""
        plans = self._pot_plans()
        best = self._best_of(plans) if plans else None
        enough = worth_of_passing(self._game, self._game.turn) + CONTENT
        if best is not None and best[1] >= enough:
            return best
        other = self._best_of(self._other_plans())
        return other if best is None or other[1] > best[1] else best

    def _refined(self, plan: PlannedAction, value: float) -> Judged:
        """A plan a little faster or slower, higher or lower, to the left or right, if that is better."""
        near = self._candidates.near(plan)
        better = self._best_of(near) if near else (plan, value)
        return better if better[1] > value else (plan, value)

    def _best_of(self, plans: Sequence[PlannedAction]) -> Judged:
        """The best of the plans under noise: all are screened, the finalists judged with care."""
        rough = self._judge.worths(plans, SCREENING)
        finalists = [plans[index] for index in np.argsort(-rough, kind="stable")[:FINALISTS]]
        worths = self._judge.worths(finalists, VARIANTS)
        best = int(np.argmax(worths))
        return finalists[best], float(worths[best])

    def _pot_plans(self) -> list[PlannedAction]:
        """Open pots from where the cue ball lies, or from where it could be put."""
        balls = self._rules.legal(self._game).callable
        if self._game.cue_ball_in_hand is None:
            return self._candidates.pots(self._game.state, None, balls, POTS)
        placed = [(place, self._game.state.moved(0, place)) for place in self._places(balls)]
        return [plan for place, before in placed for plan in self._candidates.pots(before, place, balls, 2)]

    def _places(self, balls: tuple[int, ...]) -> list[Point]:
        """Where to put the cue ball: behind a pot, or anywhere when there is none."""
        area = self._game.cue_ball_in_hand or CueBallArea.ANYWHERE
        state = self._game.state
        found = places.straight(self._table, state, balls, area)
        return found[:PLACES] or places.scattered(self._table, state, area)

    def _other_plans(self) -> list[PlannedAction]:
        """Strokes in all directions: safeties, kicks, and whatever ball such a stroke happens to make."""
        area, state = self._game.cue_ball_in_hand, self._game.state
        if area is None:
            return self._called(self._candidates.fan(state, None))
        place = places.roomy(self._table, state, area)
        return self._called(self._candidates.fan(state.moved(0, place), place))

    def _called(self, plans: Sequence[PlannedAction]) -> list[PlannedAction]:
        """The plans, those that make a ball of their own calling that ball."""
        balls = self._rules.legal(self._game).callable
        lucky = self._judge.pocketed(plans, balls)
        return [_calling(plan, call) for plan, call in zip(plans, lucky, strict=True)]

    def _break_plans(self) -> list[PlannedAction]:
        """Breaks from just behind the head string."""
        state = self._game.state
        spots = places.for_break(self._table, state)
        return [plan for place in spots for plan in self._candidates.breaks(state.moved(0, place), place)]


def _calling(plan: PlannedAction, call: Call | None) -> PlannedAction:
    """The plan with another call, when there is one."""
    if call is None:
        return plan
    return PlannedAction(dataclasses.replace(plan.action, call=call), plan.before)
