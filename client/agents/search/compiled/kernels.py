"""Compiled plane geometry for thousands of tables at once: chances of straight pots, elevations of the cue.

The chance of a pot is that the error of the cue's direction, normal with standard deviation `sigma`, stays between two
bounds: where the object ball meets the edge of the mouth, and where either ball touches another on its way. With a path
d of the cue ball, an error e moves its place at contact by d e, which turns the object ball by d e / (2 R cos(cut)).

Every array is C-contiguous float64 or int64; `positions` is (n, 16, 2) m with NaN for absent balls, `table` what
`client.agents.search.engine.table_row` makes. Loaded by that module alone: importing this one needs the compiler.
"""

import math

import numba
import numpy as np

from client.agents.search.shots import CHANCE, LAYOUT, PLACED, SEEN

WIDTH, LENGTH, RADIUS, NOSE, CUE_LENGTH, MOUTHS = 0, 1, 2, 3, 4, 5
PER_POCKET = 5
"""Places in a table's row; from MOUTHS on, five a pocket: x, y, inward normal x, y, half length of the mouth line."""

STEEPEST = math.cos(math.radians(83.0))
"""Cosine of the thinnest cut worth a thought: beyond it a tenth of a degree misses the ball."""
USUAL_REACH, USUAL_CUT = 0.5, math.cos(math.radians(25.0))
"""A ball's own difficulty is its pot from half a metre at 25 degrees: what good position play leaves."""
PLACED_REACH = 0.25
"""m: with the cue ball in hand it is put this far behind the ghost ball."""
BLOCKED = 0.8
"""Chance that a ball no pocket is open for will be made when its turn comes: others move by then, or it is banked."""

compiled = numba.njit(error_model="numpy", nogil=True, cache=bool(numba.config.CACHE_DIR))
inner = numba.njit(error_model="numpy", nogil=True)


@inner
def normal_between(low, high, sigma):
    """Chance that a normal error of standard deviation `sigma` lies in (low, high)."""
    if low >= high:
        return 0.0
    scale = 1.0 / (sigma * math.sqrt(2.0))
    return 0.5 * (math.erf(high * scale) - math.erf(low * scale))


@inner
def narrowed(row, ball, skip, x, y, ux, uy, run, radius, low, high, gain):
    """Bounds (low, high) on an angle (rad, left positive), narrowed by the balls beside a path.

    The path goes from (x, y) along the unit (ux, uy) for `run`; turning it by e moves it at distance s by s gain e.
    A negative `gain` turns the other way. `ball` and `skip` do not count.
    """
    reach = 2.0 * radius
    for other in range(16):
        if other in (ball, skip):
            continue
        dx, dy = row[other, 0] - x, row[other, 1] - y
        along = dx * ux + dy * uy
        if not (along > 0.0):  # behind, or absent (NaN)
            continue
        aside = ux * dy - uy * dx  # positive: to the left
        if along > run:
            over = along - run
            if over >= reach:
                continue
            room = math.sqrt(reach * reach - over * over)
            along = run
        else:
            room = reach
        gap = abs(aside) - room
        if gap <= 0.0:
            return 0.0, 0.0
        bound = gap / (along * abs(gain))
        if (aside > 0.0) == (gain > 0.0):
            high = min(high, bound)
        else:
            low = max(low, -bound)
    return low, high


@inner
def to_pocket(table, row, ball, pocket, skip):
    """Object ball to pocket: (ux, uy, run, low, high), direction and bounds on the angle; low = high if blocked."""
    at = MOUTHS + PER_POCKET * pocket
    x, y = row[ball, 0], row[ball, 1]
    dx, dy = table[at] - x, table[at + 1] - y
    run = math.sqrt(dx * dx + dy * dy)
    if run < 1e-9:
        return 1.0, 0.0, 1e-9, -1.0, 1.0
    ux, uy = dx / run, dy / run
    facing = -(ux * table[at + 2] + uy * table[at + 3])
    if facing <= 0.05:
        return ux, uy, run, 0.0, 0.0
    bound = math.atan2(table[at + 4] * facing, run)
    low, high = narrowed(row, ball, skip, x, y, ux, uy, run, table[RADIUS], -bound, bound, 1.0)
    return ux, uy, run, low, high


@inner
def straight(table, row, ball, ux, uy, low, high, sigma):
    """A pot from where the cue ball lies: (chance, phi, half the margin), rad; chance 0 when it cannot be played."""
    radius = table[RADIUS]
    gx, gy = row[ball, 0] - 2.0 * radius * ux, row[ball, 1] - 2.0 * radius * uy
    dx, dy = gx - row[0, 0], gy - row[0, 1]
    reach = math.sqrt(dx * dx + dy * dy)
    if reach < 1e-6:
        return 0.99, math.atan2(uy, ux), 0.05
    vx, vy = dx / reach, dy / reach
    cut = vx * ux + vy * uy
    if cut < STEEPEST:
        return 0.0, 0.0, 0.0
    gain = reach / (2.0 * radius * cut)
    phi_low, phi_high = narrowed(
        row, 0, ball, row[0, 0], row[0, 1], vx, vy, reach, radius, -high / gain, -low / gain, 1.0
    )
    chance = normal_between(phi_low, phi_high, sigma)
    return chance, math.atan2(vy, vx), 0.5 * (phi_high - phi_low)


@inner
def is_seen(table, row, ball):
    """Whether the cue ball can strike `ball` straight, on either of its halves or full."""
    dx, dy = row[ball, 0] - row[0, 0], row[ball, 1] - row[0, 1]
    far = math.sqrt(dx * dx + dy * dy)
    ux, uy = dx / far, dy / far
    side = 1.4 * table[RADIUS]
    for offset in (0.0, side, -side):
        tx, ty = dx - offset * uy, dy + offset * ux
        run = math.sqrt(tx * tx + ty * ty)
        low, high = narrowed(row, 0, ball, row[0, 0], row[0, 1], tx / run, ty / run, run, table[RADIUS], -1.0, 1.0, 1.0)
        if low < high:
            return True
    return False


@inner
def is_place(table, row, x, y, kitchen):
    """Whether the cue ball can be put there (mouths aside, where no pot starts), `kitchen` the least y."""
    radius = table[RADIUS]
    if x < radius or x > table[WIDTH] - radius or y < max(radius, kitchen) or y > table[LENGTH] - radius:
        return False
    for other in range(1, 16):
        dx, dy = row[other, 0] - x, row[other, 1] - y
        if dx * dx + dy * dy <= 4.0 * radius * radius + 1e-9:
            return False
    return True


@inner
def placed(table, row, ball, ux, uy, low, high, sigma, kitchen):
    """Chance of a pot with the cue ball in hand: from straight behind, or a little to either side."""
    radius, best = table[RADIUS], 0.0
    gx, gy = row[ball, 0] - 2.0 * radius * ux, row[ball, 1] - 2.0 * radius * uy
    for turn in (0.0, 0.5, -0.5):
        c, s = math.cos(turn), math.sin(turn)
        vx, vy = c * ux - s * uy, s * ux + c * uy
        x, y = gx - PLACED_REACH * vx, gy - PLACED_REACH * vy
        if not is_place(table, row, x, y, kitchen):
            continue
        gain = PLACED_REACH / (2.0 * radius * c)
        a, b = narrowed(row, 0, ball, x, y, vx, vy, PLACED_REACH, radius, -high / gain, -low / gain, 1.0)
        best = max(best, normal_between(a, b, sigma))
    return best


@inner
def usual(table, low, high, sigma):
    """Chance of a pot from where good position play leaves it; the object ball leaves between two angles (rad)."""
    gain = USUAL_REACH / (2.0 * table[RADIUS] * USUAL_CUT)
    return normal_between(low / gain, high / gain, sigma)


@inner
def survey_ball(table, row, ball, sigma, hand, kitchen, out):
    """Add one ball to what is known of its group: best pots, difficulty."""
    own, easy = 0.0, 0.0
    for pocket in range(6):
        ux, uy, _, low, high = to_pocket(table, row, ball, pocket, 0)
        if low >= high:
            continue
        easy = max(easy, usual(table, low, high, sigma))
        if hand:
            out[PLACED] = max(out[PLACED], placed(table, row, ball, ux, uy, low, high, sigma, kitchen))
        else:
            chance, _, _ = straight(table, row, ball, ux, uy, low, high, sigma)
            own = max(own, chance)
    out[CHANCE] = max(out[CHANCE], own)
    out[LAYOUT] -= math.log(max(easy, BLOCKED))
    if not hand and out[SEEN] == 0.0 and (own > 0.0 or is_seen(table, row, ball)):
        out[SEEN] = 1.0


@compiled
def survey(table, positions, sigma, hand, kitchen, out):
    """What the balls offer to whoever shoots next, by group.

    Args:
        sigma: rad, of the cue's direction.
        hand: (n,) whether the cue ball is in hand. kitchen: the least y it may have then.
        out: (n, 2, 4), solids and stripes; see CHANCE and its fellows. The 8 counts for a group that has no other ball.
    """
    out[:] = 0.0
    for n in range(positions.shape[0]):
        row = positions[n]
        for group in range(2):
            mine = out[n, group]
            left = 0
            for ball in range(1 + 8 * group, 8 + 8 * group):
                if row[ball, 0] == row[ball, 0]:
                    left += 1
                    survey_ball(table, row, ball, sigma, hand[n], kitchen, mine)
            if row[8, 0] != row[8, 0]:
                continue
            if left == 0:
                survey_ball(table, row, 8, sigma, hand[n], kitchen, mine)
            else:
                easy = 0.0
                for pocket in range(6):
                    _, _, _, low, high = to_pocket(table, row, 8, pocket, 0)
                    easy = max(easy, usual(table, low, high, sigma))
                mine[LAYOUT] -= math.log(max(easy, BLOCKED))


@compiled
def list_pots(table, positions, targets, sigma, ball, pocket, phi, margin, chance):
    """The best straight pots of each table, at most m, the likeliest first; chance 0 where there are fewer.

    Args:
        targets: (n, 16) whether a ball may be called.
        ball, pocket, phi (deg), margin (deg), chance: (n, m), filled.
    """
    most = ball.shape[1]
    chance[:] = 0.0
    for n in range(positions.shape[0]):
        row = positions[n]
        for one in range(1, 16):
            if not targets[n, one] or row[one, 0] != row[one, 0]:
                continue
            for into in range(6):
                ux, uy, _, low, high = to_pocket(table, row, one, into, 0)
                if low >= high:
                    continue
                p, direction, half = straight(table, row, one, ux, uy, low, high, sigma)
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
def over_ball(dx, dy, depth, low_tip, ux, uy, radius, length):
    """Elevation (rad) at which the cue passes over a ball at (dx, dy); 0 if it need not, 2 if it cannot."""
    along = -(dx * ux + dy * uy) - depth  # behind the tip
    aside = ux * dy - uy * dx
    if along <= -radius or along > length + radius or abs(aside) >= radius:
        return 0.0
    rise = math.sqrt(radius * radius - aside * aside)
    far = math.sqrt(along * along + low_tip * low_tip)
    if rise >= far:
        return 2.0
    return max(0.0, math.asin(rise / far) - math.atan2(low_tip, along))


@inner
def over_cushion(start, step, line, height, nose, length):
    """Elevation (rad) at which the cue clears a cushion's nose at `line`; 0 when it does not come so far."""
    if abs(step) < 1e-12:
        return 0.0
    far = (line - start) / step
    if far <= 0.0 or far > length:
        return 0.0
    return math.atan2(nose - height, far) if nose > height else 0.0


@compiled
def elevations(table, positions, which, phi, a, b, aside, out):
    """Least elevation (deg) at which the cue stays free, also `aside` (deg) to either side; NaN if there is none.

    Args:
        which: (n,) row of `positions`. phi: (n,) deg. a, b: (n,) mm.
    """
    radius = table[RADIUS]
    for n in range(which.shape[0]):
        row = positions[which[n]]
        side, tip = 1e-3 * a[n], 1e-3 * b[n]
        depth = math.sqrt(max(0.0, radius * radius - side * side - tip * tip))
        least = 0.0
        for turn in (0.0, -aside, aside):
            angle = math.radians(phi[n] + turn)
            ux, uy = math.cos(angle), math.sin(angle)
            for other in range(1, 16):
                if row[other, 0] == row[other, 0]:
                    dx, dy = row[other, 0] - row[0, 0] - side * uy, row[other, 1] - row[0, 1] + side * ux
                    least = max(least, over_ball(dx, dy, depth, tip, ux, uy, radius, table[CUE_LENGTH]))
            x, y = row[0, 0] - depth * ux + side * uy, row[0, 1] - depth * uy - side * ux
            for start, step, wall in ((x, -ux, table[WIDTH]), (y, -uy, table[LENGTH])):
                for line in (0.0, wall):
                    need = over_cushion(start, step, line, radius + tip, table[NOSE], table[CUE_LENGTH])
                    least = max(least, need)
        out[n] = math.degrees(least) if least < 1.5 else np.nan
