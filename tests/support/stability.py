"""How far a shot's story is decided by its doubles: the truth beside truths with v and phi moved by one ulp."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from support.compare import Happening, from_truth, partners
from support.truth.engine import play
from support.truth.model import World
from support.truth.strike import Stroke

Positions = Mapping[int, tuple[float, float]]


@dataclass(frozen=True)
class Told:
    """The true events up to the first that one ulp changes, and by how much one ulp moves each in time (s)."""

    events: list[Happening]
    whole: bool
    sensitivity: list[float]


def nudged(stroke: Stroke) -> list[Stroke]:
    """v and phi one ulp up and down, together and against each other; near 0 that of a right angle."""
    turn = math.ulp(max(abs(stroke.phi), 90.0))
    return [
        replace(stroke, v=math.nextafter(stroke.v, math.inf), phi=stroke.phi + turn),
        replace(stroke, v=math.nextafter(stroke.v, 0.0), phi=stroke.phi + turn),
    ]


def told(positions: Positions, stroke: Stroke, world: World, *, digits: int = 50, max_events: int = 10_000) -> Told:
    """The stable beginning of a shot."""
    options = {"digits": digits, "max_events": max_events}
    records = play(positions, stroke, world, **options).records
    events = from_truth(records)
    stable, moved = len(events), [0.0] * len(events)
    for other in nudged(stroke):
        also = partners(events, from_truth(play(positions, other, world, **options).records))
        stable = min(stable, len(also))
        for k, event in enumerate(also):
            moved[k] = max(moved[k], float(abs(event.time - events[k].time)))
    return Told(events[:stable], stable == len(events) and len(records) < max_events, moved[:stable])
