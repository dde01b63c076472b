"""Samples put together: the shots of a session, each with its paths and its stroke."""

from collections.abc import Mapping

import numpy as np

from calibration.errors import InvalidData
from calibration.fields import Row
from calibration.frames import Frame
from calibration.observed import IntendedStroke, Observations, ObservedShot, share_off
from physics import Table

LEAST_SAMPLES = 4
"""Samples of the cue ball in a shot."""
LONGEST_SHOT = 300.0
"""s. No shot lasts a minute; more is a wrong unit, or two shots of one name."""
MOST_OFF = 0.2
"""Part of the samples that may lie off the table; more are a wrong unit or frame."""


def assembled(
    name: str, frame: Frame, rows: list[tuple[str, Row]], intended: Mapping[str, IntendedStroke], table: Table
) -> Observations:
    """The shots in the order of their first samples."""
    by_shot: dict[str, dict[tuple[float, int], tuple[float, float, float]]] = {}
    for where, (shot, t, ball, x, y, z) in rows:
        samples = by_shot.setdefault(shot, {})
        if (t, ball) in samples:
            raise InvalidData(f"{where}, column t", t, f"must differ: ball {ball} was seen at this time already")
        samples[t, ball] = x, y, z
    if not by_shot:
        raise InvalidData(name, "no samples", "must have at least one shot")
    shots = tuple(
        _shot(name, shot, samples, frame, table, intended.get(shot, IntendedStroke()))
        for shot, samples in by_shot.items()
    )
    off = share_off(table, shots)
    if off > MOST_OFF:
        allowed = f"must fit the table {table.name}: {100.0 * off:.0f} % of the places lie off it; see unit and frame"
        raise InvalidData(f"{name}, x and y", "unit or frame", allowed)
    return Observations(shots, frame.sigma, frame.strike_known)


def _shot(
    name: str,
    shot: str,
    samples: Mapping[tuple[float, int], tuple[float, float, float]],
    frame: Frame,
    table: Table,
    stroke: IntendedStroke,
) -> ObservedShot:
    keys = sorted(samples)
    places = np.array([samples[key] for key in keys])
    times = frame.time * np.array([t for t, _ in keys])
    balls = np.array([ball for _, ball in keys])
    seen = int((balls == 0).sum())
    if seen < LEAST_SAMPLES:
        raise InvalidData(f"{name}, shot {shot}", seen, f"must have at least {LEAST_SAMPLES} samples of the cue ball")
    if (lasts := float(times[-1] - times[0])) > LONGEST_SHOT:
        allowed = f"must last at most {LONGEST_SHOT:g} s from its first sample to its last; see the unit of time"
        raise InvalidData(f"{name}, shot {shot}", f"{lasts:g} s", allowed)
    heights = frame.length * places[:, 2]
    return ObservedShot(shot, times, balls, frame.places(table, places[:, :2]), heights, stroke)
