"""One local game between agents, with what the referee refused on the way."""

from collections.abc import Callable, Iterable
from typing import Any

import physics
from client import Agent
from client.local_game import Watch, play_match
from protocol import View
from referee import Action, EightBall
from referee.play import MatchSeed, NoiseModel

Choose = Callable[[View], Action]

RULES = EightBall(physics.Table.olympiad())


def whole_game(agents: Iterable[Callable[[], Agent]], seed: int, noise: float) -> tuple[Any, list[Any]]:
    """The game as it was played, and every refusal of it. ``agents``: by seat, each makes one agent."""
    factories = list(agents)
    refused: list[Any] = []

    def seats(_number: int, _budgets: Any) -> tuple[Choose, Choose]:
        one, two = (_chooser(factory()) for factory in factories)
        return one, two

    watch = Watch(on_refusal=refused.append)
    (game,) = play_match(RULES, seats, MatchSeed.of(seed), 1, NoiseModel(noise), watch=watch)
    return game, refused


def _chooser(agent: Agent) -> Choose:
    started = False

    def choose(view: View) -> Action:
        nonlocal started
        if not started:
            started = True
            agent.game_started(view)
        return agent.choose(view)

    return choose
