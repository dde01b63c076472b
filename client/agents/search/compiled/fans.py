"""A fan is what bounds an angle of error: the balls beside a way narrow it, and what it takes gives the chance."""

import math
from typing import Any, NamedTuple

from client.agents.search import shots as at
from client.agents.search.compiled.compiling import inner


class Layout(NamedTuple):
    """One table: ``table``, its numbers (`engine.table_row`), and ``row`` (16, 2) m, where its balls lie."""

    table: Any
    row: Any


class Way(NamedTuple):
    """A ball's straight way from (x, y), m, along the unit (ux, uy) for `run`, m."""

    x: float
    y: float
    ux: float
    uy: float
    run: float


class Fan(NamedTuple):
    """Bounds on an angle, rad, left positive; low = high: closed."""

    low: float
    high: float


class Lane(NamedTuple):
    """The way of an object ball into a pocket: unit (ux, uy), by how much it may turn, and how far it is, m."""

    ux: float
    uy: float
    fan: Fan
    run: float


@inner
def normal_between(fan, sigma):
    """Chance that a normal error of standard deviation `sigma` lies within the fan."""
    if fan.low >= fan.high:
        return 0.0
    scale = 1.0 / (sigma * math.sqrt(2.0))
    return 0.5 * (math.erf(fan.high * scale) - math.erf(fan.low * scale))


@inner
def turned_by(fan, gain):
    """The fan of the cue ball's direction whose errors, times -`gain`, turn the object ball within `fan`."""
    return Fan(-fan.high / gain, -fan.low / gain)


@inner
def half_of(fan):
    """Half of what a fan takes."""
    return 0.5 * (fan.high - fan.low)


@inner
def even_of(fan):
    """What a fan takes to either side alike: one that takes no more in all is no likelier."""
    return min(-fan.low, fan.high)


@inner
def beside(view, other, way, fan, gain):
    """A fan narrowed by a ball beside a way; turning the way by e moves it at distance s by s gain e.

    A negative `gain` turns the other way. Low = high: the ball lies in the way.
    """
    dx, dy = view.row[other, 0] - way.x, view.row[other, 1] - way.y
    along, aside = dx * way.ux + dy * way.uy, way.ux * dy - way.uy * dx  # aside is positive to the left
    reach = 2.0 * view.table[at.RADIUS]
    wide = max(fan.high, -fan.low) * abs(gain)
    # One test that most balls fail, absent ones (NaN) too: processors guess it, and the others would cost as much each.
    if not ((along > 0.0) & (along < way.run + reach) & (abs(aside) < reach + wide * along)):
        return fan
    room = reach
    if along > way.run:
        over = along - way.run
        room = math.sqrt(reach * reach - over * over)
        along = way.run
    gap = abs(aside) - room
    if gap <= 0.0:
        return Fan(0.0, 0.0)
    bound = gap / (along * abs(gain))
    if (aside > 0.0) == (gain > 0.0):
        return Fan(fan.low, min(fan.high, bound))
    return Fan(max(fan.low, -bound), fan.high)


@inner
def narrowed(view, ball, skip, way, fan, gain):
    """A fan narrowed by all balls beside a way but `ball` and `skip`."""
    for other in range(16):
        if other != ball and other != skip:
            fan = beside(view, other, way, fan, gain)
            if fan.low >= fan.high:
                return Fan(0.0, 0.0)
    return fan
