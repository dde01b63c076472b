"""One game after another, as environments play them."""

from dataclasses import dataclass

import numpy as np

from physics import Table
from referee import Action, EightBall, EndReason, Game, NoiseModel, Phase
from referee.play import GameSeeds, Refused, play_stroke, start_game
from referee.play.seeds import SEED_BYTES


@dataclass(slots=True)
class Episode:
    """A game under way.

    Attributes:
        rules, noise: of the game. seeds: its secrets. game: how it stands.
    """

    rules: EightBall
    noise: NoiseModel
    seeds: GameSeeds
    game: Game

    @classmethod
    def begin(cls, rules: EightBall, noise: NoiseModel, chance: np.random.Generator, start: Game | None) -> "Episode":
        """A new game: racks, noise and the breaker drawn, or from a position."""
        seeds = GameSeeds(noise=chance.bytes(SEED_BYTES), racks=chance.bytes(SEED_BYTES))
        game = start_game(rules, seeds, int(chance.integers(2))) if start is None else start
        return cls(rules, noise, seeds, game)

    def play(self, action: Action) -> None:
        """Go on with an action of the player in turn; one that is refused forfeits the game."""
        try:
            stroke = play_stroke(self.rules, self.game, action, self.seeds, self.noise, trace=False)
        except Refused:
            self.forfeit()
            return
        self.game = stroke.game

    def follow(self, game: Game) -> None:
        """Go on with the game after a stroke, on the next rack if it awaits one."""
        reracks = game.phase is Phase.RERACK
        self.game = self.rules.rerack(game, self.seeds.rack(game.rack + 1)) if reracks else game

    def forfeit(self) -> None:
        """The player in turn loses the game."""
        self.game = self.rules.end(self.game, EndReason.FORFEIT, self.game.turn).game

    def reward(self, seat: int) -> float:
        """1 for the game won, -1 for the game lost, 0 while it goes on and for a draw."""
        return reward(self.game, seat)


def reward(game: Game, seat: int) -> float:
    """1 for a game won by the seat, -1 for one lost, 0 while it goes on and for a draw."""
    if game.outcome is None or game.outcome.winner is None:
        return 0.0
    return 1.0 if game.outcome.winner == seat else -1.0


def referee_of(table: Table | None) -> EightBall:
    """The referee on a table; the Olympiad's unless given."""
    return EightBall(table or Table.olympiad())
