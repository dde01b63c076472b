"""Kernels of the step: look, aim, rule, rack. Rows in, rows out; loaded by `client.learn.engine` alone.

`places` (n, 16, 2) m with NaN for absent balls and `games` (n, WIDTH) int64 hold all games; `rows` (m,) says which of
them an array of m rows is about. Every array is C-contiguous.
"""

import math

import numba
import numpy as np

from client.learn.compiled import layout as to
from physics.kernels import layout as at
from physics.kernels.compiling import load, row
from physics.kernels.start import place
from physics.kernels.strike import MILLIMETRE, lowest_elevation, playable, read_stroke
from physics.kernels.tasks import may_lie
from physics.kernels.workspace import bare_real_workspace, bare_workspace

compiled = numba.njit(error_model="numpy", nogil=True, cache=bool(numba.config.CACHE_DIR))
inner = numba.njit(error_model="numpy", nogil=True, no_cpython_wrapper=True, no_cfunc_wrapper=True)

EIGHT = 8
NEVER = -1
BALLS_TO_CUSHION = 4
"""R9."""


@inner
def group_of(game, seat):
    """OPEN, or the seat's group."""
    group = game[to.GROUP]
    return group if group == to.OPEN or seat == 0 else 1 - group


@inner
def in_group(ball, group):
    """Whether an object ball is of a group; on an open table every one but the 8 is."""
    if ball == at.CUE_BALL or ball == EIGHT:
        return False
    return group == to.OPEN or (ball > EIGHT) == (group == 1)


@inner
def is_on_eight(before, group):
    """R27: none of the shooter's group is left."""
    if group == to.OPEN:
        return False
    for ball in range(at.LANES):  # noqa: SIM110 - kernels have no generators
        if in_group(ball, group) and before[ball, 0] == before[ball, 0]:
            return False
    return True


@inner
def count_decisions(game, here):
    """How many decisions a choice offers; `here`: whether the cue ball is on the table."""
    choice = game[to.CHOICE]
    if choice == to.R12:
        return 3
    if choice == to.R12A:
        return 4 if here else 3
    return 2


@inner
def decision_at(game, here, number):
    """The decision of this number among those that a choice offers."""
    choice = game[to.CHOICE]
    if choice == to.R12:
        return to.ACCEPT_TABLE if number == 0 else to.RERACK_AND_BREAK + number - 1
    if choice == to.R12A:
        number += 0 if here else 1
        return number if number < 2 else to.RERACK_AND_BREAK + number - 2
    if choice == to.R13 or choice == to.R14:
        return to.SPOT_EIGHT if number == 0 else to.RERACK_AND_BREAK
    return to.ACCEPT_TABLE if number == 0 else to.BALL_IN_HAND


@compiled
def observe(table, places, games, rows, seats, seen):
    """`codec.observe` of each row, by the seat given for it, into `seen` (m, OBSERVATION_SIZE) float32."""
    seen[:] = 0.0
    for k in range(rows.shape[0]):
        game, lies, out = games[rows[k]], places[rows[k]], seen[k]
        group = group_of(game, seats[k])
        for n in range(at.LANES):
            ball = n
            if group == 1 and n != 0:
                ball = n + 8 if n < 8 else (8 if n == 8 else n - 8)
            x, y = lies[ball, 0], lies[ball, 1]
            if x == x:
                out[3 * n] = np.float32(min(max(x / table[to.T_WIDTH], 0.0), 1.0))
                out[3 * n + 1] = np.float32(min(max(y / table[to.T_LENGTH], 0.0), 1.0))
                out[3 * n + 2] = 1.0
        at_phase = 3 * at.LANES
        phase = game[to.PHASE]
        if phase <= to.DECISION:
            out[at_phase + phase] = 1.0
        out[at_phase + 3 + game[to.AREA]] = 1.0
        out[at_phase + 6 + (0 if group == to.OPEN else 1 + group)] = 1.0
        if phase == to.DECISION:
            here = lies[0, 0] == lies[0, 0]
            for number in range(count_decisions(game, here)):
                out[at_phase + 9 + decision_at(game, here, number)] = 1.0
        out[at_phase + 14] = np.float32(min(1.0, game[to.DRY_VISITS] / 24.0))
        out[at_phase + 15] = np.float32(min(1.0, game[to.STROKE] / 400.0))


@inner
def await_rack(game, turn):
    """As `referee.rules.stalemate.await_rack`."""
    if turn != game[to.TURN]:
        game[to.VISIT_STROKES] = 0
    game[to.PHASE], game[to.TURN], game[to.GROUP] = to.RERACK, turn, to.OPEN
    game[to.AREA], game[to.CHOICE] = to.NOT_IN_HAND, to.NO_CHOICE


@inner
def decide(game, here, share):
    """Make the decision that a number in [0, 1] chooses; what became of it."""
    count = count_decisions(game, here)
    decision = decision_at(game, here, min(int(share * count), count - 1))
    if decision == to.SPOT_EIGHT:
        return to.TO_REFEREE
    if decision >= to.RERACK_AND_BREAK:
        await_rack(game, game[to.TURN] if decision == to.RERACK_AND_BREAK else 1 - game[to.TURN])
        return to.PLAYED
    game[to.PHASE], game[to.CHOICE] = to.PLAY, to.NO_CHOICE
    game[to.AREA] = to.KITCHEN if decision == to.BALL_IN_HAND else to.NOT_IN_HAND
    return to.PLAYED


@inner
def is_free(s, table, before, x, y, kitchen):
    """Whether the cue ball may be put there: see `client.geometry.are_free`."""
    if kitchen and not y > table[to.T_HEAD]:
        return False
    if not may_lie(s, x - 0.5 * table[to.T_WIDTH], y - 0.5 * table[to.T_LENGTH], table[to.T_SLACK]):
        return False
    least = table[to.T_CLEAR]
    for ball in range(1, at.LANES):
        dx, dy = before[ball, 0] - x, before[ball, 1] - y
        if dx * dx + dy * dy < least * least:
            return False
    return True


@inner
def put(s, table, lattice, game, before, share):
    """Put a cue ball in hand where it is asked for, or at the nearest free place of the lattice."""
    radius = table[to.T_RADIUS]
    kitchen = game[to.AREA] == to.KITCHEN
    low = table[to.T_HEAD] if kitchen else radius
    x = radius + share[to.PLACE_X] * (table[to.T_WIDTH] - 2.0 * radius)
    y = low + share[to.PLACE_Y] * (table[to.T_LENGTH] - radius - low)
    if not is_free(s, table, before, x, y, kitchen):
        best, wanted_x, wanted_y = math.inf, x, y
        for up in lattice[2 if kitchen else 1]:
            for across in lattice[0]:
                if up == up and across == across and is_free(s, table, before, across, up, kitchen):
                    far = math.sqrt((across - wanted_x) ** 2 + (up - wanted_y) ** 2)
                    if far < best:
                        best, x, y = far, across, up
    before[0, 0], before[0, 1] = x, y


@inner
def call(game, before, share):
    """The ball and the pocket that a number in [0, 1] calls; SAFETY for none, and on the break."""
    if game[to.PHASE] == to.BREAK:
        return to.SAFETY, to.SAFETY
    group, balls = group_of(game, game[to.TURN]), 0
    eight = is_on_eight(before, group)
    for ball in range(1, at.LANES):
        callable_now = ball == EIGHT if eight else in_group(ball, group)
        balls += int(callable_now and before[ball, 0] == before[ball, 0])
    chosen = min(int(share * (balls * 6 + 1)), balls * 6)
    left, pocket = chosen // 6, chosen % 6
    for ball in range(1, at.LANES):
        callable_now = ball == EIGHT if eight else in_group(ball, group)
        if callable_now and before[ball, 0] == before[ball, 0]:
            if left == 0:
                return ball, pocket
            left -= 1
    return to.SAFETY, to.SAFETY


@inner
def raise_cue(s, table, shots, k, share):
    """Elevate a stroke as asked for, or as little as can be; whether it can be played. `s` has the balls laid out."""
    shot = shots[k]
    least = 0.0
    if load(s.p, at.P_CUE_TEST) != 0.0:
        least = lowest_elevation(s, shot[at.S_PHI], shot[at.S_A] * MILLIMETRE, shot[at.S_B] * MILLIMETRE)
    if math.isnan(least):
        return False
    wanted = least + (table[to.T_ELEVATION] - least) * (share * share)
    for n in range(3):
        shot[at.S_THETA] = wanted if n == 0 else least
        if n == 1:
            shot[at.S_THETA] = min(table[to.T_ELEVATION], least + table[to.T_MARGIN])
        if playable(s, read_stroke(row(shots, k))) == at.AT_REST:
            return True
    return False


@inner
def mod_360(phi):
    """As `referee.play.noise` has it, of an angle in (-360, 720), where the difference is exact."""
    rest = phi - 360.0 if phi >= 360.0 else phi
    if rest < 0.0:
        rest += 360.0
    return rest if rest < 360.0 else 0.0


@inner
def disturb(table, shot, sigmas, draw):
    """Add the game's noise, as `NoiseModel.perturb_rows` does."""
    shot[at.S_V] = min(max(shot[at.S_V] + sigmas[at.S_V] * draw[at.S_V], 0.0), table[to.T_SPEED])
    shot[at.S_PHI] = mod_360(mod_360(shot[at.S_PHI]) + sigmas[at.S_PHI] * draw[at.S_PHI])
    theta = shot[at.S_THETA] + sigmas[at.S_THETA] * draw[at.S_THETA]
    shot[at.S_THETA] = min(max(theta, 0.0), table[to.T_ELEVATION])
    shot[at.S_A] += sigmas[at.S_A] * draw[at.S_A]
    shot[at.S_B] += sigmas[at.S_B] * draw[at.S_B]


@inner
def aim_row(s, table, lattice, k, game, share, before, shots, calls, turns):
    """One stroke as it is meant; what became of it."""
    if game[to.AREA] != to.NOT_IN_HAND:
        put(s, table, lattice, game, before[k], share)
    calls[k, 0], calls[k, 1] = call(game, before[k], share[to.CHOOSING])
    shot = shots[k]
    shot[at.S_V] = share[to.SPEED] * table[to.T_SPEED]
    shot[at.S_A] = (2.0 * share[to.SIDE] - 1.0) * table[to.T_OFFSET]
    shot[at.S_B] = (2.0 * share[to.HEIGHT] - 1.0) * table[to.T_OFFSET]
    place(s, row(before.reshape((before.shape[0], 2 * at.LANES)), k))
    for turn in range(turns):
        shot[at.S_PHI] = 360.0 * (share[to.DIRECTION] + turn / turns)
        if raise_cue(s, table, shots, k, share[to.ELEVATION]):
            return to.PLAYED
    return to.UNSTRUCK


@inner
def aim(s, table, lattice, places, games, rows, vectors, noise, before, shots, calls, became, turns):
    """Decisions are made at once; strokes are aimed: see `aim_straight`."""
    sigmas, draws = noise
    share = np.empty(8)
    for k in range(rows.shape[0]):
        game = games[rows[k]]
        before[k] = places[rows[k]]
        for n in range(8):
            share[n] = (min(max(float(vectors[k, n]), -1.0), 1.0) + 1.0) * 0.5
        if game[to.PHASE] == to.DECISION:
            became[k] = decide(game, before[k, 0, 0] == before[k, 0, 0], share[to.CHOOSING])
            continue
        became[k] = aim_row(s, table, lattice, k, game, share, before, shots, calls, turns)
        if sigmas[at.S_V] > 0.0 and became[k] == to.PLAYED:
            disturb(table, shots[k], sigmas, draws[k])


@compiled
def aim_straight(p, work, table, lattice, places, games, rows, vectors, noise, before, shots, calls, became, turns):
    """Make decisions, aim strokes: `codec.act` of each row, and the game's noise.

    Args:
        p, work: of the physics. table: numbers by `layout`. lattice: (3, m) m, NaN behind the end of each: x of its
            columns, y of its rows, y of its rows in the kitchen.
        vectors: (m, 8). noise: standard deviations (5,) and normal draws (m, 5), columns v, phi, theta, a, b.
        before: (m, 16, 2), filled with the tables, cue balls placed. shots: (m, 5), filled. calls: (m, 2), ball and
            pocket, filled. became: (m,), filled. turns: directions tried, all round.
    """
    aim(
        bare_workspace(p, work),
        table,
        lattice,
        places,
        games,
        rows,
        vectors,
        noise,
        before,
        shots,
        calls,
        became,
        turns,
    )


@compiled
def aim_with_jaws(p, work, table, lattice, places, games, rows, vectors, noise, before, shots, calls, became, turns):
    """`aim_straight` on a table with jaws."""
    s = bare_real_workspace(p, work)
    aim(s, table, lattice, places, games, rows, vectors, noise, before, shots, calls, became, turns)


@inner
def went(facts, first):
    """Whether anything befell an object ball, by the facts from column `first` on."""
    for ball in range(1, at.LANES):  # noqa: SIM110 - kernels have no generators
        if facts[first + ball] != NEVER:
            return True
    return False


@inner
def is_miscue(facts):
    """R39."""
    return facts[at.F_STATUS] == at.CUE_OBSTRUCTED or facts[at.F_STATUS] == at.TIP_OFF_BALL


@inner
def is_bad_from_kitchen(facts, before, head):
    """R38."""
    struck = False
    for ball in range(1, at.LANES):
        if facts[at.F_FIRST + ball] != NEVER:
            struck = True
            if before[ball, 1] <= head:
                return False
    if struck:
        return facts[at.F_CROSSED_BEFORE] == NEVER
    return facts[at.F_CROSSED] == NEVER


@inner
def is_foul(facts, before, group, eight, kitchen, head):
    """R32 to R39."""
    scratched = facts[at.F_POCKETED] != NEVER or facts[at.F_OFF_TABLE] != NEVER
    if is_miscue(facts) or scratched or went(facts, at.F_OFF_TABLE):
        return True
    struck = legal = False
    for ball in range(1, at.LANES):
        if facts[at.F_FIRST + ball] != NEVER:
            struck = True
            if ball == EIGHT if eight else in_group(ball, group):
                legal = True
    if not struck or not legal:
        return True
    driven = facts[at.F_CUSHION_AFTER] != NEVER or went(facts, at.F_CUSHION_AFTER)
    if not driven and not went(facts, at.F_POCKETED):
        return True
    return kitchen and is_bad_from_kitchen(facts, before, head)


@inner
def go_on(game, turn, fell):
    """The counters after one more stroke; `fell`: an object ball was pocketed."""
    game[to.STROKE] += 1
    if fell:
        game[to.DRY_VISITS] = 0
    elif game[to.VISIT_STROKES] == 0 and turn != game[to.TURN]:
        game[to.DRY_VISITS] += 1
    game[to.VISIT_STROKES] = game[to.VISIT_STROKES] + 1 if turn == game[to.TURN] else 0
    game[to.TURN] = turn
    game[to.PHASE], game[to.AREA], game[to.CHOICE] = to.PLAY, to.NOT_IN_HAND, to.NO_CHOICE


@inner
def end(game, winner, reason):
    """The game is over."""
    game[to.PHASE], game[to.AREA], game[to.CHOICE] = to.OVER, to.NOT_IN_HAND, to.NO_CHOICE
    game[to.WINNER], game[to.REASON], game[to.DECIDED_BY] = winner, reason, reason


@inner
def rule_break(game, facts, before, head):
    """R8 to R17, the 8 still in play."""
    shooter = game[to.TURN]
    fell = went(facts, at.F_POCKETED)
    driven = 0
    for ball in range(1, at.LANES):
        gone = facts[at.F_POCKETED + ball] != NEVER or facts[at.F_OFF_TABLE + ball] != NEVER
        driven += int(gone or facts[at.F_CUSHION + ball] != NEVER)
    legal = fell or driven >= BALLS_TO_CUSHION
    missed = is_miscue(facts)
    scratched = not missed and (facts[at.F_POCKETED] != NEVER or facts[at.F_OFF_TABLE] != NEVER)
    off = not missed and went(facts, at.F_OFF_TABLE)
    other = missed or not went(facts, at.F_FIRST) or is_bad_from_kitchen(facts, before, head)
    choice = to.NO_CHOICE
    if not legal:
        choice = to.R12A if scratched or off or other else to.R12
    elif off and not scratched:
        choice = to.R16
    elif other and not scratched:
        choice = to.R17
    go_on(game, shooter if choice == to.NO_CHOICE and fell and not scratched else 1 - shooter, fell)
    game[to.GROUP] = to.OPEN
    if choice != to.NO_CHOICE:
        game[to.PHASE], game[to.CHOICE] = to.DECISION, choice
    elif scratched:
        game[to.AREA] = to.KITCHEN


@inner
def rule_play(game, facts, before, ball, pocket, head):
    """R18 to R47."""
    shooter = game[to.TURN]
    group, kitchen = group_of(game, shooter), game[to.AREA] == to.KITCHEN
    eight = is_on_eight(before, group)
    fouled = is_foul(facts, before, group, eight, kitchen, head)
    fell = went(facts, at.F_POCKETED)
    made = ball != to.SAFETY and facts[at.F_POCKETED + ball] != NEVER and facts[at.F_POCKET + ball] == pocket
    down, off = facts[at.F_POCKETED + EIGHT] != NEVER, facts[at.F_OFF_TABLE + EIGHT] != NEVER
    if down or off:
        go_on(game, shooter, fell)
        as_called = eight and made and ball == EIGHT
        if as_called and not fouled:
            end(game, shooter, to.EIGHT_MADE)
        elif down and fouled:
            end(game, 1 - shooter, to.EIGHT_WITH_FOUL)
        elif down and not eight:
            end(game, 1 - shooter, to.EIGHT_TOO_EARLY)
        elif down:
            end(game, 1 - shooter, to.EIGHT_NOT_AS_CALLED)
        else:
            end(game, 1 - shooter, to.EIGHT_OFF_TABLE)
        return
    continues = made and not fouled
    go_on(game, shooter if continues else 1 - shooter, fell)
    if fouled:
        game[to.AREA] = to.ANYWHERE
    elif continues and group == to.OPEN:
        solids = ball < EIGHT
        game[to.GROUP] = 0 if solids == (shooter == 0) else 1


@inner
def limit(game, limits):
    """R49."""
    if game[to.PHASE] == to.OVER:
        return
    if game[to.STROKE] >= limits[2]:
        end(game, to.NOBODY, to.STROKE_LIMIT)
    elif game[to.DRY_VISITS] >= limits[0]:
        if game[to.REPLAYS] >= limits[1]:
            end(game, to.NOBODY, to.STALEMATE)
        else:
            await_rack(game, game[to.BREAKER])
            game[to.DRY_VISITS] = 0
            game[to.REPLAYS] += 1


@compiled
def rule(head, limits, places, games, rows, before, calls, final, facts, became):
    """`EightBall.apply` of a stroke in each row, and where the balls lie then.

    Args:
        head: y of the head string, m. limits: (3,) int64: dry visits, replays, strokes.
        before, calls: see `aim_straight`. final: (m, 16, 2), facts: (m, FACTS_WIDTH) int32, of the physics.
        became: (m,); rows that stay as they are because the 8 left play on the break are marked TO_REFEREE.
    """
    for k in range(rows.shape[0]):
        game, found = games[rows[k]], facts[k]
        if game[to.PHASE] == to.BREAK:
            if found[at.F_POCKETED + EIGHT] != NEVER or found[at.F_OFF_TABLE + EIGHT] != NEVER:
                became[k] = to.TO_REFEREE
                continue
            rule_break(game, found, before[k], head)
        else:
            rule_play(game, found, before[k], calls[k, 0], calls[k, 1], head)
        limit(game, limits)
        places[rows[k]] = final[k]


@inner
def shuffle(items, draws, first):
    """Put items in random order, by the draws from the first one on."""
    for i in range(items.shape[0] - 1, 0, -1):
        j = int(draws[first + i - 1] * (i + 1))
        items[i], items[j] = items[j], items[i]


@compiled
def rack(triangle, diameter, sigma, cue_ball, uniforms, normals, places):
    """Balls racked for a break (R1 to R7), each rack by its own draws.

    Args:
        triangle: (15, 2) m, the places row by row. cue_ball: (2,) m. sigma: m, standard deviation of a coordinate.
        uniforms: (m, 15) in [0, 1). normals: (m, tries, 15, 2): where two balls would touch, the next are taken; the
            exact triangle when all do.
        places: (m, 16, 2), filled.
    """
    order, others, moved = np.empty(15, np.int64), np.empty(12, np.int64), np.empty((15, 2))
    for k in range(places.shape[0]):
        draws = uniforms[k]
        solid, stripe = 1 + int(draws[0] * 7), 9 + int(draws[1] * 7)
        west_is_solid = draws[2] < 0.5
        n = 0
        for ball in range(1, at.LANES):
            if ball != EIGHT and ball != solid and ball != stripe:
                others[n] = ball
                n += 1
        shuffle(others, draws, 3)
        n = 0
        for spot in range(15):
            if spot == 4:
                order[spot] = EIGHT
            elif spot == 10:
                order[spot] = solid if west_is_solid else stripe
            elif spot == 14:
                order[spot] = stripe if west_is_solid else solid
            else:
                order[spot] = others[n]
                n += 1
        moved[:] = triangle
        for attempt in range(normals.shape[1]):
            clear = True
            for spot in range(15):
                for axis in range(2):
                    moved[spot, axis] = triangle[spot, axis] + sigma * normals[k, attempt, spot, axis]
                for other in range(spot):
                    dx, dy = moved[spot, 0] - moved[other, 0], moved[spot, 1] - moved[other, 1]
                    clear &= dx * dx + dy * dy > diameter * diameter
            if clear:
                break
            moved[:] = triangle
        places[k, 0] = cue_ball
        for spot in range(15):
            places[k, order[spot]] = moved[spot]
