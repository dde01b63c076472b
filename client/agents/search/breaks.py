"""The break: found once by a study, not searched for at the table."""

from dataclasses import dataclass, replace

import numpy as np

from client.geometry import Point, azimuth, is_free, lattice
from physics import Shot, Table, TableState, min_elevation
from physics.specifications import SIZES


@dataclass(frozen=True, slots=True)
class Break:
    """A break, described so that it can be played on any rack.

    Attributes:
        x, y: m, where the cue ball is put. v: m/s. aim: mm, how far beside the apex ball's centre, positive to the
            shooter's left. a, b: mm, tip offsets.
    """

    x: float
    y: float
    v: float
    aim: float
    a: float
    b: float

    @property
    def place(self) -> Point:
        """Where the cue ball is put."""
        return self.x, self.y

    def places(self, table: Table, state: TableState) -> list[Point]:
        """Where it can be played from: its own place, and if a ball lies there, others in the kitchen."""
        others = lattice(table, state, 7, 5, kitchen=True)
        return [self.place, *others] if is_free(table, state, self.place, kitchen=True) else others

    def stroke(self, table: Table, state: TableState) -> Shot:
        """The stroke on this rack; `state` has the cue ball in its place."""
        foot_x, foot_y = table.foot_spot
        place = state.position(0) or self.place
        phi = azimuth(place, (foot_x + 1e-3 * self.aim, foot_y))
        theta = min_elevation(table, state, phi, self.a, self.b)
        return Shot(min(self.v, table.v_max), phi, theta + 0.5, self.a, self.b)


BEST = {
    0.0: Break(x=0.3054, y=1.745, v=10.0, aim=28.32, a=-11.31, b=3.58),
    1.0: Break(x=0.2419, y=1.7003, v=6.58, aim=26.76, a=-9.81, b=13.79),
    5.0: Break(x=0.4601, y=1.679, v=6.8, aim=3.04, a=-3.16, b=14.27),
}
"""The best break by level of noise: `benchmarks/search_breaks.py`, line `search_breaks-20261122T024040`."""

BEST_BESIDE_JAWS = {
    1.0: Break(x=0.541, y=1.9525, v=12.0, aim=-5.33, a=-8.29, b=-0.05),
    5.0: Break(x=0.4511, y=1.9462, v=11.13, aim=-0.99, a=0.0, b=9.97),
}
"""The same on the nine-foot table: the best of 160, of which the last six were played 400 times."""

BREAKING = {
    False: {1.0: 0.69, 2.0: 0.58, 5.0: 0.52},
    True: {1.0: 0.46, 2.0: 0.52, 5.0: 0.52},
}
"""What a new rack is worth to the player who breaks it, by whether the table has jaws, and by level of noise: the share
of games won by the breaker, line `search_odds-20261130T200637`."""


def worth_of_breaking(table: Table, noise: float) -> float:
    """What a new rack is worth to the player who breaks it under a level of noise."""
    measured = BREAKING[table.has_jaws]
    levels = sorted(measured)
    return float(np.interp(noise, levels, [measured[level] for level in levels]))


def best_break(noise: float, table: Table) -> Break:
    """The break studied for the level nearest to this one, its place at the same share of the table's size."""
    studied = BEST_BESIDE_JAWS if table.has_jaws else BEST
    best = studied[min(studied, key=lambda level: abs(level - noise))]
    if not table.has_jaws:
        return best
    width, length = SIZES["nine_foot"]
    return replace(best, x=best.x * (table.width / width), y=best.y * (table.length / length))
