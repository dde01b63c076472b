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


STUDIED = {
    False: {
        0.0: Break(x=0.3054, y=1.745, v=10.0, aim=28.32, a=-11.31, b=3.58),
        0.5: Break(x=0.3133, y=1.7481, v=10.0, aim=28.31, a=-9.84, b=2.81),
        1.0: Break(x=0.2419, y=1.7003, v=6.58, aim=26.76, a=-9.81, b=13.79),
        2.0: Break(x=0.419, y=1.8191, v=7.52, aim=17.59, a=-1.33, b=13.07),
        5.0: Break(x=0.4455, y=1.6855, v=6.69, aim=2.79, a=-1.42, b=15.14),
    },
    True: {
        0.5: Break(x=0.198, y=1.9536, v=9.0, aim=-26.25, a=-7.44, b=-7.89),
        1.0: Break(x=0.18, y=1.955, v=9.28, aim=-22.6, a=-8.82, b=-9.29),
        2.0: Break(x=0.1459, y=1.9771, v=12.0, aim=-32.05, a=-6.48, b=-9.97),
        5.0: Break(x=0.1108, y=1.9812, v=12.0, aim=-31.55, a=-7.93, b=-9.06),
    },
}
"""The best break by whether the table has jaws, and by level of noise: `benchmarks/search_breaks.py`, line
`search_breaks-20261201T001527`, on the Olympiad and nine-foot tables; noise 0 is from line
`search_breaks-20261122T024040`."""

BREAKING = {
    False: {1.0: 0.69, 2.0: 0.58, 5.0: 0.52},
    True: {0.5: 0.58, 1.0: 0.55, 2.0: 0.51, 5.0: 0.50},
}
"""What a new rack is worth to the player who breaks it, by whether the table has jaws, and by level of noise. Without:
the share of games won by the breaker, line `search_odds-20261130T200637`; with: the worth of the studied break."""


def worth_of_breaking(table: Table, noise: float) -> float:
    """What a new rack is worth to the player who breaks it under a level of noise."""
    measured = BREAKING[table.has_jaws]
    levels = sorted(measured)
    return float(np.interp(noise, levels, [measured[level] for level in levels]))


def best_break(noise: float, table: Table) -> Break:
    """The break studied for the level nearest to this one, its place at the same share of the table's size."""
    studied = STUDIED[table.has_jaws]
    best = studied[min(studied, key=lambda level: abs(level - noise))]
    if not table.has_jaws:
        return best
    width, length = SIZES["nine_foot"]
    return replace(best, x=best.x * (table.width / width), y=best.y * (table.length / length))
