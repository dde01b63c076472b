"""Two records of one shot side by side: how far they tell the same story, and how far apart they are."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from mpmath import mpf
from support.truth.engine import Record

UNRECORDED = ("contact", "settling")
"""Kinds that record the contact rule at work; the two engines need not write them alike."""

TIE = 1e-9
"""s; events this close may be recorded in either order."""


@dataclass(frozen=True)
class Happening:
    """An event reduced to what both engines write, with the balls' states as plain numbers."""

    time: mpf | float
    kind: str
    ball: int
    other: int
    states: dict[int, tuple[complex, complex]]
    settled: bool = False
    """Did the contact rule part or settle balls at the same time? Then the states are not those of the impact."""

    @property
    def key(self) -> tuple[str, int, int]:
        return self.kind, self.ball, self.other


def from_truth(records: Iterable[Record]) -> list[Happening]:
    known = list(records)
    settled = {r.time for r in known if r.kind in UNRECORDED}
    return [
        Happening(
            r.time,
            r.kind,
            r.ball,
            r.other,
            {b.number: (complex(b.position), complex(b.velocity)) for b in r.states},
            r.time in settled,
        )
        for r in known
        if r.kind not in UNRECORDED
    ]


def partners(one: Sequence[Happening], two: Sequence[Happening]) -> list[Happening]:
    """For each leading event of ``one`` its counterpart in ``two``; ends at the first that has none.

    The counterpart is the next unused event, or one recorded within TIE of it.
    """
    found: list[Happening] = []
    waiting = list(two)
    for event in one:
        near = [e for e in waiting if abs(e.time - waiting[0].time) <= TIE]
        same = [e for e in near if e.key == event.key and abs(e.time - event.time) < 1e-3]
        if not same:
            break
        waiting.remove(same[0])
        found.append(same[0])
    return found


def lone(events: Sequence[Happening], index: int) -> bool:
    """Is no other event within TIE of this one, and no contact settled?"""
    time = events[index].time
    return not events[index].settled and all(
        abs(e.time - time) > TIE for e in events[max(0, index - 1) : index + 2] if e is not events[index]
    )


def position_error(one: Happening, two: Happening) -> float:
    """Largest distance between the recorded positions (m)."""
    return max((abs(one.states[b][0] - two.states[b][0]) for b in one.states if b in two.states), default=0.0)


def velocity_error(one: Happening, two: Happening) -> float:
    """Largest difference of the recorded velocities (m/s)."""
    return max((abs(one.states[b][1] - two.states[b][1]) for b in one.states if b in two.states), default=0.0)
