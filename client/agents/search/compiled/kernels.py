"""Compiled plane geometry for thousands of tables at once: chances of straight pots, elevations of the cue.

The chance of a pot is that the error of the cue's direction, normal with standard deviation `sigma`, stays between two
bounds: where the object ball meets the edge of the mouth, and where either ball touches another on its way. With a path
d of the cue ball, an error e moves its place at contact by d e, which turns the object ball by d e / (2 R cos(cut)).

Every array is C-contiguous float64 or int64; `positions` is (n, 16, 2) m with NaN for absent balls, `table` what
`client.agents.search.engine.table_row` makes. Loaded by that module alone: importing this one needs the compiler.
"""

import math
from typing import Any, NamedTuple

import numba
import numpy as np

from client.agents.search import shots as at

STEEPEST = math.cos(math.radians(83.0))
"""Cosine of the thinnest cut worth a thought: beyond it a tenth of a degree misses the ball."""
USUAL_REACH, USUAL_CUT = 0.5, math.cos(math.radians(25.0))
"""A ball's own difficulty is its pot from half a metre at 25 degrees: what good position play leaves."""
PLACED_REACH = 0.25
"""m: with the cue ball in hand it is put this far behind the ghost ball."""
BLOCKED = 0.8
"""Chance that a ball no pocket is open for will be made when its turn comes: others move by then, or it is banked."""

STEPS, CLOSE = 20, 1e-6
"""Most steps of the search for the edge of an entrance, and its precision in metres; four to six steps are usual."""
NARROWEST, WIDEST = 5e-5, 1.0
"""rad to either side: an entrance that is narrower is closed; a ball that hangs in the jaws may go anywhere."""

BARE = {"error_model": "numpy", "nogil": True, "_nrt": False}
"""Nothing is allocated here, so nobody has to count who holds an array: counting took more time than the geometry."""
compiled = numba.njit(cache=bool(numba.config.CACHE_DIR), **BARE)
inner = numba.njit(no_cpython_wrapper=True, no_cfunc_wrapper=True, **BARE)


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


UX, UY, LOW, HIGH, RUN, LEFT_LOW, LEFT_HIGH, EASE = range(8)
"""Columns of a lane: unit; bounds of what the pocket takes, rad; length, m; bounds of what other balls leave of it;
chance of the pot from where good position play leaves the cue ball."""


class Task(NamedTuple):
    """What to find about a group: whether its player shoots next, with the cue ball in hand, from which y on."""

    shoots: bool
    hand: bool
    kitchen: float


class LevelCue(NamedTuple):
    """A level cue along (ux, uy); seen from the cue ball's centre its tip is `depth` back and `tip` up, m."""

    ux: float
    uy: float
    depth: float
    tip: float
    length: float


@inner
def normal_between(fan, sigma):
    """Chance that a normal error of standard deviation `sigma` lies within the fan."""
    if fan.low >= fan.high:
        return 0.0
    scale = 1.0 / (sigma * math.sqrt(2.0))
    return 0.5 * (math.erf(fan.high * scale) - math.erf(fan.low * scale))


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
def straight(view, ball, lane, least):
    """A pot from where the cue ball lies: its direction, rad, and the fan of errors that still pot it.

    The fan is closed when it cannot be played, and when half of it is no more than `least` to begin with.
    """
    row, radius = view.row, view.table[at.RADIUS]
    gx, gy = row[ball, 0] - 2.0 * radius * lane.ux, row[ball, 1] - 2.0 * radius * lane.uy
    dx, dy = gx - row[0, 0], gy - row[0, 1]
    reach = math.sqrt(dx * dx + dy * dy)
    if reach < 1e-6:
        return math.atan2(lane.uy, lane.ux), Fan(-0.05, 0.05)
    vx, vy = dx / reach, dy / reach
    cut = vx * lane.ux + vy * lane.uy
    if cut < STEEPEST:
        return 0.0, Fan(0.0, 0.0)
    gain = reach / (2.0 * radius * cut)
    fan = turned_by(lane.fan, gain)
    if half_of(fan) <= least:
        return 0.0, Fan(0.0, 0.0)
    return math.atan2(vy, vx), narrowed(view, 0, ball, Way(row[0, 0], row[0, 1], vx, vy, reach), fan, 1.0)


@inner
def is_seen(view, ball):
    """Whether the cue ball can strike `ball` straight, on either of its halves or full."""
    row = view.row
    dx, dy = row[ball, 0] - row[0, 0], row[ball, 1] - row[0, 1]
    far = math.sqrt(dx * dx + dy * dy)
    ux, uy = dx / far, dy / far
    side = 1.4 * view.table[at.RADIUS]
    for offset in (0.0, side, -side):
        tx, ty = dx - offset * uy, dy + offset * ux
        run = math.sqrt(tx * tx + ty * ty)
        fan = narrowed(view, 0, ball, Way(row[0, 0], row[0, 1], tx / run, ty / run, run), Fan(-1.0, 1.0), 1.0)
        if fan.low < fan.high:
            return True
    return False


@inner
def is_place(view, x, y, kitchen):
    """Whether the cue ball can be put there (mouths aside, where no pot starts), `kitchen` the least y."""
    table, row = view
    radius = table[at.RADIUS]
    if x < radius or x > table[at.WIDTH] - radius or y < max(radius, kitchen) or y > table[at.LENGTH] - radius:
        return False
    for other in range(1, 16):
        dx, dy = row[other, 0] - x, row[other, 1] - y
        if dx * dx + dy * dy <= 4.0 * radius * radius + 1e-9:
            return False
    return True


@inner
def placed(view, ball, lane, least, kitchen):
    """The widest fan of a pot with the cue ball in hand, from straight behind or a little to either side.

    Closed when half of none is more than `least`.
    """
    row, radius, best = view.row, view.table[at.RADIUS], Fan(0.0, 0.0)
    gx, gy = row[ball, 0] - 2.0 * radius * lane.ux, row[ball, 1] - 2.0 * radius * lane.uy
    for turn in (0.0, 0.5, -0.5):
        c, s = math.cos(turn), math.sin(turn)
        gain = PLACED_REACH / (2.0 * radius * c)
        fan = turned_by(lane.fan, gain)
        if half_of(fan) <= max(least, even_of(best)):
            continue
        vx, vy = c * lane.ux - s * lane.uy, s * lane.ux + c * lane.uy
        x, y = gx - PLACED_REACH * vx, gy - PLACED_REACH * vy
        if is_place(view, x, y, kitchen):
            fan = narrowed(view, 0, ball, Way(x, y, vx, vy, PLACED_REACH), fan, 1.0)
            if even_of(fan) > even_of(best):
                best = fan
    return best


@inner
def usual(table, fan, sigma):
    """Chance of a pot from where good position play leaves it; the object ball may leave within `fan`."""
    gain = USUAL_REACH / (2.0 * table[at.RADIUS] * USUAL_CUT)
    return normal_between(Fan(fan.low / gain, fan.high / gain), sigma)


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


@inner
def survey_ball(view, memory, ball, sigma, task, out):
    """Add one ball to what is known of its group: its difficulty, and if its player shoots next, best pots."""
    easy, even = 0.0, 0.0
    column = at.PLACED if task.hand else at.CHANCE
    for pocket in range(6):
        lane, same = lane_now(view, memory, ball, pocket)
        if lane.fan.low >= lane.fan.high:
            continue
        if same:
            easy = max(easy, memory.lanes[ball, pocket, EASE])
        elif half_of(lane.fan) > even:  # else it is no easier than another
            chance = usual(view.table, lane.fan, sigma)
            if chance > easy:
                easy, even = chance, even_of(lane.fan)
        if not task.shoots:
            continue
        if task.hand:
            fan = placed(view, ball, lane, out[at.EVEN], task.kitchen)
        else:
            _, fan = straight(view, ball, lane, out[at.EVEN])
        if half_of(fan) > out[at.EVEN]:
            chance = normal_between(fan, sigma)
            if chance > out[column]:
                out[column], out[at.EVEN] = chance, max(out[at.EVEN], even_of(fan))
    out[at.LAYOUT] -= math.log(max(easy, BLOCKED))
    if task.shoots and not task.hand and out[at.SEEN] == 0.0 and (out[at.CHANCE] > 0.0 or is_seen(view, ball)):
        out[at.SEEN] = 1.0


@inner
def survey_group(view, memory, group, sigma, task, out):
    """What the balls of a group offer; the 8 counts as one to be made later, and at once if no other is left."""
    out[:] = 0.0
    left = 0
    for ball in range(1 + 8 * group, 8 + 8 * group):
        if view.row[ball, 0] == view.row[ball, 0]:
            left += 1
            survey_ball(view, memory, ball, sigma, task, out)
    if view.row[8, 0] == view.row[8, 0]:
        survey_ball(view, memory, 8, sigma, Task(task.shoots and left == 0, task.hand, task.kitchen), out)
        left += 1
    return left


@compiled
def survey(table, positions, sigma, hand, kitchen, memory, out):
    """What the balls offer to whoever shoots next, by group.

    Args:
        sigma: rad, of the cue's direction.
        hand: (n,) whether the cue ball is in hand. kitchen: the least y it may have then.
        memory: `new_memory`.
        out: (n, 2, 5), solids and stripes; see CHANCE and its fellows.
    """
    for n in range(positions.shape[0]):
        view = Layout(table, positions[n])
        remember(table, memory, positions[n], positions[n], sigma)
        for group in range(2):
            survey_group(view, memory, group, sigma, Task(True, hand[n], kitchen), out[n, group])


@inner
def looked_up(values, row, column):
    """A table's value between its entries, bilinear; beyond its edges the edge's."""
    most = values.shape[0] - 1
    row, column = min(max(row, 0.0), float(most)), min(max(column, 0.0), float(most))
    i, j = min(int(row), most - 1), min(int(column), most - 1)
    s, t = row - i, column - j
    low = (1.0 - t) * values[i, j] + t * values[i, j + 1]
    high = (1.0 - t) * values[i + 1, j] + t * values[i + 1, j + 1]
    return (1.0 - s) * low + s * high


@compiled
def shooter(race, needs, other, chance, seen):
    """The shooter's chance to win the game.

    Args:
        race: (4, m, m), the values of `client.agents.search.race.Race`.
        needs, other: perfect balls that the shooter and the opponent need, >= 0, the 8 included.
        chance: of the shooter's best pot. seen: whether any ball can be struck straight.
    """
    made, missed = looked_up(race[at.MADE], needs - 1.0, other), looked_up(race[at.MISSED], needs, other)
    safe = looked_up(race[at.SAFE] if seen else race[at.HIDDEN], needs, other)
    return max(chance * made + (1.0 - chance) * missed, safe)


@compiled
def worths(table, before, positions, shooters, terms, race, memory, out):
    """What each position is worth to its shooter.

    Args:
        before: (n, 16, 2) m, where balls lay before the stroke that led there: rows alike cost less.
        shooters: (group, hand), each (n,): the group that shoots, -1 on an open table (the better one then), and
            whether the cue ball is in hand.
        terms: (sigma, kitchen, perfect, pots): as for `survey`; what a layout's hardness is divided by to count as
            balls; whether pots count, or nothing but safeties.
        race: as for `shooter`. memory: `new_memory`. out: (n,), filled.
    """
    group, hand = shooters
    sigma, kitchen, perfect, pots = terms
    offers, needs = memory.offers, memory.needs
    for n in range(positions.shape[0]):
        view = Layout(table, positions[n])
        remember(table, memory, before[n], positions[n], sigma)
        for g in range(2):
            mine = group[n] == -1 or group[n] == g
            left = survey_group(view, memory, g, sigma, Task(mine, mine and hand[n], kitchen), offers[g])
            needs[g] = left + offers[g, at.LAYOUT] / perfect
        best = 0.0
        for g in range(2):
            if group[n] == -1 or group[n] == g:
                chance = (offers[g, at.PLACED] if hand[n] else offers[g, at.CHANCE]) if pots else 0.0
                seen = hand[n] or offers[g, at.SEEN] > 0.0
                best = max(best, shooter(race, needs[g], needs[1 - g], chance, seen))
        out[n] = best


@compiled
def list_pots(table, positions, targets, sigma, found):
    """The best straight pots of each table, at most m, the likeliest first; chance 0 where there are fewer.

    Args:
        targets: (n, 16) whether a ball may be called.
        found: (ball, pocket, phi in deg, margin in deg, chance), each (n, m), filled.
    """
    ball, pocket, phi, margin, chance = found
    most = ball.shape[1]
    chance[:] = 0.0
    for n in range(positions.shape[0]):
        view = Layout(table, positions[n])
        for one in range(1, 16):
            if not targets[n, one] or view.row[one, 0] != view.row[one, 0]:
                continue
            for into in range(6):
                lane = to_pocket(view, one, into)
                if lane.fan.low >= lane.fan.high:
                    continue
                direction, fan = straight(view, one, lane, 0.0)
                p, half = normal_between(fan, sigma), half_of(fan)
                if p <= chance[n, most - 1]:
                    continue
                place = most - 1
                while place > 0 and chance[n, place - 1] < p:
                    ball[n, place] = ball[n, place - 1]
                    pocket[n, place] = pocket[n, place - 1]
                    phi[n, place] = phi[n, place - 1]
                    margin[n, place] = margin[n, place - 1]
                    chance[n, place] = chance[n, place - 1]
                    place -= 1
                ball[n, place], pocket[n, place] = one, into
                phi[n, place], margin[n, place] = math.degrees(direction) % 360.0, math.degrees(half)
                chance[n, place] = p


@inner
def over_ball(dx, dy, cue, radius):
    """Elevation (rad) at which the cue passes over a ball at (dx, dy); 0 if it need not, 2 if it cannot."""
    along = -(dx * cue.ux + dy * cue.uy) - cue.depth  # behind the tip
    aside = cue.ux * dy - cue.uy * dx
    if along <= -radius or along > cue.length + radius or abs(aside) >= radius:
        return 0.0
    rise = math.sqrt(radius * radius - aside * aside)
    far = math.sqrt(along * along + cue.tip * cue.tip)
    if rise >= far:
        return 2.0
    return max(0.0, math.asin(rise / far) - math.atan2(cue.tip, along))


@inner
def over_cushion(start, step, line, rise, length):
    """Elevation (rad) at which the cue clears a nose `rise` above its tip at `line`; 0 when it does not come so far."""
    if abs(step) < 1e-12:
        return 0.0
    far = (line - start) / step
    if far <= 0.0 or far > length:
        return 0.0
    return math.atan2(rise, far) if rise > 0.0 else 0.0


@compiled
def elevations(table, positions, which, strokes, aside, out):
    """Least elevation (deg) at which the cue stays free, also `aside` (deg) to either side; NaN if there is none.

    Args:
        which: (n,) row of `positions`. strokes: (phi in deg, a in mm, b in mm), each (n,).
    """
    phi, a, b = strokes
    radius = table[at.RADIUS]
    for n in range(which.shape[0]):
        row = positions[which[n]]
        side, tip = 1e-3 * a[n], 1e-3 * b[n]
        depth = math.sqrt(max(0.0, radius * radius - side * side - tip * tip))
        rise = table[at.NOSE] - (radius + tip)
        least = 0.0
        for turn in (0.0, -aside, aside):
            angle = math.radians(phi[n] + turn)
            cue = LevelCue(math.cos(angle), math.sin(angle), depth, tip, table[at.CUE_LENGTH])
            for other in range(1, 16):
                if row[other, 0] == row[other, 0]:
                    dx = row[other, 0] - row[0, 0] - side * cue.uy
                    dy = row[other, 1] - row[0, 1] + side * cue.ux
                    least = max(least, over_ball(dx, dy, cue, radius))
            x, y = row[0, 0] - depth * cue.ux + side * cue.uy, row[0, 1] - depth * cue.uy - side * cue.ux
            for start, step, wall in ((x, -cue.ux, table[at.WIDTH]), (y, -cue.uy, table[at.LENGTH])):
                for line in (0.0, wall):
                    least = max(least, over_cushion(start, step, line, rise, cue.length))
        out[n] = math.degrees(least) if least < 1.5 else np.nan
