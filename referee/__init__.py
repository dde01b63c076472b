"""The referee: World Standardized 8-ball as a pure state machine, the stroke everyone plays, the record of a game."""

from referee.errors import InvalidAction, InvalidGame, RefereeError
from referee.game import (
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
    Ruling,
)

__all__ = [
    "SAFETY",
    "Action",
    "Call",
    "CueBallArea",
    "Decision",
    "EndReason",
    "Evidence",
    "Game",
    "Group",
    "InvalidAction",
    "InvalidGame",
    "Legal",
    "Outcome",
    "Phase",
    "RefereeError",
    "Refusal",
    "Ruling",
]
