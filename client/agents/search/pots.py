"""Straight pots in many ways: soft and hard, with follow, draw and side, so that the cue ball has somewhere to go."""

import math

import numpy as np

from client.agents.search.shots import Floats, Shots, Tables
from client.agents.search.sight import Pots

SLOWEST, FASTEST = 0.45, 5.0
"""m/s of the cue: enough for a short pot; enough for the cue ball to travel the table twice."""
FOLLOW, SIDE = 14.0, 10.0
"""mm: greatest tip offsets up and down, and to either side. The tip leaves the ball at 28.6."""
STEPS = (0.8191725133961645, 0.6710436067037893, 0.5497004779019703)
"""Powers of 1/1.2207..., the plastic number's cousin: Roberts' additive sequence fills three dimensions evenly."""
STRAIGHT_SHARE = 0.4
"""Share of the ways without side: it costs margin, and is wanted for the angle off a cushion alone."""


def ways(count: int) -> Floats:
    """`count` ways to strike, (count, 3): cue speed m/s, side mm, height mm; evenly spread, the same every time."""
    number = np.arange(count)[:, None]
    spread = (0.5 + number * np.array(STEPS)[None, :]) % 1.0
    speed = np.exp(math.log(SLOWEST) + spread[:, 0] * math.log(FASTEST / SLOWEST))
    height = FOLLOW * (2.0 * spread[:, 1] - 1.0)
    aside = 2.0 * spread[:, 2] - 1.0
    side = SIDE * np.sign(aside) * np.maximum(0.0, np.abs(aside) - STRAIGHT_SHARE) / (1.0 - STRAIGHT_SHARE)
    return np.stack((speed, side, height), axis=1)


def in_all_ways(tables: Tables, pots: Pots, count: int) -> Shots:
    """Every listed pot in `count` ways."""
    most = pots.chance.shape[1]
    pot = np.repeat(np.flatnonzero(pots.chance.reshape(-1) > 0.0), count)
    speed, side, height = np.tile(ways(count), (len(pot) // count, 1)).T
    phi, margin = pots.phi.reshape(-1)[pot], pots.margin.reshape(-1)[pot]
    strokes = np.stack((speed, phi, np.zeros(len(pot)), side, height), axis=1)
    return Shots(tables, pot // most, strokes, pots.ball.reshape(-1)[pot], pots.pocket.reshape(-1)[pot], margin)
