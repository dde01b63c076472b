"""What pockets open to balls at rest, remembered from one table to the next."""

from typing import Any, NamedTuple

import numpy as np

from client.agents.search.compiled.compiling import inner
from client.agents.search.compiled.fans import Fan, Lane, Layout, Way, beside, narrowed
from client.agents.search.compiled.lanes import opened, to_pocket
from client.agents.search.compiled.pots import usual

UX, UY, LOW, HIGH, RUN, LEFT_LOW, LEFT_HIGH, EASE = range(8)
"""Columns of a lane: unit; bounds of what the pocket takes, rad; length, m; bounds of what other balls leave of it;
chance of the pot from where good position play leaves the cue ball."""


class Memory(NamedTuple):
    """What pockets open to balls at rest: after most strokes most balls lie where they lay before.

    ``rest`` (16, 2) m, where; ``lanes`` (16, 6, 8), columns UX and its fellows; ``bounds`` (16, 6, 2), which balls
    narrow them, 0 for none; ``moved`` (16,), which balls lie elsewhere in the row at hand; ``movers`` (17,), the same
    as a list, its length first; ``offers`` (2, 5) and ``needs`` (2,), of both groups in the row at hand.
    """

    rest: Any
    lanes: Any
    bounds: Any
    moved: Any
    movers: Any
    offers: Any
    needs: Any


def new_memory():
    """Nothing known yet: no ball lies at rest."""
    return Memory(
        rest=np.full((16, 2), np.nan),
        lanes=np.zeros((16, 6, 8)),
        bounds=np.zeros((16, 6, 2), np.int64),
        moved=np.zeros(16, np.bool_),
        movers=np.zeros(17, np.int64),
        offers=np.zeros((2, 5)),
        needs=np.zeros(2),
    )


@inner
def is_elsewhere(one, other, ball):
    """Whether a ball lies elsewhere in two rows, or is absent from one of them."""
    x, y, u, v = one[ball, 0], one[ball, 1], other[ball, 0], other[ball, 1]
    return (x != u or y != v) and (x == x or u == u)


@inner
def learn_lane(view, memory, ball, pocket, sigma):
    """What a pocket opens to a ball at rest, and which balls narrow it."""
    lane = opened(view, ball, pocket)
    low, high, fan = 0, 0, lane.fan
    if fan.low < fan.high and lane.run > 0.0:
        way = Way(view.row[ball, 0], view.row[ball, 1], lane.ux, lane.uy, lane.run)
        for other in range(1, 16):
            if other == ball:
                continue
            left = beside(view, other, way, fan, 1.0)
            if left.low >= left.high:
                low, high, fan = other, other, Fan(0.0, 0.0)
                break
            if left.low != fan.low:
                low = other
            if left.high != fan.high:
                high = other
            fan = left
    kept = memory.lanes[ball, pocket]
    kept[UX], kept[UY], kept[LOW], kept[HIGH], kept[RUN] = lane.ux, lane.uy, lane.fan.low, lane.fan.high, lane.run
    kept[LEFT_LOW], kept[LEFT_HIGH] = fan
    kept[EASE] = usual(view.table, fan, sigma) if fan.low < fan.high else 0.0
    memory.bounds[ball, pocket, 0], memory.bounds[ball, pocket, 1] = low, high


@inner
def remember(table, memory, before, row, sigma):
    """Learn where balls lay before a stroke, if that is new, and which of them it moved."""
    new = False
    for ball in range(1, 16):
        new = new or is_elsewhere(memory.rest, before, ball)
    if new:
        for ball in range(16):
            memory.rest[ball, 0], memory.rest[ball, 1] = before[ball, 0], before[ball, 1]
        for ball in range(1, 16):
            if before[ball, 0] == before[ball, 0]:
                for pocket in range(6):
                    learn_lane(Layout(table, memory.rest), memory, ball, pocket, sigma)
    count = 0
    for ball in range(1, 16):
        memory.moved[ball] = is_elsewhere(memory.rest, row, ball)
        if memory.moved[ball]:
            count += 1
            memory.movers[count] = ball
    memory.movers[0] = count


@inner
def lane_now(view, memory, ball, pocket):
    """`to_pocket`, from memory as far as it goes; and whether it is as it was."""
    if memory.moved[ball]:
        return to_pocket(view, ball, pocket), False
    kept = memory.lanes[ball, pocket]
    fan = Fan(kept[LEFT_LOW], kept[LEFT_HIGH])
    if kept[LOW] >= kept[HIGH] or kept[RUN] == 0.0:
        return Lane(kept[UX], kept[UY], fan, kept[RUN]), True
    way = Way(view.row[ball, 0], view.row[ball, 1], kept[UX], kept[UY], kept[RUN])
    bounds = memory.bounds[ball, pocket]
    if memory.moved[bounds[0]] or memory.moved[bounds[1]]:
        return Lane(kept[UX], kept[UY], narrowed(view, ball, 0, way, Fan(kept[LOW], kept[HIGH]), 1.0), kept[RUN]), False
    for place in range(1, memory.movers[0] + 1):
        if fan.low < fan.high:
            fan = beside(view, memory.movers[place], way, fan, 1.0)
    same = fan.low == kept[LEFT_LOW] and fan.high == kept[LEFT_HIGH]
    return Lane(kept[UX], kept[UY], fan, kept[RUN]), same
