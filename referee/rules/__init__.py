"""8-ball: one predicate per rule, and the state machine that puts them together."""

from referee.rules.eight_ball import EightBall
from referee.rules.rack import breaker
from referee.rules.spotting import SPOT_GAP, spot
from referee.rules.stalemate import Limits

__all__ = ["SPOT_GAP", "EightBall", "Limits", "breaker", "spot"]
