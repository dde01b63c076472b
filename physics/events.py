"""Events and the states of the balls after them."""

import dataclasses
from enum import IntEnum, StrEnum
from typing import Any, NoReturn

from physics.constants import CUSHION_NAMES, POCKET_NAMES
from physics.errors import shown
from physics.kernels import layout


class Motion(IntEnum):
    """Motion state of a ball ([I], section 3), or why it has none."""

    STATIONARY = layout.STATIONARY
    SPINNING = layout.SPINNING
    SLIDING = layout.SLIDING
    ROLLING = layout.ROLLING
    POCKETED = layout.POCKETED
    ABSENT = layout.ABSENT
    FLYING = layout.FLYING
    DRIVEN_OFF = layout.DRIVEN_OFF


OUT_OF_PLAY = (Motion.POCKETED, Motion.ABSENT, Motion.DRIVEN_OFF)
"""Motion states of balls that are not in play."""


class EventKind(StrEnum):
    """What happened: the nine event types of the paper ([I], section 4) and those it lacks."""

    CUE_STRIKE = "cue_strike"
    BALL_COLLISION = "ball_collision"
    RAIL_COLLISION = "rail_collision"
    POCKET_COLLISION = "pocket_collision"
    SLIDING_ROLLING = "sliding_rolling"
    SLIDING_SPINNING = "sliding_spinning"
    SLIDING_STATIONARY = "sliding_stationary"
    ROLLING_SPINNING = "rolling_spinning"
    ROLLING_STATIONARY = "rolling_stationary"
    SPINNING_STATIONARY = "spinning_stationary"
    CONTACT = "contact"
    """A touching ball was parted or brought to rest by the contact rule; see docs/physics.md."""
    JAW_COLLISION = "jaw_collision"
    """A ball hit a jaw of a pocket mouth: its facing, or the horn between facing and nose."""
    LANDING = "landing"
    """A ball that flew met the cloth; it may bounce."""
    RAIL_TOP = "rail_top"
    """A ball bounced on the top of a rail."""
    OFF_TABLE = "off_table"
    """A ball left the table, or came to rest on it elsewhere than on the cloth."""

    @classmethod
    def _missing_(cls, value: object) -> NoReturn:
        raise ValueError(f"kind = {shown(value)}: must be one of {', '.join(cls)}")


KINDS: tuple[EventKind, ...] = tuple(sorted(EventKind, key=lambda kind: getattr(layout, kind.name)))
"""Kernels write a kind as its place in this tuple."""


@dataclasses.dataclass(frozen=True, slots=True)
class BallState:
    """State of one ball at one time.

    Attributes:
        ball: its number.
        position: (x, y) m. velocity: (vx, vy) m/s. spin: (wx, wy, wz) rad/s.
        motion: its motion state.
        height: m, of the centre above where it rests on the cloth. velocity_z: m/s, upwards.
        flight: whether the table lets balls fly: only then ``to_dict`` tells the last two.
    """

    ball: int
    position: tuple[float, float]
    velocity: tuple[float, float]
    spin: tuple[float, float, float]
    motion: Motion
    height: float = 0.0
    velocity_z: float = 0.0
    flight: bool = False

    def to_dict(self) -> dict[str, Any]:
        """Plain values, for JSON."""
        values = {
            "ball": self.ball,
            "position": list(self.position),
            "velocity": list(self.velocity),
            "spin": list(self.spin),
            "motion": self.motion.name.lower(),
        }
        if self.flight:
            values |= {"height": self.height, "velocity_z": self.velocity_z}
        return values


@dataclasses.dataclass(frozen=True, slots=True)
class Event:
    """One event of a shot.

    Attributes:
        index: its ordinal in the shot, from 0.
        time: s since the strike.
        kind: what happened.
        ball: the ball it happened to; in a ball collision the lower number.
        other: the other ball, the cushion or the rail (0..3 = W, E, S, N), the jaw (0..11, ``physics.Jaw``) or the
            pocket (0..5 = SW W NW NE E SE); else -1.
        states: state of each ball involved, after the event.
    """

    index: int
    time: float
    kind: EventKind
    ball: int
    other: int
    states: tuple[BallState, ...]

    def to_dict(self) -> dict[str, Any]:
        """Plain values, for JSON."""
        return {
            "index": self.index,
            "time": self.time,
            "kind": self.kind.value,
            "ball": self.ball,
            "other": self.other,
            "states": [state.to_dict() for state in self.states],
        }

    def __str__(self) -> str:
        partner = ""
        if self.kind is EventKind.BALL_COLLISION:
            partner = f" with ball {self.other}"
        elif self.kind is EventKind.RAIL_COLLISION:
            partner = f" at the {CUSHION_NAMES[self.other]} cushion"
        elif self.kind is EventKind.RAIL_TOP:
            partner = f" on the {CUSHION_NAMES[self.other]} rail"
        elif self.kind is EventKind.JAW_COLLISION:
            partner = f" at a jaw of pocket {POCKET_NAMES[self.other // 2]}"
        elif self.kind is EventKind.POCKET_COLLISION:
            partner = f" in pocket {POCKET_NAMES[self.other]}"
        return f"{self.time:.6f} s  ball {self.ball}  {self.kind.value.replace('_', ' ')}{partner}"
