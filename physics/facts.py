"""What rules need to know about a shot, gathered by the kernel without a trace.

Every per-ball fact is the ordinal of the event that proves it (``Event.index``), or -1 when it did not happen.
A batch holds the same fields as a structured array of ``FACTS_DTYPE``.
"""

import dataclasses
import itertools
import math
from typing import Any, Final, Self

import numpy as np
from numpy.typing import NDArray

from physics.constants import N_BALLS
from physics.kernels import layout

NEVER: Final = -1
"""The ordinal of an event that did not happen."""

FACTS_DTYPE: Final = np.dtype(
    [
        (name, kind) if size == 1 else (name, kind, (size,))
        for kind, fields in ((np.int32, layout.INTEGER_FACTS), (np.float64, layout.FLOAT_FACTS))
        for name, size in fields.items()
    ],
    align=True,
)
"""One shot's facts. The kernel writes the int32 and the float64 by position (``physics.kernels.layout``)."""

FACTS_WORDS: Final = layout.FACTS_WIDTH
"""Size of one shot's facts in 32-bit words."""

PerBall = tuple[int, ...]
_NOBODY: PerBall = (NEVER,) * N_BALLS


@dataclasses.dataclass(frozen=True, slots=True)
class Facts:
    """The facts of one shot.

    Attributes:
        status: ``Status`` number.
        n_events: how many events the shot had, the cue strike included.
        crossed_head_string: event that opens the stretch of the cue ball's path on which its centre was first
            not behind the head string (y <= head string); at the start counts.
        crossed_before_contact: the same, but before the first contact.
        first_contact: (16,) the collision in which the cue ball struck this ball first; several when
            simultaneous.
        cushion: (16,) first collision of each ball with a cushion; a jaw counts as its cushion. Touches slower than
            1 mm/s, and touches at the start by a ball frozen to that cushion, do not count.
        cushion_after_contact: (16,) the same, counting only what follows the first contact.
        pocketed: (16,) the pocket collision; pocket: (16,) which pocket, or -1.
        off_table: (16,) the event by which the ball left the table.
        frozen_to_cushion, frozen_to_cue_ball: (16,) 1 where the ball touched a cushion, the cue ball, at the start.
        miscue: 1 if the tip slipped off the cue ball; it never does on a table whose cue has no end mass.
        duration: s.
        first_contact_cue_ball: (x, y) m, the cue ball's centre at first contact; NaN if there was none.
    """

    status: int
    n_events: int
    crossed_head_string: int
    crossed_before_contact: int
    first_contact: PerBall
    cushion: PerBall
    cushion_after_contact: PerBall
    pocketed: PerBall
    pocket: PerBall
    off_table: PerBall
    frozen_to_cushion: PerBall
    frozen_to_cue_ball: PerBall
    miscue: int
    duration: float
    first_contact_cue_ball: tuple[float, float]

    def __repr__(self) -> str:
        """What was a fact: numbers that are not those of ``none()``, of a list the balls it holds for."""
        nothing, parts = Facts.none(), []
        for field in dataclasses.fields(self):
            value, usual = getattr(self, field.name), getattr(nothing, field.name)
            if isinstance(value, tuple) and len(value) == N_BALLS:
                value = {ball: number for ball, number in enumerate(value) if number != usual[ball]}
                usual = {}
            if str(value) != str(usual):  # NaN is NaN
                parts.append(f"{field.name}={value}")
        return f"Facts({', '.join(parts)})"

    @classmethod
    def none(cls) -> Self:
        """The facts of a stroke in which nothing happened: the base for building facts by hand."""
        nothing_frozen = (0,) * N_BALLS
        return cls(
            status=0,
            n_events=0,
            crossed_head_string=NEVER,
            crossed_before_contact=NEVER,
            first_contact=_NOBODY,
            cushion=_NOBODY,
            cushion_after_contact=_NOBODY,
            pocketed=_NOBODY,
            pocket=_NOBODY,
            off_table=_NOBODY,
            frozen_to_cushion=nothing_frozen,
            frozen_to_cue_ball=nothing_frozen,
            miscue=0,
            duration=0.0,
            first_contact_cue_ball=(math.nan, math.nan),
        )

    @classmethod
    def from_record(cls, record: Any) -> Self:
        """Facts from one row of a ``FACTS_DTYPE`` array, e.g. ``batch.facts[i]``."""
        return cls.from_words(np.frombuffer(record.tobytes(), np.int32))

    @classmethod
    def from_words(cls, words: NDArray[np.int32]) -> Self:
        """Facts from the ``FACTS_WORDS`` int32 that a kernel wrote."""
        whole = words[: layout.F_INTEGERS].tolist()
        duration, x, y = words.view(np.float64)[layout.F_DURATION :].tolist()
        fields: list[Any] = [whole[part][0] if single else tuple(whole[part]) for part, single in _PARTS]
        fields += [duration, (x, y)]
        return cls(*fields)

    @property
    def struck_first(self) -> tuple[int, ...]:
        """Balls the cue ball struck first, ascending; empty when it struck none."""
        return tuple([ball for ball, event in enumerate(self.first_contact) if event != NEVER])

    @property
    def pocketed_in_order(self) -> tuple[tuple[int, int, int], ...]:
        """(ball, pocket, event ordinal) of every pocketed ball, in order of events."""
        events = sorted((event, ball) for ball, event in enumerate(self.pocketed) if event != NEVER)
        return tuple((ball, self.pocket[ball], event) for event, ball in events)


_ENDS: Final = tuple(itertools.accumulate(layout.INTEGER_FACTS.values()))
_PARTS: Final = tuple(
    [(slice(end - size, end), size == 1) for size, end in zip(layout.INTEGER_FACTS.values(), _ENDS, strict=True)]
)
"""Where each integer fact stands, and whether it is one number."""
