"""The next event of one ball.

Every ball keeps one next event, its earliest (Lubachevsky 1991). A ball's prediction is redone only when its motion
changed; a partner that thereby loses its event looks again when that event would have been. Pairs are filtered by
16 branch-free lanes before any of them is solved.
"""

import math

from physics.kernels import layout as at
from physics.kernels.apart import apart
from physics.kernels.compiling import kernel, load, load_integer, lowest_bit, small_kernel, store, store_integer
from physics.kernels.detect.air import meet_in_air
from physics.kernels.detect.boundary import Coming, meet_octagon
from physics.kernels.detect.contact import contact
from physics.kernels.detect.mouths import meet_rails
from physics.kernels.motion import moves
from physics.kernels.path import Path, in_space, path_of, rise_of, seen_from
from physics.kernels.tolerances import GRAZE, TOUCH
from physics.kernels.workspace import RealWorkspace, by_table


@small_kernel
def meet_octagon_of(s, _i, path, _now, lasts):
    """See ``meet_boundary``."""
    return meet_octagon(s, path, lasts)


@small_kernel
def meet_rails_of(s, i, path, now, lasts):
    """See ``meet_boundary``."""
    if load_integer(s.k, at.MOTION + i) == at.FLYING:
        return meet_in_air(s, path, rise_of(s, i, now), lasts)
    return meet_rails(s, path, lasts)


meet_boundary = by_table(meet_octagon_of, meet_rails_of)
"""``meet_boundary(s, i, path, now, lasts)``: the first Coming event of ball ``i`` at cushions, mouths, jaws, holes or
rails within ``lasts``."""

FOREVER = 1e6
"""s. The filter's horizon for a ball without an event of its own: finite, so that 0 m/s times it is 0 m."""


@small_kernel
def count(s, counter):
    """Count one more piece of work."""
    store_integer(s.k, counter, load_integer(s.k, counter) + 1)


@small_kernel
def exactly(_s, squared):
    """See ``near_enough``."""
    return squared


@small_kernel
def nearly(_s, squared):
    """See ``near_enough``."""
    return squared * GRAZE


near_enough = by_table(exactly, nearly)
"""``near_enough(s, squared)``: squared distance from which on the filter lets a pair go, m^2. Balls that pass at just
a diameter are the solver's to judge; on tables with straight mouths the filter's rounding may judge them, as ever."""


@small_kernel
def partners_on_cloth(s, _i, path, now, limit):
    """Bit set of the balls whose path may meet this one before either's next event.

    Branch-free over 16 lanes. Up to the horizon H the relative path c + b t + a t^2 lies in the triangle of its
    control points c, c + b H/2, c + b H + a H^2. A pair cannot meet if the triangle comes no nearer along c, if it
    stays more than the diameter away along c, or beside b. Bits 16 to 31: the balls it touches now.
    """
    limit = min(limit, FOREVER)
    diameter = 2.0 * load(s.p, at.P_RADIUS)
    squared = near_enough(s, diameter * diameter)
    touching = (diameter + TOUCH) * (diameter + TOUCH)
    found = 0
    for j in range(at.LANES):
        cx, cy, bx, by, ax, ay = seen_from(path, path_of(s, j, now))
        horizon = min(limit, load(s.w, at.NEXT + j)) - now
        cc = cx * cx + cy * cy
        end_x, end_y = horizon * ax, horizon * ay
        to_middle = horizon * (cx * bx + cy * by)  # twice the middle point's advance along c, times |c|
        nearer = min(0.5 * to_middle, to_middle + horizon * (cx * end_x + cy * end_y))
        least = cc + nearer
        along_c = (nearer >= 0.0) | ((least > 0.0) & (least * least > squared * cc))
        beside = cx * by - cy * bx  # the distance of the line c + b t from the origin, times |b|
        at_end = beside + horizon * (end_x * by - end_y * bx)
        aside = (beside * at_end > 0.0) & (min(beside * beside, at_end * at_end) > squared * (bx * bx + by * by))
        found |= int(not (along_c | aside)) << j
        found |= int(cc <= touching) << (j + at.LANES)
    return found


@apart(int, RealWorkspace, int, Path, float, float)
@kernel
def partners_in_space(s, i, path, now, limit):
    """``partners`` where a ball flies: the same triangle in plan, for heights only ever add to a distance.

    Balls one above the other overlap in plan. That it comes no nearer along c then proves nothing: such a pair is
    dropped only if it stays more than the diameter away along c. Touching is meant in space.
    """
    limit = min(limit, FOREVER)
    diameter = 2.0 * load(s.p, at.P_RADIUS)
    squared = near_enough(s, diameter * diameter)
    touching = (diameter + TOUCH) * (diameter + TOUCH)
    height = rise_of(s, i, now).z
    found = 0
    for j in range(at.LANES):
        cx, cy, bx, by, ax, ay = seen_from(path, path_of(s, j, now))
        cz = rise_of(s, j, now).z - height
        horizon = min(limit, load(s.w, at.NEXT + j)) - now
        cc = cx * cx + cy * cy
        end_x, end_y = horizon * ax, horizon * ay
        to_middle = horizon * (cx * bx + cy * by)
        nearer = min(0.5 * to_middle, to_middle + horizon * (cx * end_x + cy * end_y))
        least = cc + nearer
        apart = (least > 0.0) & (least * least > squared * cc)
        along_c = (cc >= touching) & ((nearer >= 0.0) | apart)
        beside = cx * by - cy * bx
        at_end = beside + horizon * (end_x * by - end_y * bx)
        aside = (beside * at_end > 0.0) & (min(beside * beside, at_end * at_end) > squared * (bx * bx + by * by))
        found |= int(not (along_c | aside)) << j
        found |= int(cc + cz * cz <= touching) << (j + at.LANES)
    return found


@small_kernel
def partners_anywhere(s, i, path, now, limit):
    """See ``partners``."""
    if load_integer(s.k, at.FLYING_BALLS) != 0:
        return partners_in_space(s, i, path, now, limit)
    return partners_on_cloth(s, i, path, now, limit)


partners = by_table(partners_on_cloth, partners_anywhere)
"""``partners(s, i, path, now, limit)``: the filter. ``path`` is that of ball ``i``."""


@small_kernel
def meets_on_cloth(s, _i, j, path, now, lasts, limit):
    """See ``time_to_meet``."""
    return contact(seen_from(path, path_of(s, j, now)), lasts, limit, 2.0 * load(s.p, at.P_RADIUS)).time


@apart(float, RealWorkspace, int, int, Path, float, float, float)
@kernel
def meets_in_space(s, i, j, path, now, lasts, limit):
    """See ``time_to_meet``."""
    relative = in_space(seen_from(path, path_of(s, j, now)), rise_of(s, i, now), rise_of(s, j, now))
    return contact(relative, lasts, limit, 2.0 * load(s.p, at.P_RADIUS)).time


@small_kernel
def meets_anywhere(s, i, j, path, now, lasts, limit):
    """See ``time_to_meet``."""
    if load_integer(s.k, at.FLYING_BALLS) & (1 << i | 1 << j):
        return meets_in_space(s, i, j, path, now, lasts, limit)
    return meets_on_cloth(s, i, j, path, now, lasts, limit)


time_to_meet = by_table(meets_on_cloth, meets_anywhere)
"""``time_to_meet(s, i, j, path, now, lasts, limit)``: s until balls i and j meet, NaN if not within ``limit``."""


@small_kernel
def release(s, i):
    """Tell the ball that was to meet ball ``i`` to look again at that time."""
    if load_integer(s.k, at.KIND + i) == at.MEET_BALL:
        partner = load_integer(s.k, at.PARTNER + i)
        meets_i = load_integer(s.k, at.PARTNER + partner) == i
        if load_integer(s.k, at.KIND + partner) == at.MEET_BALL and meets_i:
            store_integer(s.k, at.KIND + partner, at.LOOK_AGAIN)


@small_kernel
def expect(s, i, coming):
    """Note the next event of ball ``i``."""
    store(s.w, at.NEXT + i, coming.time)
    store_integer(s.k, at.KIND + i, coming.kind)
    store_integer(s.k, at.PARTNER + i, coming.number)


@small_kernel
def meeting(s, i, j, path, now, lasts, best):
    """Time at which ball ``j`` meets ball ``i`` on ``path`` if before ``best`` and j's next event, else infinity.

    ``lasts``: how long both keep their motion states.
    """
    count(s, at.SOLVES)
    limit = min(best, load(s.w, at.NEXT + j)) - now
    t = time_to_meet(s, i, j, path, now, lasts, limit)
    return now + t if now + t < load(s.w, at.NEXT + j) else math.inf


@small_kernel
def meet_partners(s, found, i, path, now, best):
    """The first meeting with one of the balls in ``found`` that is earlier than ``best``, else ``best``."""
    moving = moves(load_integer(s.k, at.MOTION + i))
    own = load(s.w, at.END + i) - now if moving else math.inf
    rest = found
    while rest != 0:
        j = lowest_bit(rest)
        rest &= rest - 1
        count(s, at.PAIRS_LEFT)
        other_moves = moves(load_integer(s.k, at.MOTION + j))
        if moving or other_moves:
            lasts = min(own, load(s.w, at.END + j) - now) if other_moves else own
            t = meeting(s, i, j, path, now, lasts, best.time)
            if t < best.time:
                best = Coming(t, at.MEET_BALL, j)
    return best


@apart(int, RealWorkspace, int, int, float)
@kernel
def predict(s, alive, i, now):
    """Find the next event of ball ``i`` at time ``now`` and, if it is a collision, make it its partner's too.

    ``alive`` is the bit set of balls on the table. Returns the bit set of balls it touches now.
    """
    count(s, at.LOOKS)
    end = load(s.w, at.END + i)
    best = Coming(end, at.TRANSITION if end < math.inf else at.NOTHING, 0)
    path = path_of(s, i, now)
    if moves(load_integer(s.k, at.MOTION + i)):
        wall = meet_boundary(s, i, path, now, end - now)
        if wall.kind != at.NOTHING:
            best = Coming(now + wall.time, wall.kind, wall.number)
    lanes = partners(s, i, path, now, best.time)
    others = alive & ~(1 << i)
    found = lanes & others
    if found != 0:
        best = meet_partners(s, found, i, path, now, best)
    release(s, i)
    if best.kind == at.MEET_BALL:
        release(s, best.number)
        expect(s, best.number, Coming(best.time, at.MEET_BALL, i))
    expect(s, i, best)
    return lanes >> at.LANES & others
