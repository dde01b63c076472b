"""The choices after a break (R12 to R17) carried out."""

from dataclasses import replace

from physics.state import TableState
from physics.table import Table
from referee.game import CueBallArea, Decision, Game, Phase
from referee.rules.spotting import spot
from referee.rules.stalemate import await_rack
from referee.rules.stroke_facts import CUE_BALL


def decide(table: Table, game: Game, decision: Decision) -> Game:
    """The game after one of ``game.decisions``."""
    match decision:
        case Decision.SPOT_EIGHT:
            state = spot(table, game.state)
            scratched = CUE_BALL not in state.balls
            return _play(game, state, CueBallArea.KITCHEN if scratched else None)
        case Decision.BALL_IN_HAND:
            return _play(game, game.state, CueBallArea.KITCHEN)
        case Decision.RERACK_AND_BREAK:
            return await_rack(game, game.turn)
        case Decision.OPPONENT_RERACKS:
            return await_rack(game, game.opponent)
        case _:
            return _play(game, game.state, None)


def _play(game: Game, state: TableState, area: CueBallArea | None) -> Game:
    return replace(game, state=state, phase=Phase.PLAY, cue_ball_in_hand=area, decisions=(), choice=None)
