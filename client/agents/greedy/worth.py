"""What the situation after a stroke is worth to the one who played it: 1 is a won game, 0 a lost one.

Between those two it is a scale of five steps, by who shoots next and with how much freedom. It knows
nothing about where the balls lie; that is what makes the agent greedy.
"""

from referee import Game, Phase

WON, LOST, DRAWN = 1.0, 0.0, 0.5
AT_THE_TABLE = 0.7
"""The shooter goes on."""
IN_DECISION = {True: 0.55, False: 0.45}
"""Somebody decides after a break, the shooter or the opponent."""
OPPONENT_SHOOTS = 0.35
OPPONENT_IN_HAND = 0.15
"""The opponent shoots, from where the cue ball lies or from where it suits best."""


def worth(game: Game, seat: int) -> float:
    """The worth of `game` to `seat`, in [0, 1]."""
    if game.outcome is not None:
        winner = game.outcome.winner
        return DRAWN if winner is None else WON if winner == seat else LOST
    if game.phase is not Phase.PLAY:
        return IN_DECISION[game.turn == seat]
    if game.turn == seat:
        return AT_THE_TABLE
    return OPPONENT_SHOOTS if game.cue_ball_in_hand is None else OPPONENT_IN_HAND
