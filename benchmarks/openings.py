"""What pockets with jaws let in, and how much of it `client.geometry.opening` promises.

A lone ball is rolled from places all over the table towards a pocket, in steps of 0.05 degrees. `covered`: share of the
directions that fall which lie in the opening; `broken`: share of the opening that does not fall; by kind of pocket, by
whether the ball is frozen to a cushion, and by its speed at the mouth.
"""

import math
from collections import defaultdict

import numpy as np
from numpy.typing import NDArray

import physics
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from client import geometry
from client.geometry.openings import SIDES
from physics.cue_ball import struck_ball
from physics.real_table import RealTable

SEED = 5
SPEEDS = (0.8, 1.0, 2.0, 3.0, 4.0, 5.0)
"""m/s at the mouth."""
STEP, AROUND = 0.05, 15.0
"""deg between directions, and to either side of the opening's middle."""
PLACES, FEW = 400, 40
TABLES = {
    "nine_foot": physics.Table.nine_foot(),
    "seven_foot": physics.Table.seven_foot(),
    "nine_foot, mathavan": physics.Table.nine_foot().replace(cushion="mathavan"),
}


def measure(full: bool) -> Tables:
    """Every table."""
    return {"openings": [row for name in TABLES for row in of_table(name, PLACES if full else FEW)]}


def of_table(name: str, count: int) -> list[Row]:
    """One table, from so many places; every fourth is at the west cushion."""
    table, chance = TABLES[name], np.random.default_rng(SEED)
    assert isinstance(table, RealTable)
    sums: dict[tuple[str, bool, float], NDArray[np.float64]] = defaultdict(lambda: np.zeros(4))
    nose = table.contact_distance + 1e-6
    for number in range(count):
        frozen, pocket = number % 4 == 0, int(chance.integers(6))
        x, y = (float(chance.uniform(nose, extent - nose)) for extent in (table.width, table.length))
        place = (nose if frozen else x, y)
        kind = "side" if pocket in SIDES else "corner"
        for speed in SPEEDS:
            sums[kind, frozen, speed] += counted(table, place, pocket, speed)
    return [
        {
            "table": name,
            "pocket": kind,
            "frozen": frozen,
            "speed": speed,
            "falls_deg": round(STEP * fell / places, 3),
            "covered": round(covered / max(1.0, fell), 4),
            "broken": round(broken / max(1.0, covered + broken), 4),
        }
        for (kind, frozen, speed), (fell, covered, broken, places) in sorted(sums.items())
    ]


def counted(table: RealTable, place: geometry.Point, pocket: int, speed: float) -> NDArray[np.float64]:
    """Directions that fall, of them in the opening, in the opening but not falling; and 1 for the place."""
    opening = geometry.opening(table, place, pocket)
    run = geometry.distance(place, opening.target)
    off = np.arange(-AROUND, AROUND + 0.5 * STEP, STEP)
    shots = np.zeros((len(off), 5))
    shots[:, 1], shots[:, 4] = geometry.azimuth(place, opening.target) + off, 0.4e3 * table.ball_radius
    per_cue_speed = struck_ball(table, [[1.0, 0.0, 0.0, 0.0, shots[0, 4]]]).speed[0]
    shots[:, 0] = math.sqrt(speed * speed + 2.0 * table.mu_roll * table.gravity * run) / per_cue_speed
    positions = np.full((len(off), 16, 2), np.nan)
    positions[:, 0] = place
    batch = physics.simulate_batch(table.replace(cue_test=False), positions, shots)
    fell = batch.pocket[:, 0] == pocket
    inside = np.abs(off) < math.degrees(math.atan2(opening.room, run)) if opening.room else np.zeros(len(off), bool)
    return np.array([fell.sum(), (fell & inside).sum(), (inside & ~fell).sum(), 1.0])


if __name__ == "__main__":
    main("openings", measure)
