"""What a player does in a turn: a stroke with its call, or a decision."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from operator import index
from typing import Any, Final, Literal

from physics.pocket_names import POCKET_NUMBERS, POCKETS_ALLOWED
from physics.shot import Shot
from referee.errors import InvalidAction

SAFETY: Final = "safety"
"""The call of a player who gives the turn up: whatever is pocketed, the opponent shoots next."""


class Decision(StrEnum):
    """The choices a player can be asked for after a break, and giving up, which is always allowed."""

    ACCEPT_TABLE = "accept_table"
    """Play on, the cue ball where it lies."""
    BALL_IN_HAND = "ball_in_hand"
    """Play on with the cue ball in hand behind the head string."""
    SPOT_EIGHT = "spot_eight"
    """The 8 fell on the break: spot it and play on (after a scratch: ball in hand behind the head string)."""
    RERACK_AND_BREAK = "rerack_and_break"
    """A new rack; whoever decides breaks it."""
    OPPONENT_RERACKS = "opponent_reracks"
    """A new rack; the opponent, who broke badly, breaks again."""
    CONCEDE = "concede"
    """Give the game up."""


@dataclass(frozen=True, slots=True, init=False)
class Call:
    """The announced ball and pocket (0..5, SW W NW NE E SE); whether it may be called, ``check`` says.

    Args:
        ball: its number.
        pocket: its number or its name; ``Call(3, "SW")`` is ``Call(3, 0)``.

    Raises:
        InvalidAction: a number that is no integer, or a name that no pocket has.
    """

    ball: int
    pocket: int

    def __init__(self, ball: int, pocket: int | str) -> None:
        number = POCKET_NUMBERS.get(pocket, pocket) if isinstance(pocket, str) else pocket
        object.__setattr__(self, "ball", _integer("call.ball", ball, "must be the number of a ball, an integer"))
        object.__setattr__(self, "pocket", _integer("call.pocket", number, f"must be {POCKETS_ALLOWED}"))

    def to_dict(self) -> dict[str, int]:
        """``{"ball": 3, "pocket": 5}``."""
        return {"ball": self.ball, "pocket": self.pocket}


@dataclass(frozen=True, slots=True)
class Action:
    """A stroke or a decision: exactly one of ``shot`` and ``decision``.

    Args:
        shot: the intended stroke.
        call: ``Call`` (or ``{"ball": 3, "pocket": 5}``, or ``(3, "SE")``), ``"safety"``, or None on the break.
        cue_ball: where to put the cue ball, metres, when it is in hand; None leaves it where it lies.
        decision: a ``Decision`` or its string value.

    Raises:
        InvalidAction: not of this form. Legality in a given game is for ``EightBall.check`` to say.
    """

    shot: Shot | None = None
    call: Call | Literal["safety"] | None = None
    cue_ball: tuple[float, float] | None = None
    decision: Decision | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "call", _call(self.call))
        object.__setattr__(self, "cue_ball", _point(self.cue_ball))
        object.__setattr__(self, "decision", _decision(self.decision))
        if self.shot is not None and not isinstance(self.shot, Shot):
            raise InvalidAction("shot", self.shot, "a physics.Shot")
        if (self.shot is None) == (self.decision is None):
            raise InvalidAction("action", self.to_dict(), "exactly one of shot and decision")
        if self.decision is not None and (self.call is not None or self.cue_ball is not None):
            raise InvalidAction("action", self.to_dict(), "a decision has neither call nor cue_ball")

    @property
    def is_safety(self) -> bool:
        """A safety was called."""
        return self.call == SAFETY

    def to_dict(self) -> dict[str, Any]:
        """JSON form; the parts that are None are left out, except the call of a stroke."""
        if self.decision is not None:
            return {"decision": self.decision.value}
        data: dict[str, Any] = {"shot": None if self.shot is None else self.shot.to_dict()}
        data["call"] = self.call.to_dict() if isinstance(self.call, Call) else self.call
        if self.cue_ball is not None:
            data["cue_ball"] = list(self.cue_ball)
        return data

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> "Action":
        """Read what ``to_dict`` wrote, or raise ``InvalidAction`` (for the stroke itself ``InvalidShot``)."""
        if not isinstance(data, Mapping):
            raise InvalidAction("action", data, "an object with a shot or a decision")
        unknown = set(data) - {"shot", "call", "cue_ball", "decision"}
        if unknown:
            raise InvalidAction("action", sorted(unknown), "the keys shot, call, cue_ball, decision")
        shot = data.get("shot")
        return cls(
            shot=Shot.from_dict(shot) if isinstance(shot, Mapping) else shot,
            call=data.get("call"),
            cue_ball=data.get("cue_ball"),
            decision=data.get("decision"),
        )


def _integer(field: str, value: Any, allowed: str) -> int:
    try:
        if isinstance(value, bool):
            raise TypeError
        return index(value)
    except TypeError:
        raise InvalidAction(field, value, allowed) from None


def _call(value: Any) -> Call | Literal["safety"] | None:
    if value is None or isinstance(value, Call):
        return value
    if isinstance(value, str) and value == SAFETY:
        return SAFETY
    if isinstance(value, Mapping) and set(value) == {"ball", "pocket"}:
        return Call(value["ball"], value["pocket"])
    if isinstance(value, tuple | list) and len(value) == 2:
        return Call(*value)
    raise InvalidAction("call", value, 'must be a Call, (ball, pocket), {"ball": , "pocket": }, "safety" or None')


def _point(value: Any) -> tuple[float, float] | None:
    if value is None:
        return None
    try:
        x, y = value
        if isinstance(x, str | bool) or isinstance(y, str | bool):
            raise TypeError
        return float(x), float(y)
    except (TypeError, ValueError, OverflowError):
        raise InvalidAction("cue_ball", value, "two numbers (x, y) in metres, or None") from None


def _decision(value: Any) -> Decision | None:
    if value is None:
        return None
    try:
        return Decision(value)
    except ValueError:
        raise InvalidAction("decision", value, f"one of {', '.join(Decision)}") from None
