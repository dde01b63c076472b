"""Straight pots: from where the cue ball lies, with it in hand, and from where good position play leaves it."""

import math

from client.agents.search import shots as at
from client.agents.search.compiled.compiling import compiled, inner
from client.agents.search.compiled.fans import Fan, Layout, Way, even_of, half_of, narrowed, normal_between, turned_by
from client.agents.search.compiled.lanes import to_pocket

STEEPEST = math.cos(math.radians(83.0))
"""Cosine of the thinnest cut worth a thought: beyond it a tenth of a degree misses the ball."""
USUAL_REACH, USUAL_CUT = 0.5, math.cos(math.radians(25.0))
"""A ball's own difficulty is its pot from half a metre at 25 degrees: what good position play leaves."""
PLACED_REACH = 0.25
"""m: with the cue ball in hand it is put this far behind the ghost ball."""


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
