"""What the situation after a stroke is worth to the one who played it: 1 is a won game, 0 a lost one.

Between those two it is who shoots next and with how much freedom, and who has fewer balls left. It knows nothing
about where the balls lie; that is what makes the agent greedy.
"""

import numpy as np
from numpy.typing import NDArray

from physics import Batch
from physics.facts import NEVER
from referee import Game, Group, Limits, Phase
from referee.game import members, remaining
from referee.rules.batch_rulings import OPEN, Verdicts

WON, LOST, DRAWN = 1.0, 0.0, 0.5
AT_THE_TABLE = 0.7
"""The shooter goes on."""
IN_DECISION = {True: 0.55, False: 0.45}
"""Somebody decides after a break, the shooter or the opponent."""
OPPONENT_SHOOTS = 0.35
OPPONENT_IN_HAND = 0.15
"""The opponent shoots, from where the cue ball lies or from where it suits best."""
BALL_AHEAD = 0.03
"""What each ball that the opponent has left beyond one's own adds: far ahead, nobody risks the 8 for little."""


def worth(game: Game, seat: int) -> float:
    """The worth of `game` to `seat`, in [0, 1]."""
    if game.outcome is not None:
        winner = game.outcome.winner
        return DRAWN if winner is None else WON if winner == seat else LOST
    if game.phase is not Phase.PLAY:
        return IN_DECISION[game.turn == seat]
    return _initiative(game, seat) + BALL_AHEAD * _ahead(game, seat)


def worth_of_passing(game: Game, seat: int) -> float:
    """The worth of a fair stroke after which the opponent shoots: what a plain safety brings."""
    return OPPONENT_SHOOTS + BALL_AHEAD * _ahead(game, seat)


def _initiative(game: Game, seat: int) -> float:
    """Who shoots next, and with how much freedom."""
    if game.turn == seat:
        return AT_THE_TABLE
    return OPPONENT_SHOOTS if game.cue_ball_in_hand is None else OPPONENT_IN_HAND


def _ahead(game: Game, seat: int) -> int:
    """How many balls more than `seat` the opponent has left; 0 on an open table."""
    return len(remaining(game, 1 - seat)) - len(remaining(game, seat))


def worths_of(game: Game, verdicts: Verdicts, batch: Batch, limits: Limits) -> NDArray[np.float64]:
    """`worth` to the player in turn of what follows from each of n strokes, (n,), none of them a break."""
    on_table = ~np.isnan(batch.positions[:, :, 0])
    left = [on_table[:, list(members(group))].sum(axis=1) for group in (Group.SOLIDS, Group.STRIPES)]
    ahead = np.select([verdicts.group == OPEN, verdicts.group == 0], [0, left[1] - left[0]], left[0] - left[1])
    shoots_next = np.where(verdicts.fouled, OPPONENT_IN_HAND, OPPONENT_SHOOTS)
    worths = np.where(verdicts.continues, AT_THE_TABLE, shoots_next) + BALL_AHEAD * ahead
    pocketed = (batch.facts["pocketed"][:, 1:] != NEVER).any(axis=1)
    dry = np.where(pocketed, 0, game.dry_visits + ((game.visit_strokes == 0) & ~verdicts.continues))
    stuck = DRAWN if game.replays >= limits.replays else np.where(game.breaker == game.turn, *IN_DECISION.values())
    worths = np.where(dry >= limits.dry_visits, stuck, worths)
    if game.stroke + 1 >= limits.strokes:
        worths[:] = DRAWN
    worths[verdicts.won], worths[verdicts.lost] = WON, LOST
    return worths
