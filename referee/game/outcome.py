"""How a game ended."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from referee.errors import InvalidGame
from referee.game.rule_id import plain_id


class EndReason(StrEnum):
    """Why a game is over. The first group is decided by a stroke, the second by the driver from outside."""

    EIGHT_MADE = "eight_made"
    EIGHT_WITH_FOUL = "eight_with_foul"
    EIGHT_TOO_EARLY = "eight_too_early"
    EIGHT_NOT_AS_CALLED = "eight_not_as_called"
    EIGHT_OFF_TABLE = "eight_off_table"
    STALEMATE = "stalemate"
    STROKE_LIMIT = "stroke_limit"

    CONCESSION = "concession"
    TIME_OUT = "time_out"
    FORFEIT = "forfeit"
    NO_SHOW = "no_show"
    CRASH = "crash"
    STALL = "stall"
    ABORTED = "aborted"
    """The organiser stopped the game; nobody won."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """The result: the winner's seat (None when drawn or aborted), the reason, and the rule id behind it."""

    winner: int | None
    reason: EndReason
    rule: str

    def __post_init__(self) -> None:
        if self.winner not in (None, 0, 1) or isinstance(self.winner, bool):
            raise InvalidGame("outcome.winner", self.winner, "seat 0, seat 1 or None")
        if not isinstance(self.rule, str):
            raise InvalidGame("outcome.rule", self.rule, "a rule id")

    def to_dict(self) -> dict[str, Any]:
        """``{"winner": 0, "reason": "eight_made", "rule": "R46"}``."""
        return {"winner": self.winner, "reason": self.reason.value, "rule": plain_id(self.rule)}

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> "Outcome":
        """Read what ``to_dict`` wrote; ``InvalidGame`` if it is not that."""
        if not isinstance(data, Mapping) or set(data) != {"winner", "reason", "rule"}:
            raise InvalidGame("outcome", data, "an object with winner, reason and rule")
        try:
            reason = EndReason(data["reason"])
        except ValueError:
            raise InvalidGame("outcome.reason", data["reason"], f"one of {', '.join(EndReason)}") from None
        return cls(data["winner"], reason, data["rule"])
