"""What a pocket opens to an object ball: straight mouths, and entrances between jaws."""

import math

from client.agents.search import shots as at
from client.agents.search.compiled.compiling import inner
from client.agents.search.compiled.fans import Fan, Lane, Way, narrowed

STEPS, CLOSE = 20, 1e-6
"""Most steps of the search for the edge of an entrance, and its precision in metres; four to six steps are usual."""
NARROWEST, WIDEST = 5e-5, 1.0
"""rad to either side: an entrance that is narrower is closed; a ball that hangs in the jaws may go anywhere."""


@inner
def offset_of(table, edges, first, step, count, angle):
    """An edge of an entrance in a direction, between those that are known."""
    place = min(max((angle - first) / step, 0.0), count - 1.0)
    before = min(int(place), count - 2)
    share = place - before
    return (1.0 - share) * table[edges + before] + share * table[edges + before + 1]


@inner
def edge_of(table, entrance, edges, bearing, far):
    """The direction along one edge of an entrance, as `client.geometry.openings` finds it: rad from the axis."""
    first, step, count = table[entrance + at.FIRST], table[entrance + at.STEP], int(table[entrance + at.COUNT])
    turn = math.asin(min(1.0, table[entrance + at.REACH] / far))
    left, right = bearing - turn, bearing + turn
    before = far * math.sin(left - bearing) - offset_of(table, edges, first, step, count, left)
    after = far * math.sin(right - bearing) - offset_of(table, edges, first, step, count, right)
    for _ in range(STEPS):  # regula falsi; an end that stays counts half (the Illinois rule)
        if before >= 0.0 or after <= 0.0 or right - left < NARROWEST:
            break
        middle = (left * after - right * before) / (after - before)
        aside = far * math.sin(middle - bearing) - offset_of(table, edges, first, step, count, middle)
        if abs(aside) < CLOSE:
            return middle
        if aside < 0.0:
            left, before, after = middle, aside, 0.5 * after
        else:
            right, after, before = middle, aside, 0.5 * before
    return 0.5 * (left + right)


@inner
def between_jaws(view, ball, place):
    """`opened` on a table with jaws: the middle of the directions in which the ball falls, and half of them."""
    table = view.table
    entrance = int(table[place + at.ENTRANCE])
    x, y = view.row[ball, 0], view.row[ball, 1]
    in_x, in_y = -table[place + at.INWARD_X], -table[place + at.INWARD_Y]
    dx, dy = table[place + at.HOLE_X] - x, table[place + at.HOLE_Y] - y
    bearing = math.atan2(in_x * dy - in_y * dx, in_x * dx + in_y * dy)
    far = math.sqrt(dx * dx + dy * dy)
    low = edge_of(table, entrance, entrance + at.EDGES, bearing, far)
    high = edge_of(table, entrance, entrance + at.EDGES + int(table[entrance + at.COUNT]), bearing, far)
    half = min(0.5 * (high - low), WIDEST)
    turn = 0.5 * (low + high)
    c, s = math.cos(turn), math.sin(turn)
    ux, uy = c * in_x - s * in_y, s * in_x + c * in_y
    if half <= NARROWEST:
        return Lane(ux, uy, Fan(0.0, 0.0), 0.0)
    run = max((table[place + at.MOUTH_X] - x) * ux + (table[place + at.MOUTH_Y] - y) * uy, table[at.RADIUS])
    return Lane(ux, uy, Fan(-half, half), run)


@inner
def opened(view, ball, pocket):
    """The lane that a pocket opens to an object ball, whatever lies beside it; its fan is closed if none is open."""
    table = view.table
    place = at.MOUTHS + at.PER_POCKET * pocket
    x, y = view.row[ball, 0], view.row[ball, 1]
    if table[place + at.ENTRANCE] > 0.0:
        return between_jaws(view, ball, place)
    dx, dy = table[place + at.MOUTH_X] - x, table[place + at.MOUTH_Y] - y
    run = math.sqrt(dx * dx + dy * dy)
    if run < 1e-9:
        return Lane(1.0, 0.0, Fan(-1.0, 1.0), 0.0)
    ux, uy = dx / run, dy / run
    facing = -(ux * table[place + at.INWARD_X] + uy * table[place + at.INWARD_Y])
    if facing <= 0.05:
        return Lane(ux, uy, Fan(0.0, 0.0), run)
    bound = math.atan2(table[place + at.HALF_MOUTH] * facing, run)
    return Lane(ux, uy, Fan(-bound, bound), run)


@inner
def unblocked(view, ball, lane):
    """A lane narrowed by the balls beside it."""
    if lane.fan.low >= lane.fan.high or lane.run == 0.0:
        return lane
    way = Way(view.row[ball, 0], view.row[ball, 1], lane.ux, lane.uy, lane.run)
    return Lane(lane.ux, lane.uy, narrowed(view, ball, 0, way, lane.fan, 1.0), lane.run)


@inner
def to_pocket(view, ball, pocket):
    """The lane of an object ball into a pocket; its fan is closed if it is blocked."""
    return unblocked(view, ball, opened(view, ball, pocket))
