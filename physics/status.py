"""How a shot can end, by name."""

from enum import IntEnum

from physics.kernels import layout


class Status(IntEnum):
    """How a shot ended. The first is the regular end; the rest say why there was no shot or no end.

    Kernels write these numbers; ``explain`` puts them in words.
    """

    AT_REST = layout.AT_REST
    CUE_OBSTRUCTED = layout.CUE_OBSTRUCTED
    TIP_OFF_BALL = layout.TIP_OFF_BALL
    OUT_OF_RANGE = layout.OUT_OF_RANGE
    NO_CUE_BALL = layout.NO_CUE_BALL
    EVENT_LIMIT = layout.EVENT_LIMIT

    @property
    def played(self) -> bool:
        """Whether the cue ball was struck at all."""
        return self in (Status.AT_REST, Status.EVENT_LIMIT)

    def explain(self) -> str:
        """Say the status in words."""
        return _WORDS[self]


_WORDS = {
    Status.AT_REST: "every ball came to rest or was pocketed",
    Status.CUE_OBSTRUCTED: "the cue is blocked by a ball or a cushion",
    Status.TIP_OFF_BALL: "the tip offset lies outside the ball (a^2 + b^2 > R^2)",
    Status.OUT_OF_RANGE: "the cue's speed or elevation is out of the table's range",
    Status.NO_CUE_BALL: "there is no cue ball on the table",
    Status.EVENT_LIMIT: "the shot had more events than the limit",
}
