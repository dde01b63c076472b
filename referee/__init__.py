"""The referee: World Standardized 8-ball as a pure state machine, and the stroke that everything plays.

The record of a game and the messages on the wire are imported by name: ``referee.record``, ``protocol``.
"""

from referee.errors import InvalidAction, InvalidGame, RefereeError
from referee.game import (
    RULES,
    SAFETY,
    Action,
    Call,
    CueBallArea,
    Decision,
    EndReason,
    Evidence,
    Game,
    Group,
    Legal,
    Outcome,
    Phase,
    Refusal,
    RuleId,
    Ruling,
)
from referee.play import (
    BudgetSpent,
    Clocks,
    GameSeeds,
    MatchSeed,
    NoiseModel,
    Refused,
    SimulationBudget,
    Stroke,
    play_stroke,
    start_game,
)
from referee.rules import EightBall, Limits

__all__ = [
    "RULES",
    "SAFETY",
    "Action",
    "BudgetSpent",
    "Call",
    "Clocks",
    "CueBallArea",
    "Decision",
    "EightBall",
    "EndReason",
    "Evidence",
    "Game",
    "GameSeeds",
    "Group",
    "InvalidAction",
    "InvalidGame",
    "Legal",
    "Limits",
    "MatchSeed",
    "NoiseModel",
    "Outcome",
    "Phase",
    "RefereeError",
    "Refusal",
    "Refused",
    "RuleId",
    "Ruling",
    "SimulationBudget",
    "Stroke",
    "play_stroke",
    "start_game",
]
