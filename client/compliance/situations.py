"""The situations an agent is put into: a position, the terms of the match, and what goes wrong on the way."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Final

from protocol import Position


class Twist(StrEnum):
    """What the proxy does to the traffic."""

    NONE = "none"
    LOST_REPLY = "lost reply"
    """The first action arrives; its reply does not."""
    DRAINING = "draining"
    """The first action is answered 503 with `Retry-After: 1`."""
    RESET = "reset"
    """Every second request for a turn has its connection cut."""
    REFUSED = "refused"
    """The first action is refused, whatever it is."""
    NEW_FIELDS = "new fields"
    """Answers have fields that no agent knows."""


@dataclass(frozen=True, slots=True)
class Situation:
    """One thing an agent has to cope with.

    Attributes:
        name: short. words: what happens, in a sentence.
        start: the position; None for a break.
        seconds: thinking time of the game.
        told: whether the agent is told the level of noise.
        twist: what goes wrong on the way.
        ends: whether the opponent gives the game up then, instead of the match being called off.
    """

    name: str
    words: str
    start: Position | None = None
    seconds: float = 60.0
    told: bool = True
    twist: Twist = Twist.NONE
    ends: bool = False


_SOLIDS = {"1": [0.3, 0.5], "3": [0.8, 0.9], "5": [0.5, 1.3]}
_STRIPES = {"9": [0.2, 1.6], "12": [0.9, 1.5], "14": [0.4, 0.9]}
_EIGHT = {"8": [0.6, 0.3]}
_CUE = {"0": [0.5, 1.8]}
_ALL: Final = _CUE | _SOLIDS | _STRIPES | _EIGHT
_GROUPS: Final = ("solids", "stripes")
_WALL = {
    str(ball): [0.5 + 0.06 * place, 1.6] for place, ball in zip((-2, -1, 0, 1, 2), (9, 10, 11, 12, 13), strict=True)
}
"""Stripes between the cue ball and everything else."""


def _at(balls: Mapping[str, Any], **fields: Any) -> Position:
    return Position.model_validate({"balls": balls} | fields)


def _asked(choice: str, balls: Mapping[str, Any] = _ALL) -> Position:
    return _at(balls, phase="decision", choice=choice)


def _without(*balls: str) -> dict[str, Any]:
    return {ball: place for ball, place in _ALL.items() if ball not in balls}


SITUATIONS: Final[tuple[Situation, ...]] = (
    Situation("break", "A rack to be broken, the cue ball in hand behind the head string."),
    Situation("open table", "An open table: any ball but the 8 may be called.", _at(_ALL)),
    Situation("groups", "A table with groups: only the own balls may be called.", _at(_ALL, groups=_GROUPS)),
    Situation("other group", "The same with the other group.", _at(_ALL, groups=_GROUPS[::-1])),
    Situation(
        "in the kitchen",
        "Ball in hand behind the head string, the cue ball off the table.",
        _at(_without("0"), cue_ball_in_hand="kitchen"),
    ),
    Situation(
        "ball in hand",
        "Ball in hand anywhere, the cue ball off the table.",
        _at(_without("0"), cue_ball_in_hand="anywhere"),
    ),
    Situation("may stay", "Ball in hand anywhere, the cue ball on the table.", _at(_ALL, cue_ball_in_hand="anywhere")),
    Situation(
        "on the 8",
        "The own group is cleared: the 8 alone may be called.",
        _at(_CUE | _STRIPES | _EIGHT, groups=_GROUPS),
    ),
    Situation("one ball", "Nothing but the cue ball and the 8.", _at(_CUE | _EIGHT, groups=_GROUPS)),
    Situation("eight on an open table", "Only the 8 is left and nobody has a group: a safety.", _at(_CUE | _EIGHT)),
    Situation(
        "snookered", "No way to the own balls but off a cushion.", _at(_CUE | _WALL | _SOLIDS | _EIGHT, groups=_GROUPS)
    ),
    Situation("illegal break", "R12: accept the table, or have it racked again.", _asked("R12")),
    Situation("illegal break, scratch", "R12a: ball in hand or a new rack.", _asked("R12a", _without("0"))),
    Situation("8 on the break", "R13: spot the 8 or break again.", _asked("R13", _without("8"))),
    Situation("8 and scratch on the break", "R14: spot the 8 or break.", _asked("R14", _without("0", "8"))),
    Situation("ball off on the break", "R16: accept the table or ball in hand.", _asked("R16")),
    Situation("foul on the break", "R17: the same after another foul.", _asked("R17")),
    Situation("noise not told", "The level of noise is a secret.", _at(_ALL), told=False),
    Situation("low clock", "Three seconds are left.", _at(_ALL, groups=_GROUPS), seconds=3.0),
    Situation(
        "refused", "The first action is refused: another is needed.", _at(_ALL, groups=_GROUPS), twist=Twist.REFUSED
    ),
    Situation(
        "lost reply", "The reply to the first action is lost.", _at(_ALL, groups=_GROUPS), twist=Twist.LOST_REPLY
    ),
    Situation("draining", "The server asks for a second's patience.", _at(_ALL, groups=_GROUPS), twist=Twist.DRAINING),
    Situation("reconnect", "Every second poll is cut off.", _at(_ALL, groups=_GROUPS), twist=Twist.RESET),
    Situation("new fields", "A newer server says things nobody knows yet.", _at(_ALL), twist=Twist.NEW_FIELDS),
    Situation("game over", "The opponent gives up, and the match is over.", _at(_ALL), ends=True),
)
