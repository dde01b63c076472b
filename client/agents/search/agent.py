"""The agent: a turn from its view to its action."""

import time
from typing import Any

from client.agent import Agent
from client.agents.chance import generator
from client.agents.search import breaks
from client.agents.search.budget import Budget, Pace, allowance
from client.agents.search.engine import geometry
from client.agents.search.evaluate import Evaluator, Responder, Thinking, answered
from client.agents.search.options import Options
from client.agents.search.sight import Sight
from client.agents.search.thinking import Thought, TurnSearch
from client.agents.search.value import Values
from protocol import View
from referee import Action, CueBallArea, Decision, EightBall, Game, Phase

USUAL_NOISE = 1.0
"""The level to reckon with when the game does not tell."""


class SearchAgent(Agent):
    """Looks for the stroke that wins most, by simulating what comes of it.

    Args:
        seed: repeats its draws; with `shots` among the options it repeats its choices. None draws fresh ones.
        options: by name, see `client.agents.search.options.Options`.

    Attributes:
        thoughts: what it thought about each stroke of this game but breaks.

    Raises:
        ValueError: an option that does not exist, or a value it cannot have.
    """

    def __init__(self, seed: int | None = None, **options: Any) -> None:
        self._seed = seed
        self._options = Options(**options)
        geometry()  # before any clock runs
        self._pace = Pace()
        self.thoughts: list[Thought] = []

    def game_started(self, view: View) -> None:
        """Set up for this game's table and noise."""
        self._chance = generator(self._seed, view)
        self._noise = view.noise.model(USUAL_NOISE)
        self._rules = EightBall(view.table_model())
        self._values = Values(Sight(self._rules.table, self._noise), self._noise.by_direction)

    def choose(self, view: View) -> Action:
        """The best stroke, or the decision that leads to the best position."""
        return answered(self.thinking(view), self.responder())

    @property
    def counts_shots_alone(self) -> bool:
        """Whether no clock limits it: then who else thinks meanwhile changes nothing."""
        return self._options.shots > 0

    def responder(self) -> Responder:
        """What answers this agent's questions: the physics, counted, and the values of this game."""
        return Responder(self._rules.table, self._values, self.simulator.simulate_batch)

    def thinking(self, view: View) -> Thinking[Action]:
        """The train of thought about a turn; its result is what `choose` answers."""
        game = view.to_game()
        if game.decisions:
            return (yield from self._decision(game, view))
        if game.phase is Phase.BREAK:
            return self._break(game)
        budget = self._budget(view)
        thought = yield from self._turn(game, budget).best()
        budget.close()
        self.thoughts.append(thought)
        return thought.action

    def _budget(self, view: View, parts: int = 1) -> Budget:
        """What may be spent on one of `parts` equal parts of this turn."""
        options = self._options
        clock = time.process_time if options.cpu else time.perf_counter
        left = None if view.seat is None else view.clocks[view.seat].seconds_left
        seconds, shots = allowance(options, left, self.simulator.remaining)
        return Budget(self._pace, shots // parts, seconds / parts, clock)

    def _turn(self, game: Game, budget: Budget) -> TurnSearch:
        kitchen, options = game.cue_ball_in_hand is CueBallArea.KITCHEN, self._options
        evaluator = Evaluator(self._rules.table, self._values, self._noise, self._chance, budget, kitchen, options)
        return TurnSearch(self._rules, game, evaluator, options, self._chance)

    def _break(self, game: Game) -> Action:
        """The studied break."""
        table = self._rules.table
        best = breaks.best_break(self._noise.by_direction, table)
        place = best.places(table, game.state)[0]
        return Action(shot=best.stroke(table, game.state.moved(0, place)), cue_ball=place)

    def _decision(self, game: Game, view: View) -> Thinking[Action]:
        """The decision after which this player stands best."""
        worths = {}
        for each in game.decisions:
            worths[each] = yield from self._worth_after(game, each, view)
        return Action(decision=max(worths, key=lambda each: worths[each]))

    def _worth_after(self, game: Game, decision: Decision, view: View) -> Thinking[float]:
        if decision is Decision.OPPONENT_RERACKS:
            return 1.0 - self._breaking()
        ruling = self._rules.apply(game, Action(decision=decision), None, None)
        if ruling.rerack:
            return self._breaking()
        thought = yield from self._turn(ruling.game, self._budget(view, len(game.decisions))).best()
        return thought.worth

    def _breaking(self) -> float:
        """What a new rack is worth to the player who breaks it."""
        return breaks.worth_of_breaking(self._rules.table, self._noise.by_direction)
