"""What the first samples of a shot say about its start: where balls lay, which moved, how the cue ball was struck."""

import numpy as np

from calibration.observed import Floats, ObservedShot
from physics import Table
from physics.cue_ball import struck_ball

MOVED = 6.0
"""Standard deviations off where it lay that make a ball a moving one."""
FIRST_SAMPLES = (3, 4, 6, 9)
"""Samples of the struck ball that its first velocity is read from: as many as one parabola fits."""


def places_at_rest(shot: ObservedShot, ball: int, sigma: float) -> tuple[Floats, int]:
    """Where a ball lay, (2,) m, and the number of its samples before it moved; all of them if it never does."""
    places = shot.places[shot.of_ball(ball)]
    lay = places[0]
    for number in range(1, len(places)):
        reach = MOVED * sigma * np.sqrt(1.0 + 1.0 / number)
        aside = np.abs(places[number : number + 2] - lay).max(axis=1)
        if (aside > reach).all():  # twice in a row: one alone may be an outlier
            return lay, number
        lay = np.median(places[: number + 1], axis=0)
    return lay, len(places)


def first_velocity(times: Floats, places: Floats, sigma: float) -> Floats:
    """(2,) m/s at time 0 of a ball that starts then: of the longest run of first samples that one parabola fits."""
    velocity: Floats = (places[-1] - places[0]) / (times[-1] - times[0])
    for n in FIRST_SAMPLES:
        if n > len(times):
            break
        degree = 1 if n < 4 else 2
        powers = np.vander(times[:n], degree + 1, increasing=True)
        found, *_ = np.linalg.lstsq(powers, places[:n], rcond=None)
        off = powers @ found - places[:n]
        if n > FIRST_SAMPLES[0] and np.abs(off).max() > 4.0 * sigma:
            break
        velocity = found[1]
    return velocity


def stroke_for(table: Table, velocity: Floats) -> tuple[float, float]:
    """(v m/s, phi deg) of a level stroke through the centre that gives the cue ball this velocity."""
    per_speed = float(struck_ball(table, [[1.0, 0.0, 0.0, 0.0, 0.0]]).speed[0])
    speed = float(np.hypot(*velocity)) / per_speed
    return min(max(speed, 0.05), 0.98 * table.v_max), float(np.degrees(np.arctan2(velocity[1], velocity[0])))
