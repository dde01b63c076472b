"""The values of a game: what a player does, how the game stands, what the referee answers."""

from referee.game.action import SAFETY, Action, Call, Decision
from referee.game.game import CueBallArea, Game, Group, Phase
from referee.game.legal import EIGHT, Legal, callable_balls, legal, members, remaining
from referee.game.outcome import EndReason, Outcome
from referee.game.rule_id import RULES, RuleId
from referee.game.ruling import Evidence, Refusal, Ruling

__all__ = [
    "EIGHT",
    "RULES",
    "SAFETY",
    "Action",
    "Call",
    "CueBallArea",
    "Decision",
    "EndReason",
    "Evidence",
    "Game",
    "Group",
    "Legal",
    "Outcome",
    "Phase",
    "Refusal",
    "RuleId",
    "Ruling",
    "callable_balls",
    "legal",
    "members",
    "remaining",
]
