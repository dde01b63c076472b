"""Games of a few strokes, played here by players who aim at ghost balls, and given up then."""

from collections.abc import Callable

from support.players import Potter

import physics
from client.local_game import PlayedGame, play_game
from protocol import View
from referee import Action, EightBall, MatchSeed, NoiseModel
from referee.game import Decision


def short_game(
    seed: int, actions: int, table: physics.Table | None = None, players: tuple[str, str] = ("ann 3", "bob 3")
) -> PlayedGame:
    """A break and some strokes after it, then a concession; every tenth game on the historical table unless told."""
    left = [actions]

    def player(name: str) -> Callable[[View], Action]:
        potter = Potter(name)

        def choose(view: View) -> Action:
            left[0] -= 1
            return Action(decision=Decision.CONCEDE) if left[0] < 0 else potter(view)

        return choose

    if table is None:
        table = physics.Table.fastfiz() if seed % 10 == 9 else physics.Table.olympiad()
    chairs = (player(f"ann {seed}"), player(f"bob {seed}"))
    return play_game(EightBall(table), chairs, MatchSeed.of(seed).game(0), NoiseModel(1.0), players=players)
